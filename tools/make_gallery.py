"""Makes the gallery: runs cases, and keeps a picture of each in docs/gallery.

    python tools/make_gallery.py [CASE...]

Runs lie in build/gallery. Without names all cases of the list are run; some take minutes.
"""

import sys
from pathlib import Path

from PIL import Image

import sazare
from sazare.report import write_pictures

ROOT = Path(__file__).resolve().parents[1]
GALLERY = ROOT / "docs/gallery"
WIDTH = 900  # pixels

# Case -> the picture of its report that shows most.
PICTURES = {
    "free-face-blast": "cracks",
    "direct-shear": "cracks",
    "uniaxial-compression": "cracks",
    "brazilian-disc": "cracks",
    "dynamic-brazilian": "cracks",
    "kalthoff-winkler": "cracks",
    "cylinder-blast": "cracks",
    "crater-test": "shape",
    "contour-blast": "shape",
    "borehole-under-stress": "cracks",
    "spalling-bar": "cracks",
    "column-ricker": "accelerations",
    "column-nonlinear": "response_spectra",
    "liquefaction-column": "pore_pressures",
    "toppling-columns": "moving",
    "mortar-beam": "moving",
    "base-friction": "moving",
    "block-on-slope": "square_gauges",
    "rotating-drum": "spheres",
    "slope-el-centro": "failure",
    "irregular-beam": "moving",
    "shaking-table": "moving",
    "bonded-beam": "broken_bonds",
    "tetrapod-armour": "spheres",
    "armour-slope": "spheres",
    "tetrapod-drop": "broken_bonds",
    "stones-through-water": "spheres",
    "strip-footing": "yielding",
    "caisson-quay-wall": "yielding",
    "quay-wall-dry": "yielding",
    "slope-free-field": "yielding",
    "cantilever-fem": "displaced",
    "seawall-shaking-table": "together",
    "seawall-in-water": "together",
    "block-on-soft-ground": "together",
    "slope-hits-wall": "together",
    "rock-fall-on-slab": "together",
}


def keep(picture, target):
    """Writes a picture small, as the page shows it."""
    with Image.open(picture) as image:
        image = image.convert("RGB")
        if image.width > WIDTH:
            image = image.resize((WIDTH, round(image.height * WIDTH / image.width)), Image.Resampling.LANCZOS)
        image.quantize(256).save(target, optimize=True)


def main(names):
    """Runs the cases and keeps their pictures."""
    for case in names or PICTURES:
        folder = ROOT / "build/gallery" / case
        sazare.run(ROOT / "cases" / case / "case.toml", folder, overwrite=True)
        (picture,) = write_pictures(folder, [PICTURES[case]], folder / "pictures")
        keep(picture, GALLERY / f"{case}.png")
        print(GALLERY / f"{case}.png")


if __name__ == "__main__":
    main(sys.argv[1:])
