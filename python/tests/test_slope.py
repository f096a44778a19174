"""Limit equilibrium and Newmark's block against closed forms."""

import numpy as np
import pytest

from sazare import slope


@pytest.mark.parametrize(("angle", "friction", "number"), [(60.0, 0.0, 0.191), (45.0, 10.0, 0.108), (30.0, 10.0, 0.075)])
def test_safety_factor_is_that_of_taylors_chart(angle, friction, number):
    # c/(gamma H) at which a slope just stands: Taylor, J. Boston Soc. Civil Engrs. 24 (1937), table 1.
    height, density = 10.0, 2000.0
    ground = slope.Slope(height, angle, number * density * slope.GRAVITY * height, friction, density)
    assert slope.safety_factor(ground)[0] == pytest.approx(1.0, rel=0.02)


def test_shaking_makes_a_slope_less_safe_until_it_yields():
    ground = slope.Slope(height=12.0, angle=45.0, cohesion=15e3, friction_angle=30.0, density=1800.0)
    still, shaken = slope.safety_factor(ground)[0], slope.safety_factor(ground, seismic=0.1)[0]
    assert shaken < still
    coefficient = slope.yield_coefficient(ground)
    assert slope.safety_factor(ground, seismic=coefficient)[0] == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize("step", [0.1, 0.02])
def test_block_on_a_pulse_slides_as_the_closed_form_says(step):
    # A = 6 m/s2 for 0.4 s, held back by N = 1.5 m/s2: V^2 (A - N)/(2 A N), V = A t.
    count = round(0.4 / step)
    pulse = np.r_[np.full(count, 6.0), np.zeros(10 * count)]
    assert slope.sliding_block(pulse, step, 1.5) == pytest.approx((6.0 * 0.4) ** 2 * (6.0 - 1.5) / (2 * 6.0 * 1.5))


def test_block_stays_below_its_yield_acceleration():
    assert slope.sliding_block(np.full(100, 1.4), 0.01, 1.5) == 0.0
