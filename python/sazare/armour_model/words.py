"""An armour layer in words: the numbers that its designer reads."""

from sazare.armour_model.layout import SPREAD


def summary(model):
    """Lines about the units, the slope and the layer."""
    layout, slope = model.layout, model.layout.slope
    height = layout.solid.points[:, 2].max() - layout.solid.points[:, 2].min()
    shore, up = layout.distances
    rows = -(-layout.number // (layout.columns * layout.layers))
    published = f", published {layout.kind.volume:g}" if layout.kind.volume else ""
    return [
        f"unit         {layout.kind.name}, {layout.kind.words}: {height:.4g} m high, D_n {layout.size:.4g} m, {layout.volume:.4g} m3 = {layout.volume / height**3:.4g} height^3{published}, {model.mass:.4g} kg",
        f"slope        1:{slope.cot:g} from {slope.toe:g} to {slope.crest:g} m, {slope.length:.4g} m long, {slope.width:g} m along the shore, periodic",
        f"layer        {layout.number} units in {layout.layers} layer{'s' if layout.layers > 1 else ''} of {rows} row{'s' if rows > 1 else ''} of {layout.columns}, {shore:.4g} m along the shore and {up:.4g} m up the slope; room for {layout.room}",
        f"packing      N D_n^2/A = {layout.packing:.3f}: {layout.number / layout.area:.4g} units per m2 on {layout.area:.4g} m2",
        f"thickness    {layout.thickness:.4g} m = {layout.layers} x {layout.kind.layer_coefficient:g} D_n",
        f"porosity     {layout.porosity:.3f} = 1 - N V/(A t)",
    ]


def assumptions(model):
    """What was assumed, in sentences without a point at the end."""
    layout = model.layout
    soft = "given" if model.material.youngs_modulus else "that of concrete, so that impacts break as they should" if model.material.tensile_strength else "softer than concrete, so that steps can be long; stresses and impacts are not those of concrete"
    said = [
        f"Young's modulus {model.youngs_modulus:.3g} Pa: {soft}",
        f"friction {model.material.friction:g}, restitution 0.4",
        "the slope is rigid, and units beyond the crest are missing: nothing lies on the uppermost row",
        "a row of fixed spheres of D_n on the ground holds the toe",
        f"at most {model.material.count} spheres fill a unit, which has the mass and the inertia of the solid; its edges are rounder",
    ]
    if model.material.tensile_strength:
        said.append(f"units break where a bond of two spheres has a tensile stress of {1e-6 * model.material.tensile_strength:g} MPa or twice that in shear; bonds are brittle")
    if layout.rules.underlayer:
        said.append(f"the underlayer is fixed spheres of a tenth of the volume of a unit, {layout.stone:.3g} m with {100.0 * SPREAD:g} % more or less")
    said.append(
        "orientations are random" if layout.rules.orientation == "random" else
        "orientations follow a rule: every unit stands on the slope, in every other layer upside down, turned by half a turn in every other row"
    )
    return said


def page(model, command):
    """model.md of the folder."""
    made = [f"Made by `{command}`.", ""] if command else []
    lines = [f"# Armour of {model.layout.number} units: {model.layout.kind.name}", "", *made, "```", *summary(model), "```", "", "## Assumed", ""]
    lines += [f"- {line[0].upper()}{line[1:]}." for line in assumptions(model)]
    lines += [
        "", "## Axes", "", "The toe of the slope is the line x = 0; x goes landward, y along the shore, z up.", "",
        "## Files", "", "`unit.stl` is the solid of a unit [m]. `places.csv` has centres and rotation vectors; each unit in turn is lowered until it touches (`lowered`), and all come to rest before the run begins (`rain`).", "",
        "## Run it", "", "```", "sazare check case.toml --picture model.png", "sazare run case.toml --out run", "sazare armour run", "sazare report run", "```", "",
    ]
    return "\n".join(lines)
