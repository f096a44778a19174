"""Which snapshots the panels of a picture show."""

from types import SimpleNamespace

import numpy as np
import pytest

from sazare.moments import equal_shares, growth, moments, moments_of, movement


def snapshots(places):
    """Snapshots of two points, one of which is at these places along x."""
    return [SimpleNamespace(elements=SimpleNamespace(points=np.array([[0.0, 0.0, 0.0], [x, 0.0, 0.0]]), cell_data={"broken_fraction": [x, 0.0]}))
            for x in places]


def test_panels_follow_what_happens_and_not_the_time():
    # All happens in the first tenth of the run.
    places = 10.0 + np.minimum(np.arange(41) / 4.0, 1.0)
    assert moments(snapshots(places), 5) == [0, 1, 2, 3, 40]


def test_panels_are_spread_over_a_run_in_which_nothing_happens():
    assert moments(snapshots(np.zeros(7)), 4) == [0, 2, 4, 6]


def test_first_and_last_are_always_there():
    assert moments([], 4) == []
    assert moments(snapshots([1.0]), 4) == [0]
    assert moments(snapshots([0.0, 1.0]), 4) == [0, 1]


def test_of_a_long_series_some_snapshots_are_read():
    chosen = moments(snapshots(np.linspace(0.0, 1.0, 500)), 4)
    assert len(chosen) == 4 and chosen == pytest.approx([0, 166, 333, 499], abs=12)


def test_change_is_the_mean_way_or_the_growth_of_a_field():
    first, before, after = (one.elements for one in snapshots([10.0, 1.0, 1.4]))
    assert movement(first)(before, after) == pytest.approx(0.2)
    assert growth("broken_fraction")(before, after) == pytest.approx(0.4)
    assert growth("heat")(before, after) == 0.0


def test_what_flies_off_does_not_count_more_than_what_stays():
    first, before, after = (one.elements for one in snapshots([10.0, 20.0, 1000.0]))
    assert movement(first)(before, after) == pytest.approx(0.5)


def test_steps_that_are_no_numbers_count_as_nothing():
    assert equal_shares([0.0, np.nan, 1.0, 1.0], 3) == [0, 2, 3]


def test_both_sides_of_a_run_count_alike_however_little_one_moves():
    early = snapshots(10.0 + np.minimum(np.arange(21) / 2.0, 1.0))
    late = snapshots(10.0 + 1e-3 * np.maximum(np.arange(21) - 18.0, 0.0))
    assert moments_of([early, late], 5) == [0, 1, 2, 19, 20]
    assert moments_of([early, []], 5) == []
