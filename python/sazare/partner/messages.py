"""Messages of a coupling as files, byte by byte as docs/reference/coupling-files.md says, and what can be wrong with them."""

import zlib
from dataclasses import dataclass, field

import numpy as np

PROTOCOL, VERSION = "sazare-coupling", 1
SEAL = 18  # bytes of the last line: "checksum ", eight digits, a line break


class PartnerError(RuntimeError):
    """Something is wrong between the two programs; its classes say what."""


class TimedOut(PartnerError):
    """The partner did not come, or has sent nothing for too long."""


class Died(PartnerError):
    """The partner's program ended without a farewell."""


class Failed(PartnerError):
    """The partner's program failed, and said why."""


class Stopped(PartnerError):
    """The partner was stopped, and can be resumed; it stands at the beginning of `window`."""

    def __init__(self, words, window):
        super().__init__(words)
        self.window = window


class Damaged(PartnerError):
    """A file is half written, or was changed."""


class Stale(PartnerError):
    """A file is of another run, or of another place in this one."""


class OtherVersion(PartnerError):
    """The partner speaks another version of the protocol, or another protocol."""


class Mismatch(PartnerError):
    """The two sides do not go together: surfaces, windows or runs."""


class NotFinite(PartnerError):
    """A number is infinite, or none."""


class Busy(PartnerError):
    """Another program has this side's place in the folder."""


def read_entries(text, name, last=None):
    """The lines "key value" of a text as a list of pairs, and where they end: behind the line `last`, or at the end."""
    lines, place = [], 0
    while (stop := text.find(b"\n", place)) >= 0:
        line, place = text[place:stop].decode("utf-8", "replace"), stop + 1
        if not lines:
            _check_greeting(line, name)
        elif line == last:
            return lines[1:], place
        key, space, value = line.partition(" ")
        if not space:
            raise Damaged(f"{name}: has a line without a value in its head")
        lines.append((key, value))
    if not lines and len(text) > len(PROTOCOL) + 1:
        _check_greeting(text[:80].decode("utf-8", "replace"), name)
    if last is not None or not lines or place != len(text):
        raise Damaged(f"{name}: is half written: it ends in its head")
    return lines[1:], place


def write_entries(entries):
    """The greeting and the lines."""
    return "".join(f"{key} {value}\n" for key, value in [(PROTOCOL, VERSION), *entries]).encode()


def _check_greeting(line, name):
    protocol, _, version = line.partition(" ")
    if protocol != PROTOCOL:
        raise OtherVersion(
            f"{name}: is no file of a coupling: it should begin with '{PROTOCOL} {VERSION}'. "
            "Choose a folder for the exchange that nobody else writes to"
        )
    if version != str(VERSION):
        raise OtherVersion(
            f"{name}: the partner speaks version {version} of the protocol, and this program version {VERSION}. "
            "Use programs of the same version on both sides"
        )


@dataclass
class Message:
    """A message; `details` are further lines of its head, `tables` maps a name to (numbers (rows, columns), unit)."""

    kind: str
    window: int = 0
    pass_: int = 0
    time: float = 0.0
    details: dict = field(default_factory=dict)
    tables: dict = field(default_factory=dict)
    side: str = ""
    run: str = ""
    sequence: int = 0

    def encode(self):
        """The bytes of the file."""
        head = [("from", self.side), ("kind", self.kind), ("run", self.run), ("sequence", self.sequence), ("window", self.window)]
        head += [("pass", self.pass_), ("time", float(self.time)), *self.details.items()]
        head += [("table", f"{name} {len(rows)} {rows.shape[1]} {unit}") for name, (rows, unit) in self.tables.items()]
        data = b"".join(np.ascontiguousarray(rows, "<f8").tobytes() for rows, _ in self.tables.values())
        bytes_ = write_entries(head) + b"data\n" + data
        return bytes_ + f"checksum {zlib.crc32(bytes_):08x}\n".encode()

    @classmethod
    def decode(cls, bytes_, name):
        """The message of such bytes; `name` is for the errors. Raises Damaged or OtherVersion."""
        lines, end = read_entries(bytes_, name, "data")
        head = dict(lines)
        try:
            message = cls(head.pop("kind"), int(head.pop("window")), int(head.pop("pass")), float(head.pop("time")))
            message.side, message.run, message.sequence = head.pop("from"), head.pop("run"), int(head.pop("sequence"))
            layouts = [_layout(value) for key, value in lines if key == "table"]
        except (KeyError, ValueError) as error:
            raise Damaged(f"{name}: its head cannot be understood: {error}") from None
        size = end + sum(8 * rows * columns for _, rows, columns, _ in layouts) + SEAL
        if len(bytes_) < size:
            raise Damaged(f"{name}: is half written: {len(bytes_)} of {size} bytes")
        if len(bytes_) > size:
            raise Damaged(f"{name}: is damaged: {len(bytes_)} bytes instead of {size}")
        if bytes_[-SEAL:] != f"checksum {zlib.crc32(bytes_[:-SEAL]):08x}\n".encode():
            raise Damaged(f"{name}: is damaged: its checksum is not that of its bytes")
        for table, rows, columns, unit in layouts:
            message.tables[table] = (np.frombuffer(bytes_, "<f8", rows * columns, end).reshape(rows, columns), unit)
            end += 8 * rows * columns
        message.details = head
        return message

    def table(self, name, rows, columns, unit):
        """A table's numbers; `rows` None for any. Raises Mismatch when there is none of that layout and unit."""
        if name not in self.tables:
            raise Mismatch(f"message {self.sequence} of the {self.side} has no table '{name}'")
        found, its_unit = self.tables[name]
        if its_unit != unit or found.shape[1] != columns:
            raise Mismatch(
                f"message {self.sequence} of the {self.side}: the table '{name}' has {found.shape[1]} numbers in [{its_unit}] a row, "
                f"and {columns} in [{unit}] are awaited"
            )
        if rows is not None and len(found) != rows:
            raise Mismatch(f"the surfaces do not match: '{name}' of the {self.side} has {len(found)} rows, and the surface has {rows} nodes")
        return found

    def check_finite(self, who):
        """Raises NotFinite with the first number that is none."""
        for name, (rows, _) in self.tables.items():
            if not np.isfinite(rows).all():
                node, column = np.argwhere(~np.isfinite(rows))[0]
                raise NotFinite(
                    f"{who}: {name} of node {node} in window {self.window} (t = {self.time:.6g} s, pass {self.pass_}) is {rows[node, column]}"
                )


def _layout(line):
    name, rows, columns, unit = line.split(" ")
    if int(rows) < 0 or int(columns) < 1:
        raise ValueError(f"'table {line}' is no table")
    return name, int(rows), int(columns), unit


def file_name(side, sequence):
    """Name of the file of a message."""
    return f"{side}-{sequence:012d}.message"
