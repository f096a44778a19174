"""Functions of time that a case leaves to its caller, as the engine takes them: samples at every step, ahead of the simulated time."""

import math

from sazare.engine import engine


class History:
    """One function of a run, whose step [s] it has. `begin` is the time [s] of the run at which its own is 0."""

    def __init__(self, name, function, begin, step):
        self._name, self._function = name, function
        self._begin, self._step = begin, step
        self._count = 0

    def sample(self, live, step):
        """Hands the engine the samples it needs to reach a step. Raises what the function raises; ValueError where a value is not finite."""
        # A sample beyond the present one, so that what lies between two of them never depends on how far they are known.
        wanted = math.floor(step - self._begin / self._step) + 3
        values = []
        for number in range(self._count, wanted):
            time = number * self._step
            value = float(self._function(time))
            if not math.isfinite(value):
                raise ValueError(f'the function "{self._name}" gives {value} at {time} s')
            values.append(value)
        if values:
            live.add_samples(self._name, self._step, values)
            self._count += len(values)


def histories_of(live, functions):
    """The histories of a run, from the caller's functions by name. Raises UserError where one is missing or unknown to the case."""
    asked = dict(live.functions)
    for name in asked:
        if name not in functions:
            raise engine().UserError(f'the case leaves "{name}" to its caller: give functions={{"{name}": ...}}, a function of time')
    for name in functions:
        if name not in asked:
            known = ", ".join(f'"{each}"' for each in asked) or "none"
            raise engine().UserError(f'the case asks for no function "{name}"; it asks for: {known}')
    step = live.end / live.steps
    return [History(name, functions[name], begin, step) for name, begin in asked.items()]
