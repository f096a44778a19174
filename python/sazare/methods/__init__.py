"""What is particular to a method, in one place: a module of its own behind one small interface.

`MODULES` is the only list of methods in the package. A module of it has `METHOD`, a `Method`, which says what the shared files ask
for: report, summary, 3-D view, movie and results know `method_of(results)` and no names. Beside it lies `X_model`, whose function `model` says
what a picture of a case shows before it runs. A new method is these two modules and its row.
"""

import importlib
import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from sazare import style
from sazare.style import count, quantity

MODULES = {
    "blocks": "sazare.methods.blocks",
    "mps": "sazare.methods.mps",
    "rectangles": "sazare.methods.rectangles",
    "spheres": "sazare.methods.spheres",
    "fem": "sazare.methods.fem",
    "hybrid": "sazare.methods.hybrid",
    "study": "sazare.methods.study",  # a study of limit steps is written as a run is
}
# A folder that does not say its method is taken for one of this method, whose module tells what is missing.
USUAL = "blocks"


@dataclass(frozen=True)
class Section:
    """A picture of the report: file name, heading, one sentence below it, how to draw it, what to say without data.

    draw: a function without arguments that returns a matplotlib Figure, or None where the run has no data for it.
    places: whether it shows where the bodies are; a run that couples methods leaves such a picture out where it has one of both.
    """

    name: str
    heading: str
    caption: str
    draw: Callable[[], Any]
    missing: str
    wide: bool = True
    places: bool = False


@dataclass(frozen=True)
class Sheet:
    """A table of the report: file-like name, heading, titles of its columns, rows of words, and one sentence below it."""

    name: str
    heading: str
    titles: tuple[str, ...]
    rows: list[tuple[str, ...]]
    caption: str = ""
    wide: bool = False


@dataclass(frozen=True)
class Headline:
    """One figure in words: its name, its value, and a smaller line below it."""

    name: str
    value: str
    note: str = ""


@dataclass(frozen=True)
class Figure:
    """A headline figure of the manifest: its key there, its name in words, its SI unit ("" for a count), and what else is said of it.

    note: a function of all figures (dict) that returns a few words, "" where there is nothing to say.
    """

    key: str
    name: str
    unit: str = ""
    note: Callable[[dict], str] = lambda _: ""

    def headline(self, figures):
        """The figure in words; None where the run did not write it."""
        value = figures.get(self.key)
        if value is None:
            return None
        return Headline(self.name, quantity(value, self.unit) if self.unit else count(value), self.note(figures))


@dataclass(frozen=True)
class Method:
    """What the shared files ask of a method.

    sections: a function of Results that returns the report's pictures, in their order.
    verdict: a function of Results of a run that is done: ("good", "fair" or "bad", sentence).
    headlines: the figures at the top, in their order.
    measured: a function of Results that returns more of them (list of Headline), which are read from the snapshots.
    sheets: a function of Results that returns tables of the report (list of Sheet), in their order.
    snapshots: the kind of its snapshots, with which the names of their files begin; None where it writes none of its own.
    fields: data of the snapshots, of cells or points, that the 3-D view and the movie colour, the first one by default: name in the file ->
        (name in words, unit). Of vectors the magnitude is shown.
    extent: a function of a mesh that returns the corners (2, 3) [m] of the part that the 3-D view and the movie look at; all where it is None.
    colors: the colour map of the fields (matplotlib).
    moving: a function of Results that yields (time [s], figure) of every snapshot, of a method whose own snapshots the movie cannot draw.
    tables: a function of Results that returns the tables written beside the report: name of the file -> columns, as `write_table` takes them;
        one without columns is not written.
    has_case: whether what it writes belongs to one case, whose text is in the folder.
    """

    sections: Callable[[Any], list[Section]]
    verdict: Callable[[Any], tuple[str, str]]
    headlines: tuple[Figure, ...] = ()
    measured: Callable[[Any], list[Headline]] = lambda _: []
    sheets: Callable[[Any], list[Sheet]] = lambda _: []
    snapshots: str | None = None
    fields: dict[str, tuple[str, str]] = field(default_factory=dict)
    extent: Callable[[Any], Any] | None = None
    colors: Any = field(default_factory=lambda: style.SPEED)
    moving: Callable[[Any], Iterator[tuple[float, Any]]] | None = None
    tables: Callable[[Any], dict[str, dict]] = lambda _: {}
    has_case: bool = True


def method_named(name):
    """The Method of a name. Raises KeyError where there is none."""
    return importlib.import_module(MODULES[name]).METHOD


def method_of(results):
    """The Method of a run, by its manifest or, where that is missing, by its case."""
    names = (results.manifest.get("method"), _name_in(results.case_text), USUAL)
    return method_named(next(name for name in names if isinstance(name, str) and name in MODULES))


def model_of(case):
    """The module that says what is drawn of a case (dict) at t = 0, by its method: `model(opened)` returns a `Model` of `sazare.model.parts`, and
    `preparation(case)`, where the method can take steps before t = 0, the settings that leave them out."""
    return importlib.import_module(f"{MODULES[case['case']['method']]}_model")


def _name_in(case_text):
    """The method that a case names; None where the text is no case."""
    try:
        return tomllib.loads(case_text)["case"]["method"]
    except (tomllib.TOMLDecodeError, KeyError, TypeError):
        return None
