"""Units of the keys of cases, from the schema that also checks cases."""

import json
import re
from functools import cache

from sazare.engine import engine

UNIT = re.compile(r"\. \[(?P<unit>[^\[\]]+)\]")  # behind the sentence of a key
NOT_NAMED = "materials"  # the table of a key that stands alone


def unit_of_key(name):
    """Unit of a key by its name as for --set, such as `materials.0.cohesion`; one that stands alone, such as `friction angle`, is that of a material.

    "" where there is no such key, where it has no unit, where methods differ in it, and without the engine, which has the schema.
    """
    parts = [part for part in name.strip().replace(" ", "_").split(".") if not part.isdigit()]
    found = _units().get(tuple(parts) if len(parts) != 1 else (NOT_NAMED, *parts), set())
    return next(iter(found)) if len(found) == 1 else ""


@cache
def _units():
    """The units that a key has in the methods, by table and key."""
    try:
        methods = json.loads(engine().schema_json())["oneOf"]
    except ImportError:
        return {}
    units = {}
    for method in methods:
        for table, schema in method["properties"].items():
            for key, value in schema.get("items", schema).get("properties", {}).items():
                told = UNIT.search(value.get("description", ""))
                units.setdefault((table, key), set()).add(told["unit"] if told else "")
    return units
