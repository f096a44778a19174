"""Folders that commands write their results into, and in which nothing is replaced that was not asked for."""

from pathlib import Path

from sazare.tables import NotARun


class Occupied(FileExistsError, ValueError):
    """There is something in a folder that may not be replaced: the user's error, not one of the machine."""


def require_folder(path):
    """The Path of a folder, which need not exist. Raises Occupied where it is a file."""
    folder = Path(path)
    if folder.exists() and not folder.is_dir():
        raise Occupied(f"{folder}: a file, and a folder is wanted: --out DIR takes another one")
    return folder


def require_room(path, names, overwrite=False):
    """The Path of a folder for files of these names.

    Raises Occupied where it is a file, where one of the names is a link, or where files of these names are there and `overwrite` is false.
    """
    folder = require_folder(path)
    links = [name for name in names if (folder / name).is_symlink()]
    if links:
        raise Occupied(f"{folder}: {', '.join(links)} lead elsewhere: remove the links, or --out DIR takes another folder")
    there = [name for name in names if (folder / name).exists()]
    if there and not overwrite:
        raise Occupied(f"{folder}: {', '.join(there)} are there already: --overwrite replaces them, --out DIR takes another folder")
    return folder


def own(path):
    """A path to write to. Raises NotARun where it is a link: a folder may come from anyone, and what it leads to is not the run's."""
    if path.is_symlink():
        raise NotARun(f"{path}: a link; results are written into their own folder: remove the link")
    return path
