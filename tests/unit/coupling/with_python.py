"""The engine's side and Python's side of an exchange of files understand each other, to the bit: python with_python.py PROGRAM FOLDER."""

import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "python"))
from sazare import partner  # noqa: E402

NODES, FACES, WINDOW, WINDOWS = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]), [[0, 1], [1, 2]], 1e-3, 20


class Engine:
    """The program of the other side."""

    def __init__(self, program, side, folder, *mark):
        command = [program, side, str(folder), str(WINDOWS), *map(str, mark)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def rows(self):
        """What it got, window by window, once it has ended."""
        out, words = self.process.communicate(timeout=60)
        assert self.process.returncode == 0, words
        return [np.array([int(word, 16) for word in line.split()[1:]], np.uint64).view(float) for line in out.splitlines()]


def continuum_in(folder, **options):
    return partner.Continuum(folder, NODES, FACES, WINDOW, width=0.5, time_out=20.0, checkpoints=True, **options)


def step(other, place, force):
    """A window of a continuum like that of the program."""
    place = place + (0.3 * force.mean + 0.7 * force.last)
    return place, other.exchange(place, place * (1.0 / 3))


def lead(folder):
    """The places of such a continuum, window by window."""
    places = []
    with continuum_in(folder) as other:
        place, force = np.full_like(NODES, 0.1), other.force
        for _ in range(WINDOWS):
            place, force = step(other, place, force)
            places.append(place)
    return places


def follow(folder):
    """Bodies like those of the program: what they are told, and what they answer."""
    got = []
    with partner.Bodies(folder, time_out=20.0, checkpoints=True) as other:
        other.answer(other.shape.nodes * 0.7, other.shape.nodes * 0.9)
        for motion in other:
            got.append((motion.displacement, motion.displacement * -0.7))
            other.answer(motion.displacement * -0.7, motion.velocity * 1.1)
    return got


def check(ours, theirs):
    assert len(ours) == len(theirs) == WINDOWS
    for mine, its in zip(ours, theirs, strict=True):
        assert mine.tobytes() == its.tobytes(), (mine, its)


def go_on_after_a_death(program, folder):
    """The engine's bodies are killed on the way; Python's side is told so, and resumed. The bodies catch up from the messages kept."""
    places, mark = [], None
    bodies = Engine(program, "bodies", folder)
    try:
        with continuum_in(folder) as other:
            place, force = np.full_like(NODES, 0.1), other.force
            while True:
                mark, kept = other.mark(), (place, force)
                if mark["window"] == 7:
                    bodies.process.send_signal(signal.SIGKILL)
                    bodies.process.wait()
                place, force = step(other, place, force)
                places.append(place)
    except partner.Died as error:
        assert f"process {bodies.process.pid} " in str(error), error
    assert mark["window"] == len(places) == 7
    bodies = Engine(program, "bodies", folder)
    with continuum_in(folder, resume=mark) as other:
        place, force = kept
        for _ in range(7, WINDOWS):
            place, force = step(other, place, force)
            places.append(place)
    check(places, bodies.rows())
    return places


def main(program, folder):
    shutil.rmtree(folder, ignore_errors=True)
    bodies = Engine(program, "bodies", folder / "a")
    places = lead(folder / "a")
    check(places, bodies.rows())

    continuum = Engine(program, "continuum", folder / "b")
    got = follow(folder / "b")
    check([force for _, force in got], continuum.rows())
    check(places, [place for place, _ in got])

    check(places, go_on_after_a_death(program, folder / "c"))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
