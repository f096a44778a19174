"""Spheres and blocks in water: sinking, floating, sliding on the bed, and in waves, against closed forms."""

import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import sazare

GRAVITY, WATER = 9.81, 1000.0  # m/s2, kg/m3
CASE = """
[case]
title = "{title}"
method = "spheres"
[[materials]]
name = "body"
density = {density}
youngs_modulus = 1e8
poisson_ratio = 0.2
[contact]
restitution = 0.2
friction_coefficient = {friction}
[[spheres]]
name = "body"
material = "body"
{body}
[gravity]
acceleration = [0.0, 0.0, -9.81]
[[gauges]]
name = "body"
group = "body"
[time]
end = {end}
history_interval = {interval}
step = {step}
{more}
"""


def run(title, body, end, step, interval, density=2650.0, friction=0.5, more=""):
    """The gauges of a run as arrays by name, and its figures."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.toml"
        path.write_text(CASE.format(title=title, density=density, friction=friction, body=body, end=end, step=step, interval=interval, more=more))
        results = sazare.run(path, Path(folder) / "run", progress=False)
        table = results.gauge_table
        return {name.removeprefix("body."): np.asarray(table[name]) for name in table}, results.figures


def ball(radius, centre=(0.0, 0.0, -100.0), more=""):
    return f'source = "one"\nradius = {radius}\ncentre = [{centre[0]}, {centre[1]}, {centre[2]}]\n{more}'


def water(more=""):
    return f"[water]\nlevel = 0.0\n{more}"


def sinking():
    radius, drag, density = 0.1, 0.44, 2650.0
    found, figures = run("Sinking", ball(radius), 3.0, 1e-3, 0.01, more=water(f"drag_coefficient = {drag}"))
    volume, area = 4.0 / 3.0 * np.pi * radius**3, np.pi * radius**2
    weight = (density - WATER) * volume * GRAVITY
    steady = np.sqrt(weight / (0.5 * WATER * drag * area))
    delay = (density + 0.5 * WATER) * volume * steady / weight
    exact = -steady * np.tanh(found["time"] / delay)
    print(f"sinking,{np.max(np.abs(found['velocity_z'] - exact)) / steady}")
    print(f"sinking-energy,{abs(figures['energy_residual']) / figures['energy_work']}")


def grain():
    """The velocity of a grain of sand of 1 mm, from the balance of weight and drag solved on its own."""
    radius, density, viscosity = 5e-4, 2650.0, 1e-3
    found, _ = run("Grain", ball(radius), 0.5, 2.5e-6, 0.01, more=water())

    def balance(speed):
        reynolds = WATER * speed * 2.0 * radius / viscosity
        drag = max(24.0 / reynolds * (1.0 + 0.15 * reynolds**0.687), 0.44)
        return drag * 0.5 * WATER * np.pi * radius**2 * speed**2 - (density - WATER) * 4.0 / 3.0 * np.pi * radius**3 * GRAVITY

    print(f"grain,{-found['velocity_z'][-1] / brentq(balance, 1e-6, 10.0)}")


def buoy():
    """Half-submerged ball that is let go 1 mm off its place, without drag."""
    radius, away = 0.2, 1e-3
    found, _ = run("Buoy", ball(radius, (0.0, 0.0, away)), 9.0, 1e-3, 1e-3, density=500.0, more=water("drag_coefficient = 0.0"))
    time, height = found["time"], found["position_z"]
    up = np.flatnonzero((height[:-1] < 0.0) & (height[1:] >= 0.0))
    crossings = time[up] - height[up] * (time[up + 1] - time[up]) / (height[up + 1] - height[up])
    volume = 4.0 / 3.0 * np.pi * radius**3
    mass = 500.0 * volume + 0.5 * WATER * volume / 2.0
    exact = 2.0 * np.pi * np.sqrt(mass / (WATER * GRAVITY * np.pi * radius**2))
    print(f"buoy,{np.mean(np.diff(crossings)) / exact}")


def block(folder):
    """Four balls side by side, which do not roll."""
    path = Path(folder) / "block.csv"
    path.write_text("0.05 -0.06 -0.06 0\n0.05 0.06 -0.06 0\n0.05 -0.06 0.06 0\n0.05 0.06 0.06 0\n0.05 0 0 0\n")
    return f'[[shapes]]\nname = "block"\nsource = "file"\nfile = "{path}"\n'


def slid(share, end=2.0, friction=0.5, drag=1.0, density=2650.0):
    """How far a block on the bed slides in a current whose drag is this share of friction, and how far it should [m]."""
    with tempfile.TemporaryDirectory() as folder:
        shape = block(folder)
        body = 'source = "one"\nshape = "block"\ncentre = [0.0, 0.0, 0.05]\n'
        volume = block_volume(shape, body)
        factor = 0.5 * WATER * drag * np.pi * (0.75 * volume / np.pi) ** (2.0 / 3.0)
        least = np.sqrt(friction * (density - WATER) * volume * GRAVITY / factor)
        speed = np.sqrt(share) * least
        bed = '[[walls]]\nname = "bed"\nmaterial = "body"\npoint = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]\n'
        more = bed + shape + f"[water]\nlevel = 2.0\ndrag_coefficient = {drag}\ncurrent = [{speed}, 0.0, 0.0]\n"
        found, _ = run("Block on the bed", body, end, 2e-5, 0.05, friction=friction, more=more)
    # The current relative to the block falls to `least`: w = least coth(rate t + c).
    rate = factor * least / ((density + 0.5 * WATER) * volume)
    start = np.arctanh(least / speed) if speed > least else np.inf
    exact = speed * end - least / rate * np.log(np.sinh(rate * end + start) / np.sinh(start)) if speed > least else 0.0
    return found["position_x"][-1], exact


def block_volume(shape, body):
    """From the weight of a block of density 1 [m3]."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "case.toml"
        path.write_text(CASE.format(title="volume", density=1.0, friction=0.5, body=body, end=1e-5, step=1e-5, interval=1e-5, more=shape))
        weight = sazare.run(path, Path(folder) / "run", progress=False)
        return float(weight.history["energy_potential"][0]) / (GRAVITY * 0.05)


def airy(height, period, depth, time, z):
    """Horizontal and vertical velocity and acceleration of an Airy wave at x = 0, without stretching, from its potential."""
    omega = 2.0 * np.pi / period
    k = brentq(lambda k: GRAVITY * k * np.tanh(k * depth) - omega**2, 1e-6, 1e3)
    cosh, sinh = (f(k * (z + depth)) / np.sinh(k * depth) for f in (np.cosh, np.sinh))
    a = 0.5 * height * omega
    u, w = a * cosh * np.cos(omega * time), -a * sinh * np.sin(omega * time)
    return np.array([u, w]), omega * np.array([-a * cosh * np.sin(omega * time), -a * sinh * np.cos(omega * time)])


WAVE = 'waves = "airy"\nbed = -10.0\nwave_height = {height}\nwave_period = 5.0\n'


def held_in_waves():
    """Force on a ball that is held: Morison's equation worked out here. The wave is so low that stretching is of no account."""
    height, radius, drag, inertia, z = 0.01, 0.1, 1.2, 2.0, -2.0
    more = water(f"drag_coefficient = {drag}\ninertia_coefficient = {inertia}\n" + WAVE.format(height=height))
    found, _ = run("Held in waves", ball(radius, (0.0, 0.0, z), "held = true"), 10.0, 5e-4, 0.05, more=more)
    velocity, acceleration = airy(height, 5.0, 10.0, found["time"], z)
    volume = 4.0 / 3.0 * np.pi * radius**3
    exact = WATER * volume * inertia * acceleration + 0.5 * WATER * drag * np.pi * radius**2 * np.linalg.norm(velocity, axis=0) * velocity
    exact[1] += WATER * volume * GRAVITY
    force = np.array([found["force_x"], found["force_z"]])
    print(f"held-in-waves,{np.max(np.abs(force - exact)[0]) / np.max(np.abs(exact[0]))}")


def adrift_in_waves():
    """A ball as heavy as water goes round with it."""
    height, z = 0.02, -2.0
    more = water("drag_coefficient = 0.5\n" + WAVE.format(height=height))
    velocity, _ = airy(height, 5.0, 10.0, np.array([0.0]), z)
    found, _ = run("Adrift", ball(0.1, (0.0, 0.0, z), f"velocity = [{velocity[0][0]}, 0.0, {velocity[1][0]}]"), 5.0, 5e-4, 0.05, density=WATER, more=more)
    exact = airy(height, 5.0, 10.0, found["time"], z)[0]
    print(f"adrift,{np.max(np.abs(found['velocity_x'] - exact[0])) / np.max(np.abs(exact[0]))}")


def main():
    sinking()
    grain()
    buoy()
    print(f"rests,{abs(slid(0.95)[0])}")
    way, exact = slid(1.5)
    print(f"slides,{way / exact}")
    held_in_waves()
    adrift_in_waves()


if __name__ == "__main__":
    main()
