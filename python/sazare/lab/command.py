"""The command `sazare lab`: its arguments, and what it writes and prints."""

import re
from pathlib import Path

from sazare.arguments import length, whole, within
from sazare.engine import errors_of_commands
from sazare.lab import words
from sazare.lab.calibrate import MOST_TRIALS, TOLERANCE, Targets, calibrate
from sazare.lab.envelope import coulomb, hoek_brown, mohr_coulomb
from sazare.lab.folders import claim
from sazare.lab.machine import carry_out
from sazare.lab.rock import rock_from
from sazare.lab.trials import PLATEN_FRICTION, Options, Platens, trial_of
from sazare.tables import write_table

HELP = {
    "uniaxial": "press a cylinder along its axis: strength, E, nu",
    "triaxial": "press cylinders under one or more confinements: strength, envelope",
    "brazilian": "press a disc over its diameter: splitting strength",
    "direct-tension": "pull a cylinder along its axis: tensile strength",
    "direct-shear": "push the upper half of a prism over the lower one under one or more normal stresses: peak, residual, envelope",
    "point-load": "press a core between two points: point load index",
}
COUNT = whole(1, 1_000_000)
PRESSURE = {"least": 1e3, "most": 1e10, "unit": "Pa", "factors": (1e6, 1e3)}  # who writes 5 means MPa
STRENGTH, CONFINEMENT = within(**PRESSURE), within(**PRESSURE, above=True)
SIDE = length(10.0, 1e-4)  # of a specimen
PRESSURES = {"triaxial": "--confinement", "direct-shear": "--normal-stress"}


def add_to(commands):
    """Adds the command and its tests to the commands of a parser."""
    lab = commands.add_parser(
        "lab", help="test a rock of method blocks as in a laboratory",
        description="Test a material of a case of method blocks as in a laboratory: mesh a specimen, load it until it fails, measure.",
    )
    tests = lab.add_subparsers(dest="test", required=True, metavar="TEST")
    for name, text in HELP.items():
        _add_test(tests, name, text)
    _add_calibrate(tests)


def _add_common(command):
    command.add_argument("case", metavar="CASE", help="a case of method blocks (TOML)")
    command.add_argument("--material", metavar="NAME", help="the material to be tested; not needed where the case has one")
    command.add_argument("--set", metavar="KEY=VALUE", action="append", default=[], help="override a key of the case, such as joints.0.cohesion=5e6")
    command.add_argument("--out", metavar="DIR", help="folder of the test (default: runs/lab-TEST-MATERIAL)")
    command.add_argument("--overwrite", action="store_true", help="replace the test that is in the folder")
    command.add_argument("--threads", metavar="N", type=COUNT, default=0, help="threads (default: all processors)")
    command.add_argument("--quiet", action="store_true", help="print results and warnings only")
    command.add_argument("--diameter", metavar="M", type=SIDE, default=Options.diameter, help="diameter, or side of a prism [m] (default %(default)g)")
    command.add_argument("--elements", metavar="N", type=COUNT, default=Options.elements, help="elements over the diameter (default %(default)d)")
    command.add_argument("--seed", metavar="N", type=COUNT, default=1, help="seed of the mesh: another one makes another mesh of the same size (default 1)")
    command.add_argument("--scatter-seed", metavar="N", type=whole(0, 1_000_000_000), help="seed of the scatter of strength, for a rock with weibull_modulus")
    command.set_defaults(function=carry_out_command, blame="{case}: the laboratory cannot test it", advice="Please report it")


def _add_test(tests, name, text):
    command = tests.add_parser(name, help=text, description=text)
    _add_common(command)
    command.add_argument("--height", metavar="M", type=SIDE, help="height, or thickness of a disc [m]")
    command.add_argument("--strain-rate", metavar="R", type=within(1e-9, 1e6, "1/s"), help="speed of the platen over the length of the specimen [1/s] (default: quasi-static)")
    command.add_argument("--strain", metavar="E", type=within(1e-9, 1.0, "", factors=(0.01,)), help="displacement over the length at which the test ends")
    if name in ("uniaxial", "triaxial"):
        command.add_argument("--platens", choices=Platens.ALL, help="ends that slide freely, are held, or rub on steel (default: frictionless)")
        command.add_argument("--platen-friction", metavar="F", type=within(0.0, 10.0, ""), help=f"friction of --platens {Platens.STEEL} (default {PLATEN_FRICTION:g})")
    if name == "brazilian":
        command.add_argument("--platens", choices=(Platens.HELD, Platens.FRICTIONLESS), help="jaws that hold the disc or let it slide (default: held)")
        command.add_argument("--contact-angle", metavar="DEG", type=within(0.1, 180.0, "degrees"), default=Options.contact_angle, help="arc on which a jaw bears [deg] (default %(default)g)")
    if name == "point-load":
        command.add_argument("--tip-radius", metavar="M", type=SIDE, default=Options.tip_radius, help="radius of the circles that press [m] (default %(default)g)")
    if name in PRESSURES:
        command.add_argument(PRESSURES[name], dest="pressures", metavar="PA", type=CONFINEMENT, nargs="+", required=True, help="one or more [Pa]; several give an envelope")


def _add_calibrate(tests):
    text = "find the strengths of the joints for which specimens have measured strengths"
    command = tests.add_parser("calibrate", help=text, description=text)
    _add_common(command)
    command.add_argument("--uniaxial", metavar="PA", type=STRENGTH, required=True, help="measured strength in uniaxial compression [Pa]")
    command.add_argument("--tensile", metavar="PA", type=STRENGTH, required=True, help="measured tensile strength [Pa]")
    command.add_argument("--tensile-test", choices=("brazilian", "direct-tension"), default="brazilian", help="test that gave it (default: brazilian)")
    command.add_argument("--triaxial", metavar="PA", type=STRENGTH, help="measured axial stress at failure under --confinement [Pa]; then friction is sought too")
    command.add_argument("--confinement", metavar="PA", type=STRENGTH, help="confinement of that test [Pa]")
    command.add_argument("--meshes", metavar="N", type=COUNT, default=3, help="meshes with which the result is tested at the end (default 3)")
    command.add_argument("--platens", choices=Platens.ALL, help="platens of the compressed cylinders (default: frictionless)")
    command.set_defaults(function=calibrate_command)


def _options(chosen):
    names = Options.__dataclass_fields__
    return Options(**{name: value for name, value in vars(chosen).items() if name in names and value is not None})


def _rock(chosen):
    from sazare.simulation import source_of

    with errors_of_commands():
        return rock_from(source_of(Path(chosen.case)).with_settings(chosen.set), chosen.material)


def _folder(chosen, rock):
    name = re.sub(r"[^\w.-]+", "-", rock.name).strip("-.")[:60] or "rock"
    return Path(chosen.out or Path("runs") / f"lab-{chosen.test}-{name}")


def _carry_out(chosen, trial, folder):
    """Carries out one trial with words before and after; its pictures are in the folder."""
    from sazare import style
    from sazare.lab import pictures
    from sazare.report import sections_of, write_pictures

    if not chosen.quiet:
        print(*words.before(trial), sep="\n")
    with errors_of_commands():
        tested = carry_out(trial, folder, threads=chosen.threads, overwrite=chosen.overwrite, progress=not chosen.quiet)
    print(*words.after(tested), sep="\n", flush=True)
    style.save(pictures.curve(tested), folder / "curve.png")
    names = [section.name for section in sections_of(tested.results) if section.name in ("cracks", "modes")]
    list(write_pictures(tested.folder / "run", names, folder))
    return tested


def carry_out_command(chosen):
    """Carries out a test, or one for every pressure."""
    rock, options = _rock(chosen), _options(chosen)
    folder = _folder(chosen, rock)
    pressures = sorted(set(getattr(chosen, "pressures", [0.0])))
    if len(pressures) == 1:
        tested = _carry_out(chosen, trial_of(chosen.test, rock, options, pressures[0]), folder)
        print(f"{folder}: curve.csv, figures.json, curve.png, cracks.png; the run is in {tested.folder / 'run'}")
        return
    places = {f"{1e-6 * value:.9g}-MPa": trial_of(chosen.test, rock, options, value) for value in pressures}
    claim(folder, chosen.test, [trial.pressure for trial in places.values()], chosen.overwrite)
    series = [_carry_out(chosen, trial, folder / name) for name, trial in places.items()]
    _write_envelope(chosen.test, series, folder)


def _write_envelope(test, series, folder):
    """Writes what a series of pressures gives, and prints the envelopes of those specimens that failed."""
    from sazare import style
    from sazare.lab import pictures

    names = ["peak_stress", *(["residual_stress"] if test == "direct-shear" else [])]
    pressure_name = "normal_stress" if test == "direct-shear" else "confinement"
    columns = {f"{pressure_name} [Pa]": [tested.trial.pressure for tested in series]}
    columns |= {f"{name} [Pa]": [tested.figures[name] for tested in series] for name in names}
    write_table(folder / "envelope.csv", columns | {"failed [-]": [tested.figures["failed"] for tested in series]})
    style.save(pictures.curves(series), folder / "curves.png")
    failed = [tested for tested in series if tested.figures["failed"]]
    if len(failed) < len(series):
        print("warning: specimens that did not fail are left out of the envelope")
    lines = _fits(test, failed)
    print(*words.envelopes(lines), sep="\n")
    found = {name: line for name, line in lines.items() if not isinstance(line, str)}
    if test == "direct-shear" and len(found) == 2:
        style.save(pictures.shear_envelope(failed, found["peak"], found["residual"]), folder / "envelope.png")
    if "Mohr-Coulomb" in found:
        style.save(pictures.envelope(failed, found["Mohr-Coulomb"], found.get("Hoek-Brown")), folder / "envelope.png")
    print(f"{folder}: envelope.csv, curves.png" + (", envelope.png" if (folder / "envelope.png").exists() else ""))


def _fits(test, failed):
    """Envelopes by name; in place of one that there is not, why."""
    pressures = [tested.trial.pressure for tested in failed]

    def fitted(law, name):
        try:
            return law(pressures, [tested.figures[name] for tested in failed])
        except ValueError as error:
            return str(error)

    if test == "direct-shear":
        return {"peak": fitted(coulomb, "peak_stress"), "residual": fitted(coulomb, "residual_stress")}
    return {"Mohr-Coulomb": fitted(mohr_coulomb, "peak_stress"), "Hoek-Brown": fitted(hoek_brown, "peak_stress")}


def calibrate_command(chosen):
    """Finds strengths of joints from measured ones."""
    if (chosen.triaxial is None) != (chosen.confinement is None):
        raise ValueError("--triaxial and --confinement go together: an axial stress at failure, and the confinement under which it was measured")
    rock, options = _rock(chosen), _options(chosen)
    folder = _folder(chosen, rock)
    claim(folder, "calibrate", [], chosen.overwrite)
    targets = Targets(chosen.uniaxial, chosen.tensile, chosen.tensile_test, chosen.triaxial, chosen.confinement or 0.0)

    def say(number, rock, row, ratios):
        strengths = f"cohesion {1e-6 * rock.joint.cohesion:.4g} MPa, tensile strength {1e-6 * rock.joint.tensile_strength:.4g} MPa, friction {rock.friction:.3g}"
        peaks = ", ".join(f"{name} {1e-6 * row[name]:.4g} MPa ({ratio:.3f})" for name, ratio in zip(list(row)[3:], ratios))
        print(f"{number if isinstance(number, str) else f'trial {number}'}: {strengths}: {peaks}", flush=True)

    def machine(trial, where):
        return carry_out(trial, where, threads=chosen.threads, overwrite=chosen.overwrite, progress=not chosen.quiet)

    with errors_of_commands():
        found = calibrate(rock, targets, options, folder, meshes=chosen.meshes, say=say, machine=machine)
    if not found.converged:
        print(f"warning: no trial of {MOST_TRIALS} came within {100 * TOLERANCE:g} % of all measured values; this is the nearest one")
    joint = found.rock.joint
    print("for the joints of the case, with elements of this size:")
    print(f"  cohesion = {joint.cohesion:.5g}\n  tensile_strength = {joint.tensile_strength:.5g}" + (f"\n  friction_coefficient = {found.rock.friction:.4g}" if chosen.triaxial else ""))
    print(*words.scatter(found), sep="\n")
    print(f"{folder}: calibration.csv, scatter.csv")
