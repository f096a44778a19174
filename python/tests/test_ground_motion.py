"""Spectra and figures of records against closed forms, independent solvers and published values; corrections and scaling."""

import re
import warnings
from pathlib import Path

import numpy as np
import pytest
from scipy import signal

import sazare
import sazare.ground_motion as ground_motion
from sazare.ground_motion import GRAVITY, Record, response_spectrum
from sazare.ground_motion.intensity import FIGURES

CASES = Path(__file__).resolve().parents[2] / "cases"
CENTRO = CASES / "soil-column-el-centro/el-centro-1940-ns.AT2"
INCH, FOOT = 0.0254, 0.3048


@pytest.fixture(scope="module")
def centro():
    return ground_motion.read_record(CENTRO)


def sine(amplitude, frequency, cycles, step):
    """A record of whole cycles of a sine."""
    time = step * np.arange(round(cycles / frequency / step) + 1)
    return Record(step, amplitude * np.sin(2.0 * np.pi * frequency * time), "sine")


def pulse(area, step=1e-3, duration=4.0):
    """A triangle of two steps, which is an impulse to slow oscillators."""
    acceleration = np.zeros(round(duration / step) + 1)
    acceleration[1] = area / step
    return Record(step, acceleration, "pulse")


# Response spectra


@pytest.mark.parametrize("damping", [0.02, 0.05, 0.2])
def test_resonance_grows_to_the_static_response_over_twice_the_damping(damping):
    record = sine(2.0, 1.0, 100, 2e-3)
    spectrum = response_spectrum(record, [1.0], damping)
    largest = 2.0 / (2.0 * np.pi) ** 2 / (2.0 * damping)
    reached = 1.0 - np.exp(-damping * 2.0 * np.pi * 100.0)
    assert spectrum.displacement[0] == pytest.approx(largest * reached, rel=1e-4)
    assert spectrum.velocity[0] == pytest.approx(largest * reached * 2.0 * np.pi, rel=1e-4)
    assert spectrum.absolute_acceleration[0] == pytest.approx(2.0 * reached / (2.0 * damping) * np.sqrt(1.0 + 4.0 * damping**2), rel=1e-3)


def test_an_undamped_oscillator_under_a_sine_beats_as_the_closed_form():
    record, w, load = sine(1.0, 1.0, 10, 1e-3), 2.0 * np.pi / 0.7, 2.0 * np.pi
    time = np.linspace(0.0, 10.0, 200001)
    exact = np.abs(np.sin(load * time) - load / w * np.sin(w * time)).max() / (w**2 - load**2)
    assert response_spectrum(record, [0.7], 0.0).displacement[0] == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("damping", [0.0, 0.05, 0.3])
def test_an_impulse_gives_its_velocity(damping):
    spectrum = response_spectrum(pulse(0.5), [1.0, 2.0], damping)
    lag = np.exp(-damping / np.sqrt(1.0 - damping**2) * np.arccos(damping))
    assert spectrum.pseudo_velocity == pytest.approx([0.5 * lag] * 2, rel=3e-3)
    assert spectrum.velocity == pytest.approx([0.5] * 2, rel=1e-2)


def test_a_step_doubles_the_static_response_and_overdamping_takes_that_away():
    record = Record(0.01, np.full(1001, 3.0), "step")
    static = 3.0 / (2.0 * np.pi) ** 2
    assert response_spectrum(record, [1.0], 0.0).displacement[0] == pytest.approx(2.0 * static, rel=2e-3)
    for damping in (1.0, 2.0):
        assert response_spectrum(record, [1.0], damping).displacement[0] == pytest.approx(static, rel=1e-5)


def test_a_rigid_oscillator_follows_the_ground_and_a_slack_one_stays_where_it_was(centro):
    rigid = response_spectrum(centro, [1e-3], 0.05)
    assert rigid.pseudo_acceleration[0] == pytest.approx(ground_motion.peak_acceleration(centro), rel=1e-3)
    with pytest.warns(UserWarning, match="less than the longest period"):
        slack = response_spectrum(centro, [3000.0], 0.0)
    assert slack.displacement[0] == pytest.approx(ground_motion.peak_displacement(centro), rel=1e-3)


@pytest.mark.parametrize("damping", [0.0, 0.05, 1.5])
def test_spectra_are_those_of_the_solver_of_scipy(centro, damping):
    fine = ground_motion.resample(centro, 0.001)
    periods = np.array([0.1, 0.3, 1.0, 3.0])
    spectrum = response_spectrum(centro, periods, damping)
    for number, w in enumerate(2.0 * np.pi / periods):
        system = signal.StateSpace([[0.0, 1.0], [-(w**2), -2.0 * damping * w]], [[0.0], [-1.0]], [[1.0, 0.0], [0.0, 1.0]], [[0.0], [0.0]])
        _, states, _ = signal.lsim(system, fine.acceleration, fine.time)
        total = w**2 * states[:, 0] + 2.0 * damping * w * states[:, 1]
        peaks = np.abs(states[:, 0]).max(), np.abs(states[:, 1]).max(), np.abs(total).max()
        ours = spectrum.displacement[number], spectrum.velocity[number], spectrum.absolute_acceleration[number]
        assert ours == pytest.approx(peaks, rel=3e-3)


def test_spectra_and_figures_are_those_of_eqsig(centro):
    # It has no wheel, so `make setup` leaves it out: pip install eqsig, and the comparison is made.
    eqsig = pytest.importorskip("eqsig", reason="eqsig is not installed")

    fine = ground_motion.resample(centro, 0.001)  # eqsig looks at samples alone, and sums squares of them
    periods = np.geomspace(0.05, 8.0, 30)
    displacement, velocity, acceleration = eqsig.sdof.pseudo_response_spectra(fine.acceleration, fine.step, periods, 0.05)
    spectrum = response_spectrum(centro, periods, 0.05)
    assert spectrum.displacement == pytest.approx(displacement, rel=3e-3)
    assert spectrum.pseudo_velocity == pytest.approx(velocity, rel=3e-3)
    assert spectrum.pseudo_acceleration == pytest.approx(acceleration, rel=3e-3)
    theirs = eqsig.AccSignal(fine.acceleration, fine.step)
    assert ground_motion.peak_velocity(centro) == pytest.approx(theirs.pgv, rel=1e-3)
    assert ground_motion.peak_displacement(centro) == pytest.approx(theirs.pgd, rel=1e-3)
    arias = eqsig.im.calc_arias_intensity(theirs)[-1] * 9.81 / GRAVITY
    assert ground_motion.arias_intensity(centro) == pytest.approx(arias, rel=1e-3)
    assert ground_motion.cumulative_absolute_velocity(centro) == pytest.approx(eqsig.im.calc_cav(theirs)[-1], rel=1e-3)
    assert ground_motion.significant_duration(centro) == pytest.approx(eqsig.im.calc_sig_dur_vals(fine.acceleration, fine.step), abs=0.05)


def test_shorter_steps_on_the_same_lines_change_nothing(centro):
    fine, periods = ground_motion.resample(centro, 0.004), np.geomspace(0.02, 10.0, 40)
    coarse, dense = response_spectrum(centro, periods), response_spectrum(fine, periods)
    assert dense.displacement == pytest.approx(coarse.displacement, rel=4e-3)
    before, after = ground_motion.figures(centro), ground_motion.figures(fine)
    for name in ("peak_acceleration", "peak_velocity", "arias_intensity", "cumulative_absolute_velocity"):
        assert after[name] == pytest.approx(before[name], rel=1e-9), name
    for name in FIGURES:
        # The discrete Fourier transform is that of the samples, and lines between them hold less of the highest frequencies.
        assert after[name] == pytest.approx(before[name], rel=3e-2 if name == "mean_period" else 5e-3), name


@pytest.mark.parametrize(
    "periods, damping, words",
    [([1.0], -0.05, "damping ratio"), ([1.0], np.nan, "damping ratio"), ([0.0], 0.05, "above 0 s"), ([[1.0]], 0.05, "in one row"), ([np.inf], 0.05, "finite"), ([1e-6], 0.05, "rigid")],
)
def test_senseless_oscillators_are_refused(centro, periods, damping, words):
    with pytest.raises(ValueError, match=words):
        response_spectrum(centro, periods, damping)


def test_a_record_shorter_than_the_longest_period_is_warned_of():
    record = sine(1.0, 2.0, 4, 0.01)
    with pytest.warns(UserWarning, match=r"sine lasts 2 s, less than the longest period of 5 s"):
        response_spectrum(record, [1.0, 5.0])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        response_spectrum(record, [2.0])


# Figures


def test_figures_of_a_sine_are_the_closed_forms():
    record, length = sine(3.0, 2.0, 40, 5e-4), 20.0
    found = ground_motion.figures(record)
    assert found["peak_acceleration"] == pytest.approx(3.0, rel=1e-6)
    assert found["peak_velocity"] == pytest.approx(3.0 / (np.pi * 2.0), rel=1e-5)
    assert found["peak_displacement"] == pytest.approx(3.0 * length / (2.0 * np.pi * 2.0), rel=1e-5)
    assert found["arias_intensity"] == pytest.approx(np.pi / (2.0 * GRAVITY) * 3.0**2 * length / 2.0, rel=1e-5)
    assert found["cumulative_absolute_velocity"] == pytest.approx(2.0 * 3.0 / np.pi * length, rel=1e-5)
    assert found["significant_duration_5_95"] == pytest.approx(0.9 * length, rel=1e-6)
    assert found["significant_duration_5_75"] == pytest.approx(0.7 * length, rel=2e-2)  # 5 and 75 % are at other points of a cycle
    assert found["mean_period"] == pytest.approx(0.5, rel=1e-2)
    assert found["predominant_period"] == pytest.approx(0.5, rel=2e-2)
    time = record.time
    exact = time / length - np.sin(8.0 * np.pi * time) / (8.0 * np.pi * length)
    assert ground_motion.husid(record) == pytest.approx(exact, abs=1e-6)


def test_the_fourier_amplitude_of_a_sine_is_half_its_duration_times_its_amplitude():
    frequency, amplitude = ground_motion.fourier_amplitude(sine(3.0, 2.0, 40, 5e-4))
    peak = int(np.argmax(amplitude))
    assert frequency[peak] == pytest.approx(2.0, rel=1e-3)
    assert amplitude[peak] == pytest.approx(3.0 * 20.0 / 2.0, rel=1e-3)


def test_integrals_are_exact_for_straight_lines():
    ramp = Record(0.5, np.arange(9) * 0.5, "ramp")  # a = t
    assert ramp.velocity == pytest.approx(ramp.time**2 / 2.0)
    assert ramp.displacement == pytest.approx(ramp.time**3 / 6.0)
    crossing = Record(2.0, [1.0, -1.0])
    assert ground_motion.cumulative_absolute_velocity(crossing) == pytest.approx(1.0)
    assert ground_motion.arias_intensity(crossing) == pytest.approx(np.pi / (2.0 * GRAVITY) * 2.0 / 3.0)


def test_the_spectrum_intensities_are_areas_and_means_of_their_spectra():
    record = pulse(0.4, duration=12.0)
    assert ground_motion.spectrum_intensity(record, 0.0) == pytest.approx(0.4 * 2.4, rel=3e-3)
    assert ground_motion.si_value(record) == pytest.approx(0.4, rel=2e-2)


def test_el_centro_has_the_published_figures(centro):
    """Newmark (1965) gives 0.32 g, 13.7 in/s and 8.3 in; Housner (1952), table II, an undamped spectrum intensity of 8.35 ft."""
    found = ground_motion.figures(centro)
    assert found["peak_acceleration"] / GRAVITY == pytest.approx(0.32, rel=0.01)
    assert found["peak_velocity"] / INCH == pytest.approx(13.7, rel=0.05)
    assert found["peak_displacement"] / INCH == pytest.approx(8.3, rel=0.01)
    assert ground_motion.spectrum_intensity(centro, 0.0) / FOOT == pytest.approx(8.35, rel=0.05)


def test_a_record_without_motion_has_figures_too():
    still = Record(0.01, np.zeros(3000), "still")
    found = ground_motion.figures(still)
    assert all(value == 0.0 for name, value in found.items() if name not in ("mean_period", "predominant_period"))
    assert np.isnan(found["mean_period"])
    for scale in (lambda: ground_motion.scale_to_peak(still, 1.0), lambda: ground_motion.factor_for_spectrum(still, [0.1, 1.0], [1.0, 1.0])):
        with pytest.raises(ValueError, match="no motion"):
            scale()


# Correction and scaling


def test_a_baseline_is_that_of_a_case(centro):
    told = sazare.check(CASES / "soil-column-el-centro/case.toml")
    velocity, displacement = (float(word) for word in re.search(r"at the end of the record (\S+) m/s, displacement (\S+) m", told).groups())
    record = ground_motion.take_off_baseline(centro, 1)
    amplitude = velocity / record.velocity[-1]  # the case may tell the drift of the record or of its half, which comes in
    assert amplitude in (pytest.approx(0.5, rel=0.02), pytest.approx(1.0, rel=0.02))
    assert displacement == pytest.approx(amplitude * record.displacement[-1], rel=0.02)


@pytest.mark.parametrize("degree", [0, 1, 3])
def test_a_polynomial_is_taken_off_whole(degree):
    time = 0.01 * np.arange(2000)
    clean = np.sin(2.0 * np.pi * time)
    spoilt = clean + np.polyval(np.arange(1, degree + 2) * 0.05 / 20.0 ** np.arange(degree, -1, -1), time)
    left = ground_motion.take_off_baseline(Record(0.01, spoilt), degree).acceleration
    once = ground_motion.take_off_baseline(Record(0.01, clean), degree).acceleration
    assert left == pytest.approx(once, abs=2e-5)


def test_a_record_that_ends_at_rest_is_changed_as_little_as_can_be(centro):
    rest = ground_motion.end_at_rest(centro)
    assert abs(rest.velocity[-1]) < 1e-12 and abs(rest.displacement[-1]) < 1e-11
    change = rest.acceleration - centro.acceleration
    for other in (np.cos(np.pi * centro.time / centro.duration * 3), centro.time**2):
        still = other - np.polynomial.Polynomial.fit(centro.time, other, 1)(centro.time)  # changes neither, to the step
        assert abs(change @ still) < 1e-9 * np.linalg.norm(change) * np.linalg.norm(still)


@pytest.mark.parametrize("causal, at_corner", [(False, 0.5), (True, np.sqrt(0.5))])
def test_a_filter_keeps_its_band_and_halves_its_corner(causal, at_corner):
    def passed(frequency):
        record = sine(1.0, frequency, 60 * frequency, 0.005)
        filtered = ground_motion.butterworth(record, 1.0, 8.0, causal=causal).acceleration
        middle = slice(len(filtered) // 3, 2 * len(filtered) // 3)
        return np.abs(filtered[middle]).max()

    assert passed(3.0) == pytest.approx(1.0, rel=5e-3)
    assert passed(1.0) == pytest.approx(at_corner, rel=5e-3)
    assert passed(8.0) == pytest.approx(at_corner, rel=5e-3)
    assert passed(0.25) < 0.01 and passed(30.0) < 0.02


def test_a_filter_in_both_directions_moves_no_phase():
    bell = np.exp(-(((np.arange(2001) - 1000) / 40.0) ** 2))
    filtered = ground_motion.butterworth(Record(0.01, bell), low=0.2).acceleration
    assert filtered == pytest.approx(filtered[::-1], abs=1e-9)
    assert np.argmax(ground_motion.butterworth(Record(0.01, bell), high=1.0, causal=True).acceleration) > 1000


def test_longer_steps_pass_what_they_can_hold():
    slow, fast = sine(1.0, 1.0, 20, 0.002), sine(1.0, 40.0, 800, 0.002)
    both = Record(0.002, slow.acceleration + fast.acceleration)
    coarse = ground_motion.resample(both, 0.02)
    assert coarse.step == 0.02 and coarse.duration == pytest.approx(both.duration)
    middle = slice(100, 900)
    assert coarse.acceleration[middle] == pytest.approx(np.sin(2.0 * np.pi * coarse.time[middle]), abs=2e-2)


def test_scaling_gives_the_peak_that_was_asked_for(centro):
    assert ground_motion.peak_acceleration(ground_motion.scale_to_peak(centro, acceleration=5.0)) == pytest.approx(5.0)
    assert ground_motion.peak_velocity(ground_motion.scale_to_peak(centro, velocity=0.5)) == pytest.approx(0.5)
    for wrong in ({}, {"acceleration": 1.0, "velocity": 1.0}, {"acceleration": 0.0}, {"velocity": np.nan}):
        with pytest.raises(ValueError):
            ground_motion.scale_to_peak(centro, **wrong)


def test_one_factor_brings_a_spectrum_to_its_target(centro):
    periods = np.geomspace(0.1, 3.0, 400)
    own = response_spectrum(centro, periods).pseudo_acceleration
    factor, off = ground_motion.factor_for_spectrum(centro, periods, 2.5 * own, shortest=0.2, longest=2.0)
    assert factor == pytest.approx(2.5, rel=2e-3) and off < 5e-3
    flat, off = ground_motion.factor_for_spectrum(centro, [0.2, 2.0], [6.0, 6.0])
    chosen = np.geomspace(0.2, 2.0, 2001)

    left = np.log(6.0 / response_spectrum(centro.scaled(flat), chosen).pseudo_acceleration)
    assert left.mean() == pytest.approx(0.0, abs=1e-2) and off == pytest.approx(left.std(), rel=2e-2)


@pytest.mark.parametrize(
    "period, target, limits, words",
    [([0.1, 1.0], [1.0, 1.0], (0.05, 0.5), "must hold the range"), ([0.1, 1.0], [1.0, 0.0], (None, None), "above 0"), ([1.0, 0.1], [1.0, 1.0], (None, None), "rise"),
     ([0.1], [1.0], (None, None), "at least 2"), ([0.1, 1.0], [1.0, 1.0], (0.5, 0.5), "must hold the range")],
)
def test_a_senseless_target_is_refused(centro, period, target, limits, words):
    with pytest.raises(ValueError, match=words):
        ground_motion.factor_for_spectrum(centro, period, target, shortest=limits[0], longest=limits[1])


@pytest.mark.parametrize(
    "change, words",
    [(lambda r: ground_motion.butterworth(r), "needs a lower or an upper"), (lambda r: ground_motion.butterworth(r, 5.0, 1.0), "below the upper"),
     (lambda r: ground_motion.butterworth(r, high=25.0), "below half"), (lambda r: ground_motion.butterworth(r, 1.0, order=0), "order"),
     (lambda r: ground_motion.butterworth(r, 1e-9), "too short for a corner"), (lambda r: ground_motion.resample(r, 1e-12), "more than 50000000"),
     (lambda r: ground_motion.resample(r, 0.0), "above 0"), (lambda r: ground_motion.resample(r, 20.0), "quarter"),
     (lambda r: ground_motion.take_off_baseline(r, 6), "degree"), (lambda r: ground_motion.take_off_baseline(Record(0.1, [1.0, 2.0]), 1), "too few"),
     (lambda r: ground_motion.significant_duration(r, 0.9, 0.1), "rise"), (lambda r: ground_motion.usual_periods(1.0, 0.5), "longer one")],
)
def test_senseless_corrections_are_refused(centro, change, words):
    with pytest.raises(ValueError, match=words):
        change(centro)


# Files


@pytest.mark.parametrize(
    "step, values, words",
    [(0.0, [1.0, 2.0], "above 0 s"), (np.nan, [1.0, 2.0], "above 0 s"), (0.1, [1.0], "at least 2"), (0.1, [[1.0, 2.0]], "in one row"), (0.1, [1.0, np.nan, 2.0], "sample 1 is not")],
)
def test_what_is_no_record_is_refused(step, values, words):
    with pytest.raises(ValueError, match=words):
        Record(step, values)


def test_a_record_that_is_written_is_read_again_by_python_and_by_a_case(centro, tmp_path):
    path = ground_motion.write_record(tmp_path / "again.csv", centro)
    again = ground_motion.read_record(path)
    assert again.step == centro.step and again.acceleration == pytest.approx(centro.acceleration, abs=0.0)
    assert len(centro.acceleration) == 1560 and ground_motion.peak_acceleration(centro) == pytest.approx(0.31882 * GRAVITY)
    case = (CASES / "soil-column-el-centro/case.toml").read_text().replace("el-centro-1940-ns.AT2", "again.csv")
    (tmp_path / "case.toml").write_text(case)
    assert "el-centro" in sazare.check(tmp_path / "case.toml")


def test_k_net_and_other_quantities_are_read(tmp_path):
    knet = tmp_path / "quake.EW"
    head = ["Origin Time       2026/01/01 00:00:00"] * 10 + ["Sampling Freq(Hz) 100Hz", "Duration Time(s)  0.04", "Dir.              E-W", "Scale Factor      2000(gal)/8000"]
    knet.write_text("\n".join([*head, "Max. Acc. (gal)   1", "Last Correction   2026/01/01 00:00:00", "Memo.", "  4  -4   8  -8"]) + "\n")
    record = ground_motion.read_record(knet)
    assert record.step == pytest.approx(0.01) and record.acceleration == pytest.approx([0.01, -0.01, 0.02, -0.02])
    time = 0.01 * np.arange(101)
    for quantity, unit, values in (("velocity", "cm/s", 100.0 * time**2), ("displacement", "m", time**3 / 3.0)):
        path = tmp_path / f"{quantity}.csv"
        sazare.write_table(path, {"time [s]": time, f"{quantity} [{unit}]": values})
        assert ground_motion.read_record(path).acceleration[5:-5] == pytest.approx(2.0 * time[5:-5], abs=1e-6)
    with pytest.raises(ValueError, match="jerk is none of"):
        ground_motion.from_samples(0.1, [1.0, 2.0], "jerk")


@pytest.mark.parametrize(
    "name, text, words",
    [("a.csv", "", "empty"), ("a.csv", "time [s],acceleration [furlong]\n0,1\n1,2\n", "furlong is not a unit of acceleration"),
     ("a.csv", "time [s],acceleration [m/s2]\n0,1\n0.1,2\n0.3,2\n", "times are not uniform"), ("a.csv", "time [s],acceleration [m/s2]\n0,1\n0.1,nan\n", "finite|number"),
     ("a.AT2", "one\ntwo\n", "too short"), ("a.txt", "1 2 3\n", "known format"), ("missing.csv", None, "cannot be read")],
)
def test_a_file_that_is_no_record_is_refused_with_its_place(tmp_path, name, text, words):
    if text is not None:
        (tmp_path / name).write_text(text)
    with pytest.raises(ValueError, match=words) as refused:
        ground_motion.read_record(tmp_path / name)
    assert name in str(refused.value)
