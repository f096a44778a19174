"""Pictures of a blasted body of method blocks: fragments by size in plan and section, and slices with cracks. Each returns a matplotlib Figure."""

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import BoundaryNorm
from matplotlib.patches import Patch

from sazare import style
from sazare.blast.sizes import sieve_sizes
from sazare.methods.blocks_maps import EDGES, STONE, bar, crack_layers, crack_norm, outline_layers, panel_title, sheet
from sazare.scenes import Layer, PlaneView

MOST_CLASSES = 8
SLICES = 4


def size_classes(smallest, largest):
    """Bounds [m] of at most eight classes that hold sizes: a series of 1, 2, 5, 10 ..., of which every n-th is taken where there are too many."""
    powers = 10.0 ** np.arange(np.floor(np.log10(smallest)) - 1, np.ceil(np.log10(largest)) + 3)
    series = np.ravel(powers[:, None] * [1.0, 2.0, 5.0])
    first = np.searchsorted(series, smallest, "right") - 1
    last = max(np.searchsorted(series, largest, "left"), first + 1)
    step = -(-(last - first) // MOST_CLASSES)
    return series[first : last + step : step]


def has_loose_fragments(results):
    """Whether the run tells which fragments stay, and some do not."""
    return "stays" in results.fragments and bool(np.any(results.fragments["stays"] == 0))


def _sized(body, results):
    """The elements at the start with the sieve size of their fragment at the end [m], nan where it stays; None where fragments and snapshot differ."""
    snapshot, table = body.snapshots[-1], results.fragments
    loose = table["fragment"][table["stays"] == 0]
    sizes = sieve_sizes(snapshot.elements, loose)
    if sizes is None or snapshot.elements.n_cells != body.first.n_cells:
        return None
    by_number = np.full(int(max(table["fragment"].max(), np.max(snapshot.elements.cell_data["fragment"]))) + 1, np.nan)
    by_number[loose.astype(int)] = sizes
    mesh = body.first.copy()
    mesh.cell_data["sieve_size"] = by_number[np.asarray(snapshot.elements.cell_data["fragment"], dtype=int)]
    return mesh


@style.styled
def fragments_by_size(body, results):
    """The fragments that have come loose where they were at the start, coloured by their sieve size [m]; the rock that stays pale. None where no
    snapshot shows the fragments of the end."""
    mesh = _sized(body, results)
    if mesh is None:
        return None
    size = mesh.cell_data["sieve_size"]
    loose, rock = (mesh.extract_cells(np.flatnonzero(which)) for which in (~np.isnan(size), np.isnan(size)))
    bounds = size_classes(np.nanmin(size), np.nanmax(size))
    loose.cell_data["class"] = np.clip(np.searchsorted(bounds, loose.cell_data["sieve_size"], "right") - 1, 0, len(bounds) - 2)
    colors = colormaps[style.SIZE].resampled(len(bounds) - 1)
    options = {"scalars": "class", "cmap": colors, "clim": (-0.5, len(bounds) - 1.5), **EDGES, "line_width": 0.6}
    figure, axes = sheet([(view, _sized_layers(body, view, loose, rock, options), _words(body, view)) for view in _views(body, loose)])
    bar(
        figure, axes, colors, BoundaryNorm(bounds, len(bounds) - 1), "sieve size of the fragment [m]", ticks=bounds, format="{x:g}", spacing="uniform",
    )
    figure.legend(handles=[Patch(facecolor=style.STONE, edgecolor=style.STONE_EDGE, label="rock that stays")], loc="outside lower center")
    return figure


def _views(body, loose):
    """A slab in its plane; a solid from a corner, in plan and in two vertical sections through the middle of what is loose."""
    if body.is_slab:
        return [body.plane_view()]
    middle = np.median(loose.cell_centers().points, axis=0)
    return [body.solid_view(), *(body.plane_view(axis, float(middle[axis])) for axis in (2, 1, 0))]


def _sized_layers(body, view, loose, rock, options):
    """What has come loose within the rock that stays, in a section; within the outline of the body, from a corner."""
    if isinstance(view, PlaneView):
        return [Layer(view.cut(loose), options), Layer(view.cut(rock), STONE)]
    return [*outline_layers(body.hull()), Layer(loose, {**options, "lighting": True, "ambient": 0.35})]


def _words(body, view):
    if body.is_slab:
        return ""
    kind = {2: "plan, ", 1: "section, ", 0: "section, "}[view.axis] if isinstance(view, PlaneView) else ""
    return kind + view.words


@style.styled
def crack_slices(body):
    """Cracks at the end in parallel planes through a solid, across the axis along which planes meet most of them; None for a slab or without cracks."""
    snapshot = body.snapshots[-1]
    broken = body.broken(snapshot)
    if body.is_slab or broken is None or not broken.n_cells:
        return None
    norm = crack_norm(body)
    axis = body.cut_view().axis
    # Planes beside the nodes, which stand at round places.
    places = np.percentile(broken.cell_centers().points[:, axis], np.linspace(5.0, 95.0, SLICES)) + 1e-4 * body.extents[axis]
    views = [body.plane_view(axis, float(place)) for place in np.unique(places)]
    figure, axes = sheet([(view, crack_layers(body, view, snapshot, norm, None), panel_title(body, view, snapshot)) for view in views])
    factor, prefix = style.prefix_for(norm.vmax)
    bar(figure, axes, style.BREAK_TIME, type(norm)(norm.vmin / factor, norm.vmax / factor), f"time of failure [{prefix}s]")
    return figure
