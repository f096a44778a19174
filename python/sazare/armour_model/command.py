"""The command `sazare armour-model`: its arguments, and what it writes and prints."""

import argparse
import shlex
from pathlib import Path

from sazare.arguments import length, number, positive, whole, within
from sazare.armour_model import words
from sazare.armour_model.layout import Layout, Rules, Slope
from sazare.armour_model.model import ArmourModel, Material, write_model
from sazare.armour_model.units import KINDS, unit_solid
from sazare.checked import lines_of, warnings_of
from sazare.engine import errors_of_commands
from sazare.simulation import check

TOLD = ("shapes", "steps", "work", "cost")  # lines of the check that are printed
SIZES = ("mass", "dn", "height")


def _kind(text):
    """A kind of units."""
    if text not in KINDS:
        known = "; ".join(f"{kind.name}, {kind.words}" for kind in KINDS.values())
        raise argparse.ArgumentTypeError(f"there is no unit {text!r}; the units are: {known}")
    return KINDS[text]


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "write the case of an armour layer: units of a kind, placed by a grid on a slope, with packing density and porosity"
    command = commands.add_parser("armour-model", help=text, description=text[0].upper() + text[1:] + ".")
    command.add_argument("unit", metavar="UNIT", type=_kind, help=f"kind of the units: {', '.join(KINDS)}")
    command.add_argument("--stl", metavar="FILE", help="of rock: its closed surface; its unit of length does not matter")
    size = command.add_mutually_exclusive_group(required=True)
    size.add_argument("--mass", metavar="KG", type=within(1e-3, 1e6, "kg"), help="mass of a unit [kg]")
    size.add_argument("--dn", metavar="M", type=length(20.0, 1e-3), help="nominal diameter of a unit, the cube root of its volume [m]")
    size.add_argument("--height", metavar="M", type=length(50.0, 1e-3), help="height of a unit [m]")
    command.add_argument("--density", metavar="KG/M3", type=within(500.0, 10000.0, "kg/m3", factors=(1e3,)), default=Material.density, help="density of the units [kg/m3] (default %(default)g)")
    command.add_argument("--cot", metavar="C", type=within(0.2, 20.0, ""), default=1.5, help="cotangent of the slope (default %(default)g)")
    command.add_argument("--toe", metavar="Z", type=number, default=0.0, help="level of the toe [m] (default %(default)g)")
    command.add_argument("--crest", metavar="Z", type=number, required=True, help="level of the crest [m]")
    command.add_argument("--width", metavar="M", type=length(10000.0), required=True, help="width along the shore, along which the slope repeats [m]")
    command.add_argument("--units", metavar="N", type=whole(1, 100000), help="number of units, from the toe up (default: as many as there is room for)")
    command.add_argument("--layers", metavar="N", type=whole(1, 4), help="number of layers (default: that of the unit)")
    command.add_argument("--packing", metavar="PHI", type=within(0.1, 4.0, ""), help="packing density N D_n^2/A of all layers (default: that of the unit)")
    command.add_argument("--grid", metavar=("SHORE", "UP"), nargs=2, type=length(1000.0), help="distances along the shore and up the slope [m], instead of --packing")
    command.add_argument("--orientation", choices=("random", "rule"), default="random", help="orientation of the units (default %(default)s)")
    command.add_argument("--seed", metavar="N", type=whole(1, 10**6), default=1, help="seed of what is random (default %(default)d)")
    command.add_argument("--smooth", action="store_true", help="no stones under the units: they lie on a plane")
    command.add_argument("--friction", metavar="MU", type=within(0.0, 5.0, ""), default=Material.friction, help="coefficient of friction (default %(default)g)")
    command.add_argument("--youngs-modulus", metavar="PA", type=positive, help="of units and stones [Pa] (default: 20000 times density, gravity and D_n; of units that break that of concrete)")
    command.add_argument("--spheres", metavar="N", type=whole(1, 1000), default=Material.count, help="spheres that fill a unit, at most (default %(default)d)")
    command.add_argument("--breaking", metavar="MPA", type=within(0.1, 50.0, "MPa", factors=(1e-6,)), help="tensile strength [MPa]: units are bonded spheres that break (default: rigid)")
    command.add_argument("--out", metavar="DIR", help="folder of the model (default: UNIT-model)")
    command.add_argument("--overwrite", action="store_true", help="replace the model that is in the folder")
    command.set_defaults(function=write, blame="no model can be made", advice="Please report it")


def write(chosen):
    """Writes a model, and prints what there is to know of it."""
    kind = chosen.unit
    if (kind.make is None) != (chosen.stl is not None):
        raise ValueError(f"{kind.name} takes no --stl: its shape is known" if chosen.stl else f"{kind.name} has the shape of a file: --stl FILE")
    if chosen.packing and chosen.grid:
        raise ValueError("--packing and --grid are two ways to say the same: keep one of them")
    size = (chosen.mass / chosen.density) ** (1.0 / 3.0) if chosen.mass else chosen.dn
    solid = unit_solid(kind, size=size, height=chosen.height, file=chosen.stl and Path(chosen.stl))
    rules = Rules(chosen.units, chosen.layers, chosen.packing, chosen.grid and tuple(chosen.grid), chosen.orientation, chosen.seed, not chosen.smooth)
    layout = Layout(Slope(chosen.toe, chosen.crest, chosen.cot, chosen.width), kind, solid, rules)
    material = Material(chosen.density, chosen.youngs_modulus, chosen.friction, chosen.breaking and 1e6 * chosen.breaking, chosen.spheres)
    model = ArmourModel(layout, material)
    print(*words.summary(model), "", sep="\n")
    print(*(f"note: {note}" for note in words.assumptions(model)), sep="\n")
    case = write_model(model, Path(chosen.out or f"{kind.name}-model"), chosen.overwrite, _line(chosen))
    print(f"\n{case.parent}: {case.name}, unit.stl, places.csv, model.md", flush=True)
    with errors_of_commands():
        said = check(case)
    print(*lines_of(said, TOLD), *warnings_of(said), sep="\n")
    print(f"\nsazare run {case} runs it")


def _line(chosen):
    """The command that makes the model again."""
    words_ = ["sazare armour-model", chosen.unit.name]
    for name in ("stl", *SIZES, "density", "cot", "toe", "crest", "width", "units", "layers", "packing", "seed", "friction", "youngs_modulus", "breaking"):
        value = getattr(chosen, name)
        default = {"density": Material.density, "cot": 1.5, "toe": 0.0, "seed": 1, "friction": Material.friction}.get(name)
        if value is not None and value != default:
            words_.append(f"--{name.replace('_', '-')} {shlex.quote(str(value) if name == 'stl' else f'{value:g}')}")
    words_ += [f"--spheres {chosen.spheres}"] if chosen.spheres != Material.count else []
    words_ += ["--grid {:g} {:g}".format(*chosen.grid)] if chosen.grid else []
    words_ += ["--orientation rule"] if chosen.orientation == "rule" else []
    return " ".join([*words_, *(["--smooth"] if chosen.smooth else [])])
