"""Rows of the block: what an element costs when there are more and more of them."""

import math

import scenes
from table import Limit, NotChosen, Peer, Row

SMALLEST = scenes.BLOCK_SIZES[0]
MEMORY_FROM = 100_000  # elements; below, the program itself is the larger part


def run_of(bench, size):
    """The measurement of a block. Raises NotRun or NotChosen."""
    if size.elements > bench.options.largest:
        raise NotChosen(f"--largest is {bench.options.largest}")
    return bench.run(scenes.block(size))


def size_rows(size):
    """The rows of one size."""

    def of_run(function):
        return lambda bench: function(run_of(bench, size))

    def rate(bench):
        return run_of(bench, size).evaluations_per_second, run_of(bench, SMALLEST).evaluations_per_second

    name = f"blocks/ourselves-block-{size.label}"
    return [
        Row(f"{name}-elements", "elements", "-", of_run(lambda run: run.figures["elements"])),
        Row(f"{name}-joints", "joints", "-", of_run(lambda run: run.figures["joints"])),
        Row(f"{name}-memory", "resident memory per element", "B", of_run(lambda run: run.bytes_per_element),
            limit=Limit("ours", high=2000) if size.elements >= MEMORY_FROM else None),
        Row(f"{name}-rate", "pair evaluations per second of the steps, 1 thread", "1/s", rate,
            Peer(f"ourselves, block of {SMALLEST.label}"), more_is_better=True),
        Row(f"{name}-setup", "setup per element", "s", of_run(lambda run: run.setup_per_element)),
    ]


def cost_exponent(bench):
    """The slope of elements times seconds per evaluation over elements, both logarithmic, through all sizes."""
    sizes = [size for size in scenes.BLOCK_SIZES if size.elements <= bench.options.largest]
    if len(sizes) < 2:
        raise NotChosen("needs two sizes; --largest leaves fewer")
    runs = [run_of(bench, size) for size in sizes]
    x = [math.log(run.figures["elements"]) for run in runs]
    y = [math.log(run.figures["elements"] / run.evaluations_per_second) for run in runs]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y)) / sum((a - mean_x) ** 2 for a in x)


def rows():
    """All rows of the block."""
    of_sizes = [row for size in scenes.BLOCK_SIZES for row in size_rows(size)]
    return of_sizes + [Row("blocks/ourselves-block-exponent", "cost grows as the number of elements to this power", "-",
                           cost_exponent, limit=Limit("ours", high=1.1))]
