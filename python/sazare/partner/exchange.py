"""One side of a coupling that exchanges files with a partner in another program: who is there, what is sent and awaited.

The same protocol as `sazare/coupling/file_exchange` in the engine; docs/reference/coupling-files.md says it step by step.
"""

import os
import re
import secrets
import socket
import time
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

from sazare.partner.messages import (
    Busy, Damaged, Died, Failed, Message, Mismatch, PartnerError, Stale, Stopped, TimedOut, file_name, read_entries, write_entries,
)

try:
    import fcntl
except ImportError:  # a system without it: the partner then knows this program by its process number
    fcntl = None

GRACE = 1.0  # s, of a partner that does not write its files in one go
GLANCE = 0.1  # s between looks after the partner
SHORTEST, LONGEST, SHARE = 1e-5, 1e-3, 1 / 64  # s, s and of what was waited so far: how long to sleep between looks


@dataclass(frozen=True)
class Presence:
    """What the file <side>.here says of a program."""

    side: str
    session: str
    partner: str = "-"
    run: str = "-"
    next: int = 0
    kept: int = -1
    process: int = 0
    host: str = ""
    lock: str = "flock"
    state: str = "here"

    @classmethod
    def read(cls, path):
        """The presence that a file holds; None where it is not there, or not whole."""
        try:
            lines = dict(read_entries(path.read_bytes(), str(path))[0])
            return cls(**{name: kind(lines[name]) for name, kind in cls.__annotations__.items()})
        except (FileNotFoundError, Damaged, KeyError, ValueError):
            return None

    def written(self):
        """Its bytes."""
        return write_entries(vars(self).items())


def write_at_once(path, content):
    """Writes a file that appears under its name all at once."""
    temporary = path.with_name(f".{path.name}.part")
    temporary.write_bytes(content)
    os.replace(temporary, path)


def is_there(process):
    """Whether a process of this machine is alive."""
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


class FileExchange:
    """Sends and receives the messages of one side, "continuum" or "bodies", in a folder.

    mark: where a resumed run goes on, {"run": ..., "next": ...}. Raises Busy when another program has this side's place.
    """

    def __init__(self, folder, side, mark=None, keeps_checkpoints=False, time_out=600.0):
        self.folder, self.side, self.time_out = Path(folder), side, time_out
        self.other = "bodies" if side == "continuum" else "continuum"
        self.partner_name = "the bodies' program" if side == "continuum" else "the continuum's program"
        self.next = mark["next"] if mark else 0
        self._lock = self._take_lock()
        self._parted, self._partner_session, self._oldest = False, None, max(self.next, 1)
        self._remove_from(self.next)
        run = mark["run"] if mark else secrets.token_hex(8) if side == "continuum" else "-"
        self._presence = Presence(
            side, secrets.token_hex(8), "-", run, self.next, self.next if keeps_checkpoints else -1, os.getpid(), socket.gethostname() or "unknown",
            "flock" if fcntl else "none",
        )
        self._tell()

    @property
    def run(self):
        """Identity of the coupled run."""
        return self._presence.run

    def close(self):
        """Gives the side's place back."""
        if self._lock is not None:
            os.close(self._lock)
            self._lock = None

    def meet(self):
        """Waits for the partner. Raises TimedOut, Mismatch, OtherVersion."""
        for _ in self._waits(f"did not come within {self.time_out:g} s. Start it with the same folder, or wait longer"):
            partner = self._partner()
            if partner and self._has_met(partner):
                return self._agree(partner)

    def send(self, message):
        """Sends the next message; who, which run and the sequence are filled in. Raises NotFinite."""
        message.check_finite("this side")
        message.side, message.run, message.sequence = self.side, self.run, self.next
        write_at_once(self.folder / file_name(self.side, self.next), message.encode())
        self.next += 1
        if self._presence.kept < 0:
            self._remove_before(self.next - 2)

    def receive(self, sequence):
        """Waits for the partner's message of a sequence. Raises the errors of this package."""
        damaged_since, next_glance = None, time.monotonic() + GLANCE
        for now in self._waits(f"has sent nothing for {self.time_out:g} s. If it needs so long, wait longer"):
            try:
                message = self._look_for(sequence)
                if message is not None:
                    return self._opened(message)
            except Damaged as error:
                damaged_since = damaged_since or now
                if now - damaged_since > GRACE:
                    raise Damaged(f"{error}. It should be written under another name and then renamed") from None
            if now > next_glance:
                self._watch_partner(sequence)
                next_glance = now + GLANCE

    def own(self, sequence):
        """A message of this side that is still there."""
        path = self.folder / file_name(self.side, sequence)
        if not path.exists():
            raise Mismatch(f"{path}: is not there: this folder is not that of the run")
        return Message.decode(path.read_bytes(), str(path))

    def keep_from(self, sequence):
        """A checkpoint was made that goes on with this sequence: what both sides no longer need is removed."""
        self._presence = replace(self._presence, kept=sequence)
        self._tell()
        partner = self._partner()
        if partner:
            self._remove_before(self.next - 2 if partner.kept < 0 else min(sequence, partner.kept))

    def part(self, reason, window, words=""):
        """The last word: reason is done, stopped or failed; `window` is that at whose beginning this side stands."""
        if self._parted or self._partner_session is None:
            return
        self._parted = True
        self.send(Message("farewell", window, details={"reason": reason, "words": " ".join(words.split())[:2000] or "-"}))
        self.next -= 1  # a run that is resumed goes on in its place
        if reason == "done":
            self._presence = replace(self._presence, state="done")
            self._tell()

    def _take_lock(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        if fcntl is None:
            return None
        descriptor = os.open(self.folder / f"{self.side}.lock", os.O_RDWR | os.O_CREAT, 0o666)
        for _ in range(20):  # a partner that looks whether the lock is taken has it for a moment
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return descriptor
            except BlockingIOError:
                time.sleep(0.005)
        os.close(descriptor)
        raise Busy(f"{self.folder}: another program is the {self.side} in this folder. Wait for it, or choose another folder for the exchange")

    def _remove_from(self, sequence):
        """Removes own messages that an earlier program of this side has left: they are sent anew."""
        for path in self.folder.glob(f"{self.side}-*.message"):
            found = re.fullmatch(rf"{self.side}-(\d+)\.message", path.name)
            if found and int(found[1]) >= sequence:
                path.unlink(missing_ok=True)
            elif found and int(found[1]) >= 1:
                self._oldest = min(self._oldest, int(found[1]))

    def _remove_before(self, sequence):
        """Removes own messages before a number. The message of the shape stays: a side that is resumed reads it again."""
        for number in range(self._oldest, sequence):
            (self.folder / file_name(self.side, number)).unlink(missing_ok=True)
        self._oldest = max(self._oldest, sequence)

    def _tell(self):
        write_at_once(self.folder / f"{self.side}.here", self._presence.written())

    def _partner(self):
        return Presence.read(self.folder / f"{self.other}.here")

    def _waits(self, words):
        """Comes back after sleeps that grow with the time waited; raises TimedOut in the end."""
        began = now = time.monotonic()
        while now - began <= self.time_out:
            yield now
            time.sleep(min(max((now - began) * SHARE, SHORTEST), LONGEST))
            now = time.monotonic()
        raise TimedOut(f"{self.folder}: {self.partner_name} {words}")

    def _has_met(self, partner):
        """Both have met when each has seen the session of the other: what an older run has left knows no session of today.

        A partner that has done its part of this very run needs not come again.
        """
        was_here = partner.state == "done" and self.run != "-" and partner.run == self.run
        if partner.session != self._presence.partner:
            self._presence = replace(self._presence, partner=partner.session)
            self._tell()
        return partner.partner == self._presence.session or was_here

    def _agree(self, partner):
        if "-" not in (partner.run, self.run) and partner.run != self.run:
            raise Mismatch(
                f"{self.folder}: {self.partner_name} is at another run: one side goes on with a run, and the other one begins anew or goes on "
                "with another. Resume both, or begin both anew"
            )
        if partner.next > self.next and not (self.folder / file_name(self.other, self.next)).exists():
            raise Mismatch(
                f"{self.folder}: {self.partner_name} is ahead, and its message {self.next} is no longer there, so this side cannot catch up. "
                "Resume both from their checkpoints, or begin both anew"
            )
        if self.run == "-":
            self._presence = replace(self._presence, run=partner.run)
            self._tell()
        self._partner_session = partner.session

    def _look_for(self, sequence):
        path = self.folder / file_name(self.other, sequence)
        try:
            message = Message.decode(path.read_bytes(), str(path))
        except FileNotFoundError:
            return None
        if message.side != self.other:
            raise Stale(f"{path}: holds data of the {message.side}, and those of the {self.other} are awaited")
        if message.run != self.run:
            raise Stale(f"{path}: is stale: it is of run {message.run}, and this is run {self.run}. Begin both sides anew in an empty folder")
        if message.sequence != sequence:
            raise Stale(f"{path}: is stale: it holds message {message.sequence}, and {sequence} is awaited")
        return message

    def _watch_partner(self, sequence):
        partner = self._partner()
        if partner is None:
            return
        if partner.session != self._partner_session:
            raise Died(f"{self.folder}: {self.partner_name} died, and was started again. Resume this side as well")
        if self._is_gone(partner) and not (self.folder / file_name(self.other, sequence)).exists():
            raise Died(
                f"{self.folder}: {self.partner_name} (process {partner.process} on {partner.host}) died without notice. Resume both sides"
            )

    def _is_gone(self, partner):
        """Whether the partner's program is no more; another host's program without a lock cannot be watched."""
        if partner.lock == "flock" and fcntl:
            with suppress(FileNotFoundError):
                descriptor = os.open(self.folder / f"{self.other}.lock", os.O_RDONLY)
                try:
                    fcntl.flock(descriptor, fcntl.LOCK_SH | fcntl.LOCK_NB)
                    return True
                except BlockingIOError:
                    return False
                finally:
                    os.close(descriptor)
            return True
        return partner.host == socket.gethostname() and not is_there(partner.process)

    def _opened(self, message):
        if message.kind != "farewell":
            message.check_finite(self.partner_name)
            return message
        reason, words = message.details["reason"], message.details["words"]
        if reason == "stopped":
            raise Stopped(f"{self.folder}: {self.partner_name} was stopped", message.window)
        if reason == "failed":
            raise Failed(f"{self.folder}: {self.partner_name} failed: {words}")
        return message


__all__ = ["FileExchange", "PartnerError"]
