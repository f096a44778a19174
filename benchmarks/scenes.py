"""The scenes: which case with which settings, and on how many threads or ranks."""

from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Scene:
    """A case as one run of the command carries it out."""

    name: str
    case: str  # from the repository's root
    settings: tuple = ()  # "table.key=value"
    threads: int = 1
    ranks: int = 1
    mesh: tuple = ()  # (geometry, name, value) of a mesh to be made for it; the case then reads that mesh
    long: bool = False  # only when asked for

    def on(self, threads):
        """This scene with a number of threads."""
        return replace(self, name=f"{self.name}-{threads}-threads", threads=threads)

    def on_ranks(self, ranks):
        """This scene as several processes."""
        return replace(self, name=f"{self.name}-{ranks}-ranks", ranks=ranks)

    def with_settings(self, name, *settings, long=False):
        """This scene under another name, with more settings."""
        return replace(self, name=name, settings=self.settings + settings, long=long)


SLAB_END = 5e-4  # of cases/free-face-blast [s]
SLAB = Scene("slab-stability", "cases/free-face-blast/case.toml")
SLAB_UNIFORM = SLAB.with_settings("slab-uniform", "time.levels=uniform", "time.limiter=none", "time.base_step=1e-8")
# The paper lets neighbours differ by any number of levels.
SLAB_TRAVEL = SLAB.with_settings("slab-travel", "time.limiter=travel", "time.base_step=1e-8", "time.travel_length=1e-8",
                                 "time.neighbor_levels=20")
SLAB_SMALLEST = SLAB_TRAVEL.with_settings("slab-smallest", "time.levels=uniform", long=True)
FULL = Scene("full-stability", "cases/free-face-blast-full/case.toml")


@dataclass(frozen=True)
class BlockSize:
    """A cube of about `elements` elements: its side [m], and the simulated time [s], shorter the larger it is."""

    label: str
    elements: int
    side: float
    end: float


BLOCK_SIZES = (
    BlockSize("1k", 1_000, 0.29, 1e-4),
    BlockSize("10k", 10_000, 0.64, 2e-5),
    BlockSize("100k", 100_000, 1.40, 4e-6),
    BlockSize("1m", 1_000_000, 3.01, 2e-6),
)


def block(size):
    """The scene of a block of that size; histories and snapshots are written at the beginning and the end only."""
    times = tuple(f"time.{key}={size.end}" for key in ("end", "history_interval", "snapshot_interval"))
    return Scene(f"block-{size.label}", "benchmarks/scenes/block.toml", times,
                 mesh=("benchmarks/scenes/block.geo", "side", size.side))
