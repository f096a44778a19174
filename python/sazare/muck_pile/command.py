"""The command `sazare muck-pile`: its arguments, and what it writes and prints."""

from pathlib import Path

from sazare.arguments import number, whole, within
from sazare.checked import WARNING
from sazare.engine import errors_of_commands
from sazare.muck_pile import words
from sazare.muck_pile.model import Options


COEFFICIENT = within(0.0, 10.0, "")  # of friction


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "let the fragments of a run of blasting fly and land as rigid bodies: throw, flyrock, muck pile, back-break, in DIR/muck-pile"
    command = commands.add_parser("muck-pile", help=text, description=text)
    command.add_argument("folder", metavar="DIR", help="the folder of a run of blasting that has ended")
    command.add_argument("--out", metavar="DIR", help="folder of the pile (default: muck-pile in that of the run)")
    command.add_argument("--overwrite", action="store_true", help="replace the pile that is in the folder")
    command.add_argument("--ground", metavar="Z", type=within(-20000.0, 20000.0, "m"), help="height of the ground [m] (default: of the floor in front of the rock that stays)")
    command.add_argument("--direction", metavar=("X", "Y"), type=number, nargs=2, help="direction of the throw (default: across the row of holes, or that of the momentum)")
    command.add_argument("--toe", metavar="M", type=within(-1e8, 1e8, "m"), help="coordinate along the throw at which the bench ends [m] (default: of the free face before the blast)")
    command.add_argument("--end", metavar="S", type=within(0.001, 3600.0, "s"), help="time for which fragments are followed [s] (default: until 99 %% of the mass has landed and settled)")
    command.add_argument("--restitution", metavar="E", type=within(0.001, 1.0, ""), default=Options.restitution, help="coefficient of restitution (default %(default)g)")
    command.add_argument("--friction", metavar="F", type=COEFFICIENT, help="coefficient of friction (default: of the contacts of the case)")
    command.add_argument("--rolling-friction", metavar="F", type=COEFFICIENT, default=Options.rolling_friction, help="coefficient of rolling friction (default %(default)g)")
    command.add_argument("--spheres", metavar="N", type=whole(1, 10_000), default=Options.most, help="spheres of one fragment, at most (default %(default)d)")
    command.add_argument("--smallest", metavar="M", type=within(0.0, 100.0, "m", factors=(1e-3,)), help="size below which fragments are fines that meet nothing [m] (default: the smallest with 1 %% of the mass)")
    command.add_argument("--threads", metavar="N", type=whole(1, 1_000_000), default=0, help="threads (default: all processors)")
    command.add_argument("--quiet", action="store_true", help="print results and warnings only")
    command.set_defaults(function=tell, blame="{folder}: the files of this run do not fit together", advice="If sazare wrote them as they are, please report it")


def tell(chosen):
    """Lets the fragments of a run fly, writes tables and pictures of the pile, and prints its numbers."""
    from sazare import style
    from sazare.muck_pile import pictures
    from sazare.muck_pile.numbers import write_numbers
    from sazare.muck_pile.throw import muck_pile
    from sazare.results import open_run

    options = Options(
        ground=chosen.ground, direction=tuple(chosen.direction) if chosen.direction else None, toe=chosen.toe, end=chosen.end, restitution=chosen.restitution,
        friction=chosen.friction, rolling_friction=chosen.rolling_friction, smallest=chosen.smallest, most=chosen.spheres,
    )

    def say(lines):
        told = [line for line in lines if not chosen.quiet or WARNING.match(line)]
        print(*told, sep="\n", flush=True) if told else None

    with errors_of_commands():
        numbers = muck_pile(
            open_run(chosen.folder), chosen.out, options, threads=chosen.threads, overwrite=chosen.overwrite, progress=not chosen.quiet, say=say,
        )
    folder = Path(chosen.out or Path(chosen.folder) / "muck-pile")
    print(*words.text_of(numbers), sep="\n")
    for name, figure in pictures.pictures_of(numbers):
        style.save(figure, folder / f"{name}.png")
    print(f"tables and pictures: {folder}; the run is in {folder / 'run'}")
