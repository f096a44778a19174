"""Laws of the size of joints: the diameters of discs, between two bounds."""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

PARAMETERS = {
    "constant": ("diameter",), "exponential": ("diameter",), "lognormal": ("diameter", "deviation"), "power": ("exponent", "diameter_min", "diameter_max"),
}  # by the name of a law, what it cannot do without
SHARE_BELOW = 0.999  # of the discs of a law without an upper bound, which are smaller than the bound that it is given


@dataclass(frozen=True)
class SizeLaw:
    """Diameters of discs [m]; bounds cut the law off, so that its mean differs a little from `diameter`.

    constant: diameter. exponential: mean diameter. lognormal: mean diameter and standard deviation. power: density proportional to d^-exponent between the
    bounds, all before the cut.
    """

    name: str
    diameter: float | None = None  # mean [m]
    deviation: float | None = None  # m
    exponent: float | None = None
    diameter_min: float = 0.0  # m
    diameter_max: float | None = None  # m

    @property
    def largest(self):
        """The upper bound [m]: that given, or the diameter below which 99.9 % of the discs are."""
        if self.name == "constant":
            return self.diameter
        return self.diameter_max if self.diameter_max is not None else float(self._quantile(SHARE_BELOW))

    @property
    def mean(self):
        """Mean diameter between the bounds [m]."""
        return self._moment(1) / self._moment(0)

    @property
    def mean_area(self):
        """Mean area of a disc [m2]."""
        return 0.25 * math.pi * self._moment(2) / self._moment(0)

    def sample(self, shares):
        """Diameters [m] below which are given shares (n,) in 0..1 of the discs between the bounds."""
        if self.name == "constant":
            return np.full(len(shares), self.diameter)
        low, high = self.diameter_min, self.largest
        if self.name == "power":
            rest = 1.0 - self.exponent
            if abs(rest) < 1e-12:
                return low * (high / low) ** shares
            return (low**rest + shares * (high**rest - low**rest)) ** (1.0 / rest)
        below, above = self._below(low), self._below(high)
        return np.clip(self._quantile(below + shares * (above - below)), low, high)

    @property
    def _log(self):
        """Mean and standard deviation of the logarithm of lognormal diameters in m."""
        spread = math.sqrt(math.log1p((self.deviation / self.diameter) ** 2))
        return math.log(self.diameter) - 0.5 * spread**2, spread

    def _below(self, diameter):
        """Share of discs that are smaller, without bounds."""
        if self.name == "exponential":
            return -math.expm1(-diameter / self.diameter)
        middle, spread = self._log
        return float(ndtr((math.log(diameter) - middle) / spread)) if diameter > 0.0 else 0.0

    def _quantile(self, share):
        if self.name == "exponential":
            return -self.diameter * np.log1p(-np.asarray(share))
        middle, spread = self._log
        return np.exp(middle + spread * ndtri(share))

    def _moment(self, order):
        """Integral of d^order times the density without bounds, from one bound to the other; of the power law without its factor."""
        low, high = self.diameter_min, self.largest
        if self.name == "constant":
            return self.diameter**order
        if self.name == "power":
            power = order + 1.0 - self.exponent
            return math.log(high / low) if abs(power) < 1e-12 else (high**power - low**power) / power
        if self.name == "exponential":
            parts = [math.exp(-d / self.diameter) * sum(math.perm(order, k) * self.diameter**k * d ** (order - k) for k in range(order + 1)) for d in (low, high)]
            return parts[0] - parts[1]
        middle, spread = self._log
        ends = [ndtr((math.log(d) - middle) / spread - order * spread) if d > 0.0 else 0.0 for d in (low, high)]
        return float(math.exp(order * middle + 0.5 * (order * spread) ** 2) * (ends[1] - ends[0]))
