"""Waves that enter a bar through absorbing faces."""

import numpy as np


def incident_velocity(stress, density, young, poisson):
    """Velocity [m/s] of the incident wave at absorbing faces for a stress of compression in a bar [Pa].

    density [kg/m3], young: Young's modulus [Pa], poisson: Poisson's ratio. The faces' dashpots are those of the plane P wave of the whole
    solid, which is faster than the wave of a bar: rho c_P (2 v - u) = rho c u with the velocity u of the bar behind the wave."""
    bar_speed = np.sqrt(young / density)
    solid_speed = bar_speed * np.sqrt((1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)))
    return stress / (density * bar_speed) * (bar_speed + solid_speed) / (2.0 * solid_speed)
