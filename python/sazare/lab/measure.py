"""What is measured while a specimen is loaded."""

import numpy as np

from sazare.lab.trials import PICTURES, ROWS
from sazare.tables import write_table

BROKEN = 0.5  # share of the largest stress at which a specimen counts as broken
STEADY = 4  # rows for which the stress must have stayed below that
LOADED = 0.3  # share of the expected stress below which nothing has broken yet
LOOKS = ROWS // PICTURES  # rows between two looks at the stress: the last one has a snapshot


class Extensometer:
    """Mean strains of the middle half of a specimen that stands on 0, from displacements of its blocks: the linear displacement field that fits
    them best."""

    def __init__(self, positions, axis, length):
        self._inside = np.abs(positions[:, axis] - 0.5 * length) <= 0.25 * length
        self._first = positions[self._inside].copy()
        middle = self._first.mean(axis=0)
        self._fit = np.linalg.pinv(np.column_stack([np.ones(len(self._first)), self._first - middle]))
        self._axis = axis

    def read(self, positions):
        """Strain along the axis and mean strain across it, extension positive."""
        gradient = (self._fit @ (positions[self._inside] - self._first))[1:]
        across = [gradient[i, i] for i in range(3) if i != self._axis]
        return gradient[self._axis, self._axis], 0.5 * sum(across)


class Watch:
    """Reads the extensometer at every row of the history, and ends the run when the specimen has broken."""

    def __init__(self, trial, simulation):
        self._trial = trial
        self._extensometer = Extensometer(simulation.positions, trial.specimen.axis, trial.specimen.length) if trial.measures_strain else None
        self._rows = 0
        self.strains = {0.0: (0.0, 0.0)}

    def __call__(self, simulation):
        """Whether the run may end."""
        if self._extensometer:
            self.strains[simulation.time] = self._extensometer.read(simulation.positions)
        self._rows += 1
        if self._rows % LOOKS or not self._trial.ends_when_broken:
            return False
        stress = stress_of(self._trial, simulation.results.history) - self._trial.pressure
        largest = stress.max(initial=0.0)
        return bool(largest > LOADED * (self._trial.expected_stress - self._trial.pressure) and (stress[-STEADY:] < BROKEN * largest).all())


def force_of(trial, history, surfaces):
    """Force [N] of platens along the axis of the test, positive in the direction in which it loads."""
    axis = "xyz"[trial.specimen.axis]
    return trial.sense * sum(history[f"{name}.force_{axis}"] for name in surfaces)


def stress_of(trial, history):
    """The stress [Pa] that a test measures: force of the moving platen over the area of the specimen."""
    return force_of(trial, history, trial.specimen.top) / trial.specimen.area


def curve_of(trial, history, strains):
    """Columns of curve.csv: time, stress, strain of the platens and, in the middle of a cylinder, axial, lateral and volumetric strain.

    Strains across and of volume are positive for extension, except for the axial one, which is positive in the direction of loading.
    """
    time = history["time"]
    columns = {
        "time [s]": time,
        "stress [Pa]": stress_of(trial, history),
        "opposite_stress [Pa]": -force_of(trial, history, trial.specimen.bottom) / trial.specimen.area,
        "displacement [m]": trial.displacement(time),
        "platen_strain [-]": trial.displacement(time) / trial.specimen.length,
    }
    if trial.measures_strain:
        when = np.array(list(strains))
        axial, lateral = (np.interp(time, when, [pair[i] for pair in strains.values()]) for i in (0, 1))
        columns |= {"axial_strain [-]": trial.sense * axial, "lateral_strain [-]": lateral, "volumetric_strain [-]": axial + 2.0 * lateral}
    return columns | {"broken_joints [-]": history["broken_joints"]}


def write_curve(path, trial, history, strains):
    """Writes curve.csv; returns its columns by name without units."""
    columns = curve_of(trial, history, strains)
    write_table(path, columns)
    return {name.split(" ")[0]: values for name, values in columns.items()}
