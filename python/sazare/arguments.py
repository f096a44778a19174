"""The parser of command lines, and numbers that they may give, each as a type of argparse."""

import argparse
import math
import re
import sys

NEGATIVE = re.compile(r"^-(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?$|^-(inf|nan)$", re.IGNORECASE)


class Parser(argparse.ArgumentParser):
    """A parser whose errors are one line, and where the options are shown; a negative number such as -5e6 is the value of an option."""

    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self._negative_number_matcher = NEGATIVE  # argparse knows none with an exponent

    def parse_args(self, args=None, namespace=None):
        """As argparse, but what is unknown is told as of the command that it was given to."""
        chosen, rest = self.parse_known_args(args, namespace)
        if rest:
            self._end(f"unrecognized arguments: {' '.join(rest)}", " ".join([self.prog, *(vars(chosen)[name] for name in ("command", "test") if vars(chosen).get(name))]))
        return chosen

    def error(self, message):
        """Ends the command with an error of the user."""
        self._end(message, self.prog)

    def exit(self, status=0, message=None):
        """As argparse, but what --help prints is written before, so that a full disk is an error that can be told."""
        sys.stdout.flush()
        super().exit(status, message)

    def _end(self, message, command):
        self.exit(2, f"error: {message}\n      help: {command} --help shows the options\n")


def _float(text):
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number, found {text!r}") from None


def number(text):
    """A finite number."""
    value = _float(text)
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"must be a finite number, found {text}")
    return value


def positive(text):
    """A finite number above 0."""
    value = _float(text)
    if not (math.isfinite(value) and value > 0.0):
        raise argparse.ArgumentTypeError(f"must be a finite number above 0, found {text}")
    return value


def not_negative(text):
    """A finite number of 0 or more."""
    value = _float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise argparse.ArgumentTypeError(f"must be a finite number of 0 or more, found {text}")
    return value


def within(least, most, unit, *, above=False, factors=()):
    """A number from `least` to `most`, which belong to it, in a unit; `above`: 0 as well though it is less than `least`. factors: between the unit and those that are
    taken for it, such as 1e-6 where somebody writes Pa for MPa; the number that was meant is asked for."""

    def number_within(text):
        value = _float(text)
        if least <= value <= most or (above and value == 0.0):
            return value
        meant = [factor * value for factor in factors if least <= factor * value <= most]
        question = f"; did you mean {meant[0]:g}?" if meant else ""
        raise argparse.ArgumentTypeError(f"must be {'0, or ' if above else ''}{least:g} to {most:g}{f' {unit}' if unit else ''}, found {text}{question}")

    return number_within


def length(most, least=1e-6):
    """A length [m] that is not that in mm."""
    return within(least, most, "m", factors=(1e-3,))


def whole(least, most):
    """A whole number between two bounds, which belong to it."""

    def whole_number(text):
        if not (text.isdigit() and least <= int(text) <= most):
            raise argparse.ArgumentTypeError(f"must be a whole number from {least} to {most}, found {text}")
        return int(text)

    return whole_number
