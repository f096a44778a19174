"""The table of results: its rows, their limits, and the files they are kept in."""

import csv
from dataclasses import dataclass, field
from typing import Callable

COLUMNS = ("id", "quantity", "unit", "ours", "peer", "peer_value", "ratio", "limit")
NOT_RUN = "not run: "


class NotRun(Exception):
    """Why a row has no value."""


class NotChosen(NotRun):
    """Which option would have it measured."""


@dataclass(frozen=True)
class Limit:
    """What a column, `ours` or `ratio`, must hold to."""

    column: str
    low: float | None = None
    high: float | None = None

    def __str__(self):
        if self.low is None:
            return f"{self.column} <= {self.high:g}"
        if self.high is None:
            return f"{self.column} >= {self.low:g}"
        return f"{self.low:g} <= {self.column} <= {self.high:g}"

    def holds(self, value):
        """Whether the column's value is within the limit; a value that is undefined is not."""
        return value is not None and (self.low is None or value >= self.low) and (self.high is None or value <= self.high)


@dataclass(frozen=True)
class Peer:
    """Whom a row is compared with; `value` where it is known beforehand, otherwise it is measured beside ours."""

    name: str
    value: float | None = None


NOBODY = Peer("")


@dataclass
class Row:
    """One figure. `measure` takes a Bench and returns our value, or ours and the peer's; it raises NotRun or NotChosen.

    The verdict is met or MISSED where there is a limit, otherwise empty; or why there is no value.
    """

    id: str
    quantity: str
    unit: str
    measure: Callable
    peer: Peer = NOBODY
    limit: Limit | None = None
    more_is_better: bool = False
    cells: dict = field(default_factory=dict)
    verdict: str = "not run"

    def __post_init__(self):
        self.leave_out(NotRun("not reached"))

    def fill(self, bench):
        """Measures, and fills the cells of the table."""
        try:
            found = self.measure(bench)
        except Exception as reason:  # whatever went wrong with one row, the others are still to be measured
            self.leave_out(reason)
            return
        ours, peer = found if isinstance(found, tuple) else (found, self.peer.value)
        ratio = self._ratio(ours, peer)
        self.cells = self._cells(number_text(ours), number_text(peer), number_text(ratio))
        self.verdict = ""
        if self.limit:
            self.verdict = "met" if self.limit.holds(ours if self.limit.column == "ours" else ratio) else "MISSED"

    def _ratio(self, ours, peer):
        """How many times better we are; None without a peer, or where a division by zero leaves it undefined."""
        better, worse = (ours, peer) if self.more_is_better else (peer, ours)
        return better / worse if better is not None and worse else None

    def leave_out(self, reason):
        """Says in the table why there is no value; `reason` is an exception."""
        text = str(reason) if isinstance(reason, NotRun) else f"{type(reason).__name__}: {reason}"
        self.cells = self._cells(NOT_RUN + " ".join(text.split()), number_text(self.peer.value), "")
        self.verdict = "not chosen" if isinstance(reason, NotChosen) else "not run"

    @property
    def has_value(self):
        """Whether it was measured."""
        return not self.cells["ours"].startswith(NOT_RUN)

    def _cells(self, ours, peer_value, ratio):
        limit = str(self.limit) if self.limit else ""
        return dict(zip(COLUMNS, (self.id, self.quantity, self.unit, ours, self.peer.name, peer_value, ratio, limit)))


def number_text(value):
    """Four significant digits, whole numbers in full, nothing for None."""
    if value is None:
        return ""
    return f"{value:.0f}" if float(value).is_integer() and abs(value) < 1e12 else f"{value:.4g}"


def write_table(cells, path):
    """Writes rows of cells as CSV."""
    path.parent.mkdir(parents=True, exist_ok=True)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(cells)


def keep(rows, path):
    """Writes the stored record. A row that was not run now keeps the value it had there."""
    earlier = {}
    if path.exists():
        with path.open(newline="", encoding="utf-8") as file:
            earlier = {cells["id"]: cells for cells in csv.DictReader(file)}
    write_table([row.cells if row.has_value else earlier.get(row.id, row.cells) for row in rows], path)


def print_summary(rows):
    """The table for the terminal."""
    shown = ("id", "ours", "unit", "peer_value", "ratio", "limit")
    lines = [shown + ("",)] + [tuple(row.cells[column] for column in shown) + (row.verdict,) for row in rows]
    lines = [tuple(cell if len(cell) <= 50 else cell[:47] + "..." for cell in line) for line in lines]
    widths = [max(map(len, column)) for column in zip(*lines)]
    for line in lines:
        print("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip())
