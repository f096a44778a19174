"""The command `python -m sazare`, to which `sazare report`, `plot`, `movie`, `compare` and `check --picture` hand over."""

import os
import sys
import time
import traceback
from pathlib import Path

from sazare.arguments import Parser, not_negative, within
from sazare.armour import command as armour_command
from sazare.armour_model import command as armour_model_command
from sazare.blast import command as blast_command
from sazare.blast_model import command as blast_model_command
from sazare.comparison import compare
from sazare.ground_motion import command as motion_command
from sazare.lab import command as lab_command
from sazare.muck_pile import command as muck_pile_command
from sazare.results import open_run
from sazare.summary import terminal_text
from sazare.sweep import command as sweep_command
from sazare.tables import NotARun

USER_ERROR, MACHINE_ERROR = 2, 4
SECONDS_PER_FRAME = within(0.001, 60.0, "s", factors=(1e-3,))  # pictures count it in milliseconds, in two bytes


def report(chosen):
    """Writes the report, and says where it is."""
    from sazare.report import write_report

    started = time.monotonic()
    page = write_report(chosen.folder)
    print(f"report: {page} ({time.monotonic() - started:.1f} s)")


def summary(chosen):
    """Prints the headline figures, and where the report is if there is one."""
    results = open_run(chosen.folder)
    print(terminal_text(results))
    page = results.path / "report.html"
    if page.exists():
        print(f"report: {page}")


def plot(chosen):
    """Writes chosen pictures of the report, or lists their names."""
    from sazare.report import write_pictures

    for line in write_pictures(chosen.folder, chosen.names, chosen.out):
        print(line)


def movie(chosen):
    """Writes the animation, and says where it is."""
    from sazare.movie import write_movie

    results = open_run(chosen.folder)
    print(write_movie(results, Path(chosen.out or results.path / "movie.gif"), chosen.field, chosen.enlarge, chosen.interval))


def comparison(chosen):
    """Prints the comparison of two runs."""
    print(compare(chosen.folder, chosen.other))


def model(chosen):
    """Draws a case before it runs, and says where the picture is."""
    from sazare.engine import errors_of_commands
    from sazare.model import draw_source
    from sazare.simulation import source_of

    with errors_of_commands():
        draw_source(source_of(Path(chosen.case)).with_settings(chosen.set), chosen.picture)
    print(f"picture: {chosen.picture}")


def parser():
    """What the command line may say."""
    top = Parser(prog="sazare", description="Read, draw and report the folder of a run.")
    commands = top.add_subparsers(dest="command", required=True)

    def add(name, words, function):
        reading = commands.add_parser(name, help=words, description=words)
        reading.add_argument("folder", metavar="DIR", help="the folder of a run")
        reading.set_defaults(
            function=function, blame="{folder}: the files of this run do not fit together", advice="If sazare wrote them as they are, please report it",
        )
        return reading

    add("report", "write DIR/report.html and its pictures", report)
    add("summary", "print the headline figures", summary)
    drawn = add("plot", "write chosen pictures of the report as PNG; without names, list what there is", plot)
    drawn.add_argument("names", metavar="NAME", nargs="*", help="a picture, such as energy or gauges")
    drawn.add_argument("--out", metavar="DIR", help="folder of the pictures (default: the current one)", default=".")
    moving = add("movie", "write the snapshots as an animation", movie)
    moving.add_argument("--out", metavar="FILE", help="a .gif or .webp (default: DIR/movie.gif)")
    moving.add_argument("--field", metavar="NAME", help="the field shown in colour, such as speed or displacement")
    moving.add_argument("--enlarge", metavar="FACTOR", type=not_negative, help="magnification of displacements")
    moving.add_argument("--interval", metavar="SECONDS", type=SECONDS_PER_FRAME, default=0.15, help="time for which each frame is shown [s]")
    add("compare", "compare figures and histories of two runs", comparison).add_argument("other", metavar="OTHER")
    drawn = commands.add_parser("model", help="draw a case before it runs, as sazare check --picture does")
    drawn.add_argument("case", metavar="CASE", help="the case file (TOML)")
    drawn.add_argument("picture", metavar="FILE", help="a .png, .pdf, .svg or .jpg")
    drawn.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="override a key of the case")
    drawn.set_defaults(function=model, blame="{case}: the model of this case cannot be drawn", advice="Please report it")
    lab_command.add_to(commands)
    motion_command.add_to(commands)
    blast_command.add_to(commands)
    blast_model_command.add_to(commands)
    muck_pile_command.add_to(commands)
    sweep_command.add_to(commands)
    armour_command.add_to(commands)
    armour_model_command.add_to(commands)
    return top


def drop_unwritten_output():
    """Lets go of what standard output cannot take, or the interpreter would try again at its end, and end with another exit code."""
    try:
        sys.stdout.flush()
    except OSError:
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)


def main(arguments=None):
    """Runs the command; returns its exit code: 0 done, 2 an error of the user, 4 the machine, or Ctrl-C."""
    chosen = None
    try:
        chosen = parser().parse_args(arguments)
        chosen.function(chosen)
        sys.stdout.flush()
    except KeyboardInterrupt:
        print("stopped", file=sys.stderr)
        return MACHINE_ERROR
    except (NotARun, ValueError) as error:
        words = str(error)
        print(words if ": error: " in words else f"error: {words}", file=sys.stderr)
        return USER_ERROR
    except OSError as error:
        print(f"error: {error}", file=sys.stderr)
        drop_unwritten_output()
        return MACHINE_ERROR
    except (TypeError, KeyError, IndexError, AttributeError, ArithmeticError, RuntimeError) as error:
        place = traceback.extract_tb(error.__traceback__)[-1]
        cause = f"{type(error).__name__}: {error} ({Path(place.filename).name}:{place.lineno})"
        print(f"error: {chosen.blame.format(**vars(chosen))}: {cause}. {chosen.advice}", file=sys.stderr)
        return USER_ERROR
    return 0


if __name__ == "__main__":
    sys.exit(main())
