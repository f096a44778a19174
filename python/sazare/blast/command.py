"""The command `sazare blast`: its arguments, and what it writes and prints."""

from sazare import style
from sazare.arguments import positive
from sazare.blast import curves
from sazare.blast.numbers import BlastNumbers, write_numbers
from sazare.blast.settings import Settings
from sazare.blast.words import text_of
from sazare.folders import own
from sazare.results import open_run


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "sizes of fragments, vibration, damage and energy of a run of blasting, as tables and pictures in DIR/blast"
    command = commands.add_parser("blast", help=text, description=f"Tell {text}. What is said here, the report uses too when it is made after this.")
    command.add_argument("folder", metavar="DIR", help="the folder of a run")
    command.add_argument("--oversize", metavar="M", type=positive, help="size above which a fragment is too large [m]")
    command.add_argument(
        "--charge-mass", metavar="KG", type=positive, nargs="+", default=[],
        help="mass of the charge of each hole in the order of the case, or one mass for all [kg]: vibration is told over scaled distance",
    )
    command.add_argument(
        "--contour", metavar="NAME", nargs="+", default=[],
        help="contour holes, by the physical groups of their walls or patterns such as 'rim_*', which share the half-cast factor (default: all holes)",
    )
    command.set_defaults(function=tell, blame="{folder}: the files of this run do not fit together", advice="If sazare wrote them as they are, please report it")


def tell(chosen):
    """Writes the numbers and pictures of a blast, and prints the numbers."""
    results = open_run(chosen.folder)
    numbers = BlastNumbers(results, Settings(chosen.oversize, tuple(chosen.charge_mass), tuple(chosen.contour)))
    folder = write_numbers(numbers)
    print(text_of(numbers))
    for name, figure in pictures_of(numbers):
        style.save(figure, own(folder / f"{name}.png"))
    print(f"tables and pictures: {folder}")


def pictures_of(numbers):
    """The curves of BlastNumbers that there is data for: (name, matplotlib Figure)."""
    drawn = {
        "sizes": curves.size_distribution(numbers.sphere, numbers.sieve, numbers.settings.oversize),
        "attenuation": curves.attenuation_curve(numbers.shaken),
        "vibration_limits": curves.limit_curves(numbers.shaken),
        "damage": curves.damage_curves(numbers.damages),
        "radiated": curves.absorbed_energy(numbers.results),
    }
    return [(name, figure) for name, figure in drawn.items() if figure is not None]
