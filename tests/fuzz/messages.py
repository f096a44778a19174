"""Changed messages of a coupling: the bodies of a small hybrid case meet a continuum of Python that sends them, their checksums set right."""

import shutil
import subprocess
import sys
import tempfile
import threading
import zlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "python"))

from sazare import partner  # noqa: E402
from sazare.partner import exchange, messages  # noqa: E402

CASE = ROOT / "cases/two-mass-oscillator"
WINDOWS = 3
TIME_OUT = 3  # s


class Mutating(exchange.FileExchange):
    """The exchange of a continuum, one message of which is changed by a function of its bytes before it is sent."""

    def __init__(self, folder, sequence, change):
        super().__init__(folder, "continuum", time_out=TIME_OUT)
        self._changed, self._change = sequence, change

    def send(self, message):
        """Sends the next message."""
        sequence = self.next
        super().send(message)
        if sequence == self._changed:
            path = self.folder / messages.file_name("continuum", sequence)
            bytes_ = self._change(path.read_bytes()[: -messages.SEAL])
            exchange.write_at_once(path, bytes_ + f"checksum {zlib.crc32(bytes_):08x}\n".encode())


NODES = np.array([[0.0, 0.1], [0.1, 0.1]])  # m; the ball is above
WINDOW = 1e-4  # s


def play_continuum(folder, sequence, change):
    """Sends a shape and some motions, until the bodies leave."""
    link = Mutating(folder, sequence, change)
    try:
        link.meet()
        shape = {"dimension": 2, "width": 0.1, "window_length": WINDOW}
        link.send(messages.Message("shape", -1, details=shape, tables={"nodes": (NODES, "m"), "faces": (np.array([[0.0, 1.0]]), "1")}))
        link.receive(0)
        for window in range(WINDOWS):
            tables = {"displacement": (0 * NODES, "m"), "velocity": (0 * NODES, "m/s")}
            link.send(messages.Message("motion", window, time=WINDOW * (window + 1), tables=tables))
            link.receive(link.next - 1)
    except (partner.PartnerError, OSError):
        pass  # the bodies have refused what came
    finally:
        link.close()


def attempt(command, number, change, verdict, limited):
    """Tries one changed message; returns what is wrong, or None. `verdict(done)` judges the end of the bodies' program."""
    with tempfile.TemporaryDirectory(prefix="sazare-fuzz-") as place:
        shutil.copytree(CASE, place, dirs_exist_ok=True)
        folder = Path(place, "exchange")
        folder.mkdir()
        continuum = threading.Thread(target=play_continuum, args=(folder, number % (WINDOWS + 1), change))
        continuum.start()
        arguments = ["run", "case.toml", "--side", "bodies", "--exchange", "exchange", "--time-out", str(TIME_OUT), "--out", "run", "--quiet", "--threads", "1"]
        try:
            done = subprocess.run([command, *arguments], cwd=place, capture_output=True, timeout=60, preexec_fn=limited)
        except subprocess.TimeoutExpired:
            return "more than 60 s by the clock"
        finally:
            continuum.join()
        return verdict(done)
