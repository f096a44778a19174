"""Curves fitted to sizes of fragments and to vibration: Rosin-Rammler, Swebrec, and a power law with its confidence band."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

POINTS = 30  # of the curve to which size distributions are fitted, equally spaced in the logarithm of the size
LEAST_SIZES = 5
LEAST_SPAN = 2.0  # largest over smallest
MOST_LARGEST = 3.0  # x_max of Swebrec over the largest fragment; a curve that is far from its end would have any


@dataclass(frozen=True)
class SizeFit:
    """A size distribution fitted to another one between two sizes [m].

    parameters: by name. passing: the share of the mass (0 to 1) that passes sizes [m]. r2: coefficient of determination of that share. worst: largest
    difference of the share from the fitted one.
    """

    name: str
    parameters: dict[str, float]
    passing: Callable[[np.ndarray], np.ndarray]
    lower: float
    upper: float
    r2: float
    worst: float


def rosin_rammler(size, characteristic, uniformity):
    """Share that passes a size: 1 - exp(-(x / x_c)^n) (Rosin and Rammler, 1933, J. Inst. Fuel 7, 29-36)."""
    return 1.0 - np.exp(-((size / characteristic) ** uniformity))


def swebrec(size, largest, median, undulation):
    """Share that passes a size: 1 / (1 + (ln(x_max / x) / ln(x_max / x_50))^b), 1 from x_max on (Ouchterlony, 2005, Mining Technology 114, A29-A44)."""
    ratio = np.log(np.maximum(largest / size, 1.0)) / np.log(largest / median)
    return 1.0 / (1.0 + ratio**undulation)


def size_fits(distribution):
    """The SizeFits of a Distribution over the range that its mesh can see, Rosin-Rammler first; none where fewer than five sizes, or less than a factor of
    two, lie beyond the limit of the mesh."""
    seen = distribution.sizes[distribution.sizes > distribution.mesh_limit]
    if len(np.unique(seen)) < LEAST_SIZES or seen[-1] < LEAST_SPAN * seen[0]:
        return []
    sizes = np.geomspace(seen[0], seen[-1], POINTS)
    shares = distribution.passing(sizes)
    median = distribution.size_at(0.5)
    largest = distribution.sizes[-1]
    return [
        _fit("Rosin-Rammler", rosin_rammler, {"x_c": (median, 0.0, np.inf), "n": (1.0, 0.05, 20.0)}, sizes, shares),
        _fit(
            "Swebrec", swebrec,
            {"x_max": (1.2 * largest, largest, MOST_LARGEST * largest), "x_50": (min(median, 0.9 * largest), 0.0, 0.999 * largest), "b": (2.0, 0.2, 20.0)},
            sizes, shares,
        ),
    ]


def _fit(name, law, unknowns, sizes, shares):
    """The SizeFit of a law; unknowns: name -> (first guess, least, most)."""
    from scipy.optimize import curve_fit  # here, since it takes long to load

    guess, least, most = zip(*unknowns.values())
    found, _ = curve_fit(law, sizes, shares, p0=guess, bounds=(least, most), max_nfev=10000)
    off = law(sizes, *found) - shares
    spread = np.sum((shares - shares.mean()) ** 2)
    return SizeFit(
        name, dict(zip(unknowns, map(float, found))), lambda size: law(np.asarray(size, dtype=float), *found), float(sizes[0]), float(sizes[-1]),
        float(1.0 - np.sum(off**2) / spread) if spread > 0.0 else float("nan"), float(np.abs(off).max()),
    )


@dataclass(frozen=True)
class PowerLaw:
    """y = factor x^exponent, by least squares of the logarithms of n points, and what is needed for its bands."""

    factor: float
    exponent: float
    r2: float
    points: int
    mean_log: float  # of x
    spread_log: float  # sum of squares of ln x about it
    deviation: float  # standard deviation of ln y from the line

    def at(self, x):
        """y at x (n,)."""
        return self.factor * np.asarray(x, dtype=float) ** self.exponent

    def confidence(self, x, level=0.95):
        """Lower and upper bound at x (n,) between which the line lies with a probability."""
        return self._band(x, level, 0.0)

    def prediction(self, x, level=0.95):
        """Lower and upper bound at x (n,) between which a further point lies with a probability."""
        return self._band(x, level, 1.0)

    def _band(self, x, level, of_a_point):
        from scipy.special import stdtrit  # here, since it takes long to load

        away = (np.log(x) - self.mean_log) ** 2 / self.spread_log
        half = stdtrit(self.points - 2, 0.5 + 0.5 * level) * self.deviation * np.sqrt(of_a_point + 1.0 / self.points + away)
        return self.at(x) * np.exp(-half), self.at(x) * np.exp(half)


def power_law(x, y):
    """The PowerLaw through points x (n,), y (n,), all above 0; None for fewer than three, or for one x alone.

    Linear regression of ln y on ln x; bands by Student's distribution with n - 2 degrees of freedom (Draper and Smith, 1998, Applied Regression Analysis,
    sections 1.4 and 3.1).
    """
    log_x, log_y = np.log(np.asarray(x, dtype=float)), np.log(np.asarray(y, dtype=float))
    away = log_x - log_x.mean() if len(log_x) else log_x
    spread = float(np.sum(away**2))
    if len(log_x) < 3 or spread < 1e-12:
        return None
    exponent = float(np.sum(away * log_y) / spread)
    factor = float(np.exp(log_y.mean() - exponent * log_x.mean()))
    off = log_y - np.log(factor) - exponent * log_x
    whole = float(np.sum((log_y - log_y.mean()) ** 2))
    r2 = 1.0 - float(np.sum(off**2)) / whole if whole > 0.0 else float("nan")
    return PowerLaw(factor, exponent, r2, len(log_x), float(log_x.mean()), spread, float(np.sqrt(np.sum(off**2) / (len(log_x) - 2))))
