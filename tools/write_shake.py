"""Writes a record of a shaking table: rest, then five waves of 2 Hz and 500 gal between a wave that grows and one that dies away, then rest.

    python tools/write_shake.py SECONDS_OF_REST FILE
"""

import math
import sys

STEP, END = 0.005, 5.0
REST, FILE = float(sys.argv[1]), sys.argv[2]
FREQUENCY, PEAK, WAVES = 2.0, 5.0, 5


def envelope(cycles):
    """Share of the full amplitude, and its first and second derivative by cycles."""
    total = WAVES + 2
    if cycles <= 0 or cycles >= total:
        return 0.0, 0.0, 0.0
    side = min(cycles, total - cycles)
    sign = 1.0 if cycles < 0.5 * total else -1.0
    if side >= 1:
        return 1.0, 0.0, 0.0
    angle = math.pi * side
    return 0.5 - 0.5 * math.cos(angle), sign * 0.5 * math.pi * math.sin(angle), 0.5 * math.pi**2 * math.cos(angle)


def acceleration(time):
    """Second derivative of the displacement envelope times sine."""
    cycles = FREQUENCY * (time - REST)
    share, slope, bend = envelope(cycles)
    turn = 2 * math.pi
    sine, cosine = math.sin(turn * cycles), math.cos(turn * cycles)
    return PEAK / turn**2 * (share * turn**2 * sine - 2 * slope * turn * cosine - bend * sine)


with open(FILE, "w", encoding="utf-8") as file:
    file.write("time [s],acceleration [m/s2]\n")
    for row in range(round(END / STEP) + 1):
        file.write(f"{row * STEP:.3f},{acceleration(row * STEP):.6f}\n")
