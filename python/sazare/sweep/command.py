"""The command `sazare sweep`: its arguments, and what it writes and prints."""

import math

from sazare import style
from sazare.arguments import whole
from sazare.engine import errors_of_commands
from sazare.folders import own
from sazare.sweep.family import Sweep, parameter_of
from sazare.sweep.pictures import figures_over
from sazare.tables import write_table

SHOWN = ("p50", "half_cast_factor", "broken_area", "detached_volume", "throw_max", "energy_work")  # unless others are asked for


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "run a case with every combination of values of some keys, several at once, and put their figures into one table and picture"
    command = commands.add_parser(
        "sweep", help=text, description=f"{text[0].upper()}{text[1:]}. Given again, it goes on where it was stopped.",
    )
    command.add_argument("case", metavar="CASE", help="the case file (TOML)")
    command.add_argument("--over", metavar="KEY=V,V,...", action="append", required=True, help="a key of the case and its values; once for each key")
    command.add_argument("--out", metavar="DIR", required=True, help="folder of the sweep")
    command.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="override a key of the case in all runs")
    command.add_argument("--jobs", metavar="N", type=whole(1, 1024), default=1, help="runs at once (default 1)")
    command.add_argument("--threads", metavar="N", type=whole(1, 4096), default=1, help="threads of each run (default 1)")
    command.add_argument("--figures", metavar="NAME", nargs="+", default=[], help="figures that are printed and drawn, such as p50 or 'ppv G1' (default: some)")
    command.set_defaults(function=tell, blame="{out}: the runs of this sweep do not fit together", advice="If sazare wrote them as they are, please report it")


def tell(chosen):
    """Carries out a sweep, writes its table and picture, and prints the table."""
    with errors_of_commands():
        sweep = Sweep(chosen.case, [parameter_of(text) for text in chosen.over], chosen.out, chosen.set)
        failed = sweep.run(chosen.jobs, chosen.threads, lambda line: print(line, flush=True))
    columns = sweep.table()
    write_table(own(sweep.out / "sweep.csv"), columns)
    unknown = [name for name in chosen.figures if name not in columns]
    if unknown and len(failed) < len(columns["run"]):
        raise ValueError(f"no run has the figure {unknown[0]!r}; there are {', '.join(list(columns)[2 + len(sweep.parameters):])}")
    names = [name for name in chosen.figures or SHOWN if name in columns]
    print(*lines_of(sweep, columns, names), sep="\n")
    figure = figures_over(sweep, columns, names)
    if figure is not None:
        style.save(figure, own(sweep.out / "sweep.png"))
    print(f"table{' and picture' if figure is not None else ''}: {sweep.out}")
    if failed:
        raise ValueError("\n".join(f"run {sweep.folder(number).name} failed: {words}" for number, words in sorted(failed.items())))


def lines_of(sweep, columns, names):
    """The table of a sweep as lines for a terminal."""
    shown = ["run", *(one.key for one in sweep.parameters), "status", *names]
    cells = [shown, *([_cell(columns[name][row]) for name in shown] for row in range(len(columns["run"])))]
    widths = [max(len(row[place]) for row in cells) for place in range(len(shown))]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in cells]


def _cell(value):
    return value if isinstance(value, str) else "-" if not math.isfinite(value) else f"{value:.4g}"
