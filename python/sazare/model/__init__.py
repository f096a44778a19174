"""A case before it runs, as a picture: its groups, boundaries, loads, walls and gauges at t = 0, in one figure with a legend."""

import tempfile
import tomllib
from pathlib import Path

from sazare.cases import toml_value
from sazare.engine import engine, refuse_after_fork
from sazare.histories import histories_of
from sazare.methods import model_of
from sazare.model.parts import Opened
from sazare.results import open_run
from sazare.simulation import source_of
from sazare.style import save

ENDINGS = (".png", ".pdf", ".svg", ".jpg")


def draw_model(case, file=None, *, overrides=None, folder=None):
    """Draws the model of a case at t = 0, and returns the matplotlib Figure; writes it to a file where one is given, as .png, .pdf, .svg or .jpg.

    case, overrides, folder: as for `run`. No step is made and nothing but the file is left behind. A state that has to be computed first is not:
    ground is shown before it settles under gravity, spheres before they rain.

    Raises UserError with all errors of the case; ValueError where the file cannot be written as a picture.
    """
    return draw_source(source_of(case, overrides, folder), file)


def draw_source(source, file=None):
    """Draws the model of a `Source` at t = 0 as `draw_model` does for a case."""
    if file is not None:
        _check_place(Path(file))
    refuse_after_fork()
    case = tomllib.loads(source.resolved())
    with tempfile.TemporaryDirectory(prefix="sazare-") as temporary:
        title = _write_first_snapshot(_without_preparation(source, case, Path(temporary)), Path(temporary) / "run")
        opened = Opened(open_run(Path(temporary) / "run"), case)
        figure = _draw(model_of(case).model(opened), title)
    if file is not None:
        save(figure, Path(file))
    return figure


def _check_place(path):
    """Raises ValueError where a picture cannot be written to a path."""
    if path.suffix.lower() not in ENDINGS:
        known = f"{', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}"
        found = f"it ends in {path.suffix}" if path.suffix else "it has no ending"
        raise ValueError(f"{path}: the ending of the file says what kind of picture it is, and {found}: let it end in {known}, as in {path.stem or 'model'}.png")
    if not path.absolute().parent.is_dir():
        raise ValueError(f"{path}: the folder {path.absolute().parent} does not exist: make it first, or name a file in another folder")
    if path.is_dir():
        raise ValueError(f"{path}: this is a folder: give the name of a file")


def _without_preparation(source, case, folder):
    """The case without steps that are taken before it begins; the sides of a coupled one are rewritten into a folder."""
    more = getattr(model_of(case), "preparation", lambda _: [])(case)
    for side, path in case.get("sides", {}).items():
        own = source_of(Path(path))
        rewritten = folder / f"{side}.toml"
        rewritten.write_text(_without_preparation(own, tomllib.loads(own.resolved()), folder).resolved(), encoding="utf-8")
        more.append(f"sides.{side}={toml_value(rewritten)}")
    return source.with_settings(more)


def _write_first_snapshot(source, place):
    """Writes the snapshot at t = 0 into a folder; returns the title of the case with its method and size."""
    live = engine().LiveSimulation(source.for_engine(), place, "fresh", 0, warns=False)
    # Functions of the caller have no say at t = 0.
    for history in histories_of(live, {name: lambda _: 0.0 for name, _ in live.functions}):
        history.sample(live, 0)
    live.begin()
    live.finish()
    return f"{live.title} (t = 0)"


def _draw(model, title):
    # VTK takes a second to load, and a plane model does without.
    if model.dimension == 2:
        from sazare.model import plane as drawing
    else:
        from sazare.model import space as drawing
    return drawing.draw(model, title)
