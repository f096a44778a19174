"""Writes the classes of cases, python/sazare/cases/<method>.py, from the schema: sazare schema | tools/write_case_classes.py.

With --check nothing is written; the exit code is 1 where a file is not what the schema says.
"""

import argparse
import json
import keyword
import sys
import textwrap
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[1] / "python/sazare/cases"
WIDTH = 130

HEAD = '''"""Cases of method {method}, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part
'''


def class_name(table, repeated):
    """initial_velocities -> InitialVelocity; a table that stands once keeps its number: particles -> Particles."""
    words = table.split("_")
    if repeated:
        last = words[-1]
        words[-1] = last[:-3] + "y" if last.endswith("ies") else last.removesuffix("s")
    return "".join(word.capitalize() for word in words)


def type_words(schema):
    """The type of a value as Python writes it."""
    if "enum" in schema:
        return "Literal[" + ", ".join(json.dumps(word) for word in schema["enum"]) + "]"
    kind = schema["type"]
    if kind == "array":
        item = type_words(schema["items"])
        exact = schema.get("minItems") == schema.get("maxItems")
        return f"tuple[{', '.join([item] * schema['minItems'])}]" if exact and "minItems" in schema else f"list[{item}]"
    if kind == "object":
        return f"dict[str, {type_words(schema['additionalProperties'])}]"
    return {"string": "str", "boolean": "bool", "number": "float", "integer": "int"}[kind]


def bounds_words(schema):
    """" Greater than 0." and the like; "" where any number will do."""
    words = [
        f"{name} {schema[key]:g}"
        for key, name in (("exclusiveMinimum", "greater than"), ("minimum", "at least"), ("exclusiveMaximum", "less than"), ("maximum", "at most"))
        if key in schema
    ]
    text = " and ".join(words)
    return f" {text[0].upper()}{text[1:]}." if text else ""


def docstring(text, indent="    "):
    """The lines of a docstring."""
    one = f'{indent}"""{text}"""'
    if len(one) <= WIDTH:
        return [one]
    lines = textwrap.wrap(text, WIDTH - len(indent) - 3)
    return [f'{indent}"""{lines[0]}', *(f"{indent}{line}" for line in lines[1:]), f'{indent}"""']


def part_lines(table, schema):
    """The class of one table."""
    repeated = schema["type"] == "array"
    body = schema["items"] if repeated else schema
    lines = ["", "", "@dataclass(kw_only=True, eq=False)", f"class {class_name(table, repeated)}(Part):", *docstring(body["description"]), ""]
    required = body.get("required", [])
    for key, value in body["properties"].items():
        words = type_words(value) + ("" if key in required else " | None = None")
        lines.append(f"    {key}{'_' if keyword.iskeyword(key) else ''}: {words}")
        lines += docstring(value["description"] + bounds_words(value))
    return lines


def case_lines(method, tables, required):
    """The class of the whole case."""
    lines = ["", "", "@dataclass(kw_only=True, eq=False)", "class Case(AnyCase):", f'    """A case of method {method}."""', ""]
    names = {table: class_name(table, schema["type"] == "array") for table, schema in tables.items()}
    lines.append(f'    method: ClassVar[str] = "{method}"')
    lines.append("    tables: ClassVar[dict[str, type[Part]]] = {")
    lines += [f'        "{table}": {name},' for table, name in names.items()]
    lines += ["    }", ""]
    for table, schema in tables.items():
        repeated = schema["type"] == "array"
        kind = f"list[{names[table]}]" if repeated else names[table]
        default = "" if table in required else " = field(default_factory=list)" if repeated else " | None = None"
        lines.append(f"    {table}: {kind}{default}")
        lines += docstring((schema["items"] if repeated else schema)["description"])
    return lines


def module_text(schema):
    """The module of one method, and the method's name."""
    tables = dict(schema["properties"])
    method = tables.pop("case")["properties"]["method"]["const"]
    lines = [line for table, body in tables.items() for line in part_lines(table, body)]
    lines += case_lines(method, tables, schema["required"])
    return method, HEAD.format(method=method) + "\n".join(lines) + "\n"


def main(arguments=None):
    """Reads the schema from the standard input and writes or compares; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing, compare")
    check = parser.parse_args(arguments).check
    different = []
    for schema in json.load(sys.stdin)["oneOf"]:
        method, text = module_text(schema)
        path = FOLDER / f"{method}.py"
        if path.exists() and path.read_text(encoding="utf-8") == text:
            continue
        different.append(path.name)
        if not check:
            path.write_text(text, encoding="utf-8")
    if check and different:
        print(f"not what the schema says: {', '.join(different)}. Write them anew: sazare schema | tools/write_case_classes.py")
    return 1 if check and different else 0


if __name__ == "__main__":
    sys.exit(main())
