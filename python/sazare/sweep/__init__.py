"""Families of runs of one case, of any method: every combination of some values of some keys, as one table and picture.

    from sazare.sweep import Parameter, Sweep

    sweep = Sweep("cases/crater-test/case.toml", [Parameter("charges.0.top", ("0.5", "1.0", "1.5"))], "runs/depths")
    sweep.run(jobs=2)
    sweep.table()   # columns by name: run, the parameters, status, figures of the manifests
"""

from sazare.sweep.family import Parameter, Sweep, parameter_of

__all__ = ["Parameter", "Sweep", "parameter_of"]
