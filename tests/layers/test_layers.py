"""The sources keep to the module graph of layers.toml, and every header compiles alone."""

import hashlib
import json
import os
import re
import shlex
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from layers import ROOT, includes, module_of, problem_of, read_graph, sources, unused_edges, violations

COMMANDS = ROOT / "build" / "release" / "compile_commands.json"
COMPILED = ROOT / "build" / "test" / "headers-that-compile.txt"
HEADERS = [path for path in sources() if path.suffix == ".hpp"]


def test_every_include_is_allowed():
    found = violations(read_graph())
    assert not found, "\n" + "\n".join(found)


def test_every_edge_is_used():
    assert not unused_edges(read_graph())


def test_an_unused_edge_is_found(small_tree):
    assert unused_edges({"core": {"core"}, "cases": {"cases", "core"}, "geometry": {"geometry", "core", "cases"}}, small_tree) == [
        ("geometry", "cases")
    ]


# One folder per method: whoever else works with a method goes by the table of methods, which the registry alone lists.
METHODS = sorted(path.name for path in (ROOT / "sazare/methods").iterdir() if path.is_dir())
SHARED = ("core", "parallel", "laws", "geometry", "state", "neighbors", "observe", "coupling", "levels", "particles", "cases", "runs")


def test_shared_modules_include_no_method():
    found = [
        f"{path}:{number}: {name}"
        for path in sources()
        if path.parts[1] in SHARED
        for number, _, name in includes((ROOT / path).read_text())
        if name.startswith("sazare/methods/")
    ]
    assert not found, "\n" + "\n".join(found)


@pytest.mark.parametrize("method", METHODS)
def test_few_files_name_a_method_by_its_includes(method):
    others = {
        path.as_posix()
        for path in sources()
        if not path.as_posix().startswith((f"sazare/methods/{method}/", "sazare/methods/hybrid/"))
        for _, _, name in includes((ROOT / path).read_text())
        if name.startswith(f"sazare/methods/{method}/")
    }
    assert others == {"sazare/registry/methods.cpp"}


def test_no_folder_is_crowded():
    folders = {p.parent for p in (ROOT / "sazare").rglob("*")}
    crowded = {str(folder): len(list(folder.iterdir())) for folder in folders if len(list(folder.iterdir())) >= 40}
    assert not crowded


def test_every_folder_of_the_engine_is_in_the_graph():
    graph = read_graph()
    folders = {p.parent.relative_to(ROOT / "sazare").as_posix() for p in (ROOT / "sazare").rglob("CMakeLists.txt")}
    assert folders - {"."} <= set(graph)


def test_modules_link_only_what_they_may_include():
    graph = read_graph()
    for module in graph:
        build_file = ROOT / "sazare" / module / "CMakeLists.txt"
        if not build_file.exists():
            continue
        words = re.sub(r"#.*", "", build_file.read_text())
        for depends in re.findall(r"DEPENDS\s+([^)A-Z]*)", words):
            extra = set(depends.split()) - graph[module]
            assert not extra, f"{build_file.relative_to(ROOT)}: {module} may not depend on {', '.join(sorted(extra))}"


@pytest.fixture
def small_tree(tmp_path):
    """A root with one header in core and one in cases."""
    for module in ("core", "cases"):
        (tmp_path / "sazare" / module).mkdir(parents=True)
        (tmp_path / "sazare" / module / "thing.hpp").touch()
    (tmp_path / "sazare" / "loose.hpp").touch()
    return tmp_path


@pytest.mark.parametrize(
    "mark, name, words",
    [
        ('"', "sazare/core/absent.hpp", "does not exist"),
        ('"', "thing.hpp", "must be written from the root"),
        ("<", "sazare/core/thing.hpp", "with quotes"),
        ('"', "sazare/loose.hpp", "lies in no module"),
        ('"', "sazare/cases/thing.hpp", "geometry may not include sazare/cases/thing.hpp; it may include core"),
    ],
)
def test_forbidden_includes_are_explained(mark, name, words, small_tree):
    assert words in problem_of("geometry", mark, name, read_graph(), small_tree)


def test_allowed_includes_pass(small_tree):
    graph = read_graph()
    assert problem_of("geometry", '"', "sazare/core/thing.hpp", graph, small_tree) is None
    assert problem_of("geometry", "<", "Eigen/Core", graph, small_tree) is None


def test_a_forbidden_include_is_found_at_its_line(small_tree):
    (small_tree / "sazare" / "core" / "thing.hpp").write_text('#pragma once\n\n#include "sazare/cases/thing.hpp"\n')
    found = violations(read_graph(), small_tree)
    assert "sazare/core/thing.hpp:3: core may not include sazare/cases/thing.hpp; it may include " in "\n".join(found)


def test_module_of_a_path():
    graph = read_graph()
    assert module_of("sazare/methods/blocks/joint.hpp", graph) == "methods/blocks"
    assert module_of("sazare/core/vector.hpp", graph) == "core"
    assert module_of("sazare/nowhere/vector.hpp", graph) is None


def test_graph_refuses_a_cycle(tmp_path):
    path = tmp_path / "layers.toml"
    path.write_text('[modules]\ncore = []\nstate = ["terms"]\nterms = ["state"]\n')
    with pytest.raises(ValueError, match="state may not name 'terms'"):
        read_graph(path)


def first_includes():
    """Headers that a source of the build includes before anything else: the build has compiled them alone already."""
    for entry in json.loads(COMMANDS.read_text()):
        source = Path(entry["file"])
        if source.exists():
            yield next((Path(name) for _, _, name in includes(source.read_text())), None)


def compiler_flags():
    """The compiler and every include folder, definition and language flag that the build gives the engine's sources."""
    if not COMMANDS.exists():
        pytest.fail(f"{COMMANDS.relative_to(ROOT)} is not there: run `make test` once")
    flags = {}
    compiler = "c++"
    for entry in json.loads(COMMANDS.read_text()):
        words = shlex.split(entry["command"])
        compiler = words[0]
        for place, word in enumerate(words):
            if word in ("-isystem", "-I"):
                flags[(word, words[place + 1])] = None
            elif re.match(r"-(I.|D|std=|W(?!p,)|f(openmp|fp-contract))", word):
                flags[(word,)] = None
    return [compiler, *(word for pair in flags for word in pair)]


def compile_alone(flags, header):
    """The compiler's words about a source that includes this header and nothing else; empty when it compiles."""
    command = [*flags, "-fsyntax-only", "-x", "c++", "-"]
    done = subprocess.run(command, input=f'#include "{header}"\n', capture_output=True, text=True, cwd=ROOT)
    return "" if done.returncode == 0 else done.stderr or f"the compiler ended with {done.returncode}"


def fingerprint(flags, header):
    """Changes when the flags, the header, or one of the engine's headers it includes changes."""
    digest = hashlib.sha256("\0".join(flags).encode())
    waiting, seen = [str(header)], set()
    while waiting:
        name = waiting.pop()
        if name in seen or not (ROOT / name).exists():
            continue
        seen.add(name)
        text = (ROOT / name).read_text()
        digest.update(f"{name}\0{text}\0".encode())
        waiting += sorted(other for _, _, other in includes(text))
    return digest.hexdigest()


@pytest.fixture(scope="module")
def verdicts():
    """The compiler's words about each header but those it has compiled alone before: in the build, or here and unchanged."""
    flags = compiler_flags()
    built = set(first_includes())
    prints = {header: fingerprint(flags, header) for header in HEADERS if header not in built}
    known = set(COMPILED.read_text().split()) if COMPILED.exists() else set()
    waiting = [header for header in prints if prints[header] not in known]
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        words = dict(zip(waiting, pool.map(lambda header: compile_alone(flags, header), waiting)))
    COMPILED.parent.mkdir(parents=True, exist_ok=True)
    COMPILED.write_text("\n".join(prints[header] for header in prints if not words.get(header)))
    return words


@pytest.mark.parametrize("header", HEADERS, ids=str)
def test_header_compiles_alone(header, verdicts):
    assert not verdicts.get(header), f"{header} does not compile alone:\n{verdicts.get(header)}"
