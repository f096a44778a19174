"""The command `python -m sazare`: report DIR, summary DIR."""

import argparse
import sys
import time

from sazare.results import NotARun, open_run
from sazare.summary import terminal_text

USER_ERROR, MACHINE_ERROR = 2, 4


def report(folder):
    """Writes the report, and says where it is."""
    from sazare.report import write_report

    started = time.monotonic()
    page = write_report(folder)
    print(f"report: {page} ({time.monotonic() - started:.1f} s)")


def summary(folder):
    """Prints the headline figures, and where the report is if there is one."""
    results = open_run(folder)
    print(terminal_text(results))
    page = results.path / "report.html"
    if page.exists():
        print(f"report: {page}")


def main(arguments=None):
    """Runs the command; returns its exit code: 0 done, 2 not a run, 4 the machine."""
    parser = argparse.ArgumentParser(prog="python -m sazare", description="Read and report the folder of a run.")
    commands = parser.add_subparsers(dest="command", required=True)
    for name, words in (("report", "write DIR/report.html and its pictures"), ("summary", "print the headline figures")):
        command = commands.add_parser(name, help=words, description=words)
        command.add_argument("folder", metavar="DIR", help="the folder of a run")
    chosen = parser.parse_args(arguments)
    try:
        {"report": report, "summary": summary}[chosen.command](chosen.folder)
    except NotARun as error:
        print(f"error: {error}", file=sys.stderr)
        return USER_ERROR
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        return MACHINE_ERROR
    return 0


if __name__ == "__main__":
    sys.exit(main())
