"""The script that checks the documentation's links."""

import importlib.util
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "tools" / "check_links.py"
specification = importlib.util.spec_from_file_location("check_links", SCRIPT)
check_links = importlib.util.module_from_spec(specification)
specification.loader.exec_module(check_links)


def test_broken_links_are_named_at_their_lines(tmp_path, capsys):
    page = tmp_path / "page.md"
    page.write_text("# A title: with marks\n[good](#a-title-with-marks) `[code](absent)`\n[bad](absent.md)\n![bad](#no)\n")
    assert check_links.main([str(tmp_path)]) == 1
    printed = capsys.readouterr().out.splitlines()
    assert printed[0] == f"{page}:3: absent.md is not there"
    assert printed[1].startswith(f"{page}:4: #no: ")
    assert printed[-1] == "1 pages, 2 broken links"


def test_pages_without_broken_links_pass(tmp_path):
    (tmp_path / "page.md").write_text("[web](https://example.org) [self](page.md)\n```\n[code](absent)\n```\n")
    assert check_links.main([str(tmp_path / "page.md"), str(tmp_path / "absent")]) == 0
