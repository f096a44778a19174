"""Tables of a run: CSV files with units in their header."""

import csv
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

HEADER = re.compile(r"^\s*(?P<name>.*?)\s*(?:\[(?P<unit>[^\]]*)\])?\s*$")


class NotARun(Exception):
    """A folder, or one of its files, is not what a run writes; the message says which and what to do."""


class NoColumn(NotARun, KeyError):
    """A table lacks a column that a run writes."""

    __str__ = Exception.__str__


class Table(Mapping):
    """The columns of a CSV file by name, in the file's order; units are apart.

    table["time"] is an array (n,) of float, or of str for a column of words; table.unit("time") is "s". `name` stands in messages.
    """

    def __init__(self, columns, units=None, name="a table of the run"):
        self._columns = dict(columns)
        self._units = dict(units or {})
        self._name = name

    def __getitem__(self, name):
        if name not in self._columns:
            raise NoColumn(f"{self._name} has no column {name!r}; it has: {', '.join(self._columns) or 'none'}")
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        return f"Table({self.rows} rows: {', '.join(self._columns)})"

    @property
    def rows(self):
        """Number of rows."""
        return len(next(iter(self._columns.values()), ()))

    def unit(self, name):
        """Unit of a column as the header has it; "" where the header has none."""
        return self._units.get(name, "")

    def to_pandas(self):
        """The table as pandas.DataFrame, its units in attrs["units"]. Raises ImportError where pandas is not installed."""
        import pandas

        frame = pandas.DataFrame(self._columns)
        frame.attrs["units"] = {name: self.unit(name) for name in self}
        return frame


def is_there(path):
    """Whether a file of a run is there. Raises NotARun where something else has its name: to read a pipe would be to wait for ever."""
    if path.exists() and not path.is_file():
        raise NotARun(f"{path}: not a file, and a run writes one")
    return path.exists()


def read_table(path):
    """A CSV file whose header has names with units in brackets, such as `time [s]`. Raises NotARun for a damaged file."""
    with path.open(newline="", encoding="utf-8") as file:
        try:
            rows = [row for row in csv.reader(file) if row]
        except (csv.Error, UnicodeDecodeError) as error:
            raise NotARun(f"{path}: not a table of a run: {error}") from error
    if not rows:
        raise NotARun(f"{path}: the file is empty; a run writes a header line first")
    heads = [HEADER.match(cell) for cell in rows[0]]
    names = [head["name"] for head in heads]
    body = rows[1:]
    # The last line of a run that was killed may be cut short.
    if body and len(body[-1]) < len(names):
        body = body[:-1]
    for number, row in enumerate(body, start=2):
        if len(row) != len(names):
            raise NotARun(f"{path}:{number}: {len(row)} values where the header names {len(names)} columns")
    columns = {name: _column(cells) for name, cells in zip(names, zip(*body) if body else [()] * len(names))}
    for head in heads:
        if head["unit"] not in (None, "", "-") and columns[head["name"]].dtype.kind == "U":
            raise NotARun(f"{path}: the column {head['name']!r} has words, and numbers in {head['unit']} were expected")
    return Table(columns, {head["name"]: head["unit"] or "" for head in heads}, str(path))


def write_table(path, columns):
    """Writes a CSV file that cases can name, such as {"time [s]": times, "pressure [Pa]": pressures}; returns its path. Words stand as they are.

    Raises ValueError where the columns differ in length.
    """
    rows = zip(*columns.values(), strict=True)
    with Path(path).open("w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(columns)
        lines.writerows([value if isinstance(value, str) else repr(float(value)) for value in row] for row in rows)
    return Path(path)


def finite(value):
    """A value for JSON: numbers that are not finite become null, as in manifests."""
    if isinstance(value, dict):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [finite(item) for item in value]
    return None if isinstance(value, float) and not abs(value) < float("inf") else value


def _column(cells):
    try:
        return np.array(cells, dtype=float)
    except ValueError:
        return np.array(cells, dtype=str)
