"""Flight without drag in closed form."""

import numpy as np


def flight_times(height, velocity, gravity):
    """Times [s] (n,) after which bodies that start at heights [m] (n,) above the ground with velocities (n, 3) [m/s] are on it; 0 for those under it."""
    up = velocity[:, 2]
    return np.where(height > 0.0, (up + np.sqrt(up**2 + 2.0 * gravity * np.maximum(height, 0.0))) / gravity, 0.0)


def ranges(height, velocity, gravity):
    """Horizontal distances [m] (n,) that they fly until then."""
    return np.linalg.norm(velocity[:, :2], axis=1) * flight_times(height, velocity, gravity)


def landing_speeds(height, velocity, gravity):
    """Speeds [m/s] (n,) with which they land, or start where that is more."""
    return np.sqrt(np.sum(velocity**2, axis=1) + 2.0 * gravity * np.maximum(height, 0.0))
