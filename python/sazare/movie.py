"""The snapshots of a run as an animation."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.colors import to_hex

from sazare import style
from sazare.folders import own
from sazare.methods import method_of
from sazare.tables import NotARun
from sazare.view3d import read_frames

PIXELS = 800
BAR = 30  # pixels of the line below the picture
MARGIN = 1.08


@dataclass(frozen=True)
class FixedView:
    """A view that is the same for every picture: `camera` of view3d."""

    camera: dict

    @property
    def size(self):
        """Width and height in pixels, even numbers."""
        width, height = self.camera["view"]
        scale = PIXELS / max(width, height)
        return tuple(max(int(MARGIN * scale * length) // 2 * 2, 80) for length in (width, height))

    def aim(self, plotter):
        """Points the camera, in parallel projection."""
        center, toward, distance = np.array(self.camera["center"]), np.array(self.camera["from"]), 3.0 * self.camera["size"]
        plotter.camera.position = center + distance * toward
        plotter.camera.focal_point = center
        plotter.camera.up = self.camera["up"]
        plotter.camera.clipping_range = (0.01 * distance, 3.0 * distance)
        plotter.enable_parallel_projection()
        plotter.camera.parallel_scale = 0.5 * MARGIN * self.camera["view"][1]

    def picture(self, image):
        """The image as it is."""
        return image


def _mesh(frames, number, field, factor):
    """What is drawn of one frame, with the field's share of its range."""
    import pyvista

    places = frames.start + factor * frames.moved[number]
    shares = field.shares[number]
    shapes = frames.shapes
    if shapes.triangles is not None:
        mesh = pyvista.PolyData(places, np.insert(shapes.triangles, 0, 3, axis=1).ravel())
        mesh.point_data["share"] = shares[shapes.cell_of_point]
        return mesh
    cloud = pyvista.PolyData(places)
    cloud.point_data["share"], cloud.point_data["radius"] = shares, shapes.radius
    corners = 14 if len(places) < 3000 else 6
    return cloud.glyph(geom=pyvista.Sphere(radius=1.0, theta_resolution=corners, phi_resolution=corners), scale="radius", orient=False)


def _labelled(image, text, field, colors):
    """The picture with its time, and the colours of the field, in a line below."""
    from matplotlib.font_manager import findfont
    from PIL import Image, ImageDraw, ImageFont

    font = ImageFont.truetype(findfont("DejaVu Sans"), 14)
    height, width = image.shape[:2]
    sheet = Image.new("RGB", (width, height + BAR), "white")
    sheet.paste(Image.fromarray(np.ascontiguousarray(image)), (0, 0))
    pen = ImageDraw.Draw(sheet)
    pen.text((8, height + 8), text, fill=style.INK, font=font)
    words = (style.quantity(field.low), f"{style.quantity(field.high)} {field.unit}  {field.name}")
    right = width - 8 - int(pen.textlength(words[1], font=font))
    for place in range(100):
        pen.line([(right - 108 + place, height + 8), (right - 108 + place, height + 24)], fill=to_hex(colors(place / 99)))
    pen.text((right, height + 8), words[1], fill=style.INK, font=font)
    pen.text((right - 116 - int(pen.textlength(words[0], font=font)), height + 8), words[0], fill=style.INK, font=font)
    return sheet


def _coloured(frames, field, factor):
    """The pictures of a run whose snapshots the 3-D view shows. Raises ValueError where there is no such field."""
    from sazare.scenes import Layer, render

    names = [each.name for each in frames.fields]
    if field is not None and field not in names:
        raise ValueError(f"no field {field!r} in the snapshots; there are: {', '.join(names)}")
    chosen = frames.fields[names.index(field) if field else 0]
    factor = frames.enlargements[-1] if factor is None else factor
    view = FixedView(frames.camera)
    options = {"scalars": "share", "cmap": frames.colors, "clim": (0.0, 1.0), "smooth_shading": False}
    for number, time in enumerate(frames.times):
        image = render(view, [Layer(_mesh(frames, number, chosen, factor), options)])
        enlarged = f", displacements × {factor:g}" if factor != 1 else ""
        yield _labelled(image, f"{style.quantity(time, 's') if time else '0 s'}{enlarged}", chosen, frames.colors)


def _of_figures(results, field, factor):
    """The pictures of a method that draws every snapshot itself. Raises ValueError where a field or a factor is asked for."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from PIL import Image

    if field is not None or factor is not None:
        raise ValueError("a coupled run is drawn as it is, with the speed of its bodies: leave out --field and --enlarge")
    for _, figure in method_of(results).moving(results):
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
        yield Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB")


def write_movie(results, path, field=None, factor=None, interval=0.15):
    """Writes the snapshots of a run as an animated GIF or WebP, by the ending of `path`; returns the path.

    field: the name of a value of the report's 3-D view, such as "speed"; its first one where it is None.
    factor: magnification of displacements; as in the 3-D view where it is None.
    interval: time for which each frame is shown [s].

    A coupled run is drawn with both sides, in true size, the bodies coloured by speed.

    Raises NotARun where there are no snapshots or `path` is a link, ValueError where there is no such field.
    """
    own(Path(path))
    if method_of(results).moving is not None:
        sheets = list(_of_figures(results, field, factor))
    else:
        frames = read_frames(results)
        sheets = list(_coloured(frames, field, factor)) if frames is not None and frames.fields else []
    if not sheets:
        raise NotARun(f"{results.path}: the run wrote no snapshots that can be drawn")
    sheets[0].save(path, save_all=True, append_images=sheets[1:], duration=int(1000 * interval), loop=0)
    return path
