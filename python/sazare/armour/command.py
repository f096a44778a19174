"""The command `sazare armour`: its arguments, and what it writes and prints."""

from pathlib import Path

from sazare.arguments import not_negative, positive
from sazare.engine import errors_of_commands


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "count the damage of an armour layer of method spheres: displaced, shifted and rocking units, N_od, eroded area, settlement, packing density and porosity, in DIR/armour"
    command = commands.add_parser("armour", help=text, description=text)
    command.add_argument("folder", metavar="DIR", help="the folder of a run of method spheres")
    command.add_argument("--group", metavar="NAME", action="append", help="group of units (default: all groups of a shape); may be given more than once")
    command.add_argument("--from", metavar="S", dest="start", type=not_negative, help="time from which movement counts [s] (default: of the first snapshot)")
    command.add_argument("--along", metavar="AXIS", choices=("x", "y", "z"), help="axis along the shore (default: the level periodic axis)")
    command.add_argument("--width", metavar="M", type=positive, help="width of the slope along the shore [m] (default: the length of the periodic axis)")
    command.add_argument("--slope", metavar="WALL", help="the wall that is the plane of the slope, for packing density and porosity (default: the one with the name slope)")
    command.set_defaults(function=tell, blame="{folder}: the files of this run do not fit together", advice="If sazare wrote them as they are, please report it")


def tell(chosen):
    """Counts the damage, writes tables and pictures, and prints the numbers."""
    from sazare import style
    from sazare.armour.damage import Options, check_along, write_damage
    from sazare.armour.pictures import pictures_of
    from sazare.armour.words import text_of
    from sazare.folders import own
    from sazare.results import open_run

    with errors_of_commands():
        results = open_run(chosen.folder)
        damage = check_along(results, Options(tuple(chosen.group) if chosen.group else None, chosen.start, chosen.width, chosen.along, chosen.slope))
        folder = Path(chosen.folder) / "armour"
        write_damage(damage, folder)
        print(*text_of(damage), sep="\n")
        for name, figure in pictures_of(damage):
            style.save(figure, own(folder / f"{name}.png"))
    print(f"tables and pictures: {folder}")
