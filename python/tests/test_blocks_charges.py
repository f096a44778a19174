"""The picture of charges, and what runs with charges leave."""

from types import SimpleNamespace

import numpy as np
import pytest

from sazare.methods import blocks_charges
from sazare.tables import Table


def history(peaks, end=1e-3):
    """A history of charges with these peak pressures [Pa]."""
    time = np.linspace(0.0, end, 50)
    columns = {"time": time}
    for n, peak in enumerate(peaks):
        columns |= {
            f"hole {n}.pressure": peak * np.exp(-time / (0.2 * end)), f"hole {n}.volume": np.ones(50),
            f"hole {n}.released": np.full(50, 1e6), f"hole {n}.work": 3e5 * (1.0 - np.exp(-time / end)), f"hole {n}.lost": np.zeros(50),
            f"hole {n}.in_cracks": np.zeros(50),
        }
    return SimpleNamespace(history=Table(columns))


def test_names_come_from_the_columns():
    assert blocks_charges.names(history([1e9, 2e9])) == ["hole 0", "hole 1"]
    assert blocks_charges.names(SimpleNamespace(history=Table({"time": np.zeros(2)}))) == []


def test_pressures_and_energies_of_all_charges_are_drawn():
    figure = blocks_charges.charges(history([1e9, 2e9]))
    left, right = figure.axes
    assert [line.get_label() for line in left.lines] == ["hole 0", "hole 1"]
    assert left.get_ylabel() == "pressure of the gas [GPa]" and left.get_yscale() == "log"
    released, work = right.lines[0].get_ydata(), right.lines[1].get_ydata()
    assert released[-1] == pytest.approx(2.0) and right.get_ylabel() == "energy [MJ]"
    assert np.all(work <= released)


def test_what_left_at_the_collar_is_drawn_on_top_of_the_work():
    results = history([1e9])
    results.history["hole 0.lost"][:] = np.linspace(0.0, 2e5, 50)
    right = blocks_charges.charges(results).axes[1]
    assert len(right.lines) == 3
    assert right.lines[2].get_ydata()[-1] - right.lines[1].get_ydata()[-1] == pytest.approx(0.2)


def test_gas_in_cracks_is_a_band_between_what_has_left_and_what_is_in_the_holes():
    results = history([1e9])
    results.history["hole 0.in_cracks"][:] = 1e5
    right = blocks_charges.charges(results).axes[1]
    bands = {band.get_label(): band.get_paths()[0].get_extents() for band in right.collections}
    assert list(bands) == ["gas in cracks", "gas in the holes"]
    end = 0.3 * (1.0 - np.exp(-1.0))
    assert (bands["gas in cracks"].y0, bands["gas in cracks"].y1) == pytest.approx((0.0, end + 0.1))
    assert bands["gas in the holes"].y1 == pytest.approx(1.0)


def test_only_the_strongest_of_many_have_curves():
    figure = blocks_charges.charges(history([1e8 * (n + 1) for n in range(12)]))
    assert len(figure.axes[0].lines) == blocks_charges.MOST_CHARGES
    assert "hole 11" in [line.get_label() for line in figure.axes[0].lines]


def test_charges_that_never_fired_have_no_picture():
    assert blocks_charges.charges(history([0.0])) is None
    assert blocks_charges.charges(SimpleNamespace(history=Table({"time": np.zeros(2)}))) is None
