"""Numbers of a blast against closed forms: sizes, fits, boxes, vibration, limits, damage."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sazare.blast.boxes import opening, sieve_size, smallest_box
from sazare.blast.damage import Damage, across, mean_axis
from sazare.blast.fits import power_law, rosin_rammler, size_fits, swebrec
from sazare.blast.holes import Hole, nearest
from sazare.blast.limits import INCH, LIMITS
from sazare.blast.sizes import Distribution
from sazare.blast.vibration import Shaking, attenuation, half_cycle_frequency, shaking_of

BRICK = np.array([[x, y, z] for x in (0.0, 5.0) for y in (0.0, 2.0) for z in (0.0, 1.0)])


# Boxes and sieve sizes


@pytest.mark.parametrize("seed", range(5))
def test_the_smallest_box_of_a_turned_brick_has_its_edges(seed):
    turned = Rotation.random(random_state=seed).apply(BRICK) + [7.0, -3.0, 100.0]
    assert smallest_box(turned) == pytest.approx([5.0, 2.0, 1.0], rel=1e-9)


def test_corners_within_do_not_change_the_box():
    inner = np.random.default_rng(1).uniform([0.1, 0.1, 0.1], [4.9, 1.9, 0.9], (50, 3))
    assert smallest_box(np.concatenate([BRICK, inner])) == pytest.approx([5.0, 2.0, 1.0], rel=1e-9)


def test_a_regular_tetrahedron_has_the_cube_around_it():
    # Its six edges are diagonals of the faces of a cube, which is the least box of all; of those with a side in a face the least has the height of the
    # tetrahedron as one edge: sqrt(2/3) 1 of the length of an edge, and its triangle's rectangle, 1 by sqrt(3)/2.
    corners = np.array([[0, 0, 0], [1, 1, 0], [1, 0, 1], [0, 1, 1]]) / np.sqrt(2.0)
    assert np.sort(smallest_box(corners)) == pytest.approx(np.sort([np.sqrt(2.0 / 3.0), 1.0, np.sqrt(3.0) / 2.0]), rel=1e-9)


def test_points_in_a_plane_have_no_box():
    with pytest.raises(ValueError, match="lie in a plane"):
        smallest_box(BRICK[BRICK[:, 2] == 0.0])


def test_a_brick_passes_an_opening_of_its_middle_edge():
    assert sieve_size(Rotation.random(random_state=3).apply(BRICK)) == pytest.approx(2.0, rel=1e-9)


def test_a_flat_brick_passes_along_the_diagonal():
    # A section b x c, turned by 45 degrees, lies in a square of the side (b + c) / sqrt(2).
    assert opening([5.0, 2.0, 0.1]) == pytest.approx(2.1 / np.sqrt(2.0))
    assert opening([5.0, 2.0, 2.0 * (np.sqrt(2.0) - 1.0)]) == pytest.approx(2.0)


# Sizes


def quantiles(inverse, count=4000):
    """A Distribution of fragments of equal mass whose sizes are those of a law at equally spaced shares."""
    sizes = inverse((np.arange(count) + 1.0) / count * (1.0 - 1e-9))
    return Distribution.of(sizes, np.ones(count), np.full(count, 50))


def test_a_known_distribution_gives_its_percentages_back():
    # x = 0.4 P: P50 is 0.2 m, P20 0.08 m, P80 0.32 m, and a quarter is larger than 0.3 m.
    uniform = quantiles(lambda share: 0.4 * share)
    assert uniform.size_at(0.5) == pytest.approx(0.2, rel=1e-3)
    assert uniform.size_at(0.2) == pytest.approx(0.08, rel=1e-3)
    assert uniform.size_at(0.8) == pytest.approx(0.32, rel=1e-3)
    assert uniform.oversize(0.3) == pytest.approx(0.25, abs=1e-3)
    assert uniform.passing(0.1) == pytest.approx(0.25, abs=1e-3)


def test_sizes_count_mass_and_not_numbers():
    dense = Distribution.of([0.1, 0.2], [9.0, 1.0], [5, 5])
    assert dense.size_at(0.5) == 0.1 and dense.oversize(0.15) == pytest.approx(0.1)


def test_the_mesh_cannot_see_below_the_sizes_of_its_elements():
    # Up to 0.2 m two thirds of what passes are single elements, up to 0.3 m half of it.
    found = Distribution.of([0.1, 0.2, 0.2, 0.3, 0.5], [1.0, 1.0, 1.0, 1.0, 9.0], [1, 1, 3, 4, 90])
    assert found.mesh_limit == 0.2
    assert Distribution.of([0.1, 0.2], [1.0, 1.0], [2, 2]).mesh_limit == 0.0
    assert Distribution.of([0.1, 0.2], [1.0, 1.0], [1, 1]).mesh_limit == np.inf


def test_without_fragments_there_is_no_size():
    none = Distribution.of([], [], [])
    assert np.isnan(none.size_at(0.5)) and none.oversize(0.1) == 0.0 and none.mesh_limit == 0.0 and size_fits(none) == []


# Fits


def test_the_fit_of_rosin_and_rammler_recovers_its_parameters():
    found = size_fits(quantiles(lambda share: 0.3 * (-np.log(1.0 - share)) ** (1.0 / 1.4)))[0]
    assert found.name == "Rosin-Rammler"
    assert found.parameters["x_c"] == pytest.approx(0.3, rel=5e-3) and found.parameters["n"] == pytest.approx(1.4, rel=5e-3)
    assert found.r2 > 0.9999 and found.worst < 2e-3


def test_the_fit_of_swebrec_recovers_its_parameters():
    largest, median, undulation = 1.0, 0.25, 2.4
    law = quantiles(lambda share: largest / (largest / median) ** ((1.0 / share - 1.0) ** (1.0 / undulation)))
    found = size_fits(law)[1]
    assert found.name == "Swebrec"
    assert found.parameters["x_max"] == pytest.approx(largest, rel=2e-2)
    assert found.parameters["x_50"] == pytest.approx(median, rel=5e-3) and found.parameters["b"] == pytest.approx(undulation, rel=2e-2)
    assert found.r2 > 0.9999


def test_laws_of_sizes_have_their_fixed_points():
    assert swebrec(np.array([0.25, 1.0, 2.0]), 1.0, 0.25, 2.0) == pytest.approx([0.5, 1.0, 1.0])
    assert rosin_rammler(0.3, 0.3, 1.7) == pytest.approx(1.0 - np.exp(-1.0))


def test_fits_use_only_what_the_mesh_can_see():
    single = np.linspace(0.001, 0.01, 200)
    whole = quantiles(lambda share: 0.3 * (-np.log(1.0 - share)) ** (1.0 / 1.4), 400)
    mixed = Distribution.of(np.append(single, whole.sizes), np.append(np.full(200, 0.5), whole.masses), np.append(np.ones(200), whole.elements))
    # The elements have a mass of 100, which the other fragments reach at a quarter of theirs: 0.3 m (-ln 0.75)^(1/1.4).
    limit = 0.3 * (-np.log(0.75)) ** (1.0 / 1.4)
    assert mixed.mesh_limit == pytest.approx(limit, rel=1e-2)
    assert [fit.lower > mixed.mesh_limit for fit in size_fits(mixed)] == [True, True]


def test_too_few_sizes_are_not_fitted():
    assert size_fits(Distribution.of([0.1, 0.2, 0.3, 0.4], np.ones(4), np.full(4, 9))) == []
    assert size_fits(Distribution.of(np.linspace(0.3, 0.4, 30), np.ones(30), np.full(30, 9))) == []


def test_a_power_law_is_recovered_and_its_band_has_no_width():
    x = np.array([1.0, 2.0, 5.0, 9.0])
    law = power_law(x, 0.7 * x**-1.6)
    assert law.factor == pytest.approx(0.7) and law.exponent == pytest.approx(-1.6) and law.r2 == pytest.approx(1.0)
    assert law.confidence(x)[1] == pytest.approx(law.at(x), rel=1e-9)


def test_the_bands_of_a_power_law_are_those_of_linear_regression():
    # Draper and Smith's formulas by hand: ln x = 0, 1, 2; ln y = 0, 1, 3: slope 1.5, residuals 1/6, -1/3, 1/6, s^2 = 1/6; t(0.975, 1) = 12.7062.
    law = power_law(np.exp([0.0, 1.0, 2.0]), np.exp([0.0, 1.0, 3.0]))
    assert law.exponent == pytest.approx(1.5) and law.deviation == pytest.approx(np.sqrt(1.0 / 6.0))
    lower, upper = law.confidence(np.exp([2.0]))
    half = 12.7062 * np.sqrt((1.0 / 6.0) * (1.0 / 3.0 + 0.5))
    assert np.log(upper / lower) == pytest.approx([2.0 * half], rel=1e-4)
    lower, upper = law.prediction(np.exp([2.0]))
    assert np.log(upper / lower) == pytest.approx([2.0 * 12.7062 * np.sqrt((1.0 / 6.0) * (1.0 + 1.0 / 3.0 + 0.5))], rel=1e-4)


def test_bands_hold_the_share_of_points_that_they_name():
    random, held, x = np.random.default_rng(5), 0, np.geomspace(1.0, 20.0, 8)
    for _ in range(2000):
        law = power_law(x, 3.0 * x**-1.5 * np.exp(random.normal(0.0, 0.3, 8)))
        lower, upper = law.prediction(np.array([6.0]))
        held += lower[0] < 3.0 * 6.0**-1.5 * np.exp(random.normal(0.0, 0.3)) < upper[0]
    assert held / 2000 == pytest.approx(0.95, abs=0.015)  # three standard deviations of the share


def test_two_points_or_one_place_are_no_power_law():
    assert power_law([1.0, 2.0], [3.0, 4.0]) is None
    assert power_law([2.0, 2.0, 2.0], [1.0, 2.0, 3.0]) is None


# Vibration


def test_a_sine_has_the_frequency_of_its_half_cycles():
    time = np.linspace(0.0, 0.1, 2001)
    assert half_cycle_frequency(time, 0.02 * np.sin(2.0 * np.pi * 40.0 * time) * np.exp(-10.0 * time)) == pytest.approx(40.0, rel=2e-2)


def test_a_pulse_after_rest_has_the_frequency_of_its_own_duration():
    time = np.linspace(0.0, 1e-2, 1001)
    pulse = np.where((time > 2e-3) & (time < 4e-3), np.sin(np.pi * (time - 2e-3) / 2e-3), 0.0)
    assert half_cycle_frequency(time, -pulse) == pytest.approx(250.0, rel=2e-2)


def test_a_half_cycle_that_is_not_over_or_too_coarse_has_no_frequency():
    time = np.linspace(0.0, 1e-2, 1001)
    assert half_cycle_frequency(time, np.minimum(time, 5e-3)) is None
    assert half_cycle_frequency(time[::200], np.sin(2.0 * np.pi * 200.0 * time[::200])) is None


def shaken(ppv, rises=False):
    return Shaking("G", ppv, 0.0, np.array([ppv, 0.0, 0.0]), None, rises)


def test_attenuation_leaves_out_peaks_that_still_rise():
    distances = np.array([1.0, 2.0, 4.0, 8.0])
    gauges = [shaken(0.5 * distance**-1.2) for distance in distances] + [shaken(99.0, rises=True)]
    law = attenuation(gauges, [*distances, 3.0])
    assert law.exponent == pytest.approx(-1.2) and law.points == 4
    assert attenuation(gauges[:2], distances[:2]) is None
    assert attenuation([shaken(0.5 * distance) for distance in distances], distances) is None


def test_distances_are_scaled_by_roots_of_the_charge():
    gauge = Shaking("G", 1.0, 0.0, np.ones(3), None, False, 30.0, 8.0, 32.0)
    assert gauge.scaled_distance(0.5) == pytest.approx(32.0 / np.sqrt(8.0))
    assert gauge.scaled_distance(1.0 / 3.0) == pytest.approx(16.0)
    assert shaken(1.0).scaled_distance(0.5) is None


class Run:
    """What `shaking_of` asks of a run, with one gauge at (0, 0, 0)."""

    def __init__(self, velocity):
        from sazare.results import Gauge
        from sazare.tables import Table

        time = np.linspace(0.0, 1e-2, len(velocity))
        moved = np.stack([velocity, np.zeros_like(velocity), np.zeros_like(velocity)], axis=1)
        self.gauges = {"G": Gauge("G", time, moved)}
        row = {"ppv": 1.05 * np.abs(velocity).max(), "time": 1e-3, "point_x": 0.0, "point_y": 0.0, "point_z": 0.0}
        row |= {"peak_x": row["ppv"], "peak_y": 0.0, "peak_z": 0.0}
        self.gauge_peaks = Table({name: np.array([value]) for name, value in row.items()})


def test_peaks_are_those_of_the_run_and_not_of_the_rows():
    assert shaking_of(Run(np.sin(np.linspace(0.0, 3.0, 50))))[0].ppv == pytest.approx(1.05, rel=1e-3)


def test_a_gauge_that_is_as_fast_as_ever_at_the_end_is_marked():
    assert not shaking_of(Run(np.sin(np.linspace(0.0, 3.0, 50))))[0].rises
    assert shaking_of(Run(np.linspace(0.0, 1.0, 50)))[0].rises


def hole(x, delay, charge):
    return Hole(f"x = {x}", delay, np.array([x, 0.0, -5.0]), np.array([x, 0.0, 5.0]), 0.1, charge)


def test_holes_of_one_delay_count_together_and_the_strongest_delay_counts():
    # Fired together: 2 x 8 kg, the nearer 8 m away: 8 / 4 = 2. Alone: 100 kg at 30 m: 3.
    gauge = shaking_of(Run(np.sin(np.linspace(0.0, 3.0, 50))), [hole(8.0, 0.0, 8.0), hole(9.0, 0.0, 8.0), hole(30.0, 0.025, 100.0)])[0]
    assert gauge.distance == pytest.approx(8.0) and gauge.charge == pytest.approx(16.0)
    assert gauge.scaled_distance(0.5) == pytest.approx(2.0)


def test_distance_is_from_the_axis_or_its_nearer_end():
    one = hole(0.0, 0.0, None)
    assert one.distance(np.array([[3.0, 4.0, 1.0], [0.0, 3.0, 9.0]])) == pytest.approx([5.0, 5.0])
    which, distances = nearest([one, hole(10.0, 0.0, None)], np.array([[1.0, 0.0, 0.0], [9.0, 0.0, 0.0]]))
    assert list(which) == [0, 1] and distances == pytest.approx([1.0, 1.0])


# Limits


def test_limits_have_the_values_of_their_tables():
    # DIN 4150-3, table 1, at 1 to 10, 50 and 100 Hz [mm/s].
    for line, values in zip(LIMITS[:3], ((20, 20, 40, 50), (5, 5, 15, 20), (3, 3, 8, 10))):
        assert 1e3 * line.at([1.0, 10.0, 50.0, 100.0]) == pytest.approx(values)
        assert 1e3 * line.at([30.0]) == pytest.approx([0.5 * (values[1] + values[2])])
        assert np.isnan(line.at([0.5])[0]) and line.at([300.0]) == pytest.approx(line.at([100.0]))


def test_the_bureaus_limits_are_displacements_and_velocities():
    # RI 8507, appendix B: 0.030 in up to the plateau, 0.008 in from there to 2.0 in/s.
    drywall, plaster = LIMITS[3:]
    for limit, plateau in ((drywall, 0.75), (plaster, 0.50)):
        assert limit.at([2.0]) / INCH == pytest.approx([2.0 * np.pi * 2.0 * 0.030])
        assert limit.at([8.0]) / INCH == pytest.approx([plateau])
        assert limit.at([25.0]) / INCH == pytest.approx([2.0 * np.pi * 25.0 * 0.008])
        assert limit.at([60.0]) / INCH == pytest.approx([2.0])


# Damage


def ring_of_joints():
    """100 joints of 1 m2, 0.01 to 1 m from the axis, the nearer half broken and of the others none; they lie in the direction 30 degrees."""
    distances = np.arange(1, 101) / 100.0
    return Damage("H", distances, np.ones(100), distances <= 0.5, np.full(100, np.pi / 6.0), *across(np.array([0.0, 0.0, 1.0])))


def test_radii_of_damage_are_those_of_the_share_that_is_broken_there():
    # All joints are broken to 1 m, every second one of 1 m2 from there to 2 m, every tenth to 3 m.
    distances = np.linspace(0.001, 3.0, 3000)
    number = np.arange(3000)
    broken = (distances <= 1.0) | ((distances <= 2.0) & (number % 2 == 0)) | (number % 10 == 0)
    damage = Damage("H", distances, np.ones(3000), broken, np.zeros(3000), *across(np.array([0.0, 0.0, 1.0])))
    assert damage.radius(0.9) == pytest.approx(1.0, abs=0.01)
    assert damage.radius(0.4) == pytest.approx(2.0, abs=0.02) and damage.radius(0.09) == pytest.approx(3.0, abs=0.02)
    assert damage.radius(0.55) == damage.radius(0.9)


def test_damage_counts_areas_and_not_joints():
    # Beyond 0.5 m nine joints of ten are broken, which have a tenth of the area.
    distances = np.linspace(0.0, 1.0, 1001)
    thin = np.arange(1001) % 10 != 1
    damage = Damage("H", distances, np.where(thin, 1.0, 81.0), thin | (distances <= 0.5), np.zeros(1001), *across(np.array([0.0, 0.0, 1.0])))
    assert damage.radius(0.5) == pytest.approx(0.5, abs=0.02)
    assert damage.decrease[1][-1] == pytest.approx(0.1, abs=0.01)


def test_rings_of_damage_have_the_share_of_their_area():
    damage = ring_of_joints()
    assert damage.radius(0.9) == damage.radius(0.1) == 0.5
    edges, share = damage.rings(5)
    assert edges[-1] == pytest.approx(0.5) and share == pytest.approx(np.ones(5))


def test_broken_area_lies_in_its_direction():
    edges, area = ring_of_joints().by_direction(12)
    assert area.sum() == pytest.approx(50.0) and area[1] + area[0] == pytest.approx(50.0)
    assert edges[-1] == pytest.approx(2.0 * np.pi)


def test_a_hole_that_breaks_nothing_has_no_damage():
    whole = Damage("H", np.ones(3), np.ones(3), np.zeros(3, dtype=bool), np.zeros(3), *across(np.zeros(3)))
    assert whole.radius(0.1) == 0.0 and whole.rings() is None


@pytest.mark.parametrize("axis", [(0.0, 0.0, 1.0), (0.0, 0.0, -2.0), (1.0, 0.0, 0.0), (1.0, 2.0, 0.3), (0.0, 0.0, 0.0)])
def test_directions_across_an_axis_are_perpendicular(axis):
    right, up = across(np.array(axis))
    assert right @ up == pytest.approx(0.0) and np.linalg.norm(right) == pytest.approx(1.0) and np.linalg.norm(up) == pytest.approx(1.0)
    assert right @ axis == pytest.approx(0.0) and up @ axis == pytest.approx(0.0)


def test_directions_are_the_same_for_holes_that_lean_to_both_sides():
    left, right = (Hole("H", 0.0, np.zeros(3), np.array([side, 0.0, 2.0]), 0.1) for side in (-1.0, 1.0))
    turned = Hole("H", 0.0, np.array([1.0, 0.0, 2.0]), np.zeros(3), 0.1)
    for holes in ([left, right], [left, turned]):
        assert across(mean_axis(holes))[0] == pytest.approx([1.0, 0.0, 0.0])


def test_a_vertical_axis_is_seen_from_above():
    right, up = across(np.array([0.0, 0.0, 1.0]))
    assert right == pytest.approx([1.0, 0.0, 0.0]) and up == pytest.approx([0.0, 1.0, 0.0])
