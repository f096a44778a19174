"""Whether breaking is over at the end of a run, and whether gas still works."""

from dataclasses import dataclass

import numpy as np

LAST = 0.1  # part of the run that is looked at
STILL = 0.01  # share of the broken joints, or of the work of the gas, that comes in this last part where it is not over


@dataclass(frozen=True)
class Breaking:
    """broken: share of all broken joints that broke in the last tenth of the run. worked: share of the work of a charge that its gas did then, the largest
    of any, None without charges. pressure [Pa]: the largest of any charge at the end. Some are None where the run did not write them."""

    broken: float | None
    worked: float | None
    pressure: float | None

    @property
    def rate(self):
        """Share of the broken joints per duration of the run: 1 where they break evenly from the beginning to the end."""
        return None if self.broken is None else self.broken / LAST

    @property
    def is_over(self):
        """Whether neither joints break nor gas works any more."""
        return (self.broken or 0.0) <= STILL and (self.worked or 0.0) <= STILL


def breaking_of(results):
    """The Breaking of a run by its history."""
    history = results.history
    if history.rows < 2:
        return Breaking(None, None, None)
    charges = [name.removesuffix(".pressure") for name in history if name.endswith(".pressure")]
    worked = [_last_part(history, f"{name}.work") for name in charges if f"{name}.work" in history]
    pressures = [float(history[f"{name}.pressure"][-1]) for name in charges]
    broken = _last_part(history, "broken_joints") if "broken_joints" in history else None
    return Breaking(broken, max(worked, default=None), max(pressures, default=None))


def _last_part(history, name):
    """Share of what a column has gained that it gained in the last part of the run; 0 where it gained nothing."""
    time, values = history["time"], history[name]
    gained = values[-1] - values[0]
    before = np.interp(time[-1] - LAST * (time[-1] - time[0]), time, values)
    return float((values[-1] - before) / gained) if gained > 0.0 else 0.0
