"""Pictures of a body of method blocks: crack pattern, time levels, displaced shape, fragments. Each returns a matplotlib Figure."""

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm, Normalize
from matplotlib.lines import Line2D

from sazare import style
from sazare.methods.blocks_body import SHEARED
from sazare.scenes import Layer, PlaneView, render

EDGES = {"show_edges": True, "edge_color": style.STONE_EDGE, "line_width": 1.0, "lighting": False}
STONE = {"color": style.STONE, **EDGES}
CRACK_WIDTH = 5.0
SHEAR = 2  # `mode` of a crack in which slip has dissipated more than opening
# Cracks by mode and by whether their faces are apart: words and colour.
KINDS = (
    ("opening, faces apart", style.OPEN_CRACK), ("opening, faces pressed together", style.OPEN_PRESSED),
    ("shear, faces apart", style.SHEAR_CRACK), ("shear, faces pressed together", style.SHEAR_PRESSED),
)


def _panel(axes, view, layers, title):
    picture = render(view, layers)
    axes.grid(False)
    axes.set_title(title)
    if picture.extent is None:
        axes.imshow(picture.image, interpolation="antialiased")
        axes.set_axis_off()
        return
    axes.imshow(picture.image, extent=picture.extent, interpolation="antialiased")
    axes.set_xlabel(f"{picture.axes[0]} [m]")
    axes.set_ylabel(f"{picture.axes[1]} [m]")
    axes.spines[["left", "bottom"]].set_visible(False)
    axes.tick_params(length=2)


def sheet(panels):
    """A figure with one axes per (view, layers, title), two in a row; all are drawn. Returns it with its axes."""
    columns = min(2, len(panels))
    rows = -(-len(panels) // columns)
    view = panels[0][0]
    shape = view.size[1] / view.size[0]
    width = 5.3 if columns == 2 else 6.5
    figure = style.figure(width * columns + 0.4, rows * (width * min(max(shape, 0.35), 1.1) + 0.55))
    grid = np.ravel(figure.subplots(rows, columns, squeeze=False))
    for axes, panel in zip(grid, panels):
        _panel(axes, *panel)
    for axes in grid[len(panels) :]:
        axes.set_axis_off()
    return figure, list(grid)


def bar(figure, axes, colors, norm, label, **options):
    figure.colorbar(ScalarMappable(norm, colors), ax=axes, label=label, shrink=0.8, aspect=30, pad=0.02, **options)


def _views(body, snapshots):
    """What to draw: a slab in its plane at every snapshot; a solid from a corner and in a cut, at its last snapshots."""
    if body.is_slab:
        view = body.plane_view()
        return [(view, snapshot) for snapshot in snapshots]
    views = (body.solid_view(), body.cut_view())
    return [(view, snapshot) for snapshot in snapshots[-2:] for view in views]


def _wide(view, *meshes):
    """A view onto a plane with room for what has moved out of the body; one from a corner as it is."""
    return view.holding(*meshes) if isinstance(view, PlaneView) else view


def panel_title(body, view, snapshot, factor=1.0, gone=0):
    words = [style.quantity(snapshot.time, "s")]
    if not body.is_slab:
        words.append(view.words)
    magnified = [f"displacements × {factor:g}"] if factor != 1.0 else []
    if gone:
        magnified.append(f"{style.count(gone)} elements out of the frame")
    return ", ".join(words) + ("\n" if gone else ", " if magnified else "") + ", ".join(magnified)


def _pressed(cracks):
    """Which cracks are sheared and pressed together."""
    return np.asarray(cracks.cell_data["state"]) == SHEARED if cracks.n_cells else np.zeros(0, dtype=bool)


def crack_layers(body, view, snapshot, norm, hull):
    broken, softening = body.broken(snapshot), body.softening(snapshot)
    pressed = _pressed(broken)
    parts = [(broken.extract_cells(np.flatnonzero(pressed)), style.SHEAR_TIME), (broken.extract_cells(np.flatnonzero(~pressed)), style.BREAK_TIME)]
    lines = {"lighting": False, "line_width": CRACK_WIDTH}
    colored = [(mesh, {"scalars": "break_time", "cmap": colors, "clim": (norm.vmin, norm.vmax)}) for mesh, colors in parts]
    if isinstance(view, PlaneView):
        return [
            Layer(view.cut(body.first), STONE),
            Layer(_lift(view, view.cut(softening), 1), {"color": style.SOFTENING, **lines, "line_width": 2.5}),
            *(Layer(_lift(view, view.cut(mesh), 2 + place), {**lines, **options}) for place, (mesh, options) in enumerate(colored)),
        ]
    return [
        *outline_layers(hull),
        *(Layer(mesh, {**options, "ambient": 0.35, "show_edges": False}) for mesh, options in colored),
    ]


def outline_layers(hull):
    """The outer surface of a body, through which one sees, and its edges."""
    edges = hull.extract_feature_edges(25.0, boundary_edges=False, non_manifold_edges=False, manifold_edges=False)
    return [
        Layer(hull, {"color": style.STONE, "opacity": 0.25, "show_edges": False}),
        Layer(edges, {"color": style.OLD_CRACK, "line_width": 2.0, "lighting": False}),
    ]


def _lift(view, mesh, height):
    """Moves lines a little toward the eye, so that they lie on the elements of the plane."""
    right, up = view.in_plane
    along = np.cross(np.eye(3)[right], np.eye(3)[up])
    return mesh.translate(along * height * 1e-3 * np.ptp(view.window), inplace=False) if mesh.n_cells else mesh


def crack_norm(body):
    """The scale of the times at which joints have broken [s]."""
    latest = body.latest_break() or body.snapshots.times.max() or 1.0
    first = body.first_break() or 0.0
    return Normalize(first if first < latest else 0.0, latest)


@style.styled
def crack_pattern(body, panels=4):
    """The broken joints at times between which equal shares of them have broken, coloured by the time each broke; None without joints.

    Joints that are sheared and pressed together have colours of their own.
    """
    if body.snapshots[-1].joints is None:
        return None
    snapshots = body.moments(panels)
    norm = crack_norm(body)
    factor, prefix = style.prefix_for(norm.vmax)
    hull = None if body.is_slab else body.hull()
    drawn = [
        (view, crack_layers(body, view, snapshot, norm, hull), panel_title(body, view, snapshot))
        for view, snapshot in _views(body, snapshots)
    ]
    figure, axes = sheet(drawn)
    scale = Normalize(norm.vmin / factor, norm.vmax / factor)
    if any(_pressed(body.broken(snapshot)).any() for snapshot in snapshots):
        bar(figure, axes, style.SHEAR_TIME, scale, f"sheared, faces pressed together: time of failure [{prefix}s]")
        bar(figure, axes, style.BREAK_TIME, scale, f"open: time of failure [{prefix}s]")
    else:
        bar(figure, axes, style.BREAK_TIME, scale, f"time of failure [{prefix}s]")
    if isinstance(drawn[0][0], PlaneView):
        keys = [
            Line2D([], [], color=style.ACCENT, linewidth=2.5, label="broken joint"),
            Line2D([], [], color=style.SOFTENING, linewidth=1.5, label="softening joint"),
        ]
        figure.legend(handles=keys, loc="outside lower center", ncols=2)
    return figure


def has_shear_cracks(body):
    """Whether joints have failed in shear by the last snapshot."""
    joints = body.snapshots[-1].joints
    return joints is not None and "mode" in joints.cell_data and bool(np.any(joints.cell_data["mode"] == SHEAR))


@style.styled
def crack_modes(body):
    """The cracks of the last snapshot by the mode that has dissipated more, opening or shear, and by whether their faces are apart;
    None where there is none."""
    snapshot = body.snapshots[-1]
    broken = body.broken(snapshot)
    if broken is None or not broken.n_cells or "mode" not in broken.cell_data:
        return None
    kind = 2 * (np.asarray(broken.cell_data["mode"]) == SHEAR) + _pressed(broken)
    broken.cell_data["kind_of_crack"] = kind
    hull = None if body.is_slab else body.hull()
    colors = {"scalars": "kind_of_crack", "cmap": [color for _, color in KINDS], "clim": (-0.5, len(KINDS) - 0.5), "lighting": False}

    def layers(view):
        if isinstance(view, PlaneView):
            lines = {**colors, "line_width": CRACK_WIDTH}
            return [Layer(view.cut(body.first), STONE), Layer(_lift(view, view.cut(broken), 1), lines)]
        return [Layer(hull, {"color": style.STONE, "opacity": 0.25, "show_edges": False}), Layer(broken, {**colors, "show_edges": False})]

    figure, _ = sheet([(view, layers(view), panel_title(body, view, snapshot)) for view, _ in _views(body, [snapshot])])
    counts = np.bincount(kind, minlength=len(KINDS))
    keys = [
        Line2D([], [], color=color, linewidth=3.0, label=f"{words}: {style.count(number)} joint{'s' if number != 1 else ''}")
        for (words, color), number in zip(KINDS, counts) if number
    ]
    figure.legend(handles=keys, loc="outside lower center", ncols=2)
    return figure


def _field_layers(body, view, mesh, options):
    """The elements coloured by one of their fields: whole in a slab or from a corner, cut in the plane of a solid."""
    if isinstance(view, PlaneView):
        return [Layer(mesh if body.is_slab else view.cut(mesh), {**EDGES, "line_width": 0.6, **options})]
    return [Layer(mesh, {**EDGES, "line_width": 0.6, "lighting": True, "ambient": 0.35, **options})]


@style.styled
def time_levels(body, panels=2):
    """The time level k of every element, whose step is the base step / 2^k."""
    snapshots = body.moments(panels)
    if not body.is_slab:
        snapshots = snapshots[-1:]
    levels = [snapshot.elements.cell_data["level"] for snapshot in snapshots]
    low, high = int(min(map(np.min, levels))), int(max(map(np.max, levels)))
    options = {"scalars": "level", "cmap": style.LEVEL, "clim": (low - 0.5, high + 0.5), "n_colors": high - low + 1}
    panels = [
        (view, _field_layers(body, view, snapshot.elements, options), panel_title(body, view, snapshot))
        for view, snapshot in _views(body, snapshots)
    ]
    figure, axes = sheet(panels)
    bounds = np.arange(low - 0.5, high + 1.0)
    bar(
        figure, axes, colormaps[style.LEVEL].resampled(high - low + 1), BoundaryNorm(bounds, len(bounds) - 1),
        "time level (darker: smaller time step)", ticks=np.arange(low, high + 1),
    )
    return figure


def has_stress(body):
    """Whether the run wrote the stress of its elements, and there is any."""
    return any(np.any(snapshot.elements.cell_data["von_mises_stress"]) for snapshot in body.snapshots if "von_mises_stress" in snapshot.elements.cell_data)


def _most_of(values, volumes):
    """The value that 98 % of the volume is below: small elements at a hole would leave everything else in one colour."""
    order = np.argsort(values)
    filled = np.cumsum(volumes[order])
    return float(values[order][min(np.searchsorted(filled, 0.98 * filled[-1]), len(values) - 1)])


@style.styled
def principal_stresses(body):
    """The largest and the smallest principal stress of every element when half of the joints that break have broken, tension positive."""
    snapshot = body.moments(2)[0]
    view = [view for view, _ in _views(body, [snapshot])][-1]  # of a solid the cut
    names = ("largest", "smallest")
    volumes = np.asarray(snapshot.elements.compute_cell_sizes(length=False, area=False)["Volume"])
    top = max(_most_of(np.abs(snapshot.elements.cell_data[f"{name}_principal_stress"]), np.abs(volumes)) for name in names) or 1.0
    factor, prefix = style.prefix_for(top)
    panels = [
        (
            view, _field_layers(body, view, snapshot.elements, {"scalars": f"{name}_principal_stress", "cmap": style.STRESS, "clim": (-top, top)}),
            f"{name} principal stress, {panel_title(body, view, snapshot)}",
        )
        for name in names
    ]
    figure, axes = sheet(panels)
    bar(figure, axes, colormaps[style.STRESS], Normalize(-top / factor, top / factor), f"stress [{prefix}Pa], tension positive", extend="both")
    return figure


@style.styled
def displaced_shape(body, panels=2):
    """The body with magnified displacements, coloured by speed."""
    snapshots = body.moments(panels)
    if not body.is_slab:
        snapshots = snapshots[-1:]
    factor = body.exaggeration(body.snapshots[-1])
    speeds = np.concatenate([snapshot.elements.cell_data["speed"] for snapshot in snapshots])
    # The fastest splinters would leave everything else in one colour.
    top = float(np.percentile(speeds, 99.0)) or float(speeds.max()) or 1.0
    options = {"scalars": "speed", "cmap": style.SPEED, "clim": (0.0, top)}
    shapes = {snapshot.time: body.displaced(snapshot, factor) for snapshot in snapshots}
    panels = [
        (
            _wide(view, *(mesh for mesh, _ in shapes.values())),
            _field_layers(body, view, shapes[snapshot.time][0], options),
            panel_title(body, view, snapshot, factor, snapshot.elements.n_cells - len(shapes[snapshot.time][1])),
        )
        for view, snapshot in _views(body, snapshots)
    ]
    figure, axes = sheet(panels)
    extend = "max" if speeds.max() > top else "neither"
    words = ", clipped at the 99th percentile" if speeds.max() > top else ""
    bar(figure, axes, style.SPEED, Normalize(0.0, top), f"speed [m/s]{words}", extend=extend)
    return figure


@style.styled
def fragment_map(body):
    """The fragments at the end in ten colours, those that touched at the start in different ones, the largest in the colour of stone."""
    snapshot = body.snapshots[-1]
    color, group = body.fragment_colors(snapshot.elements.cell_data["fragment"], style.RUBBLE.N)
    color = np.where(group == np.argmax(np.bincount(group)), 0, 1 + color)
    factor = body.exaggeration(snapshot)
    mesh, shown = body.displaced(snapshot, factor)
    mesh.cell_data["color"] = color[shown]
    table = [style.STONE, *style.RUBBLE.colors]
    options = {"scalars": "color", "cmap": table, "clim": (-0.5, len(table) - 0.5)}
    panels = [
        (_wide(view, mesh), _field_layers(body, view, mesh, options), panel_title(body, view, snapshot, factor, len(color) - len(shown)))
        for view, _ in _views(body, [snapshot])
    ]
    figure, _ = sheet(panels)
    return figure
