"""Sazare in Python: open the folder of a run, read it as arrays and meshes, draw it, report it.

    import sazare
    run = sazare.open("build/demo")
    run.manifest["results"]["broken_joints"]
    run.history["time"], run.history["broken_joints"]
    run.snapshots.at(2.5e-4).elements.plot(scalars="speed")
"""

from sazare.results import Gauge, NotARun, Results, Snapshot, Snapshots, Table, open_run

__all__ = ["Gauge", "NotARun", "Results", "Snapshot", "Snapshots", "Table", "open", "open_run"]

open = open_run
