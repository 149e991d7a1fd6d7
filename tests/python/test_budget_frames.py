# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.budget against 2,000 simulated frames of one pixel, each row within 4 standard errors.

One condition of each camera; all of them where TOFRAY_LONG is set. Conditions in which many cycles are wrong, walls that are turned, pixels at the rim
and warm cameras are tests of their own, as are the causes of noise, each against frames that have it alone. `pytest -s` shows the largest deviations.
"""

from __future__ import annotations

import copy
import math
import os
from typing import Any, Iterator

import numpy as np
import pytest

import tofray

FRAMES = 2000
LONG = bool(os.environ.get("TOFRAY_LONG"))
LIGHT = 299792458.0
CAMERAS = ["adtf3175", "azure-kinect-nfov-binned", "azure-kinect-nfov", "azure-kinect-wfov", "custom", "flexx2", "imx556", "kinect-v2", "o3d303",
           "opt8241", "pico-flexx", "pico-monstar"]
CONDITIONS = [(0.5, 0.2, 0.0), (1.0, 0.8, 0.0), (1.5, 0.5, 5e3), (0.8, 0.8, 5e4)]  # z in metres, reflectivity, lx
ALL_CASES = [(name, *condition) for name in CAMERAS for condition in CONDITIONS]
CASES = ALL_CASES if LONG else [(name, *CONDITIONS[i % 4]) for i, name in enumerate(CAMERAS)]
RANGES = ("range_m", "range_by_frequency_m", "cycle_by_frequency")

judged: list[tuple[float, str]] = []   # each comparison's deviation in standard errors


@pytest.fixture(scope="module", autouse=True)
def show_the_largest() -> Iterator[None]:
    yield
    print(f"\n{len(judged)} comparisons, the largest:", *(f"{z:.2f}  {what}" for z, what in sorted(judged)[:-9:-1]), sep="\n  ")


def judge(off: float, error: float, what: str, known: float = 0.0) -> None:
    """Within 4 standard errors, beyond what is known to be left out."""
    z = max(abs(off) - known, 0.0) / error
    judged.append((z, what))
    assert z <= 4, (what, off, error)


def judge_mean(found: Any, said: float, what: str, known: float = 0.0) -> None:
    values = np.asarray(found, float)
    judge(values.mean() - said, values.std(ddof=1) / np.sqrt(len(values)) + 1e-12, what, known)


def judge_spread(found: Any, said: float, what: str, sigma_rad: float = 0.0) -> None:
    """A standard deviation. The phase of a noisy phasor has a variance of σ² + σ⁴, of which a budget, being of first order, has σ²."""
    values = np.asarray(found, float)
    judge(values.std(ddof=1) / (said * (1 + sigma_rad ** 2 / 2)) - 1, 1 / np.sqrt(2 * len(values)), what)


def judge_count(count: int, share: float, what: str, of: int = FRAMES) -> None:
    """So many of a binomial law: in neither tail farther than 4 standard deviations of a normal one."""
    if not 0 < share < 1:
        assert count == round(of * share), (what, count, share)
        return
    chances = np.exp([math.lgamma(of + 1) - math.lgamma(k + 1) - math.lgamma(of - k + 1) + k * math.log(share) + (of - k) * math.log1p(-share)
                      for k in range(of + 1)])
    if share * of > 10:
        judged.append((abs(count - share * of) / math.sqrt(share * (1 - share) * of), what))
    assert min(chances[:count + 1].sum(), chances[count:].sum()) > 3.17e-5, (what, count / of, share)


def one_pixel(camera: tofray.Camera, pixel: tuple[float, float] | None = None) -> tofray.Camera:
    """That pixel alone, None: the one on the axis; without what budgets leave out: patterns, neighbours, filters and flags."""
    out = copy.deepcopy(camera)
    out.lens.cx_px, out.lens.cy_px = (0, 0) if pixel is None else (out.lens.cx_px - pixel[0], out.lens.cy_px - pixel[1])
    out.sensor.width = out.sensor.height = 1
    out.readout, out.auto_exposure = type(out.readout)(), type(out.auto_exposure)()
    out.lens.scatter, out.interference = type(out.lens.scatter)(), type(out.interference)()
    out.decoding.filter = type(out.decoding.filter)()
    out.decoding.temporal_frames, out.decoding.flying_check = 1, False
    out.decoding.noise_threshold_m, out.decoding.amplitude_threshold_e = 1e3, 0
    out.pixel.prnu = out.pixel.dsnu_dn = out.pixel.delay_s = out.pixel.phase_offset_rad = 0
    out.pixel.crosstalk_left_right = out.pixel.crosstalk_up_down = 0
    return out


def frames_of(camera: tofray.Camera, z: float, reflectivity: float, lux: float, angle: float, seed: int, arrays: tuple[str, ...]) -> list[tofray.Frame]:
    scene = tofray.Scene()
    if lux:
        scene.ambient = tofray.Ambient(spectrum="sun_am15", quantity="illuminance_lx", amount=lux)
    normal = np.array([[[np.sin(angle), 0, -np.cos(angle)]]], np.float32)
    wall = tofray.Geometry(np.full((1, 1), z, np.float32), normal, np.full((1, 1), reflectivity, np.float32))
    simulator = tofray.Simulator(scene, camera, seed=seed, threads=1, backend="cpu", arrays=arrays)
    return [simulator.frame(i, wall) for i in range(FRAMES)]


class Film:
    """What 2,000 frames of one pixel have, frame by frame."""

    def __init__(self, camera: tofray.Camera, z: float, reflectivity: float, lux: float, angle: float = 0.0, seed: int = 1) -> None:
        frames = frames_of(camera, z, reflectivity, lux, angle, seed,
                           ("raw", "tap_a", "tap_b", *RANGES, "z_m", "amplitude_e", "amplitude_by_frequency_e", "ambient_e", "noise_m", "gt_signal_e",
                            "gt_ambient_e_per_s", "gt_irradiance_w_m2", "gt_power_w"))
        depths, raws, truth = [one.depth for one in frames], [one.raw for one in frames], frames[0].truth
        self.range, self.z, self.amplitude, self.ambient, self.noise = (
            np.array([float(getattr(one, name)[0, 0]) for one in depths]) for name in ("range_m", "z_m", "amplitude_e", "ambient_e", "noise_m"))
        self.ranges, self.amplitudes = (np.array([getattr(one, name)[:, 0, 0] for one in depths], float)
                                        for name in ("range_by_frequency_m", "amplitude_by_frequency_e"))
        lit = np.asarray(raws[0].lit, bool)
        self.codes, self.taps_a, self.taps_b = (np.array([getattr(one, name)[:, 0, 0] for one in raws], float)[:, lit] for name in ("raw", "tap_a", "tap_b"))
        self.frequency, self.time = np.asarray(raws[0].modulation_frequency_hz)[lit], np.asarray(raws[0].integration_time_s)[lit]
        self.signal, self.ambient_rate = np.asarray(truth.signal_e, float)[lit, 0, 0], float(truth.ambient_e_per_s[0, 0])
        self.irradiance, self.power = float(truth.irradiance_w_m2[0, 0]), float(truth.power_w[0, 0])


def row_of(camera: tofray.Camera, z: float, reflectivity: float, lux: float, **more: Any) -> dict[str, Any]:
    return {key: value[0, 0, 0] for key, value in tofray.budget(camera, [z], [reflectivity], [lux], **more).items()}


def cycle_of(row: dict[str, Any]) -> Any:
    """Half a wavelength of each modulation frequency."""
    return LIGHT / 2 / row["modulation_frequency_hz"]


def sigma_rad(row: dict[str, Any]) -> Any:
    """Phase noise of each modulation frequency, first order."""
    return 2 * np.pi * row["frequency_sigma_m"] / cycle_of(row)


def in_its_cycle(ranges: Any, expected: float, row: dict[str, Any]) -> Any:
    """What the modulation frequencies say alone, less what is expected, in whatever cycle it is."""
    off = ranges - expected
    return off - cycle_of(row) * np.round(off / cycle_of(row))


def judge_taps(camera: tofray.Camera, film: Film, row: dict[str, Any], what: str) -> None:
    taps = np.concatenate([film.taps_a, film.taps_b], axis=1)
    means, errors = taps.mean(axis=0), taps.std(axis=0, ddof=1) / np.sqrt(FRAMES)
    fullest = int(np.argmax(means))   # of several like means it is the one that chance made largest: 2 standard errors
    filling = row["tap_filling"] * camera.pixel.full_well_e
    judge(means[fullest] - filling, errors[fullest], "tap_filling" + what, 2 * errors[fullest] + 1e-5 * filling)
    adc = camera.adc
    off = film.codes - adc.mid_code
    means, spreads = np.abs(off.mean(axis=0)), off.std(axis=0, ddof=1)
    farthest = int(np.argmax(means))
    reach = min(adc.mid_code - adc.valid_min, adc.valid_max - adc.mid_code)
    error = spreads[farthest] / np.sqrt(FRAMES)
    # A code that hardly moves is rounded the same way in each frame.
    judge(means[farthest] - row["adc_filling"] * reach, error, "adc_filling" + what, 2 * error + (0.5 if spreads[farthest] < 0.5 else 0.0))


def judge_row(camera: tofray.Camera, film: Film, row: dict[str, Any], lux: float, what: str, **given: Any) -> None:
    assert film.irradiance == pytest.approx(row["irradiance_w_m2"], rel=1e-5)
    assert film.power == pytest.approx(row["power_w"], rel=1e-5)
    for i, hz in enumerate(row["modulation_frequency_hz"]):   # without noise: what the simulator expects, to float32
        own = film.frequency == hz
        assert film.signal[own] == pytest.approx(row["frequency_signal_e"][i], rel=1e-5)
        assert film.ambient_rate * film.time[own] == pytest.approx(row["frequency_ambient_e"][i], rel=1e-5)
    for name in ("signal_e", "ambient_e", "dark_e"):
        assert row[name] == row["frequency_" + name].max()
    if row["saturated"]:
        assert np.isnan(film.range).all() and np.isnan(row["sigma_m"]) and np.isnan(row["frequency_sigma_m"]).all() and np.isnan(row["share_read"])
        assert max(row["tap_filling"], row["adc_filling"]) > 1
        return
    expected = row["range_m"] + row["bias_m"]
    wrong = np.isnan(film.range) | (np.abs(film.range - expected) > cycle_of(row).min() / 2)
    judge_count(int(wrong.sum()), row["wrong_cycle"], "wrong_cycle" + what)
    of_phase = sigma_rad(row).mean()
    judge_spread(film.range[~wrong], row["sigma_m"], "sigma_m" + what, of_phase)
    judge_spread(film.z[~wrong], row["sigma_z_m"], "sigma_z_m" + what, of_phase)
    judge_mean(film.range[~wrong], expected, "range_m" + what)
    # It goes by the slope of wiggling at the measured phase, a constant of each cell of a table: its mean over noise is not that of one phase.
    steps = np.linspace(-3, 3, 17)
    around = tofray.budget(camera, row["z_m"] + steps * row["frequency_sigma_m"].max(), [row["reflectivity"]], [lux], **given)["noise_estimate_m"][0, 0]
    bent = abs(np.average(around, weights=np.exp(-steps ** 2 / 2)) - row["noise_estimate_m"])
    # A noisy grey frame says more ambient light than there is, where that is less than its noise, for it is held to 0. Amplitudes vary by σ_φ.
    grey = film.ambient.mean() - row["frequency_ambient_e"].mean() if (film.ambient > 0).any() else 0.0
    estimate = row["noise_estimate_m"] * (1 + grey * row["share_signal_shot"] / (2 * row["signal_e"]))
    judge_mean(film.noise[~wrong], estimate, "noise_estimate_m" + what, bent + (of_phase ** 2 + 1e-4) * estimate)
    # A modulus of noisy sums is long by σ²/2A of each frequency.
    rice = film.amplitudes.var(axis=0) / (2 * row["frequency_amplitude_e"])
    judge_mean(film.amplitude, row["amplitude_e"] + rice.mean(), "amplitude_e" + what)
    assert row["contrast"] == pytest.approx(row["frequency_contrast"].mean(), rel=1e-9)
    alone = in_its_cycle(film.ranges, expected, row)
    for i, hz in enumerate(row["modulation_frequency_hz"]):
        of = f" of {hz / 1e6:g} MHz" + what
        judge_spread(alone[:, i], row["frequency_sigma_m"][i], "frequency_sigma_m" + of, sigma_rad(row)[i])
        judge_mean(film.amplitudes[:, i], row["frequency_amplitude_e"][i] + rice[i], "frequency_amplitude_e" + of)
        assert row["frequency_contrast"][i] == pytest.approx(row["frequency_amplitude_e"][i] / row["frequency_signal_e"][i], rel=1e-9)
        charge = row["frequency_signal_e"][i] + row["frequency_ambient_e"][i] + row["frequency_dark_e"][i]
        judge_mean((film.taps_a + film.taps_b)[:, film.frequency == hz].mean(axis=1), charge, "signal_e + ambient_e + dark_e" + of, 2e-6 * charge)
    judge_taps(camera, film, row, what)
    assert sum(row[name] for name in row if name.startswith("share_")) == pytest.approx(1, abs=1e-9)
    assert row["exponent"] == pytest.approx(2 - row["share_signal_shot"])


@pytest.mark.parametrize("name, z, reflectivity, lux", CASES)
def test_rows_are_those_of_simulated_frames(name: str, z: float, reflectivity: float, lux: float) -> None:
    camera = tofray.load_camera(name)
    film = Film(one_pixel(camera), z, reflectivity, lux, seed=100 * CAMERAS.index(name) + round(10 * z))
    judge_row(camera, film, row_of(camera, z, reflectivity, lux), lux, f", {name} at {z:g} m, {reflectivity:g}, {lux:g} lx")


TURNED = [("pico-flexx", 1.2, 0.6, None, None), ("flexx2", 1.0, -0.4, (5, 5), 60.0), ("kinect-v2", 0.8, 0.5, (400, 100), None),
          ("opt8241", 1.0, 0.0, (300, 200), 55.0), ("azure-kinect-nfov", 1.0, 1.2, (100, 500), 40.0)]


@pytest.mark.parametrize("name, z, angle, pixel, celsius", TURNED if LONG else TURNED[:2])
def test_turned_walls_pixels_at_the_rim_and_warm_cameras(name: str, z: float, angle: float, pixel: tuple[float, float] | None, celsius: float | None) -> None:
    camera = tofray.load_camera(name)
    # No built-in camera knows of temperatures.
    camera.pixel.dark_current_e_per_s *= 100
    camera.pixel.dark_current_doubling_k, camera.temperature.drift_m_per_kelvin = 7.0, 2e-4
    warm = copy.deepcopy(camera)
    if celsius is not None:
        warm.temperature.celsius = celsius
    given: dict[str, Any] = {"angle_rad": angle, "temperature_celsius": celsius, "pixel": pixel}
    row, what = row_of(camera, z, 0.5, 0.0, **given), f", {name} turned by {angle:g} rad, pixel {pixel}, {celsius} degrees Celsius"
    judge_row(camera, Film(one_pixel(warm, pixel), z, 0.5, 0.0, angle), row, 0.0, what, **given)
    cold = row_of(camera, z, 0.5, 0.0, angle_rad=angle, pixel=pixel)
    if celsius is not None:
        kelvin = celsius - camera.temperature.celsius
        assert row["dark_e"] == pytest.approx(cold["dark_e"] * 2 ** (kelvin / 7), rel=1e-3)
        assert row["bias_m"] - cold["bias_m"] == pytest.approx(2e-4 * kelvin, rel=1e-2)
    if pixel is None:   # the light is aside of the camera by less than a hundredth of the distance
        assert row["irradiance_w_m2"] / row_of(camera, z, 0.5, 0.0)["irradiance_w_m2"] == pytest.approx(math.cos(angle), rel=0.03)


def spread_of_codes(row: dict[str, Any]) -> float:
    """Of the taps' difference [e], from what own light's shot noise has of it."""
    return math.sqrt(row["signal_e"] / row["share_signal_shot"])


def fine(camera: tofray.Camera, row: dict[str, Any]) -> tofray.Camera:
    """Next to no rounding, and wells that nothing fills."""
    out, adc = copy.deepcopy(camera), camera.adc
    farthest = row["adc_filling"] * min(adc.mid_code - adc.valid_min, adc.valid_max - adc.mid_code) * adc.step_e_per_dn
    most = float(1.1 * farthest + 10 * math.hypot(math.sqrt(5 * row["signal_e"]), spread_of_codes(row)))
    out.pixel.full_well_e, out.adc = 1e9, tofray.Adc(bits=16, mid_code=32768, valid_max=65535, step_e_per_dn=most / 32768)
    return out


def distance_with_wrong_cycles(camera: tofray.Camera, reflectivity: float, lux: float, share: float) -> float | None:
    """Where about so many cycles are wrong; None: nowhere in the unambiguous range."""
    near, far = 0.3, 0.9 * float(tofray.budget(camera).summary["ambiguity_range_m"])
    for _ in range(20):
        middle = math.sqrt(near * far)
        wrong = row_of(camera, middle, reflectivity, lux)["wrong_cycle"]
        near, far = (near, middle) if wrong > share else (middle, far)   # saturated: farther
        if abs(wrong / share - 1) < 0.1:
            return middle
    return None


def judge_wrong_cycles(camera: tofray.Camera, reflectivity: float, lux: float, share: float, name: str) -> None:
    z = distance_with_wrong_cycles(camera, reflectivity, lux, share)
    if z is None:
        pytest.skip("so many cycles are wrong nowhere")
    row = row_of(camera, z, reflectivity, lux)
    if camera.adc.step_e_per_dn > spread_of_codes(row):   # a few codes, which have no tails of a normal law
        camera = fine(camera, row)
        row = row_of(camera, z, reflectivity, lux)
    assert 0.01 < row["wrong_cycle"] < 0.3
    frames = frames_of(one_pixel(camera), z, reflectivity, lux, 0.0, 3, RANGES)
    ranges = np.array([one.depth.range_by_frequency_m[:, 0, 0] for one in frames], float)
    wrong = ~(np.abs(ranges - row["range_m"] - row["bias_m"]) <= cycle_of(row) / 2).all(axis=1)
    judge_count(int(wrong.sum()), row["wrong_cycle"], f"wrong_cycle, {name} at {z:.2f} m, {reflectivity:g}, {lux:g} lx")


WRONG = [(0.3, 0.0, 0.03), (0.3, 2e4, 0.05), (0.1, 1e5, 0.12), (0.8, 3e3, 0.25)]   # reflectivity, lx, share of wrong cycles


@pytest.mark.parametrize("name, reflectivity, lux, share", [(name, *one) for name in CAMERAS if name != "opt8241" for one in WRONG] if LONG else [
    ("pico-flexx", *WRONG[2]), ("azure-kinect-wfov", *WRONG[1])])
def test_wrong_cycles_where_they_count(name: str, reflectivity: float, lux: float, share: float) -> None:
    camera = tofray.load_camera(name)
    judge_wrong_cycles(camera, reflectivity, lux, share, name)


def test_modulation_frequencies_with_times_of_their_own() -> None:
    camera = tofray.load_camera("custom")
    lowest = min(one.modulation_frequency_hz for one in camera.mode.sequence if one.lit)
    for one in camera.mode.sequence:
        one.integration_time_s *= 0.15 if one.lit and one.modulation_frequency_hz == lowest else 1.0
    judge_row(camera, Film(one_pixel(camera), 1.0, 0.8, 2e3), row_of(camera, 1.0, 0.8, 2e3), 2e3, ", custom with times of their own")
    judge_wrong_cycles(camera, *WRONG[1], "custom with times of their own")


def fused(camera: tofray.Camera, z: float, reflectivity: float, lux: float, row: dict[str, Any], seed: int = 1) -> Any:
    """Ranges of 2,000 frames, fused with the weights that the row's σ give its modulation frequencies; about their mean."""
    frames = frames_of(one_pixel(camera), z, reflectivity, lux, 0.0, seed, RANGES)
    ranges = np.array([one.depth.range_by_frequency_m[:, 0, 0] for one in frames], float)
    weights = row["frequency_sigma_m"] ** -2.0
    off = in_its_cycle(ranges, ranges[0], row)
    return ((off - off.mean(axis=0)) * weights).sum(axis=1) / weights.sum()


def silent(camera: tofray.Camera, row: dict[str, Any]) -> tofray.Camera:
    """With the shot noise of its own light alone."""
    out = fine(camera, row)
    out.pixel.read_noise_e = out.pixel.reset_noise_e = out.pixel.dark_current_e_per_s = out.pixel.column_noise_e = out.pixel.row_noise_e = 0
    return out


@pytest.mark.parametrize("name, z, reflectivity, lux", ALL_CASES if LONG else [("kinect-v2", *CONDITIONS[2])])
def test_shares_are_the_noise_that_each_cause_makes_alone(name: str, z: float, reflectivity: float, lux: float) -> None:
    camera = tofray.load_camera(name)
    row, what = row_of(camera, z, reflectivity, lux), f", {name} at {z:g} m, {reflectivity:g}, {lux:g} lx"
    if row["saturated"]:
        assert all(np.isnan(row[key]) for key in row if key.startswith("share_"))
        return
    own = row["sigma_m"] * math.sqrt(row["share_signal_shot"])
    alone = silent(camera, row)
    rad = sigma_rad(row).mean() * math.sqrt(row["share_signal_shot"])
    judge_spread(fused(alone, z, reflectivity, 0.0, row), own, "share_signal_shot" + what, rad)

    def judge_added(cause: str, changed: tofray.Camera, light: float, times: float, seed: int) -> None:
        """With one cause that many times its variance, so that four fifths of the noise are its own."""
        variance = row["sigma_m"] ** 2 * row["share_" + cause] * times
        assert variance > own ** 2, f"{cause} is seen"
        said = math.hypot(own, math.sqrt(variance))
        judge_spread(fused(changed, z, reflectivity, light, row, seed), said, f"share_{cause}" + what, rad * said / own)

    read = 2 * (camera.pixel.read_noise_e ** 2 + camera.pixel.reset_noise_e ** 2)
    changed = silent(camera, row)
    times = 4 * row["signal_e"] / read
    changed.pixel.read_noise_e, changed.pixel.reset_noise_e = (math.sqrt(times) * one for one in (camera.pixel.read_noise_e, camera.pixel.reset_noise_e))
    judge_added("read", changed, 0.0, times, 2)
    changed, times = silent(camera, row), 4 * row["signal_e"] / row["dark_e"]
    changed.pixel.dark_current_e_per_s = times * camera.pixel.dark_current_e_per_s
    judge_added("dark_shot", changed, 0.0, times, 3)
    if lux:
        times = 4 * row["signal_e"] / row["ambient_e"]
        judge_added("ambient_shot", silent(camera, row), times * lux, times, 4)
    else:
        assert row["share_ambient_shot"] == 0
    # Frames of one seed differ by rounding alone where one camera has fine codes and the other its own.
    finer, roomy = fine(camera, row), copy.deepcopy(camera)
    roomy.pixel.full_well_e = 1e9
    rounding = fused(roomy, z, reflectivity, lux, row, 5) - fused(finer, z, reflectivity, lux, row, 5)
    both = math.hypot(1, finer.adc.step_e_per_dn / camera.adc.step_e_per_dn)
    judge_spread(rounding, row["sigma_m"] * math.sqrt(row["share_adc"]) * both, "share_adc" + what, math.sqrt(2) * sigma_rad(row).mean())
    assert row["share_suppression"] == row["share_lines"] == 0, "no built-in camera has them"


@pytest.mark.parametrize("name, z, reflectivity", [(name, z, reflectivity) for name, z, reflectivity, _ in ALL_CASES] if LONG else [("pico-flexx", 0.7, 0.5)])
def test_shares_of_suppression_and_of_lines_are_the_noise_that_each_makes_alone(name: str, z: float, reflectivity: float) -> None:
    camera = tofray.load_camera(name)
    weak = row_of(camera, z, reflectivity, 100.0)
    lux = float(200 * weak["signal_e"] / weak["ambient_e"])   # twice as much ambient light as its own
    camera.pixel.full_well_e = 1e9
    first = row_of(camera, z, reflectivity, lux)
    camera = fine(camera, first)
    # A threshold of half of what the emptier tap has at the least, and none that holds it there.
    least = 0.5 * (first["ambient_e"] + first["dark_e"])
    camera.pixel.suppression_threshold_e, camera.pixel.suppression_budget_e = 0.3 * least, 0.4 * least
    camera.pixel.suppression_noise_factor = 1.0
    camera.pixel.column_noise_e, camera.pixel.row_noise_e = 0.5 * math.sqrt(first["signal_e"]), 0.7 * math.sqrt(first["signal_e"])
    row, what = row_of(camera, z, reflectivity, lux), f", {name} at {z:g} m, {reflectivity:g}, {lux:g} lx"
    assert row["share_suppression"] > 0.02 and row["share_lines"] > 0.02
    if sigma_rad(row).max() > 0.1:
        pytest.skip("beyond what a budget of first order says")
    with_all = fused(camera, z, reflectivity, lux, row)
    judge_spread(with_all, row["sigma_m"], "sigma_m with suppression and lines" + what, sigma_rad(row).mean())
    for cause, names in (("suppression", ["suppression_noise_factor"]), ("lines", ["column_noise_e", "row_noise_e"])):
        without = copy.deepcopy(camera)
        for one in names:
            setattr(without.pixel, one, 0.0)
        # Frames of one seed differ by this cause alone, whose part of the phase's variance is 1 + 2σ² times what first order says.
        rad = math.sqrt(2) * sigma_rad(row).mean()
        judge_spread(with_all - fused(without, z, reflectivity, lux, row), row["sigma_m"] * math.sqrt(row["share_" + cause]), f"share_{cause}" + what, rad)
