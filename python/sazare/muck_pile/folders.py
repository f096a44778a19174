"""Folders of muck piles: which run of blasting they are of, and what of an earlier pile must go."""

import json

from sazare.folders import Occupied, require_folder

MARK = "muck-pile.json"
WRITTEN = (
    "rock.stl", "case.toml", "throw.csv", "pile.csv", "back_break.csv", "numbers.json", "profile.png", "throw.png", "plan.png", "back_break.png", "bodies-*.csv",
    "spheres-*.csv",
)


def claim(folder, run, overwrite=False):
    """An empty folder for the pile of a run, or that of one before, whose tables and pictures are deleted.

    Raises Occupied where something else is in the folder, or where a pile is there and `overwrite` is false.
    """
    folder = require_folder(folder)
    if folder.is_dir() and any(folder.iterdir()):
        if not (folder / MARK).is_file() or (folder / MARK).is_symlink():
            raise Occupied(f"{folder}: there are files in it that are no muck pile, so nothing is written there: --out DIR takes another folder")
        if not overwrite:
            raise Occupied(f"{folder}: a muck pile is in it already: --overwrite replaces it, --out DIR takes another folder")
        if (folder / "run").is_symlink():
            raise Occupied(f"{folder}: run leads elsewhere: remove the link, or --out DIR takes another folder")
        for path in [path for path in folder.iterdir() if any(path.match(name) for name in WRITTEN)]:
            path.unlink()
    folder.mkdir(parents=True, exist_ok=True)
    (folder / MARK).write_text(json.dumps({"run": str(run)}) + "\n", encoding="utf-8")
