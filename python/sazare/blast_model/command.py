"""The command `sazare blast-model`: its arguments, and what it writes and prints."""

import shlex
from pathlib import Path

from sazare.arguments import length, whole, within
from sazare.blast_model import words
from sazare.blast_model.drawing import UNITS
from sazare.blast_model.drawn import tables_of
from sazare.blast_model.ground import Ground
from sazare.blast_model.joint_field import joint_field
from sazare.blast_model.joint_sets import read_joint_sets, refuse_unused
from sazare.blast_model.joints import read_discs, refuse_outside
from sazare.blast_model.layout import FEWEST_AROUND, Options, layout_of
from sazare.blast_model.mesh_quality import checked
from sazare.blast_model.model import FILES, BlastModel, write_model
from sazare.blast_model.pattern import read_pattern
from sazare.blast_model.rock import GRANITE
from sazare.checked import lines_of, warnings_of
from sazare.engine import errors_of_commands
from sazare.folders import require_room

TOLD = ("body", "holes", "explosive", "waves", "steps", "work", "cost")  # lines of the check that are printed
AZIMUTH = within(-360.0, 360.0, "degrees")
LAYERS = ("layer-holes", "layer-names", "layer-crest", "layer-toe", "layer-joints")


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "write the geometry and the case of a blast from its drill pattern"
    command = commands.add_parser("blast-model", help=text, description=text[0].upper() + text[1:] + ".")
    command.add_argument("pattern", metavar="PATTERN", help="a table of charges and their holes (CSV), or a drawing of the holes (DXF)")
    command.add_argument("--layer-holes", metavar="NAME", help="of a drawing: the layer of the holes, lines from collar to toe")
    command.add_argument("--charges", metavar="CSV", help="of a drawing: a table of charges by hole, without coordinates; the hole * is all that have no row")
    command.add_argument("--layer-names", metavar="NAME", help="of a drawing: the layer of the texts that name the holes (default: that of the holes)")
    command.add_argument("--layer-crest", metavar="NAME", help="of a drawing: the layer of the crest, from which burden and azimuth follow")
    command.add_argument("--layer-toe", metavar="NAME", help="of a drawing: the layer of the lower edge of the face, from which its height and angle follow")
    command.add_argument("--layer-joints", metavar="NAME", nargs="+", help="of a drawing: layers of joints, circles and 3-D faces; each of several is a set")
    command.add_argument("--dxf-unit", metavar="UNIT", choices=list(UNITS), help="of a drawing: the unit of its coordinates, mm, cm, m, in or ft (default: that of its header)")
    command.add_argument("--burden", metavar="M", type=length(1000.0), help="from the collars of the front row to the crest of the bench [m] (default: the distance of the rows)")
    command.add_argument("--height", metavar="M", type=length(1000.0), help="height of the bench [m] (default: the depth of the shallowest toe)")
    command.add_argument("--face-angle", metavar="DEG", type=within(30.0, 90.0, "degrees from the horizontal"), default=Options.face_angle, help="angle of the free face from the horizontal [deg] (default %(default)g)")
    command.add_argument("--azimuth", metavar="DEG", type=AZIMUTH, help="direction to which the free face looks, from y to x [deg] (default: by rows, lean and delays)")
    command.add_argument("--block", action="store_true", help="no bench: a block with one free surface, such as the face of a tunnel")
    command.add_argument("--margin", metavar="M", type=length(10000.0), help="rock around the holes [m] (default: two burdens; of a block the length of a hole)")
    command.add_argument("--size", metavar="M", type=length(1000.0), help="size of elements far from the holes [m] (default: a quarter of the burden or the margin)")
    command.add_argument("--around", metavar="N", type=whole(4, 64), default=FEWEST_AROUND, help="faces around a hole (default %(default)d)")
    command.add_argument("--joints", metavar="CSV", help="existing joints: discs with x, y, z, dip, dip_direction, radius, set")
    command.add_argument("--joint-sets", metavar="CSV", help="sets of joints: discs drawn by direction, size and P32, and the law of each set")
    command.add_argument("--gravity", action="store_true", help="weight, and the stress at the beginning that it makes")
    command.add_argument("--depth", metavar="M", type=within(0.0, 10000.0, "m"), help="ground above the collar of the first hole of a --block [m]; with --gravity (default: 0)")
    command.add_argument("--k0", metavar="K", type=within(0.0, 100.0, ""), help="horizontal over vertical stress (default: nu/(1 - nu) of the rock)")
    command.add_argument("--horizontal-stress", metavar=("LARGER", "SMALLER"), nargs=2, type=within(0.0, 1000.0, "MPa", factors=(1e-6, 1e-3)), help="horizontal stresses [MPa], compression positive, instead of --k0")
    command.add_argument("--stress-azimuth", metavar="DEG", type=AZIMUTH, help="direction of the larger horizontal stress, from y to x [deg] (default: 0, north)")
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
    ground, path, line = _ground(chosen), Path(chosen.pattern), _line(chosen)
    folder = Path(chosen.out or path.with_name(f"{path.stem}-model"))
    options = {name: getattr(chosen, name) for name in Options.__dataclass_fields__}
    table, notes = path, []
    if _is_drawing(chosen):
        table, chosen.joints, bench, notes = _from_drawing(chosen, folder)
        options |= {name: value for name, value in bench.items() if options[name] in (None, getattr(Options, name))}
    pattern = read_pattern(table)
    layout = layout_of(pattern, Options(**options))
    joints, sets = _joints(chosen, layout)
    model = BlastModel(layout, *_rock(chosen), joints, sets, ground)
    print(*words.summary(layout), "", *words.table(layout), "", sep="\n")
    if joints.rows:
        print(*words.aligned(joints.table), "", sep="\n")
    print(*(f"note: {note}" for note in [*notes, *pattern.notes, *model.assumptions]), sep="\n")
    case = write_model(model, folder, chosen.overwrite, line)
    print(f"\n{case.parent}: {case.name}, model.geo, model.md", flush=True)
    try:
        print(*_checked(case, layout), sep="\n")
    except (ValueError, OSError) as error:
        raise type(error)(f"{error}\n      help: {case.parent} keeps what was written, to look at model.geo with gmsh; --overwrite replaces it") from error
    print(f"\nsazare run {case} runs it")


def _is_drawing(chosen):
    """Whether the pattern is a drawing; raises ValueError where what is given does not go with that."""
    of_drawings = [f"--{name}" for name in (*LAYERS, "charges", "dxf-unit") if getattr(chosen, name.replace("-", "_")) is not None]
    if Path(chosen.pattern).suffix.lower() != ".dxf":
        if of_drawings:
            raise ValueError(f"{of_drawings[0]} is of drawings, and {chosen.pattern} is none: its name does not end in .dxf")
        return False
    for name, what in (("layer_holes", "--layer-holes NAME says on which layer the holes are"), ("charges", "--charges CSV has diameter, explosive, stemming and delay of the holes")):
        if getattr(chosen, name) is None:
            raise ValueError(f"{chosen.pattern}: a drawing has lines only: {what}")
    if chosen.layer_toe and not chosen.layer_crest:
        raise ValueError("--layer-toe is the lower edge of the face below the crest: --layer-crest NAME")
    if chosen.layer_joints and chosen.joints:
        raise ValueError("--joints and --layer-joints both have the joints: keep one of them")
    if chosen.block and chosen.layer_crest:
        raise ValueError("--block has no bench, so --layer-crest goes without it")
    return True


def _from_drawing(chosen, folder):
    """The tables of a drawing, written into the folder of the model: paths of pattern and joints, options of the bench, notes."""
    stem = Path(chosen.pattern).stem
    require_room(folder, (*FILES, f"{stem}.csv", f"{stem}-joints.csv"), chosen.overwrite)
    layers = {name.removeprefix("layer-"): getattr(chosen, name.replace("-", "_")) for name in LAYERS}
    table, joints, bench, notes = tables_of(chosen.pattern, chosen.dxf_unit, layers, chosen.charges, folder)
    return table, joints or chosen.joints, bench, [*notes, f"{table} has the holes of the drawing and their charges"]


def _joints(chosen, layout):
    """The joints of the model, and the sets of their laws."""
    given = read_discs(chosen.joints) if chosen.joints else []
    refuse_outside(chosen.joints, given, layout)
    sets = read_joint_sets(chosen.joint_sets) if chosen.joint_sets else []
    refuse_unused(chosen.joint_sets, sets, given)
    return joint_field(layout, given, sets, chosen.joint_sets, chosen.joints), sets


def _ground(chosen):
    """Weight and stress; None where none are asked for."""
    given = [f"--{name}" for name in ("depth", "k0", "horizontal-stress", "stress-azimuth") if getattr(chosen, name.replace("-", "_")) is not None]
    if given and not chosen.gravity:
        raise ValueError(f"{given[0]} is of the stress that goes with weight: add --gravity")
    if not chosen.gravity:
        return None
    if chosen.depth and not chosen.block:
        raise ValueError("--depth is ground above the collars, and a bench has none: leave it out, or --block for holes under ground")
    if chosen.horizontal_stress is None:
        if chosen.stress_azimuth is not None:
            raise ValueError("--stress-azimuth is the direction of the larger of two horizontal stresses: give them by --horizontal-stress LARGER SMALLER")
        return Ground(chosen.depth or 0.0, chosen.k0)
    larger, smaller = chosen.horizontal_stress
    if chosen.k0 is not None:
        raise ValueError("--k0 and --horizontal-stress are two ways to say the same: keep one of them")
    if larger < smaller:
        raise ValueError(f"--horizontal-stress {larger:g} {smaller:g}: the larger one comes first, whose direction is --stress-azimuth")
    return Ground(chosen.depth or 0.0, None, (1e6 * larger, 1e6 * smaller), chosen.stress_azimuth or 0.0)


def _rock(chosen):
    """The rock, and words for it."""
    from sazare.lab.rock import rock_from
    from sazare.simulation import source_of

    if not chosen.rock:
        return GRANITE, BlastModel.rock_words
    with errors_of_commands():
        rock = rock_from(source_of(Path(chosen.rock)), chosen.material)
    return rock, f"{rock.name} of {chosen.rock}"


def _checked(case, layout):
    """What `sazare check` says of the size and the cost of the run, the quality of its elements, and all that it warns of."""
    with errors_of_commands():
        said, quality = checked(case, layout)
    yield from lines_of(said, TOLD)
    yield from quality.words()
    warnings = warnings_of(said)
    yield from ["", *warnings] if warnings else []


def _line(chosen):
    """The command that makes the model again."""
    names = ("layer_holes", "layer_names", "layer_crest", "layer_toe", "charges", "dxf_unit", "burden", "height", "azimuth", "margin", "size", "joints", "joint_sets", "rock", "material", "depth", "k0", "stress_azimuth")
    given = [f"--{name.replace('_', '-')} {shlex.quote(str(getattr(chosen, name)))}" for name in names if getattr(chosen, name) is not None]
    given += [f"--face-angle {chosen.face_angle:g}"] if chosen.face_angle != Options.face_angle else []
    given += [f"--layer-joints {' '.join(map(shlex.quote, chosen.layer_joints))}"] if chosen.layer_joints else []
    given += ["--gravity"] if chosen.gravity else []
    given += ["--horizontal-stress {:g} {:g}".format(*chosen.horizontal_stress)] if chosen.horizontal_stress else []
    given += [f"--around {chosen.around}"] if chosen.around != FEWEST_AROUND else []
    return " ".join(["sazare blast-model", shlex.quote(chosen.pattern), *given, *(["--block"] if chosen.block else [])])
