"""Rows of the slab, cases/free-face-blast to 5e-4 s: the one problem whose cost the paper and a plain calculation tell."""

import scenes
from table import Limit, NotRun, Peer, Row

PLAIN = "plain one-file calculation, 1 core"
PAPER = "paper, 1 processor"
MINUTES = 60.0
SAME_BROKEN = Limit("ratio", 0.99, 1.01)


def wall(scene):
    """Wall-clock time of a scene [s]."""
    return lambda bench: bench.run(scene).wall_seconds


def wall_against(scene, other):
    """Wall-clock times of a scene and of another one, both ours [s]."""
    return lambda bench: (bench.run(scene).wall_seconds, bench.run(other).wall_seconds)


def figure(scene, name):
    """A figure of the scene's manifest."""
    return lambda bench: bench.run(scene).figures[name]


def output_share(scene):
    """Share of the wall-clock time that timing.csv has for output and checkpoints."""
    return lambda bench: bench.run(scene).output_share


def output_processor_share(scene):
    """Share of the processor time that a run without rows and snapshots between beginning and end does not need."""

    def measure(bench):
        base_step = scenes.SLAB_END / bench.run(scene).figures["steps"]
        silent = scene.with_settings(f"{scene.name}-silent", f"time.base_step={base_step!r}",
                                     *(f"time.{key}_interval={scenes.SLAB_END}" for key in ("history", "snapshot")))
        full, other = bench.run_in_turns(scene, silent)
        return 1 - other.processor_seconds / full.processor_seconds

    return measure


def evaluations_saved(scene):
    """Pair evaluations of a scene, and of all its elements at the smallest step of any."""

    def measure(bench):
        figures = bench.run(scene).figures
        return figures["pair_evaluations"], figures["uniform_evaluations"]

    return measure


def displacement_difference(scene, other):
    """Root mean square of the difference between the last displacements of two scenes, over that of the second."""

    def measure(bench):
        try:
            import numpy
            from sazare.results import open_run
        except ImportError as error:
            raise NotRun(f"{error}; `make setup` installs the Python package") from error

        def last(folder):
            cells = open_run(folder).snapshots[-1].elements.cell_data
            return cells["displacement"][numpy.argsort(cells["element"])]

        ours, peer = (last(bench.run(which).folder) for which in (scene, other))
        return float(numpy.linalg.norm(ours - peer) / numpy.linalg.norm(peer))

    return measure


def stability_rows():
    """The engine's own limiter."""
    slab, uniform, two = scenes.SLAB, scenes.SLAB_UNIFORM, scenes.SLAB.on(2)
    return [
        Row("blocks/plain-slab-stability", "wall time, stability limiter, 1 thread", "s", wall(slab), Peer(PLAIN, 3.1),
            Limit("ours", high=1.5)),
        Row("blocks/plain-slab-stability-broken", "broken joints", "-", figure(slab, "broken_joints"), Peer(PLAIN, 418),
            SAME_BROKEN),
        Row("blocks/plain-slab-stability-displacements", "rms difference of displacements from uniform 1e-8 s, relative",
            "-", displacement_difference(slab, uniform), Peer(PLAIN, 1.1e-3), Limit("ours", high=0.002)),
        Row("blocks/ourselves-slab-stability", "wall time per element, against uniform 1e-8 s", "s",
            wall_against(slab, uniform), Peer("ourselves, uniform 1e-8 s")),
        Row("blocks/ourselves-slab-threads", "wall time on 2 threads, against 1", "s", wall_against(two, slab),
            Peer("ourselves, 1 thread")),
        Row("blocks/paper-slab-stability", "wall time, stability limiter, 1 thread", "s", wall(slab),
            Peer(PAPER, 2702 * MINUTES)),
        Row("blocks/paper-slab-stability-threads", "wall time, stability limiter, 2 threads", "s", wall(two),
            Peer("paper, 24 processors", 340 * MINUTES)),
        Row("blocks/ourselves-slab-output", "share of wall time in histories, energy balance, snapshots, checkpoints", "-",
            output_share(slab), limit=Limit("ours", high=0.05)),
        Row("blocks/ourselves-slab-output-processor", "share of processor time that a silent run does not need", "-",
            output_processor_share(slab), limit=Limit("ours", high=0.05)),
        Row("blocks/plain-slab-uniform", "wall time, uniform 1e-8 s, 1 thread", "s", wall(uniform), Peer(PLAIN, 12)),
        Row("blocks/plain-slab-uniform-broken", "broken joints", "-", figure(uniform, "broken_joints"), Peer(PLAIN, 418),
            SAME_BROKEN),
    ]


def travel_rows():
    """The paper's limiter: no element travels more than 1e-8 m in a step."""
    travel, smallest = scenes.SLAB_TRAVEL, scenes.SLAB_SMALLEST
    return [
        Row("blocks/plain-slab-travel", "wall time, paper's limiter, 1 thread", "s", wall(travel), Peer(PLAIN, 119),
            Limit("ours", high=60)),
        Row("blocks/plain-slab-travel-broken", "broken joints", "-", figure(travel, "broken_joints"), Peer(PLAIN, 418),
            SAME_BROKEN),
        Row("blocks/ourselves-slab-travel-evaluations", "pair evaluations, against the smallest step for all", "-",
            evaluations_saved(travel), Peer("ourselves, uniform"), Limit("ratio", low=6)),
        Row("blocks/paper-slab-travel", "wall time, paper's limiter, 1 thread", "s", wall(travel),
            Peer(PAPER, 2702 * MINUTES)),
        Row("blocks/plain-slab-smallest", "wall time, the smallest step for all, 1 thread", "s", wall(smallest),
            Peer(PLAIN, 820)),
        Row("blocks/paper-slab-smallest", "wall time, the smallest step for all, 1 thread", "s", wall(smallest),
            Peer(PAPER, 3897 * MINUTES)),
        Row("blocks/ourselves-slab-travel", "wall time per element, against the smallest step for all", "s",
            wall_against(travel, smallest), Peer("ourselves, uniform")),
    ]


def rows():
    """All rows of the slab."""
    return stability_rows() + travel_rows()
