"""Folders of tests: whose they are, and what of an earlier test must go."""

import json

from sazare.folders import Occupied, require_folder

MARK = "lab.json"  # says which test a folder is of
WRITTEN = (
    "curve.csv", "figures.json", "envelope.csv", "calibration.csv", "scatter.csv", "curve.png", "cracks.png", "modes.png", "curves.png", "envelope.png",
    "pressure.csv",
)


def claim(folder, test, pressures=(), overwrite=False):
    """An empty folder for a test, or that of the same test before, whose tables and pictures are deleted.

    Raises Occupied where something else is in the folder, or where the test is there and `overwrite` is false.
    """
    folder = require_folder(folder)
    mark = {"test": test, "pressures": [float(value) for value in pressures]}
    if folder.is_dir() and any(folder.iterdir()):
        found = _mark_of(folder)
        if found is None:
            raise Occupied(f"{folder}: there are files in it that are no test, so nothing is written there: --out DIR takes another folder")
        if found != mark:
            raise Occupied(f"{folder}: there is another test in it ({_words(found)}): --out DIR takes another folder, or delete this one")
        if not overwrite:
            raise Occupied(f"{folder}: this test is in it already: --overwrite replaces it, --out DIR takes another folder")
        for name in WRITTEN:
            (folder / name).unlink(missing_ok=True)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / MARK).write_text(json.dumps(mark) + "\n", encoding="utf-8")


def _mark_of(folder):
    """What a folder says of its test; None where it says nothing that a test would."""
    try:
        found = json.loads((folder / MARK).read_text(encoding="utf-8"))
        return {"test": str(found["test"]), "pressures": [float(value) for value in found["pressures"]]}
    except (OSError, ValueError, TypeError, KeyError):
        return None


def _words(mark):
    under = ", ".join(f"{1e-6 * value:g}" for value in mark["pressures"] if value)
    return mark["test"] + (f" at {under} MPa" if under else "")
