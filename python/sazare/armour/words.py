"""What is said of the damage to armour."""

from sazare.style import count, quantity


def text_of(damage):
    """The lines of the command."""
    times = damage.results.particle_snapshots.times
    units = len(damage.units)
    lines = [
        f"units          {count(units)}, D_n {quantity(damage.size, 'm')}, from {damage.began:g} to {times[-1]:g} s",
        f"displaced      {damage.displaced}, {100.0 * damage.displaced / units:.3g} %, by D_n or more; shifted {damage.shifted}, by half of it but less than all",
        f"rocking        {damage.rocked} turned by 5 degrees or more where they are",
        f"settlement     {quantity(damage.settlement, 'm')} in the mean; the farthest unit moved {damage.ratio.max():.3g} D_n",
    ]
    if damage.broken:
        lines.append(f"broken         {damage.broken} units have broken bonds at the end")
    if damage.per_width is None:
        lines.append("N_od           not known: the case has no level periodic axis; give --width")
    else:
        lines.append(f"N_od           {damage.per_width:.3g} displaced units on a width of D_n")
    if damage.erosion is not None:
        lines.append(f"S              {damage.erosion:.3g}, eroded area over D_n squared")
    if damage.layers is not None:
        before, after = damage.layers
        for name, what, unit in (("packing", "N D_n^2/A", 1.0), ("thickness", "over D_n", damage.size), ("porosity", "1 - N V/(A t)", 1.0)):
            lines.append(f"{name:<14} {getattr(before, name) / unit:.3f} before and {getattr(after, name) / unit:.3f} after, {what}")
        lines.append(f"surveyed       from {before.window[0]:.3g} to {before.window[1]:.3g} m up the slope, with a foot of D_n/2")
    return lines
