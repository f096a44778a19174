"""The ground and the runs that Sazare, pyStrata and the differences have in common."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
RECORD = HERE.parents[2] / "cases/column-nonlinear/el-centro-1940-ns.AT2"
GRAVITY = 9.80665  # m/s2
HEIGHT, DENSITY, S_VELOCITY, REFERENCE = 20.0, 1800.0, 150.0, 1e-3  # m, kg/m3, m/s, -
ROCK_DENSITY, ROCK_VELOCITY = 2200.0, 636.3961030678928  # kg/m3, m/s
DURATION, FADE = 12.0, 2.0  # s of the record, over the last ones of which it fades out
PERIODS = np.geomspace(0.05, 4.0, 60)  # s
DAMPING, CORNERS = 0.02, (1.0, 10.0)  # Rayleigh damping: ratio, and frequencies of it [Hz]


@dataclass(frozen=True)
class Run:
    """scale: of the record; rayleigh: whether the soil has Rayleigh damping of DAMPING at CORNERS."""

    scale: float
    rayleigh: bool = False


RUNS = {"weak": Run(0.0005), "damped": Run(0.0005, True), "moderate": Run(0.02), "strong": Run(0.3)}


def samples():
    """Step [s] and acceleration [m/s2] of the outcrop: the record, which fades out."""
    lines = RECORD.read_text(encoding="utf-8").splitlines()
    step = float(lines[3].split("DT=")[1].split()[0])
    times = step * np.arange(round(DURATION / step) + 1)
    record = GRAVITY * np.array(" ".join(lines[4:]).split(), dtype=float)[: len(times)]
    return step, record * 0.5 * (1.0 - np.cos(np.pi * np.clip((DURATION - times) / FADE, 0.0, 1.0)))


def outcrop(step):
    """Acceleration of the outcrop [m/s2] at times that are `step` [s] apart: straight lines between the samples."""
    given, values = samples()
    return np.interp(step * np.arange(round(DURATION / step) + 1), given * np.arange(len(values)), values)


def rayleigh_ratio(frequency):
    """Damping ratio [-] at frequencies [Hz]; 0 at 0 Hz, and 0.4 where it were more, below 0.05 Hz."""
    low, high = CORNERS
    f = np.maximum(frequency, 1e-6)
    return np.minimum(np.where(frequency > 0.0, DAMPING * (low * high / f + f) / (low + high), 0.0), 0.4)
