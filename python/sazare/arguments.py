"""Numbers that a command line may give, each as a type of argparse."""

import argparse
import math


def number(text):
    """A finite number."""
    value = float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"must be a finite number, found {text}")
    return value


def positive(text):
    """A finite number above 0."""
    value = float(text)
    if not (math.isfinite(value) and value > 0.0):
        raise argparse.ArgumentTypeError(f"must be a finite number above 0, found {text}")
    return value


def not_negative(text):
    """A finite number of 0 or more."""
    value = float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise argparse.ArgumentTypeError(f"must be a finite number of 0 or more, found {text}")
    return value


def whole(least, most):
    """A whole number between two bounds, which belong to it."""

    def whole_number(text):
        if not (text.isdigit() and least <= int(text) <= most):
            raise argparse.ArgumentTypeError(f"must be a whole number from {least} to {most}, found {text}")
        return int(text)

    return whole_number
