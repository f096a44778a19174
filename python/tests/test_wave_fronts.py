"""The way of a wave through a column, from snapshots and gauges made here."""

from types import SimpleNamespace

import numpy as np
import pytest
import pyvista

from sazare import wave_fronts
from sazare.snapshots import Snapshots
from sazare.tables import Table

CASE = """
[[materials]]
name = "soil"
s_wave_velocity = 100.0
[[materials]]
name = "rock"
density = 2000.0
youngs_modulus = 800e6
poisson_ratio = 0.0
[[boundaries]]
side = "bottom"
motion_x = "wave"
[[gauges]]
name = "base"
point = [0.5, 0.5, 0.0]
[[gauges]]
name = "top"
point = [0.5, 39.5, 0.0]
"""
SOIL, ROCK = 100.0, np.sqrt(800e6 / (2.0 * 2000.0))  # m/s
TRAVEL = 19.5 / ROCK + 19.5 / SOIL  # s between the gauges
WIDTH = 0.02  # s


def pulse(time):
    return np.exp(-((time / WIDTH) ** 2))


def passed(height):
    """When the pulse passes, after it has passed 0.5 m at 0.2 s."""
    return 0.2 + np.minimum(height - 0.5, 19.5) / ROCK + np.maximum(height - 20.0, 0.0) / SOIL


def snapshot(time, width):
    """Particles of 1 m over 20 m of rock and 20 m of soil."""
    x, y = (each.ravel() for each in np.meshgrid(np.arange(width) + 0.5, np.arange(40) + 0.5))
    points = np.stack([x, y, 0.0 * x], axis=1)
    grid = pyvista.UnstructuredGrid(np.ravel([[1, i] for i in range(len(x))]), [1] * len(x), points)
    grid.cell_data["displacement"] = np.zeros_like(points)
    grid.cell_data["acceleration"] = np.stack([pulse(time - passed(y)), 0.0 * x, 0.0 * x], axis=1)
    grid.cell_data["material"] = np.where(y > 20.0, 0, 1)
    grid.cell_data["spacing"] = np.ones(len(x))
    return SimpleNamespace(time=time, elements=grid)


def made(interval, width=20, gauges=True):
    time = np.linspace(0.0, 1.0, 1001)
    table = {"time": time}
    for name, height in (("base", 0.5), ("top", 39.5)):
        for quantity in ("displacement", "velocity", "acceleration"):
            for axis in "xyz":
                table[f"{name}.{quantity}_{axis}"] = pulse(time - passed(height)) * (axis == "x")
    snapshots = Snapshots([snapshot(t, width) for t in np.arange(0.0, 1.0 + 1e-9, interval)])
    table = Table(table if gauges else {"time": time})
    return SimpleNamespace(all_snapshots=snapshots, case_text=CASE, gauge_table=table, gauges={"base": None, "top": None} if gauges else {}, path=None)


def test_the_travel_time_is_that_of_the_layers():
    way = wave_fronts.passage(made(0.05))
    assert way.travel == pytest.approx(TRAVEL, rel=2e-3)
    assert way.names == ("base", "top")
    assert way.arrival == pytest.approx(0.2 - WIDTH * np.sqrt(np.log(1.0 / wave_fronts.ONSET)), abs=2e-3)


def test_without_gauges_the_wave_goes_through_the_middle():
    way = wave_fronts.passage(made(0.02, gauges=False))
    assert way.travel == pytest.approx(TRAVEL, rel=2e-3)
    assert way.arrival == pytest.approx(0.18, abs=0.03)


def test_a_run_into_which_nothing_comes_has_no_fronts():
    still = made(0.05)
    still.case_text = still.case_text.replace('motion_x = "wave"', "")
    assert wave_fronts.fronts(still) is None and wave_fronts.section(still) is None


def test_panels_follow_the_front_with_one_scale_of_colours():
    figure = wave_fronts.fronts(made(0.05))
    panels = [axes for axes in figure.axes if axes.get_title(loc="left")]
    times = [float(axes.get_title(loc="left").split()[0]) * 1e-3 for axes in panels]
    assert len(panels) == wave_fronts.MOST_PANELS and 0.15 <= min(times) and max(times) <= 0.2 + 1.25 * TRAVEL
    fronts = []
    for axes, time in zip(panels, times):
        (drawn,) = axes.collections
        places, values = np.asarray(drawn.get_offsets()), np.asarray(drawn.get_array())
        fronts.append(places[np.argmax(values), 1])
        assert drawn.get_clim() == panels[0].collections[0].get_clim()
    assert np.all(np.diff(fronts) > 0.0)
    assert not figure.get_suptitle()


def test_snapshots_that_are_too_far_apart_are_said_to_be():
    figure = wave_fronts.fronts(made(0.25))
    assert "250 ms apart" in figure.get_suptitle() and "snapshot_interval = 20 ms" in figure.get_suptitle()


def test_a_column_has_profiles():
    (axes,) = wave_fronts.fronts(made(0.05, width=2)).axes
    line = axes.get_lines()[-1]
    assert line.get_ydata().max() == 39.5 and axes.get_ylabel() == "y [m]"


def test_the_line_of_the_section_follows_the_peaks():
    axes = wave_fronts.section(made(0.05)).axes[0]
    up = next(line for line in axes.get_lines() if line.get_label().startswith("S wave"))
    times, heights = up.get_data()
    behind = 0.2 - times[0]  # of the peak behind the onset
    assert np.interp(39.5, heights, times) + behind == pytest.approx(passed(39.5), abs=2e-3)
    assert np.interp(20.0, heights, times) + behind == pytest.approx(passed(20.0), abs=2e-3)
