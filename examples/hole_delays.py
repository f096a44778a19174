"""A Monte Carlo of hole delays: how the scatter of detonators changes the vibration of a round.

    python examples/hole_delays.py

One hole is computed (the case `free-face-blast`); the round is the sum of its waveform at a gauge, once for every hole at its own time. That holds
where nothing breaks, so the gauge is taken away from the hole. Detonators fire at their nominal delay plus a normal scatter.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

CASE = Path(__file__).resolve().parents[1] / "cases/free-face-blast/case.toml"


def round_velocity(seed, interval, delays):
    """Velocity of a round [m/s] (n, 3), from that of one hole (m, 3) in steps of `interval` [s] and the holes' delays [s]."""
    shifts = np.round(np.asarray(delays) / interval).astype(int)
    shifts -= shifts.min()
    total = np.zeros((len(seed) + shifts.max(), 3))
    for shift in shifts:
        total[shift : shift + len(seed)] += seed
    return total


def peaks(seed, interval, nominal, scatter, trials, generator):
    """Peak particle velocities [m/s] (trials,) with detonators that scatter by a standard deviation [s]."""
    rounds = nominal + scatter * generator.standard_normal((trials, len(nominal)))
    return np.array([np.linalg.norm(round_velocity(seed, interval, delays), axis=1).max() for delays in rounds])


def main(out=None, end=5e-4, holes=8, spacing=1e-4, trials=1000):
    """Prints the peaks of a round for scatters from none to the spacing of the delays; returns them by scatter."""
    with tempfile.TemporaryDirectory() as temporary:
        one = sazare.run(CASE, out or Path(temporary) / "one", overrides={"time.end": end}, overwrite=True, progress=False)
        gauge = max(one.gauges.values(), key=lambda each: -each.ppv)
    generator, found = np.random.default_rng(1), {}
    print(f"one hole: {gauge.ppv:.3g} m/s at gauge {gauge.name}")
    for scatter in (0.0, 0.1 * spacing, 0.3 * spacing, spacing):
        found[scatter] = peaks(gauge.velocity, gauge.time[1], spacing * np.arange(holes), scatter, trials, generator)
        low, middle, high = np.percentile(found[scatter], [5, 50, 95])
        print(f"scatter {1e6 * scatter:5.1f} us: {middle:.3g} m/s, 90 % of the rounds between {low:.3g} and {high:.3g} m/s")
    return found


if __name__ == "__main__":
    sys.exit(main() is None)
