"""Tables that people write: CSV files with names and units in the first line, each of whose errors is told with its line."""

import csv
import math
from dataclasses import dataclass, field

from sazare.tables import HEADER

IN_SI = {
    "mm": ("m", 1e-3), "cm": ("m", 1e-2), "in": ("m", 0.0254), "ft": ("m", 0.3048), "us": ("s", 1e-6), "ms": ("s", 1e-3),
    "g/cm3": ("kg/m3", 1e3), "t/m3": ("kg/m3", 1e3), "km/s": ("m/s", 1e3), "MJ/kg": ("J/kg", 1e6), "kJ/kg": ("J/kg", 1e3), "GPa": ("Pa", 1e9), "MPa": ("Pa", 1e6),
}  # units that a header may have in place of those of SI, and their size

LARGEST = {
    "m": 1e8, "s": 3600.0, "kg/m3": 1e5, "m/s": 1e6, "J/kg": 1e9, "Pa": 1e13, "N/m": 1e9, "deg": 360.0, "m2/m3": 1e3, "1/m": 1e3, "-": 1e16,
}  # by unit: no number of such a table is larger, but by a slip; coordinates of surveys are

TRUTH = {"true": True, "yes": True, "false": False, "no": False}


@dataclass
class Problems:
    """What is wrong with a file, collected so that all of it is told at once."""

    path: object
    found: list[str] = field(default_factory=list)

    def error(self, line, what, help_):
        """Notes an error in a line."""
        self.found.append(f"{self.path}:{line}: error: {what}\n      help: {help_}")

    def tell(self):
        """Raises ValueError with all errors, if there are any."""
        if self.found:
            raise ValueError("\n".join(self.found))


@dataclass(frozen=True)
class Row:
    """A line of a table: its number in the file, and what its cells hold, without those that are empty."""

    line: int
    cells: dict


def read_sheet(path, units, needed, problems, limits={}):
    """The rows of a table.

    units: by the name of every column that there may be, the unit in which its numbers are wanted; "" for a column of words, "-" for numbers without a unit.
    needed: columns whose cells may not be empty. limits: least and largest number of a column, in its unit, where those of LARGEST are not enough. Numbers in units of IN_SI are converted by what the header says.

    Raises ValueError for a file that is no such table. Cells that are wrong are told to `problems`, and left out of their row.
    """
    lines = _lines(path)
    first, names = lines[0]
    columns = _columns(path, first, names, units)
    for name in needed:
        if name not in [column for column, _ in columns]:
            problems.error(first, f"there is no column {name}", f"the table needs the columns {', '.join(needed)}")
    problems.tell()
    if len(lines) == 1:
        raise ValueError(f"{path}:{first}: error: the table has no rows\n      help: below the names of the columns write a line for each")
    rows = [_row(line, cells, columns, units, needed, problems) for line, cells in lines[1:]]
    for row in rows:
        _refuse_beyond(row, units, limits, problems)
    return rows


def _lines(path):
    """Line numbers and cells of all lines that are not empty; those that begin with # are comments."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file)
            lines = [(reader.line_num, [cell.strip() for cell in cells]) for cells in reader if any(cell.strip() for cell in cells)]
    except OSError as error:
        raise OSError(f"{path}: cannot be read: {error.strerror}") from error
    except (csv.Error, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: error: this is not a table of text: {error}\n      help: save it as CSV with commas, in UTF-8") from error
    lines = [(line, cells) for line, cells in lines if not cells[0].startswith("#")]
    if not lines:
        raise ValueError(f"{path}: error: the file is empty\n      help: its first line has the names of the columns, such as hole,collar_x [m]")
    return lines


def _columns(path, line, names, units):
    """Name and factor to SI of each column."""
    columns = []
    for head in names:
        name, unit = HEADER.match(head).group("name", "unit")
        if name not in units:
            split = "; the columns are separated by commas" if ";" in head or "\t" in head else ""
            raise ValueError(f"{path}:{line}: error: there is no column {name!r} in such a table\n      help: columns are {', '.join(units)}{split}")
        if name in [column for column, _ in columns]:
            raise ValueError(f"{path}:{line}: error: the column {name} stands there twice\n      help: keep one of them")
        columns.append((name, _factor(path, line, name, unit, units[name])))
    return columns


def _factor(path, line, name, unit, wanted):
    if unit in (None, wanted) or (wanted in ("", "-") and unit in ("", "-")):
        return 1.0
    known, factor = IN_SI.get(unit, (None, None))
    if known == wanted != "":
        return factor
    others = [other for other, (si, _) in IN_SI.items() if si == wanted]
    right = " or ".join(f"[{possible}]" for possible in [wanted, *others]) if wanted not in ("", "-") else "none"
    raise ValueError(f"{path}:{line}: error: {name} cannot have the unit [{unit}]\n      help: its unit is {right}")


def _row(line, cells, columns, units, needed, problems):
    """A row; of cells that are missing or wrong the problems are told."""
    if len(cells) != len(columns):
        problems.error(line, f"{len(cells)} values where the first line names {len(columns)} columns", "leave a cell empty where there is nothing to say, but keep its comma")
        return Row(line, {})
    found = {}
    for (name, factor), text in zip(columns, cells):
        if not text:
            if name in needed:
                problems.error(line, f"{name} is empty", "every row needs it")
            continue
        value = text if units[name] == "" else _number(text)
        if value is None:
            problems.error(line, f"{name} is {text!r}, which is no number", "write numbers with a point, such as 0.089, and units in the first line")
        else:
            found[name] = value if units[name] == "" else value * factor
    return Row(line, found)


def _refuse_beyond(row, units, limits, problems):
    for name, value in row.cells.items():
        if isinstance(value, float):
            most = LARGEST.get(units[name], math.inf)
            low, high = limits.get(name, (-most, most))
            unit = f" {units[name]}" if units[name] not in ("", "-") else ""
            if not low <= value <= high:
                bounds = f"at most {high:g}" if low == -high and value > high else f"{low:g} to {high:g}"
                problems.error(row.line, f"{name} is {value:g}{unit}", f"it is {bounds}{unit}" + ("; is its unit in the first line?" if unit else ""))


def truth(row, name, problems, help_):
    """Whether a cell of words says yes or no; None, and a problem told, for one that says neither."""
    word = row.cells[name].lower()
    if word not in TRUTH:
        problems.error(row.line, f"{name} is {row.cells[name]!r}, which is neither true nor false", help_)
    return TRUTH.get(word)


def _number(text):
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None
