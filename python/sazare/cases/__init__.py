"""Cases as objects: one module per method, written from the schema that also checks cases, with types, units and ranges.

    from sazare.cases import mps
    case = mps.Case(title="column", particles=mps.Particles(spacing=0.5), ..., time=mps.Time(end=2.0))
    sazare.run(case)

A case is the same thing as its TOML text, both ways: `case.to_toml()`, `mps.Case.from_toml(text)`, `sazare.read_case(path)`.
A key that is None is not written, so its default holds; a key that Python keeps for itself ends in `_`
(`from_`). What a value may be is checked by the engine, as for a file.
"""

import difflib
import importlib
import json
import keyword
import tomllib
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any, ClassVar, Self


def toml_value(value: Any) -> str:
    """A value as TOML: text, truth, number, list or inline table. Raises TypeError for anything else."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str | Path):
        return _quoted(str(value))
    if isinstance(value, dict):
        pairs = ", ".join(f"{_quoted(str(key))} = {toml_value(item)}" for key, item in value.items())
        return f"{{ {pairs} }}" if pairs else "{}"
    if hasattr(value, "tolist"):  # of numpy
        return toml_value(value.tolist())
    if isinstance(value, int | float):
        return repr(value)
    if isinstance(value, list | tuple):
        return "[" + ", ".join(toml_value(item) for item in value) + "]"
    raise TypeError(f"{value!r} cannot stand in a case: write text, numbers, truth values, or lists of them")


def _quoted(text: str) -> str:
    """A text as TOML: as in JSON, but for the character DEL, which TOML wants escaped too. Raises ValueError for text that UTF-8 cannot hold."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise ValueError(f"{text!r} cannot stand in a case: {error.reason}") from error
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


class _Strict:
    """Refuses attributes that are no keys: a misspelt one would be left out of the case in silence."""

    def __setattr__(self, name, value):
        known = [field.name for field in fields(self)]
        if name not in known:
            near = difflib.get_close_matches(name, known, 1)
            help_ = f"did you mean {near[0]!r}?" if near else f"its keys are {', '.join(known)}"
            raise AttributeError(f"{type(self).__module__}.{type(self).__name__} has no key {name!r}; {help_}")
        super().__setattr__(name, value)


class Part(_Strict):
    """One table of a case. Two are equal when they write the same."""

    def __eq__(self, other):
        return type(self) is type(other) and self.keys() == other.keys()

    def keys(self) -> dict[str, Any]:
        """The keys that are given, in the order of the schema, as TOML would read them."""
        given = ((field.name, getattr(self, field.name)) for field in fields(self))
        return {name.removesuffix("_"): _plain(value) for name, value in given if value is not None}


def _plain(value: Any) -> Any:
    if isinstance(value, Part):
        return value.keys()
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return str(value) if isinstance(value, Path) else value


@dataclass(kw_only=True, eq=False)
class Case(_Strict):
    """What the cases of all methods share. Two are equal when they write the same."""

    method: ClassVar[str]
    tables: ClassVar[dict[str, type[Part]]]

    title: str
    """What the case is called in reports."""
    folder: Path | None = None
    """Where the files that the case names are looked for; None: the current folder. Not a part of the TOML text."""

    def __eq__(self, other):
        return isinstance(other, Case) and self.to_dict() == other.to_dict()

    def to_dict(self) -> dict[str, Any]:
        """The case as `tomllib` reads its text."""
        found: dict[str, Any] = {"case": {"title": self.title, "method": self.method}}
        for name in self.tables:
            value = getattr(self, name)
            if value is not None and value != []:
                found[name] = _plain(value)
        return found

    def to_toml(self) -> str:
        """The case as TOML text, with the keys that are given."""
        blocks = []
        for name, value in self.to_dict().items():
            for part in value if isinstance(value, list) else [value]:
                if not isinstance(part, dict):
                    raise TypeError(f"{name} cannot be {part!r}: write a {self.tables[name].__name__}, as in {type(self).__module__}.{self.tables[name].__name__}(...)")
                head = f"[[{name}]]" if isinstance(value, list) else f"[{name}]"
                blocks.append("\n".join([head, *(f"{key} = {toml_value(item)}" for key, item in part.items())]))
        return "\n\n".join(blocks) + "\n"

    @classmethod
    def from_toml(cls, text: str, folder: Path | str | None = None) -> Self:
        """The case that a text holds. Raises UserError, in the words of `sazare check`, where it cannot be one."""
        try:
            read = tomllib.loads(text)
            values = {name: _made(cls.tables[name], value) for name, value in read.items() if name != "case"}
            return cls(title=read["case"]["title"], folder=Path(folder) if folder else None, **values)
        except (KeyError, TypeError, tomllib.TOMLDecodeError):
            from sazare.simulation import source_of

            source_of(text, folder=folder).resolved()
            raise


def _made(part: type[Part], value: Any) -> Any:
    if isinstance(value, list):
        return [_made(part, item) for item in value]
    return part(**{f"{key}_" if keyword.iskeyword(key) else key: item for key, item in value.items()})


def case_from_text(text: str, folder: Path | str | None = None) -> Case:
    """The case that a TOML text holds, of whatever method. Raises UserError where it cannot be one."""
    try:
        method = tomllib.loads(text)["case"]["method"]
        kind = importlib.import_module(f"sazare.cases.{method}").Case
    except (KeyError, TypeError, ModuleNotFoundError, tomllib.TOMLDecodeError):
        from sazare.simulation import source_of

        source_of(text, folder=folder).resolved()
        raise
    return kind.from_toml(text, folder)


def read_case(path: Path | str) -> Case:
    """The case in a file. Raises UserError where it cannot be one, OSError where the file cannot be read."""
    path = Path(path)
    return case_from_text(path.read_text(encoding="utf-8"), path.absolute().parent)
