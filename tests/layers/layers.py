"""Reads the module graph and the includes of the sources, and says which includes the graph does not allow."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GRAPH = Path(__file__).with_name("layers.toml")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
SOURCE_ENDINGS = {".hpp", ".cpp", ".in"}


def read_graph(path=GRAPH):
    """Module name -> set of modules it may include, itself and core among them."""
    modules = tomllib.loads(path.read_text())["modules"]
    graph = {}
    for module, allowed in modules.items():
        for name in allowed:
            if name not in graph:
                raise ValueError(
                    f"{path.name}: {module} may not name {name!r}: only modules that stand above it in the file"
                )
        graph[module] = {"core", module, *allowed}
    return graph


def module_of(path, graph):
    """The module that a path such as sazare/methods/blocks/x.hpp lies in; None when it lies in none."""
    parts = Path(path).parts
    for length in range(len(parts) - 1, 1, -1):
        name = "/".join(parts[1:length])
        if parts[0] == "sazare" and name in graph:
            return name
    return None


def sources(root=ROOT):
    """Every source of the engine, as paths relative to the root."""
    return sorted(p.relative_to(root) for p in (root / "sazare").rglob("*") if p.suffix in SOURCE_ENDINGS)


def includes(text):
    """(line number, quote or bracket, name) of every include of a text."""
    for number, line in enumerate(text.splitlines(), start=1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def problem_of(module, mark, name, graph, root):
    """What is wrong with one include of a module; None when it is allowed."""
    if mark == "<":
        return f'write "{name}" with quotes' if name.startswith("sazare/") else None
    if not name.startswith("sazare/"):
        return f'"{name}" must be written from the root, such as "sazare/core/vector.hpp"; other libraries take < >'
    if not (root / name).exists() and not (root / f"{name}.in").exists():
        return f"{name} does not exist"
    other = module_of(name, graph)
    if other is None:
        return f"{name} lies in no module of tests/layers/layers.toml"
    if other not in graph[module]:
        allowed = ", ".join(sorted(graph[module] - {module}))
        return f"{module} may not include {name}; it may include {allowed}"
    return None


def unused_edges(graph, root=ROOT):
    """(module, other) of the graph's edges that no include needs; core is there for all."""
    used = {module: {module, "core"} for module in graph}
    for path in sources(root):
        module = module_of(path, graph)
        if module is not None:
            used[module] |= {module_of(name, graph) for _, _, name in includes((root / path).read_text())}
    return sorted((module, other) for module, allowed in graph.items() for other in allowed - used[module])


def violations(graph, root=ROOT):
    """One line per include that the graph does not allow: file:line: what is wrong."""
    found = []
    for path in sources(root):
        module = module_of(path, graph)
        if module is None:
            found.append(f"{path}:1: lies in no module of tests/layers/layers.toml")
            continue
        for number, mark, name in includes((root / path).read_text()):
            problem = problem_of(module, mark, name, graph, root)
            if problem:
                found.append(f"{path}:{number}: {problem}")
    return found
