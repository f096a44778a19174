"""Rows of the whole specimen, cases/free-face-blast-full to 5e-4 s: three-dimensional, about 16 000 elements."""

import scenes
from slab_rows import output_share, wall
from table import Limit, NotRun, Peer, Row

MONTH = 30 * 86400.0


def thread_speed(bench):
    """Wall-clock times of the steps on two threads and on one [s]; making the mesh is not among them."""
    one, two = bench.run(scenes.FULL), bench.run(scenes.FULL.on(2))
    if one.state_hash != two.state_hash:
        raise NotRun("the states at the end differ between 1 and 2 threads")
    return two.engine_seconds, one.engine_seconds


def rank_speed(bench):
    """Wall-clock times on two ranks and on one, without making the mesh [s]."""
    one, two = bench.run(scenes.FULL), bench.run(scenes.FULL.on_ranks(2))
    if one.state_hash != two.state_hash:
        raise NotRun("the states at the end differ between 1 and 2 ranks")
    return two.wall_seconds - two.parts["setup"], one.wall_seconds - one.parts["setup"]


def rows():
    """All rows of the whole specimen."""
    two = scenes.FULL.on(2)
    return [
        Row("blocks/paper-full-stability", "wall time, stability limiter, 2 threads", "s", wall(two),
            Peer("paper, 1 processor: over a month", MONTH), Limit("ours", high=60)),
        Row("blocks/ourselves-full-threads", "wall time of the steps on 2 threads, against 1", "s", thread_speed,
            Peer("ourselves, 1 thread"), Limit("ratio", low=1.7)),
        Row("blocks/ourselves-full-ranks", "wall time without set-up on 2 ranks, against 1", "s", rank_speed,
            Peer("ourselves, 1 rank"), Limit("ratio", low=1.6)),
        Row("blocks/ourselves-full-output", "share of wall time in histories, energy balance, snapshots, checkpoints", "-",
            output_share(two), limit=Limit("ours", high=0.05)),
        Row("blocks/ourselves-full-memory", "resident memory per element", "B",
            lambda bench: bench.run(two).bytes_per_element),
    ]
