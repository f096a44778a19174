"""The command `sazare blast-model`: its arguments, and what it writes and prints."""

import argparse
import math
import shlex
from pathlib import Path

from sazare.arguments import positive, whole
from sazare.blast_model import words
from sazare.blast_model.joints import read_discs, refuse_outside
from sazare.blast_model.layout import FEWEST_AROUND, Options, layout_of
from sazare.blast_model.model import BlastModel, write_model
from sazare.blast_model.pattern import read_pattern
from sazare.blast_model.rock import GRANITE

TOLD = ("body", "holes", "explosive", "waves", "steps", "work", "cost")  # lines of the check that are printed


def face_angle(text):
    """The angle of a free face [deg]."""
    value = float(text)
    if not 30.0 <= value <= 90.0:
        raise argparse.ArgumentTypeError(f"must be 30 to 90 degrees from the horizontal, found {text}")
    return value


def direction(text):
    """An azimuth [deg]."""
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"must be a direction in degrees, found {text}")
    return value


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "write the geometry and the case of a blast from its drill pattern"
    command = commands.add_parser("blast-model", help=text, description=text[0].upper() + text[1:] + ".")
    command.add_argument("pattern", metavar="PATTERN", help="a table of charges and their holes (CSV)")
    command.add_argument("--burden", metavar="M", type=positive, help="from the collars of the front row to the crest of the bench [m] (default: the distance of the rows)")
    command.add_argument("--height", metavar="M", type=positive, help="height of the bench [m] (default: the depth of the shallowest toe)")
    command.add_argument("--face-angle", metavar="DEG", type=face_angle, default=Options.face_angle, help="angle of the free face from the horizontal [deg] (default %(default)g)")
    command.add_argument("--azimuth", metavar="DEG", type=direction, help="direction to which the free face looks, from y to x [deg] (default: by rows, lean and delays)")
    command.add_argument("--block", action="store_true", help="no bench: a block with one free surface, such as the face of a tunnel")
    command.add_argument("--margin", metavar="M", type=positive, help="rock around the holes [m] (default: two burdens; of a block the length of a hole)")
    command.add_argument("--size", metavar="M", type=positive, help="size of elements far from the holes [m] (default: a quarter of the burden or the margin)")
    command.add_argument("--around", metavar="N", type=whole(4, 64), default=FEWEST_AROUND, help="faces around a hole (default %(default)d)")
    command.add_argument("--joints", metavar="CSV", help="existing joints: discs with x, y, z, dip, dip_direction, radius")
    command.add_argument("--rock", metavar="CASE", help="a case of method blocks whose rock it is (default: a granite)")
    command.add_argument("--material", metavar="NAME", help="the material of that case; not needed where it has one")
    command.add_argument("--out", metavar="DIR", help="folder of the model (default: PATTERN-model, beside the pattern)")
    command.add_argument("--overwrite", action="store_true", help="replace the model that is in the folder")
    command.set_defaults(function=write, blame="{pattern}: no model can be made of it", advice="Please report it")


def write(chosen):
    """Writes a model, and prints what there is to know of it."""
    if chosen.block and (chosen.burden or chosen.height or chosen.azimuth is not None or chosen.face_angle != Options.face_angle):
        raise ValueError("--block has no bench, so --burden, --height, --face-angle and --azimuth go without it")
    if chosen.material and not chosen.rock:
        raise ValueError("--material is one of a case: --rock CASE")
    path = Path(chosen.pattern)
    pattern = read_pattern(path)
    layout = layout_of(pattern, Options(**{name: getattr(chosen, name) for name in Options.__dataclass_fields__}))
    discs = read_discs(chosen.joints) if chosen.joints else []
    refuse_outside(chosen.joints, discs, layout)
    model = BlastModel(layout, *_rock(chosen, discs))
    print(*words.summary(layout), "", *words.table(layout), "", sep="\n")
    print(*(f"note: {note}" for note in [*pattern.notes, *model.assumptions]), sep="\n")
    case = write_model(model, chosen.out or path.with_name(f"{path.stem}-model"), chosen.overwrite, _line(chosen))
    print(f"\n{case.parent}: {case.name}, model.geo, model.md", flush=True)
    print(*_checked(case), sep="\n")
    print(f"\nsazare run {case} runs it")


def _rock(chosen, discs):
    """Rock, discs and words for the rock, in the order of the fields of BlastModel."""
    from sazare.lab.rock import rock_from
    from sazare.simulation import source_of

    if not chosen.rock:
        return GRANITE, discs
    rock = _engine_errors(lambda: rock_from(source_of(Path(chosen.rock)), chosen.material))
    return rock, discs, f"{rock.name} of {chosen.rock}"


def _checked(case):
    """What `sazare check` says of the size and the cost of the run, and all that it warns of."""
    from sazare.simulation import check

    found = _engine_errors(lambda: check(case)).splitlines()
    told = False
    for line in found:
        told = line[2:].split(" ")[0] in TOLD if line[:2] == "  " and line[2:3] != " " else told and line[:3] == "   "
        if told:
            yield line
    place = next((number for number, line in enumerate(found) if "warning:" in line), len(found))
    yield from found[place:]


def _engine_errors(step):
    """What a step with the engine returns; its errors as those that the command tells."""
    from sazare.engine import engine

    try:
        return step()
    except engine().UserError as error:
        raise ValueError(error) from error
    except (engine().MachineError, engine().PhysicsError) as error:
        raise OSError(error) from error


def _line(chosen):
    """The command that makes the model again."""
    names = ("burden", "height", "azimuth", "margin", "size", "joints", "rock", "material")
    given = [f"--{name} {shlex.quote(str(getattr(chosen, name)))}" for name in names if getattr(chosen, name) is not None]
    given += [f"--face-angle {chosen.face_angle:g}"] if chosen.face_angle != Options.face_angle else []
    given += [f"--around {chosen.around}"] if chosen.around != FEWEST_AROUND else []
    return " ".join(["sazare blast-model", shlex.quote(chosen.pattern), *given, *(["--block"] if chosen.block else [])])
