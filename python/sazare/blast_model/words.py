"""A blast in words: the table that its designer reads, and what was assumed."""

import math

from sazare.blast_model.joint_laws import law_in_words
from sazare.blast_model.layout import FEWEST_AROUND, MANY_ELEMENTS, estimated_elements
from sazare.engine import engine

COLUMNS = (("hole", ""), ("burden", "m"), ("spacing", "m"), ("length", "m"), ("charged", "m"), ("explosive", ""), ("mass", "kg"), ("delay", "ms"), ("fires", ""))


def table(layout):
    """Lines with a row for each charge, in the order of the pattern."""
    delays = sorted({deck.delay for deck in layout.pattern.decks})
    rows = [[f"{name} [{unit}]" if unit else name for name, unit in COLUMNS]]
    places = {hole.name: place for place, hole in enumerate(layout.holes)}
    for deck in layout.pattern.decks:
        place = places[deck.hole.name]
        rows.append([
            deck.hole.name, span(layout.burdens[place]), "-" if layout.spacings[place] is None else f"{layout.spacings[place]:.2f}", f"{deck.hole.length:.2f}",
            f"{deck.top:.2f} to {deck.bottom:.2f}", deck.keys["explosive"], f"{deck.mass:.4g}", f"{1e3 * deck.delay:g}", str(delays.index(deck.delay) + 1),
        ])
    return aligned(rows)


def aligned(rows):
    """Lines of a table of words, each column as wide as it must be."""
    widths = [max(len(cell) for cell in column) for column in zip(*rows)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in rows]


def span(distances):
    """A burden, or its two ends where they differ by a centimetre or more."""
    if distances is None:
        return "-"
    low, high = distances
    return f"{low:.2f}" if high - low < 0.01 else f"{low:.2f} to {high:.2f}"


def summary(layout):
    """Lines about the pattern as a whole."""
    pattern, bench = layout.pattern, layout.bench
    mass, energy = sum(deck.mass for deck in pattern.decks), sum(energy_of(deck) for deck in pattern.decks)
    size = " x ".join(f"{length:.4g}" for length in layout.upper - layout.lower)
    lines = [f"{_counted(len(pattern.holes), 'hole')}, {_counted(len(pattern.decks), 'charge')}, {mass:.4g} kg of explosive with {1e-6 * energy:.4g} MJ"]
    if bench:
        face = f"free face {_angle(layout):.4g} degrees steep, looking to {azimuth(layout):.4g} degrees"
        lines.append(f"bench {bench.height:.4g} m high, {face}; {_counted(len(layout.rows), 'row')}; rock of {size} m")
    else:
        lines.append(f"block of {size} m with one free surface, no bench")
    broken = layout.rock_broken
    if broken:
        lines.append(f"powder factor {mass / broken:.3g} kg/m3: {mass:.4g} kg for {broken:.4g} m3, burden x spacing x height of the bench")
    return lines + [f"elements of {layout.near(layout.holes[0]):.3g} m at the holes ({layout.options.around} around) and of {layout.far:.3g} m far away"]


def energy_of(deck):
    """Energy of a charge [J]. A custom explosive without an energy has that of a steady detonation, D^2/(2 (n^2 - 1)) per mass with its gas exponent n."""
    keys = deck.keys
    if keys["explosive"] != "custom":
        return deck.mass * engine().explosives()[keys["explosive"]][2]
    return deck.mass * (keys.get("explosive_energy") or deck.velocity**2 / (2.0 * (keys["gas_exponent"] ** 2 - 1.0)))


def _counted(number, word):
    return f"{number} {word}" + ("" if number == 1 else "s")


def _angle(layout):
    return math.degrees(math.atan2(layout.bench.height, layout.bench.toe - layout.bench.crest))


def azimuth(layout):
    """Direction to which the free face looks [deg], from y towards x."""
    x = layout.frame.axes[0]
    return round(math.degrees(math.atan2(x[0], x[1])), 6) % 360.0


def assumptions(model):
    """What the model takes for granted, beside its rock."""
    layout, options = model.layout, model.layout.options
    if layout.bench:
        if options.burden is None:
            yield f"burden {layout.bench.crest - max(hole.collar[0] for hole in layout.holes):.4g} m, the distance of the rows (--burden)"
        if options.height is None:
            yield f"bench {layout.bench.height:.4g} m high, as deep as the shallowest toe, so without subdrilling there (--height)"
        if options.azimuth is None:
            yield f"the free face looks to {azimuth(layout):.4g} degrees from y (north) towards x (east) (--azimuth)"
    if options.margin is None:
        yield f"{layout.margin:.3g} m of rock around the holes (--margin)"
    if options.size is None:
        yield f"elements of {layout.far:.3g} m far from the holes (--size)"
    if options.around < FEWEST_AROUND:
        yield f"holes with {options.around} faces around are coarse: cracks begin at their edges, where few of them are; {FEWEST_AROUND} are the least for a round hole (--around)"
    if (many := estimated_elements(layout)) > MANY_ELEMENTS:
        yield f"about {many:.2g} elements, which take long to mesh and to run (larger ones: --size)"
    yield "sides and base absorb waves; all other surfaces are free, and holes are empty where no explosive is; gas pushes the stemming out where vents is true"
    if model.ground:
        yield from model.ground.words(layout, model.rock)
        if any(entry.bonded is False for entry in model.joint_laws):
            yield "joints that are not bonded carry no stress at the beginning: they close then, and move the rock beside them; bonded ones with a small strength do not"
    else:
        yield f"no gravity and no stress at the beginning (--gravity): until {1e3 * model.end:.3g} ms the weight would change velocities by {9.81 * model.end:.2g} m/s"
    for entry in model.joint_laws[1:]:
        rest = "" if entry.bonded is False else "; what no table says of them is a tenth of the strengths and fracture energies of the rock as given"
        yield f"{_counted(sum(disc.surface == entry.surface for disc in model.joints.discs), 'disc')} of {entry.surface}: {law_in_words(entry)}{rest}"
    ends = [away for away, _ in model.line_at_depth()]
    largest = max(sum(other.mass for other in layout.pattern.decks if other.delay == deck.delay) for deck in layout.pattern.decks)
    yield (
        f"gauges just below the surface, and {len(ends)} at the depth of the charges, {ends[0]:g} to {ends[-1]:g} m away: scaled distances of "
        f"{ends[0] / math.sqrt(largest):.2g} to {ends[-1] / math.sqrt(largest):.2g} m/kg^(1/2) with {largest:.4g} kg, the most that fire at once (--margin for longer ones)"
    )
    if any(deck.keys["gas_in_cracks"] == "none" and "cut_distance" not in deck.keys for deck in layout.pattern.decks):
        yield "where gas_in_cracks is none the gas presses on a wall however far it moves, which throws too fast: flow lets it into cracks"
    yield f"the run ends at {1e3 * model.end:.3g} ms, when P- and S-waves of the last charge have passed the model; throw takes longer (time.end)"


def page(model, command):
    """model.md of the folder."""
    layout = model.layout
    made = [f"Made by `{command}`.", ""] if command else []
    lines = [f"# Blast of {layout.pattern.path.stem}", "", *made, "```", *summary(layout), "", *table(layout), *(["", *aligned(model.joints.table)] if model.joints.rows else []), "```", "", "## Assumed", ""]
    lines += [f"- {line[0].upper()}{line[1:]}." for line in model.assumptions]
    axes = "; ".join(f"{name} = ({', '.join(f'{value:.6g}' for value in axis)})" for name, axis in zip("xyz", layout.frame.axes + 0.0))
    origin = ", ".join(f"{value:.10g}" for value in layout.frame.origin)
    lines += [
        "", "## Axes", "", f"The origin is the collar of hole {layout.holes[0].name}, at ({origin}) m of the pattern. The axes in those of the pattern are {axes}.",
        "", "## Run it", "", "```", "sazare check case.toml --picture model.png", "sazare run case.toml --out run", "sazare report run", "```", "",
    ]
    return "\n".join(lines)
