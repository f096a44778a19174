"""Intervals of rows and snapshots that fit round times."""

import math


def round_interval(most):
    """The largest of 1, 2 and 5 times a power of ten that is not more than `most`."""
    unit = 10.0 ** math.floor(math.log10(most) + 1e-12)
    digit = max(digit for digit in (1, 2, 5) if digit * unit <= most * (1.0 + 1e-9))
    return float(f"{digit * unit:.1g}")


def rounded_up(value, digits):
    """A number with so many digits that is not less."""
    unit = 10.0 ** (math.floor(math.log10(value)) - digits + 1)
    return float(f"{unit * math.ceil(value / unit - 1e-9):.{digits}g}")


def round_end(least, pictures):
    """An end that is not less than `least`, and the round interval of at least so many snapshots of which it is a whole number."""
    interval = round_interval(least / pictures)
    count = math.ceil(least / interval - 1e-9)
    return float(f"{count * interval:.12g}"), interval


def fits(interval, end):
    """Whether an end is a whole number of intervals."""
    return abs(end / interval - round(end / interval)) < 1e-9
