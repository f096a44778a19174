"""Waves that come in at an angle, between free-field sides, beside the sum of all rays between the surface and what reflects them."""

import subprocess
import tempfile
import tomllib
from collections import defaultdict
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
ROCK = (2200.0, 200.0, 400.0)  # kg/m3, m/s, m/s
SOIL = (1800.0, 150.0, 300.0)
SOIL_SETTINGS = ("materials.1.density=1800", "materials.1.youngs_modulus=108e6")
PLANES = (
    ("sv-half-space", "sv", 20.0, False), ("sv-to-the-left", "sv", -10.0, False), ("p-half-space", "p", 40.0, False),
    ("sv-soil-on-rock", "sv", 20.0, True), ("p-soil-on-rock", "p", 30.0, True),
)
ROCK_HEIGHT, SOIL_HEIGHT, PEAK_TIME, FREQUENCY = 5.0, 5.0, 0.1, 10.0  # m, m, s, Hz


def wavelet(time):
    """Velocity [m/s] of the incident wave, of any shape."""
    z = (np.pi * FREQUENCY * (time - PEAK_TIME)) ** 2
    return np.where(time > 0, (2.0 * z - 1.0) * np.exp(-z), 0.0)


class Medium:
    """Plane waves of one horizontal slowness p [s/m] in an elastic medium: P, SV and SH, upwards (sign 1) or downwards (-1)."""

    def __init__(self, density, s_velocity, p_velocity, p):
        self.shear, self.lame = density * s_velocity**2, density * (p_velocity**2 - 2.0 * s_velocity**2)
        self.speed = np.array([p_velocity, s_velocity, s_velocity])
        self.vertical = np.sqrt(1.0 / self.speed**2 - p**2)  # s/m
        self.p = p

    def motion(self, sign):
        """Unit directions in columns (3, 3): along the wave, up for SV against it, and across both."""
        sine, cosine = self.p * self.speed, self.vertical * self.speed
        return np.array([[sine[0], cosine[1], 0.0], [0.0, 0.0, 1.0], [sign * cosine[0], -sign * sine[1], 0.0]])

    def traction(self, sign):
        """On a level plane, for waves of unit velocity [Pa s/m] (3, 3)."""
        motion, vertical = self.motion(sign), sign * self.vertical
        volume = self.p * motion[0] + vertical * motion[2]
        return -np.array([
            self.shear * (vertical * motion[0] + self.p * motion[2]),
            self.shear * vertical * motion[1],
            self.lame * volume + 2.0 * self.shear * vertical * motion[2],
        ])


def surface_reflection(medium):
    """Amplitudes that come down for unit ones that go up (3, 3)."""
    return -np.linalg.solve(medium.traction(-1), medium.traction(1))


def interface(below, above):
    """What goes on upwards and what comes back down of waves from below, and the same of waves from above: four (3, 3)."""
    both = lambda medium, sign: np.vstack([medium.motion(sign), medium.traction(sign) / below.shear])
    left = np.hstack([both(above, 1), -both(below, -1)])
    from_below = np.linalg.solve(left, both(below, 1))
    from_above = np.linalg.solve(left, -both(above, -1))
    return from_below[:3], from_below[3:], from_above[:3], from_above[3:]


def rays(medium, thickness, start, bottom, end):
    """All rays of a layer: (wave, sign, delay at the bottom or top where it sets out [s], amplitude). From what sets out at the
    bottom, `start` {(delay): amplitudes}, up and down again until `end`; `bottom` reflects from below."""
    top = surface_reflection(medium)
    way = thickness * medium.vertical
    found, coming = [], {round(delay, 12): np.array(value) for delay, value in start.items()}
    while coming:
        after = defaultdict(lambda: np.zeros(3))
        for delay, up in coming.items():
            for wave in range(3):
                if abs(up[wave]) < 1e-9:
                    continue
                found.append((wave, 1, delay, up[wave]))
                for other in range(3):
                    down = top[other, wave] * up[wave]
                    if abs(down) < 1e-9 or delay + way[wave] > end:
                        continue
                    found.append((other, -1, delay + way[wave], down))
                    back = round(delay + way[wave] + way[other], 12)
                    if bottom is not None and back < end:
                        after[back] += bottom[:, other] * down
        coming = after
    return found


def exact(time, kind, angle, height, layered):
    """Velocity (n, 3) along the wave, across and up, of a place at a height [m], with the time since the wave has reached the foot
    below it [s] (n,)."""
    number = ("p", "sv", "sh").index(kind)
    p = np.sin(np.radians(angle)) / ROCK[2 if kind == "p" else 1]
    rock, soil = Medium(*ROCK, p), Medium(*SOIL, p)
    incident = np.eye(3)[number]
    rise = ROCK_HEIGHT * rock.vertical[number]
    if not layered:
        return sum_of(rays(rock, ROCK_HEIGHT + SOIL_HEIGHT, {0.0: incident}, None, time.max()), rock, ROCK_HEIGHT + SOIL_HEIGHT, height, time)
    through, back, reflected, leaving = interface(rock, soil)
    inside = rays(soil, SOIL_HEIGHT, {rise: through @ incident}, reflected, time.max())
    if height >= ROCK_HEIGHT:
        return sum_of(inside, soil, SOIL_HEIGHT, height - ROCK_HEIGHT, time)
    below = [(number, 1, 0.0, 1.0)] + [(wave, -1, rise, amplitude) for wave, amplitude in enumerate(back @ incident)]
    for wave, sign, delay, amplitude in inside:
        if sign < 0:
            out = delay + SOIL_HEIGHT * soil.vertical[wave]
            below += [(other, -1, out, leaving[other, wave] * amplitude) for other in range(3)]
    return sum_of(below, rock, ROCK_HEIGHT, height, time)


def sum_of(found, medium, thickness, height, time):
    total = np.zeros((len(time), 3))
    for wave, sign, delay, amplitude in found:
        way = height if sign > 0 else thickness - height
        total += amplitude * wavelet(time - delay - way * medium.vertical[wave])[:, None] * medium.motion(sign)[:, wave]
    return total


def run(folder, case, *settings):
    command = [PROGRAM, "run", HERE / case, "--out", folder, "--overwrite", "--quiet"]
    subprocess.run(command + [word for one in settings for word in ("--set", one)], check=True)
    return sazare.open(folder)


def gauges(folder, results):
    """Places [m] and velocities [m/s] (n, 2 or 3) of all gauges, and times [s] (n,)."""
    table = results.gauge_table
    for gauge in tomllib.loads((Path(folder) / "case.toml").read_text(encoding="utf-8"))["gauges"]:
        velocity = [np.asarray(table[f"{gauge['name']}.velocity_{axis}"]) for axis in "xyz" if f"{gauge['name']}.velocity_{axis}" in table]
        yield gauge["point"], np.column_stack(velocity), np.asarray(table["time"])


def plane_error(folder, kind, angle, layered):
    """Largest error of any gauge over the peak of the incident wave."""
    results = run(folder, "plane.toml", f"incident_wave.kind={kind}", f"incident_wave.angle={angle}", *(SOIL_SETTINGS if layered else ()))
    p = np.sin(np.radians(angle)) / ROCK[2 if kind == "p" else 1]
    worst = 0.0
    for place, velocity, time in gauges(folder, results):
        delay = p * place[0] if angle > 0 else p * (place[0] - 40.0)
        right = exact(time - delay, kind, angle, place[1], layered)
        worst = max(worst, np.abs(velocity[:, :2] - right[:, [0, 2]]).max())
    return worst


def space_error(folder):
    results = run(folder, "space.toml")
    p, azimuth = np.sin(np.radians(30.0)) / ROCK[1], np.radians(30.0)
    along, across = np.array([np.cos(azimuth), np.sin(azimuth), 0.0]), np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    worst = 0.0
    for place, velocity, time in gauges(folder, results):
        right = exact(time - p * along @ place, "sh", 30.0, place[2], True)[:, [1]] * across
        worst = max(worst, np.abs(velocity - right).max())
    return worst


def slope(folder):
    """Largest difference of the velocity at toe and crest to that of ground three times as wide, over the largest there, and the
    residual of the energy balance over the work of the wave."""
    of = lambda width: run(
        folder / str(width), "plane.toml", f"mesh.parameters.width={width}", "mesh.parameters.hill=5", *SOIL_SETTINGS,
        f"gauges.3.point=[{width / 2 - 10},10,0]", f"gauges.4.point=[{width / 2 + 10},15,0]",
    )
    narrow, wide = of(40), of(120)
    late = np.sin(np.radians(20.0)) / ROCK[1] * 40.0  # s, from one toe to the other
    worst = largest = 0.0
    for (place, velocity, time), (_, other, _) in list(zip(gauges(folder / "40", narrow), gauges(folder / "120", wide), strict=True))[3:5]:
        for axis in range(2):
            shifted = np.interp(time + late, time, other[:, axis])
            known = time + late <= time[-1]
            worst = max(worst, np.abs(velocity[known, axis] - shifted[known]).max())
            largest = max(largest, np.abs(velocity[:, axis]).max())
    figures = narrow.figures
    return worst / largest, abs(figures["energy_residual"]) / figures["energy_work"]


def main():
    with tempfile.TemporaryDirectory() as made:
        folder = Path(made)
        for row, kind, angle, layered in PLANES:
            print(f"{row},{plane_error(folder / row, kind, angle, layered)}")
        print(f"sh-in-space,{space_error(folder / 'space')}")
        difference, residual = slope(folder)
        print(f"slope,{difference}")
        print(f"slope-energy,{residual}")


if __name__ == "__main__":
    main()
