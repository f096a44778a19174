"""The compiled engine, `sazare._engine`, loaded on first use."""

import os
import sys
from functools import cache


@cache
def engine():
    """The module `sazare._engine`. Raises ImportError, saying what to do, where it was not built."""
    # Idle threads spin for a moment only, as in the command: OpenMP reads this when the engine is loaded.
    if "OMP_WAIT_POLICY" not in os.environ:
        os.environ.setdefault("GOMP_SPINCOUNT", "10000")
    try:
        from sazare import _engine
    except ModuleNotFoundError as error:
        raise ImportError(
            "the engine of Sazare is not built for this Python "
            f"({sys.version_info.major}.{sys.version_info.minor}): run make build in the source tree, or pip install ."
        ) from error
    for name in ("UserError", "PhysicsError", "MachineError"):
        getattr(_engine, name).__module__ = "sazare"
    return _engine
