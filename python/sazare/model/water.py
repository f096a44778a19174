"""The surface of open water in pictures of models, and planes in them."""

import numpy as np

from sazare import style
from sazare.model.parts import WALL, Part, along

WATER = "#2b6cb0"
CORNERS = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])  # of a box


def water_parts(opened, box):
    """The still surface of the water of `[water]`, where it lies in a box [m]."""
    water = opened.case.get("water", {})
    up = -np.asarray(opened.gravity if opened.gravity is not None else (0.0, 0.0, 0.0), dtype=float)
    if "level" not in water or not up.any():
        return
    up /= np.linalg.norm(up)
    waves = "" if water.get("waves", "none") == "none" else f", waves {water['waves']}"
    outline = plane_in_box(water["level"] * up, up, box)
    if len(outline) > 2:
        yield Part(f"water: level {style.quantity(water['level'], 'm')}{waves}", WATER, WALL, faces=[outline])


def current_notes(opened):
    """What is said of the current, as a list."""
    current = opened.case.get("water", {}).get("current", ())
    return [f"current {along(current, 'm/s')}"] if any(current) else []


def plane_in_box(point, normal, box):
    """The outline (k, 3) of the part of a plane that lies in a box, in order; empty where it passes beside."""
    corners = box[0] + CORNERS * (box[1] - box[0])
    heights = (corners - point) @ (normal / np.linalg.norm(normal))
    found = [corners[i] for i in range(8) if heights[i] == 0.0]
    for i in range(8):
        for axis in range(3):
            j = i | (4 >> axis)
            if heights[i] * heights[j] < 0.0:
                found.append(corners[i] + heights[i] / (heights[i] - heights[j]) * (corners[j] - corners[i]))
    if len(found) < 3:
        return np.empty((0, 3))
    found = np.array(found)
    across = np.linalg.svd(normal[None, :])[2][1:]
    flat = (found - found.mean(axis=0)) @ across.T
    return found[np.argsort(np.arctan2(flat[:, 1], flat[:, 0]))]
