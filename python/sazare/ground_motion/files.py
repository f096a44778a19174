"""Tables that belong to a record: layers of a column, target spectra, and the spectra that are written."""

from pathlib import Path

from sazare.ground_motion.column import Column, Layer
from sazare.ground_motion.record import GAL, GRAVITY
from sazare.tables import NotARun, read_table, write_table

ACCELERATIONS = {"m/s2": 1.0, "g": GRAVITY, "gal": GAL, "cm/s2": GAL}
SPECTRUM_HELP = 'the header is "period [s],acceleration [m/s2]"; g, gal and cm/s2 are read too'
COLUMN = {"thickness": "m", "density": "kg/m3", "s_wave_velocity": "m/s", "damping_ratio": "-"}
COLUMN_HELP = 'the header is "' + ",".join(f"{name} [{unit}]" for name, unit in COLUMN.items()) + '"; the last row is the half-space, with the thickness inf'


def _table(path, names, advice):
    """A CSV file with just these columns, all of numbers. Raises ValueError."""
    path = Path(path)
    if not path.is_file():
        raise ValueError(f"{path}: there is no such file")
    try:
        table = read_table(path)
    except NotARun as error:
        raise ValueError(f"{error}\nhelp: {advice}") from error
    if list(table) != list(names):
        raise ValueError(f"{path}: the columns are {', '.join(table)}\nhelp: {advice}")
    for name in names:
        if table.rows and table[name].dtype.kind != "f":
            raise ValueError(f"{path}: the column {name} holds something that is no number\nhelp: {advice}")
    return table


def read_target_spectrum(path):
    """A target spectrum: periods [s] (n,) and accelerations [m/s2] (n,). Raises ValueError for a file that is none."""
    table = _table(path, ("period", "acceleration"), SPECTRUM_HELP)
    unit = table.unit("acceleration")
    if table.unit("period") != "s" or unit not in ACCELERATIONS:
        raise ValueError(f"{path}: the units are {table.unit('period') or 'missing'} and {unit or 'missing'}\nhelp: {SPECTRUM_HELP}")
    return table["period"], ACCELERATIONS[unit] * table["acceleration"]


def read_column(path):
    """The Column of a CSV of layers from the surface down. Raises ValueError for a file that is none, with the row of a wrong layer."""
    table = _table(path, COLUMN, COLUMN_HELP)
    for name, unit in COLUMN.items():
        if table.unit(name) != unit:
            raise ValueError(f"{path}: the unit of {name} is {table.unit(name) or 'missing'}, but must be {unit}\nhelp: {COLUMN_HELP}")
    layers = []
    for number, row in enumerate(zip(*(table[name] for name in COLUMN)), start=2):
        try:
            layers.append(Layer(*(float(value) for value in row)))
        except ValueError as error:
            raise ValueError(f"{path}:{number}: {error}\nhelp: {COLUMN_HELP}") from error
    try:
        return Column(layers)
    except ValueError as error:
        raise ValueError(f"{path}: {error}\nhelp: {COLUMN_HELP}") from error


def write_spectra(path, spectra):
    """Writes response spectra of one record and the same periods, one after the other by damping ratio; returns the path."""
    columns = {"period [s]": spectra[0].period}
    for spectrum in spectra:
        mark = f"h={spectrum.damping:g} "
        columns |= {
            f"{mark}displacement [m]": spectrum.displacement,
            f"{mark}velocity [m/s]": spectrum.velocity,
            f"{mark}pseudo_velocity [m/s]": spectrum.pseudo_velocity,
            f"{mark}pseudo_acceleration [m/s2]": spectrum.pseudo_acceleration,
            f"{mark}absolute_acceleration [m/s2]": spectrum.absolute_acceleration,
        }
    return write_table(path, columns)

