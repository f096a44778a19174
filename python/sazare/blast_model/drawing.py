"""Drill patterns in drawings (DXF): holes as lines from collar to toe, crest and toe of the bench, joints as faces and circles. Read by ezdxf."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sazare.blast_model.sheet import LARGEST

UNITS = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "in": 0.0254, "ft": 0.3048}  # m
OF_HEADER = {1: "in", 2: "ft", 4: "mm", 5: "cm", 6: "m"}  # $INSUNITS
SHORTEST, LONGEST = 0.3, 100.0  # of blast holes [m]; beyond them a unit is wrong
BENT = 0.05  # m that a hole may leave the line from collar to toe


@dataclass(frozen=True)
class DrawnHole:
    """A hole of a drawing, in m."""

    name: str
    collar: np.ndarray  # (3,)
    toe: np.ndarray  # (3,)


class Drawing:
    """A DXF file; coordinates in m."""

    def __init__(self, path, unit=None):
        """unit: a key of UNITS; None for that of the header. Raises ValueError for what is no drawing, OSError where it cannot be read."""
        self.path, self.notes = Path(path), []
        self._space, code = _opened(self.path)
        self.unit = unit or OF_HEADER.get(code)
        self._source = "as --dxf-unit says" if unit else "as its header says" if self.unit else "since its header names no such unit"
        if self.unit is None:
            kind = "no unit" if code == 0 else f"the unit number {code}, which is none of {', '.join(UNITS)}"
            self.notes.append(f"{path}: its header ($INSUNITS) names {kind}; coordinates are taken for metres (--dxf-unit)")
            self.unit = "m"
        self._scale = UNITS[self.unit]

    def holes(self, layer, layer_of_names=None):
        """The holes of a layer: lines and polylines, in the order of the file. Each has the name of the text nearest to its collar, or a number."""
        lines = [(item, points) for item, points in self._lines(layer) if len(points) > 1]
        if not lines:
            raise ValueError(f"{self.path}: error: the layer {layer!r} has no lines or polylines\n      help: holes are lines from collar to toe; layers are {self._layers()}")
        ends = [self._ends(item, points) for item, points in lines]
        self._check_unit([float(np.linalg.norm(toe - collar)) for collar, toe in ends])
        names = self._names(ends, layer_of_names or layer, layer_of_names is not None)
        return [DrawnHole(name, *pair) for name, pair in zip(names, ends)]

    def outline(self, layer):
        """Corners (n, 3) of all lines of a layer [m]."""
        found = [points for _, points in self._lines(layer)]
        if not found:
            raise ValueError(f"{self.path}: error: the layer {layer!r} has no lines or polylines\n      help: layers are {self._layers()}")
        return np.concatenate(found)

    def joints(self, layer):
        """Centre (3,), unit normal (3,) and radius of discs [m]: circles, and 3-D faces as discs of their area about their centre."""
        found, others = [], 0
        for item in self._items(layer):
            kind = item.dxftype()
            if kind == "CIRCLE":
                self._require_finite(item, [*item.dxf.center, *item.dxf.extrusion, item.dxf.radius])
                centre = np.array(item.ocs().to_wcs(item.dxf.center))
                found.append((centre * self._scale, _unit(np.array(item.dxf.extrusion)), float(item.dxf.radius) * self._scale))
            elif kind == "3DFACE":
                disc = _disc_of(self._require_finite(item, [tuple(point) for point in item.wcs_vertices()]) * self._scale)
                found += [disc] if disc else []
                others += disc is None
            else:
                others += 1
        if others:
            self.notes.append(f"{self.path}: {others} entities of the layer {layer!r} are neither circles nor 3-D faces with an area, and are left out")
        if not found:
            raise ValueError(f"{self.path}: error: the layer {layer!r} has no circles or 3-D faces\n      help: joints are CIRCLE and 3DFACE; layers are {self._layers()}")
        return found

    def _items(self, layer):
        found = [item for item in self._space if item.dxf.layer.lower() == layer.lower()]
        if not found:
            raise ValueError(f"{self.path}: error: nothing is drawn on a layer {layer!r}\n      help: layers with something on them are {self._layers()}")
        return found

    def _require_finite(self, item, values):
        """Coordinates or sizes of an entity as an array. Raises ValueError where one is no finite number that can be a place."""
        values = np.array(values, dtype=float)
        wrong = values[~(np.abs(values) * self._scale <= LARGEST["m"])]
        if len(wrong):
            raise ValueError(
                f"{self.path}: error: the {item.dxftype()} {item.dxf.handle} of the layer {item.dxf.layer!r} has a coordinate {wrong[0]:g}, which is no place\n"
                "      help: move or erase it in the drawing"
            )
        return values

    def _layers(self):
        counts = {}
        for item in self._space:
            counts[item.dxf.layer] = counts.get(item.dxf.layer, 0) + 1
        return ", ".join(f"{name} ({count})" for name, count in sorted(counts.items())) or "none at all"

    def _lines(self, layer):
        """Lines and polylines of a layer with their corners (n, 3) [m]."""
        left_out = {}
        for item in self._items(layer):
            kind = item.dxftype()
            if kind == "LINE":
                points = [item.dxf.start, item.dxf.end]
            elif kind == "POLYLINE" and (item.is_3d_polyline or item.is_2d_polyline):
                points = list(item.points_in_wcs())
            elif kind == "LWPOLYLINE":
                points = list(item.vertices_in_wcs())
            else:
                if kind not in ("TEXT", "MTEXT"):
                    left_out[kind] = left_out.get(kind, 0) + 1
                continue
            yield item, self._require_finite(item, [tuple(point) for point in points]) * self._scale
        if left_out:
            kinds = ", ".join(f"{count} {kind}" for kind, count in sorted(left_out.items()))
            self.notes.append(f"{self.path}: the layer {layer!r} has {kinds} too, which are left out (explode blocks first)")

    def _ends(self, item, points):
        """Collar and toe: the upper end is the collar, and of a level hole the first."""
        first, last = points[0], points[-1]
        way, length = last - first, float(np.linalg.norm(last - first))
        if length > 0.0:
            bent = float(np.linalg.norm(np.cross(points - first, way / length), axis=1).max())
            if bent > max(BENT, 0.01 * length):
                raise ValueError(
                    f"{self.path}: error: the hole {item.dxf.handle} at ({first[0]:.6g}, {first[1]:.6g}, {first[2]:.6g}) m bends by {bent:.3g} m\n"
                    "      help: a hole is straight: draw the line from its collar to its toe"
                )
        return (last, first) if last[2] > first[2] else (first, last)

    def _check_unit(self, lengths):
        middle = float(np.median(lengths))
        if SHORTEST <= middle <= LONGEST:
            return
        likely = [name for name, scale in UNITS.items() if 2.0 <= middle / self._scale * scale <= 40.0]
        meant = f"; coordinates look like {' or '.join(likely)}: --dxf-unit {likely[0]}" if likely else ": --dxf-unit"
        wrong = f"too short: half of them have {middle:.4g} m or less" if middle < SHORTEST else f"too long: half of them have {middle:.4g} m or more"
        raise ValueError(f"{self.path}: error: the holes are {wrong}, with coordinates in {self.unit} ({self._source})\n      help: the unit is wrong{meant}")

    def _names(self, ends, layer, needed):
        texts = [item for item in self._items(layer) if item.dxftype() in ("TEXT", "MTEXT")]
        if not texts:
            if needed:
                raise ValueError(f"{self.path}: error: the layer {layer!r} has no text\n      help: names of holes are TEXT or MTEXT beside their collars; layers are {self._layers()}")
            self.notes.append(f"{self.path}: holes have no text beside them, and are numbered in the order of the file")
            return [str(number + 1) for number in range(len(ends))]
        words = [(item.plain_text() if item.dxftype() == "MTEXT" else item.dxf.text).strip() for item in texts]
        places = [item.get_placement() if item.dxftype() == "TEXT" else (None, item.dxf.insert) for item in texts]
        places = np.array([self._require_finite(item, place[1] if place[1] is not None else item.dxf.insert) for item, place in zip(texts, places)])[:, :2] * self._scale
        nearest = [int(np.argmin(np.linalg.norm(places - collar[:2], axis=1))) for collar, _ in ends]
        for place, text in enumerate(nearest):
            if text in nearest[:place]:
                raise ValueError(
                    f"{self.path}: error: the text {words[text]!r} is the nearest to two holes, {nearest.index(text) + 1} and {place + 1} of the file\n"
                    "      help: put a text beside the collar of every hole, or none at all"
                )
        return [words[text] for text in nearest]


def _opened(path):
    """Model space and unit of the header."""
    try:
        import ezdxf
    except ImportError as error:
        raise ValueError(f"{path}: reading drawings takes the Python package ezdxf, which is not installed\n      help: pip install ezdxf, or write the holes into a table (CSV)") from error
    try:
        drawing = ezdxf.readfile(path)
    except OSError as error:
        if error.errno is not None:
            raise OSError(f"{path}: cannot be read: {error.strerror}") from error
        raise ValueError(f"{path}: error: this is no drawing in the format DXF\n      help: save it as DXF (not DWG)") from error
    except (ezdxf.DXFError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: error: this drawing cannot be read: {error}\n      help: save it as DXF anew") from error
    return drawing.modelspace(), int(drawing.header.get("$INSUNITS", 0))


def _unit(vector):
    return vector / np.linalg.norm(vector)


def _disc_of(corners):
    """The disc that stands for a flat face; None for one without an area. The centre is that of the area of its triangles."""
    triangles = [np.array([corners[0], corners[i], corners[i + 1]]) for i in range(1, len(corners) - 1)]
    areas = np.array([0.5 * np.cross(b - a, c - a) for a, b, c in triangles]).reshape(-1, 3)
    normal = areas.sum(axis=0)
    area = float(np.linalg.norm(normal))
    if area < 1e-12:
        return None
    centre = sum(float(part @ normal) * triangle.mean(axis=0) for part, triangle in zip(areas, triangles)) / area**2
    return centre, normal / area, math.sqrt(area / math.pi)
