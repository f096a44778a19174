"""Sazare in Python: run cases, read their results as arrays and meshes, draw them, report them.

    import sazare
    results = sazare.run("cases/column-ricker/case.toml", "runs/column")
    results.history["time"], results.gauges["top"].ppv

    simulation = sazare.build("cases/column-ricker/case.toml")
    simulation.advance(0.5)
    simulation.positions, simulation.velocities, simulation.forces

    sazare.open("runs/column").all_snapshots.at(1.0).mesh.plot()

Modules are loaded on first use, so that the import is fast.
"""

import importlib
import os

_HOMES = {
    "sazare.results": ("Gauge", "Results", "open_run"),
    "sazare.snapshots": ("Snapshot", "Snapshots"),
    "sazare.tables": ("NotARun", "Table", "write_table"),
    "sazare.comparison": ("Comparison", "compare"),
    "sazare.model": ("draw_model",),
    "sazare.simulation": ("Simulation", "build", "check", "run"),
    "sazare.cases": ("Case", "case_from_text", "read_case"),
    "sazare._engine": ("MachineError", "PhysicsError", "UserError"),
    "sazare.report": ("write_report",),
}
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = ["open", *_HOME_OF]  # noqa: PLE0604 - they are loaded by __getattr__

# In a source tree the engine lies in the build.
_BUILT = os.path.join(os.path.dirname(os.path.dirname(os.path.dirname(__file__))), "build", "release", "python", "sazare")
if os.path.isdir(_BUILT):
    __path__.append(_BUILT)


def open(path):
    """Opens the folder of a run, which stays the same where the script changes its own folder. Raises NotARun, saying why, where it is not
    one."""
    from sazare.results import open_run

    return open_run(os.path.abspath(path))


def __getattr__(name):
    if name == "__version__":
        from sazare.engine import engine

        return engine().version
    home = _HOME_OF.get(name)
    if home is None:
        raise AttributeError(f"module 'sazare' has no attribute {name!r}")
    if home == "sazare._engine":
        from sazare.engine import engine

        return getattr(engine(), name)
    return getattr(importlib.import_module(home), name)


def __dir__():
    return sorted({*globals(), *__all__})
