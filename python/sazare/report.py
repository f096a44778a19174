"""The report of a run: one HTML page that holds its pictures, and the pictures as files."""

import base64
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

import jinja2

from sazare import finite, granular, ground, hybrid, maps, plot, squares, study, style, view3d
from sazare.results import open_run
from sazare.scenes import Body
from sazare.summary import headlines, verdict

MOST_FRAGMENTS = 10


@dataclass(frozen=True)
class Section:
    """A picture of the report: file name, heading, one sentence below it, how to draw it, what to say without data."""

    name: str
    heading: str
    caption: str
    draw: object
    missing: str
    wide: bool = True


def body_sections(body):
    """The pictures that need snapshots."""
    return [
        Section(
            "cracks", "Crack pattern",
            "Faces between elements that have broken, coloured by the time of the snapshot in which each was first seen broken.",
            partial(maps.crack_pattern, body), "The run wrote no joints beside its elements.",
        ),
        Section(
            "shape", "Displaced shape",
            "Speed of the elements. Displacements are enlarged where the title says so; the fastest hundredth shares one colour.",
            partial(maps.displaced_shape, body), "",
        ),
        Section(
            "levels", "Time levels",
            "An element of level k takes steps of the base step over 2 to the power of k.",
            partial(maps.time_levels, body), "",
        ),
        Section(
            "fragments", "Fragments", "Elements that still hang together share a colour; the largest fragment is pale.",
            partial(maps.fragment_map, body), "", wide=not body.is_slab,
        ),
    ]


def curve_sections(results):
    """The pictures that need tables only."""
    return [
        Section(
            "energy", "Where the work went",
            "Energy stored and dissipated by cause, stacked, against the work of the loads; below, the share of the work "
            "that the ledger does not account for.",
            partial(plot.energy, results), "The run wrote no energies.",
        ),
        Section(
            "fragment_curve", "Fragment sizes", "Share of the volume in fragments up to a size; half of it lies below X50.",
            partial(plot.fragment_curve, results), "The run wrote no fragments.", wide=False,
        ),
        Section(
            "broken_joints", "Broken joints", "Broken joints and fragments against time.",
            partial(plot.broken_joints, results), "The run wrote no history.", wide=False,
        ),
        Section(
            "gauges", "Gauges", "Velocity at the gauges; the dot is the peak particle velocity.",
            partial(plot.gauges, results), "The case has no gauges.",
        ),
        Section(
            "smallest_step", "Smallest step", "The smallest time step of any element.",
            partial(plot.smallest_step, results), "The run wrote no steps.", wide=False,
        ),
        Section(
            "timing", "Where the time went", "Computing time by part of the step.",
            partial(plot.timing, results), "The run wrote no timing.", wide=False,
        ),
    ] + ([rank_section(results)] if results.ranks.rows > 0 else [])


def rank_section(results):
    """The picture of a run of several processes."""
    return Section(
        "ranks", "Ranks",
        "Processor time of each rank in evaluations and kicks, cumulated; how far the busiest rank of an interval is above the "
        "mean; and with which element each rank's range begins.",
        partial(plot.ranks, results), "",
    )


def ground_sections(results):
    """The pictures of a run of method mps."""
    failure = [Section("failure", "Failure", "Plastic slip, and the share of its links that a particle has lost, at the end.",
                       partial(ground.failure, results), "The run wrote no snapshots.")] if "energy_flow" in results.history else []
    return [
        Section("accelerations", "Accelerations", "Acceleration at the gauges along the axis of strongest motion; the dot is the peak.",
                partial(ground.accelerations, results), "The case has no gauges."),
        Section("spectra", "Spectra", "Fourier amplitudes at the first and the last gauge, and their ratio.",
                partial(ground.spectra, results), "There are fewer than two gauges."),
        Section("displaced", "Displaced particles", "Particles where they are, coloured by displacement; enlarged where the title says so.",
                partial(ground.displaced, results), "The run wrote no snapshots."),
        *failure,
        Section("energies", "Energies", "Kinetic and elastic energy of the particles, and what damping and failing have dissipated.", partial(ground.energies, results),
                "The run wrote no history.", wide=False),
        Section("timing", "Where the time went", "Computing time by part of the run.", partial(plot.timing, results),
                "The run wrote no timing.", wide=False),
    ]


def square_sections(results):
    """The pictures of a run of method rectangles."""
    return [
        Section("moving", "Elements", "Elements where they are, coloured by displacement. Faces that have broken are red.",
                partial(squares.moving, results), "The run wrote no snapshots."),
        Section("supports", "Supports", "Force between the supports and what they hold.", partial(squares.supports, results),
                "The case has no supports."),
        Section("square_gauges", "Gauges", "Displacement and rotation of the elements at the gauges.", partial(squares.gauges, results),
                "The case has no gauges."),
        Section("energy", "Where the work went",
                "Energy stored and dissipated by cause, stacked, against the work of gravity and supports; below, the share of the work "
                "that the ledger does not account for.", partial(plot.energy, results), "The run wrote no energies."),
        Section("timing", "Where the time went", "Computing time by part of the run.", partial(plot.timing, results),
                "The run wrote no timing.", wide=False),
    ]


def granular_sections(results):
    """The pictures of a run of method spheres."""
    damage = [Section("damage", "Broken bonds", "Spheres coloured by the share of their bonds that is broken.",
                      partial(granular.damage, results), "No bond broke.")] if results.figures.get("bonds", 0) > 0 else []
    pieces = [Section("fragment_curve", "Fragment sizes", "Share of the volume of all bonded bodies in pieces up to a size; half of it lies "
                      "below X50.", partial(plot.fragment_curve, results), "The run is not done.", wide=False),
              Section("bodies_broken", "Broken bodies", "Bodies that are in more than one piece, and bonds that have broken.",
                      partial(granular.broken_bodies, results), "The run wrote no history.", wide=False)
              ] if results.figures.get("bodies", 0) > 0 else []
    return [
        Section("spheres", "Spheres", "Spheres coloured by speed, the front half cut away where there are many; the fastest hundredth shares one colour.",
                partial(granular.pictures, results), "The run wrote no snapshots."),
        *damage,
        *pieces,
        Section("groups", "Groups", "Centre of mass of the recorded groups along the axis of their longest way; beside it the velocity, or the "
                "force on groups whose velocity is held.", partial(granular.groups, results),
                "The case has no gauges."),
        Section("energies", "Where the energy went", "Energy of motion and in contacts, and what was lost by cause, stacked; below, what the "
                "ledger does not account for. Gravity and moving walls bring energy in.", partial(granular.energies, results),
                "The run wrote no history."),
        Section("walls", "Walls", "Force of the spheres on the walls, along the axis on which it is largest.", partial(granular.walls, results),
                "The case has no walls."),
        Section("contacts", "Contacts", "Number of contacts, and the largest speed of any sphere.", partial(granular.contacts, results),
                "The run wrote no history.", wide=False),
        Section("timing", "Where the time went", "Computing time by part of the run.", partial(plot.timing, results),
                "The run wrote no timing.", wide=False),
    ]


def study_sections(results):
    """The pictures of a study of limit steps."""
    missing = "The study varies other parameters, or is not done."
    pictures = [
        ("damping", "Limit and damping", "Dots: bisection; lines: predicted from the linearised operator. Figure 4 of the paper.", study.damping_curves),
        ("radius", "Limit and radius", "Dots: bisection; lines: predicted. Figure 5 of the paper.", study.radius_curves),
        ("scaled", "Limit and radius over velocity", "Dots: bisection; lines: (14). Figures 6 and 8 of the paper.", study.scaled),
        ("families", "Families compared", "Figure 7 of the paper.", study.families_compared),
        ("coefficients", "Coefficients", "Dots: (14) for each damping ratio; lines: (15), (16), ours and the paper's. Figure 9.",
         study.coefficients),
        ("quality", "Estimated and found", "Regressions, and the prediction from the linearised operator. Figure 10.", study.fit_quality),
    ]
    return [Section(name, heading, caption, partial(draw, results), missing) for name, heading, caption, draw in pictures]


def finite_sections(results):
    """The pictures of a run of method fem."""
    static = 'analysis = "static"' in results.case_text
    motion = [] if static else [
        Section("accelerations", "Accelerations", "Acceleration at the gauges along the axis of strongest motion; the dot is the peak.",
                partial(ground.accelerations, results), "The case has no gauges."),
        Section("spectra", "Spectra", "Fourier amplitudes at the first and the last gauge, and their ratio.",
                partial(ground.spectra, results), "There are fewer than two gauges."),
    ]
    joints = [Section("joints", "Joints", "Share of the joints that slips or is open, and the largest slip.", partial(finite.joints, results),
                      "")] if any(name.startswith("joint.") for name in results.history) else []
    return [
        Section("displaced", "Displaced mesh", "The mesh when it is displaced most, and at the end, coloured by displacement.",
                partial(finite.displaced, results), "The run wrote no snapshots."),
        Section("yielding", "Yielding", "Plastic slip of the elements at the end.", partial(finite.yielding, results), "Nothing has yielded."),
        Section("forces", "Forces of the boundaries", "Force of each boundary on the body, those that change most.",
                partial(finite.forces, results), "The case has no boundaries.", wide=False),
        Section("displacements", "Displacements", "Displacement at the gauges.", partial(finite.displacements, results),
                "The case has no gauges.", wide=False),
        *joints,
        *motion,
        Section("energy", "Where the work went", "Energy stored and dissipated by cause, stacked, against the work done; below, the share of "
                "the work that the ledger does not account for.", partial(plot.energy, results), "The run wrote no energies."),
        Section("timing", "Where the time went", "Computing time by part of the run.", partial(plot.timing, results),
                "The run wrote no timing.", wide=False),
    ]


def hybrid_sections(results):
    """The pictures of a run of method hybrid: both sides together, the surface, then those of each side."""
    left_out = {"timing"} | ({"spheres", "moving"} if hybrid.is_plane(results) else set())  # seen along z both sides stand in one picture
    of_sides = [replace(section, name=f"{name}_{section.name}", heading=f"{name.capitalize()}: {section.heading[0].lower()}{section.heading[1:]}")
                for name, side in results.sides.items() for section in sections_of(side) if section.name not in left_out]
    return [
        Section("together", "Both sides", "Finite elements, and bodies, coloured by speed.",
                partial(hybrid.together, results), "There are no snapshots that can be drawn together."),
        Section("surface", "The surface", "Mean force of the bodies on the surface in a window, and the mean displacement of its nodes.",
                partial(hybrid.surface, results), "The run wrote no history."),
        Section("exchange", "Work over the surface", "Work of the bodies on the nodes and of the nodes on the bodies; their sum is energy that the "
                "scheme of the coupling has made.", partial(hybrid.exchange, results), "The run wrote no history.", wide=False),
        *of_sides,
        Section("timing", "Where the time went", "Computing time by part of the run.", partial(plot.timing, results),
                "The run wrote no timing.", wide=False),
    ]


def _drawn(section, folder):
    """The section as the template wants it, its picture written and embedded."""
    figure = section.draw()
    filled = {"name": section.name, "heading": section.heading, "caption": section.caption, "wide": section.wide}
    if figure is None:
        return {**filled, "caption": "", "missing": section.missing, "image": None}
    path = folder / f"{section.name}.png"
    style.save(figure, path)
    return {**filled, "missing": "", "image": base64.b64encode(path.read_bytes()).decode()}


def _facts(results):
    """Small print about the run: (name, value)."""
    manifest, figures = results.manifest, results.figures
    machine = manifest.get("machine", {})
    rows = [
        ("method", manifest.get("method")),
        ("sazare", f"{manifest['sazare']} ({manifest.get('commit', 'unknown')})" if "sazare" in manifest else None),
        ("started", manifest.get("started")),
        ("finished", manifest.get("finished")),
        ("processor", machine.get("cpu")),
        ("cores, threads", f"{machine.get('cores')}, {machine.get('threads')}" if "cores" in machine else None),
        ("steps", style.count(figures["steps"]) if "steps" in figures else None),
        ("smallest step", style.quantity(figures["smallest_step"], "s") if "smallest_step" in figures else None),
        ("pair evaluations", style.count(figures["pair_evaluations"]) if "pair_evaluations" in figures else None),
        ("state hash", manifest.get("state_hash")),
    ]
    return [(name, value) for name, value in rows if value]


def _largest_fragments(results):
    """Rows of the table of fragments."""
    table = results.fragments
    return [
        {
            "number": int(table["fragment"][number]),
            "elements": style.count(table["elements"][number]),
            "volume": f"{table['volume'][number]:.3g}",
            "mass": f"{table['mass'][number]:.4g}",
            "size": style.quantity(table["size"][number], "m"),
            "throw": style.quantity(table["throw"][number], "m"),
        }
        for number in range(min(MOST_FRAGMENTS, table.rows))
    ]


def _page(results, sections):
    view = view3d.packed_view(results)
    loader = jinja2.FileSystemLoader(Path(__file__).with_name("templates"))
    template = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True).get_template("report.html")
    tone, sentence = verdict(results)
    return template.render(
        title=results.title,
        tone=tone,
        sentence=sentence,
        headlines=headlines(results),
        sections=sections,
        facts=_facts(results),
        fragments=_largest_fragments(results),
        gauges=[(gauge.name, style.quantity(gauge.ppv, "m/s")) for gauge in results.gauges.values()],
        case_text=results.case_text,
        view=view,
        viewer=view3d.viewer_script() if view else "",
    )


def sections_of(results):
    """The pictures that suit a run's method."""
    method = results.manifest.get("method")
    makers = {"mps": ground_sections, "rectangles": square_sections, "spheres": granular_sections, "fem": finite_sections,
              "hybrid": hybrid_sections, "study": study_sections}
    if method in makers:
        return makers[method](results)
    if len(results.snapshots):
        return [*body_sections(Body(results.snapshots)), *curve_sections(results)]
    missing = "The run wrote no snapshots."
    return [Section("cracks", "Crack pattern, shape, levels, fragments", "", lambda: None, missing), *curve_sections(results)]


def write_pictures(path, names, folder):
    """Writes the named pictures of a run's report as PNG into a folder; yields their paths. Without names, yields a line for each
    picture there is. Raises NotARun where `path` is no run, ValueError for a picture that there is not or that has no data."""
    sections = {section.name: section for section in sections_of(open_run(path))}
    if not names:
        yield from (f"{name:<16}{section.heading}: {section.caption}" for name, section in sections.items())
        return
    unknown = [name for name in names if name not in sections]
    if unknown:
        raise ValueError(f"no picture {', '.join(unknown)}; there are: {', '.join(sections)}")
    Path(folder).mkdir(parents=True, exist_ok=True)
    for name in names:
        figure = sections[name].draw()
        if figure is None:
            raise ValueError(f"no picture {name} of this run: {sections[name].missing}")
        target = Path(folder) / f"{name}.png"
        style.save(figure, target)
        yield target


def write_report(path):
    """Writes DIR/report.html and the pictures in DIR/report/; returns the page's path. Raises NotARun where DIR is no run."""
    results = open_run(path)
    folder = results.path / "report"
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    sections = [_drawn(section, folder) for section in sections_of(results)]
    page = results.path / "report.html"
    page.write_text(_page(results, sections), encoding="utf-8")
    return page
