"""Blocks in water: the bits of threads and of a resumed run, energies, a picture."""

from pathlib import Path

import sazare
from sazare.cases import blocks

ROOT = Path(__file__).resolve().parents[2]
BLOCK = ROOT / "tests/regression/block/case.toml"


def wet_block():
    """A small block that a pressure breaks, half in water that flows past it."""
    case = sazare.read_case(BLOCK)
    case.time.end = 2e-4
    case.gravity = blocks.Gravity(acceleration=(0.0, 0.0, -9.81))
    case.water = blocks.Water(level=0.15, density=1025.0, current=(20.0, 0.0, 0.0))
    return case


def test_a_wet_block_breaks_with_the_bits_of_threads_and_is_resumed(tmp_path):
    whole = sazare.run(wet_block(), tmp_path / "whole", progress=False, threads=1)
    assert whole.figures["broken_joints"] > 0
    assert abs(whole.history["energy_residual"]).max() < 1e-2 * whole.history["energy_work"].max()
    threads = sazare.run(wet_block(), tmp_path / "threads", progress=False, threads=2)
    assert threads.manifest["state_hash"] == whole.manifest["state_hash"]
    sazare.run(wet_block(), tmp_path / "halved", progress=False, stop=lambda now: now.time > 1e-4)
    resumed = sazare.run(wet_block(), tmp_path / "halved", progress=False, resume=True)
    assert resumed.manifest["state_hash"] == whole.manifest["state_hash"]
    dry = wet_block()
    dry.water = None
    assert sazare.run(dry, tmp_path / "dry", progress=False).manifest["state_hash"] != whole.manifest["state_hash"]


def test_the_picture_of_a_model_shows_its_water():
    figure = sazare.draw_model(wet_block())
    assert "water: level 150 mm" in [text.get_text() for legend in figure.legends for text in legend.get_texts()]
    assert "current 20 m/s along x" in figure.get_suptitle()
