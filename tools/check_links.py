"""Checks that what Markdown pages link to is there: files, pictures, and headings.

    python tools/check_links.py README.md docs ...

Prints one line per broken link, file:line, and ends with 1 when there is one. Links to the web are not followed.
"""

import re
import sys
from pathlib import Path

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)[^)]*\)")
HEADING = re.compile(r"^#+\s+(.*?)\s*#*$")


def pages(names):
    """The Markdown files among files and folders; folders that are not there count as empty."""
    for name in map(Path, names):
        yield from sorted(name.rglob("*.md")) if name.is_dir() else [name] * name.exists()


def lines_outside_code(text):
    """(line number, line) without those in fenced blocks, inline code blanked."""
    inside = False
    for number, line in enumerate(text.splitlines(), start=1):
        if line.lstrip().startswith("```"):
            inside = not inside
        elif not inside:
            yield number, re.sub(r"`[^`]*`", "", line)


def anchors(text):
    """The names under which a page's headings can be linked."""
    found = (HEADING.match(line) for _, line in lines_outside_code(text))
    return {re.sub(r"[^\w\- ]", "", match[1].lower()).replace(" ", "-") for match in found if match}


def broken_links(page):
    """(line number, what is wrong) of a page."""
    text = page.read_text(encoding="utf-8")
    for number, line in lines_outside_code(text):
        for target in LINK.findall(line):
            if re.match(r"[a-z]+:", target):
                continue
            name, _, anchor = target.partition("#")
            other = page.parent / name if name else page
            if not other.exists():
                yield number, f"{target} is not there"
            elif anchor and other.suffix == ".md" and anchor not in anchors(other.read_text(encoding="utf-8")):
                yield number, f"{target}: {other} has no such heading"


def main(names):
    """Checks the pages; returns the exit code."""
    checked = list(pages(names))
    wrong = [f"{page}:{number}: {words}" for page in checked for number, words in broken_links(page)]
    print("\n".join([*wrong, f"{len(checked)} pages, {len(wrong)} broken links"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
