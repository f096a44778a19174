"""Pictures drawn off screen: through a plane, with coordinates, or of a solid seen from a corner."""

import os
from dataclasses import dataclass

import numpy as np

# The software renderer needs no display; whoever wants another one sets the variable first.
os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")

import pyvista  # noqa: E402

MARGIN = 0.03
PIXELS = 1100
TALL = 1.3  # height over width of pictures that stand side by side
AXES = "xyz"


@dataclass(frozen=True)
class Layer:
    """One mesh of a picture, and the options of pyvista's add_mesh."""

    mesh: object
    options: dict


@dataclass(frozen=True)
class Picture:
    """An image (h, w, 3); for a plane also the coordinates of its edges [m] and the names of its two axes."""

    image: np.ndarray
    extent: tuple | None = None
    axes: tuple | None = None


@dataclass(frozen=True)
class PlaneView:
    """Looks along an axis in parallel projection; `window` (2, 2) is what is seen, lower and upper corner [m]."""

    axis: int
    position: float
    window: np.ndarray

    @property
    def in_plane(self):
        """The axes that point right and up."""
        return {0: (1, 2), 1: (0, 2), 2: (0, 1)}[self.axis]

    @property
    def words(self):
        """What the view shows, such as `plane z = 0.1 m`."""
        return f"plane {AXES[self.axis]} = {self.position:.3g} m"

    def holding(self, *meshes):
        """The view with a window that holds these meshes too, each side moved out by a quarter of its length at most."""
        boxes = np.array([mesh.bounds for mesh in meshes]).reshape(-1, 3, 2)[:, self.in_plane, :]
        lower, upper = self.window
        room = 0.25 * (upper - lower)
        margin = MARGIN * (upper - lower).max()
        lowest = np.clip(boxes[:, :, 0].min(axis=0) - margin, lower - room, lower)
        highest = np.clip(boxes[:, :, 1].max(axis=0) + margin, upper, upper + room)
        return PlaneView(self.axis, self.position, np.array([lowest, highest]))

    def cut(self, mesh):
        """The mesh in the plane: polygons of a solid, lines of a surface, with the data of their cells. The plane lies a millionth of the
        mesh beside its position, since cells whose nodes lie in a plane are cut wrongly."""
        origin = np.zeros(3)
        origin[self.axis] = self.position + 1e-6 * mesh.length
        normal = np.zeros(3)
        normal[self.axis] = 1.0
        return mesh.slice(normal=normal, origin=origin, generate_triangles=False)

    def aim(self, plotter):
        """Points the camera; right and up are the axes of `in_plane`."""
        right, up = self.in_plane
        center = np.zeros(3)
        center[self.axis] = self.position
        center[[right, up]] = self.window.mean(axis=0)
        along = np.cross(np.eye(3)[right], np.eye(3)[up])
        distance = 10.0 * np.ptp(self.window, axis=0).max()
        plotter.camera.position = center + distance * along
        plotter.camera.focal_point = center
        plotter.camera.up = np.eye(3)[up]
        plotter.camera.clipping_range = (0.01 * distance, 3.0 * distance)
        plotter.enable_parallel_projection()
        plotter.camera.parallel_scale = 0.5 * np.ptp(self.window, axis=0)[1]

    @property
    def size(self):
        """Width and height in pixels."""
        width, height = np.ptp(self.window, axis=0)
        scale = PIXELS / max(width, height)
        return max(int(width * scale), 80), max(int(height * scale), 80)

    def picture(self, image):
        """The image with its coordinates."""
        (left, bottom), (right, top) = self.window
        return Picture(image, (left, right, bottom, top), tuple(AXES[axis] for axis in self.in_plane))


@dataclass(frozen=True)
class SolidView:
    """Looks at the body from a corner; `side` (3,) holds the signs of the corner. trim: whether pictures lose their white border."""

    bounds: tuple
    side: np.ndarray
    trim: bool = True

    words = "oblique view"
    size = (PIXELS, int(0.8 * PIXELS))

    def aim(self, plotter):
        """Points the camera; z is up."""
        center = np.array(self.bounds).reshape(3, 2).mean(axis=1)
        plotter.camera.focal_point = center
        plotter.camera.position = center + self._toward_eye * np.ptp(self.bounds)
        plotter.camera.up = (0.0, 0.0, 1.0)
        plotter.enable_parallel_projection()
        plotter.reset_camera(bounds=self.bounds)

    @property
    def _toward_eye(self):
        return self.side * np.array([1.0, 1.35, 0.8])

    def shows(self, points):
        """Which points (n, 3) lie within the window (n,)."""
        box = np.array(self.bounds).reshape(3, 2)
        toward = self._toward_eye / np.linalg.norm(self._toward_eye)
        right = np.cross([0.0, 0.0, 1.0], toward)
        right /= np.linalg.norm(right)
        up = np.cross(toward, right)
        half = 0.5 * np.linalg.norm(np.ptp(box, axis=1))  # of the height: a ball about the box fits
        away = np.asarray(points) - box.mean(axis=1)
        return (np.abs(away @ up) <= half) & (np.abs(away @ right) <= half * self.size[0] / self.size[1])

    def picture(self, image):
        """The image without its white border, unless that is to stay."""
        return Picture(trimmed_alike([image])[0] if self.trim else image)


def trimmed_alike(images):
    """Images of one size without the white border that all of them have."""
    used = np.any([np.any(image < 250, axis=2) for image in images], axis=0)
    rows, columns = np.flatnonzero(used.any(axis=1)), np.flatnonzero(used.any(axis=0))
    if len(rows) == 0:
        return images
    pad = 8
    window = (slice(max(rows[0] - pad, 0), rows[-1] + pad), slice(max(columns[0] - pad, 0), columns[-1] + pad))
    return [image[window] for image in images]


def sheet(images):
    """A figure with an axes for each of some images of one size: two in a row, or all side by side where they are tall; and its axes."""
    from sazare import style

    high, wide = images[0].shape[:2]
    columns = min(len(images), 4 if high > TALL * wide else 2)
    rows = -(-len(images) // columns)
    figure = style.figure(9.0, rows * (0.45 + 7.6 / columns * high / wide))
    panels = np.ravel(figure.subplots(rows, columns, squeeze=False))
    for axes in panels:
        axes.set_axis_off()
    for axes, image in zip(panels, images):
        axes.imshow(image)
    return figure, panels


def render(view, layers):
    """The picture of some layers in a view; layers without cells are left out."""
    plotter = pyvista.Plotter(off_screen=True, window_size=view.size, lighting="none")
    plotter.background_color = "white"
    for layer in layers:
        if layer.mesh is not None and layer.mesh.n_cells > 0:
            plotter.add_mesh(layer.mesh, show_scalar_bar=False, reset_camera=False, **layer.options)
    view.aim(plotter)
    # White lights only: the colours of a field must stay those of its scale.
    plotter.add_light(pyvista.Light(light_type="headlight", intensity=0.75))
    lamp = pyvista.Light(light_type="camera light", intensity=0.35)
    lamp.position = (-1.0, 1.5, 0.6)
    plotter.add_light(lamp)
    image = plotter.screenshot(None, return_img=True)
    plotter.close()
    return view.picture(np.asarray(image)[..., :3])
