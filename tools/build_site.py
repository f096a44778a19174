"""Builds the documentation site: python tools/build_site.py [--pages-only].

The pages are copied as they lie in the tree, so that their links stay; the pages of the command and of the Python package, and the gallery, are
made here. Links to what is not a page (source files, folders) become plain words. mkdocs (mkdocs.yml) makes build/site of them; a warning is an error.
"""

import argparse
import inspect
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGES = ROOT / "build/site-pages"
COMMAND = ROOT / "build/release/apps/sazare/sazare"
SOURCES = ["docs/**/*.md", "docs/**/*.png", "docs/**/*.ipynb", "cases/*/*.md", "cases/*/*.png", "validation/**/*.md", "validation/**/*.png",
           "benchmarks/**/*.md", "benchmarks/**/*.png", "*.md", "examples/*.py"]
LINK = re.compile(r"(?<!!)\[([^\]]*)\]\(([^)\s#]+)(#[^)\s]*)?\)")
NAVIGATION = [
    ("Start", ["docs/start/README.md", "docs/start/first_blast.md", "docs/guide/python.md"]),
    ("Theory", "docs/theory/*.md"),
    ("Guide", "docs/guide/*.md"),
    ("Gallery", ["docs/gallery/README.md"]),
    ("Cases", "cases/*/README.md"),
    ("Reference", ["docs/reference/case.md", "docs/reference/run-folder.md", "docs/reference/coupling-files.md", "docs/reference/command.md", "docs/reference/python.md"]),
    ("Validation", ["docs/reference/validation.md", "validation/**/README.md"]),
    ("Develop", ["docs/develop/*.md", "CONTRIBUTING.md", "benchmarks/README.md", "CHANGELOG.md"]),
]


def copy_pages():
    """The pages and pictures of the tree, in its folders."""
    shutil.rmtree(PAGES, ignore_errors=True)
    for pattern in SOURCES:
        for path in sorted(ROOT.glob(pattern)):
            target = PAGES / path.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target)


def make_pages():
    """The pages that are made of the program itself."""
    (PAGES / "docs/reference/command.md").write_text(command_page(), encoding="utf-8")
    (PAGES / "docs/reference/python.md").write_text(package_page(), encoding="utf-8")
    (PAGES / "docs/start/first_blast.md").write_text(notebook_page(ROOT / "docs/start/first_blast.ipynb"), encoding="utf-8")
    shutil.move(PAGES / "README.md", PAGES / "index.md")


def command_page():
    """`sazare --help-all` as a page."""
    text = subprocess.run([COMMAND, "--help-all"], check=True, capture_output=True, text=True).stdout
    return f"# The command\n\n```text\n{text.strip()}\n```\n"


def package_page():
    """What `import sazare` offers, from its docstrings."""
    sys.path.insert(0, str(ROOT / "python"))
    import sazare

    lines = ["# The package `sazare`", "", "```text", inspect.getdoc(sazare), "```", ""]
    for name in sorted(sazare.__all__, key=str.lower):
        item = getattr(sazare, name)
        lines += [f"## `{name}{_signature(item)}`", "", *_words(item)]
        if inspect.isclass(item) and not issubclass(item, Exception):
            for member, value in _members(item):
                lines += [f"### `{name}.{member}{_signature(value)}`", "", *_words(value)]
    return "\n".join(lines)


def _members(kind):
    """What users call of a class: its own public functions and properties."""
    found = ((name, value) for base in reversed(kind.__mro__[:-1]) for name, value in vars(base).items() if base.__module__.startswith("sazare"))
    return [(name, value) for name, value in dict(found).items() if not name.startswith("_") and inspect.getdoc(value) and
            (callable(value) or isinstance(value, property) or hasattr(value, "func"))]


def _signature(item):
    if inspect.isclass(item) or not callable(item):
        return ""
    text = str(inspect.signature(item))
    return re.sub(r"^\(self(, )?", "(", text)


def _words(item):
    words = inspect.getdoc(item) or ""
    return ["```text", words, "```", ""] if "\n" in words else [words, ""]


def notebook_page(path):
    """A notebook as a page: words as they are, code as blocks."""
    import json

    blocks = []
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        text = "".join(cell["source"])
        blocks.append(text if cell["cell_type"] == "markdown" else f"```python\n{text}\n```")
    return "\n\n".join(blocks) + "\n"


def make_links_plain():
    """Links to what is not in the site become plain words."""
    for page in PAGES.rglob("*.md"):
        text = page.read_text(encoding="utf-8")

        def kept(match, folder=page.parent):
            words, target, _ = match.groups()
            if re.match(r"[a-z]+:", target) or (folder / target).is_file():
                return match[0]
            if (folder / target / "README.md").is_file():
                return match[0].replace(target, f"{target.rstrip('/')}/README.md")
            return words

        changed = LINK.sub(kept, text).replace("](README.md)", "](index.md)" if page.parent == PAGES else "](README.md)")
        if changed != text:
            page.write_text(changed, encoding="utf-8")


def title_of(page):
    """The first heading of a page."""
    found = re.search(r"^#\s+(.*)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1].replace("`", "") if found else page.stem


def navigation():
    """The table of contents as mkdocs takes it."""
    lines = ["nav:", "  - Sazare: index.md"]
    seen = set()
    for section, patterns in NAVIGATION:
        lines.append(f"  - {section}:")
        for pattern in [patterns] if isinstance(patterns, str) else patterns:
            for page in sorted(PAGES.glob(pattern)):
                name = page.relative_to(PAGES).as_posix()
                if name not in seen:
                    seen.add(name)
                    lines.append(f'      - "{title_of(page)}": {name}')
    return "\n".join(lines) + "\n"


def main(arguments=None):
    """Makes the pages and the site; returns the exit code of mkdocs."""
    parser = argparse.ArgumentParser(description="Builds the documentation site in build/site.")
    parser.add_argument("--pages-only", action="store_true", help="make the pages, not the site")
    chosen = parser.parse_args(arguments)
    copy_pages()
    make_pages()
    make_links_plain()
    settings = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").replace("build/site", str(ROOT / "build/site"))
    (ROOT / "build/mkdocs.yml").write_text(settings + navigation(), encoding="utf-8")
    if chosen.pages_only:
        return 0
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    return subprocess.run([sys.executable, "-m", "mkdocs", "build", "--quiet", "--config-file", ROOT / "build/mkdocs.yml"], check=False, env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
