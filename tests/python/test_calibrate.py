# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.calibrate_phase and calibrate_temperature: what a specimen is comes back with honest errors, and is of that specimen alone."""

from __future__ import annotations

import functools
import json
import os
import pathlib
import subprocess
import sys
from typing import Any, Literal

import numpy as np
import pytest

import tofray

SIXTY = "{frame_rate: 10 Hz, sequence: [{modulation_frequency: 60 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], integration_time: 1 ms}]}"
DISTANCES = [0.60, 0.66, 0.73, 0.79, 0.85, 0.92, 0.98, 1.05, 1.11, 1.18, 1.24, 1.31]  # twelve over half a wave of 8f, c/8f = 625 mm
BETWEEN = [0.63, 0.70, 0.82, 0.95, 1.08, 1.21]


@functools.lru_cache(maxsize=None)
def camera(seed: int = 1, phase: float = 0.03, **words: str) -> tofray.Camera:
    out = tofray.load_camera("pico-flexx", "calibration", set={"modes.calibration": SIXTY, "readout": "{region: {left: 82, top: 66, width: 60, height: 40}}",
                                                                "pixel.patterns.phase_offset": f"{phase} rad", "pixel.patterns.seed": seed,
                                                                "illumination.0.waveform": "{kind: rectangular, duty: 50 %, harmonics: 4}", **words})
    out.decoding.flying_check = False
    return out


def frames(of: tofray.Camera, distance: float, count: int = 4, seed: int = 0) -> list[tofray.Frame]:
    scene = tofray.scene({"objects": [{"plane": {"point": [0, 0, f"{distance} m"], "normal": [0, 0, -1], "reflectivity": "80 %"}}]})
    return list(tofray.Simulator(scene, of, seed=seed + round(1e4 * distance)).frames(0, count))


@functools.lru_cache(maxsize=None)
def calibrated(seed: int = 1) -> Any:
    of = camera(seed)
    return tofray.calibrate_phase(of, [(d, frames(of, d)) for d in DISTANCES])


def true_phase(of: tofray.Camera) -> Any:
    """Of each pixel, by two simulations without noise that differ in nothing else."""
    import copy

    plain = copy.deepcopy(of)
    plain.pixel.phase_offset_rad = 0
    out = []
    for one in (of, plain):
        silent = copy.deepcopy(one)
        silent.illumination[0].waveform.kind = "sine"
        scene = tofray.scene({"objects": [{"plane": {"point": [0, 0, "1 m"], "normal": [0, 0, -1], "reflectivity": "80 %"}}]})
        frame = tofray.Simulator(scene, silent, noise="off").frame(0)
        taps = np.asarray(frame.raw.tap_a, float) - np.asarray(frame.raw.tap_b, float) if frame.raw.tap_a is not None else np.asarray(frame.raw.raw, float) - silent.adc.mid_code
        lit = np.asarray(frame.raw.lit, bool)
        out.append(np.angle(np.tensordot(np.exp(-1j * np.asarray(frame.raw.reference_phase_rad)[lit]), taps[lit], 1)))
    return np.angle(np.exp(1j * (out[0] - out[1])))


def range_errors(of: tofray.Camera, distance: float, calibration: Literal["exact", "none", ""], specimen: str = "") -> Any:
    """Of a wall between the others, the mean of 16 frames."""
    import copy

    decoder = copy.deepcopy(of)
    if specimen:
        decoder.decoding.calibration = tofray.load_camera("pico-flexx", "calibration", set={"modes.calibration": SIXTY, "readout": "{region: {left: 82, top: 66, width: 60, height: 40}}",
                                                                                             "decoding.calibration": specimen}).decoding.calibration
    elif calibration:
        decoder.decoding.calibration.kind = calibration
    z = np.stack([tofray.process(frame.raw, decoder).z_m for frame in frames(of, distance, 16, 77)])
    return z.mean(axis=0) - distance


def test_pixels_phases_come_back_within_three_standard_errors() -> None:
    one = calibrated().frequencies[0]
    true = true_phase(camera())
    z = (one.pixel_phase_rad - (true - true.mean())) / one.pixel_phase_error_rad
    # Of 2,400 pixels χ² over their number is 1 ± 0.029; 0.27 % are beyond three standard errors: 6.5 ± 2.5. Rounding to codes adds a little.
    assert 0.88 < (z**2).mean() < 1.12, (z**2).mean()
    assert (np.abs(z) > 3).mean() < 0.008 and np.abs(z).max() < 5, np.abs(z).max()
    assert 0.9 < one.chi_square < 1.1, one.chi_square
    assert one.pixel_phase_rad.std() == pytest.approx(0.03, rel=0.05)


def test_wiggling_of_twelve_distances_is_less_than_a_millimetre_between_them(tmp_path: pathlib.Path) -> None:
    calibrated().save(tmp_path / "specimen.yaml")
    before, after = [], []
    for distance in BETWEEN:
        before.append(float(np.mean(range_errors(camera(), distance, "none"))))
        after.append(float(np.mean(range_errors(camera(), distance, "", str(tmp_path / "specimen.yaml")))))
    assert np.ptp(before) > 5e-3, before  # a square wave's
    assert np.abs(after).max() < 1e-3, after
    held = calibrated().held_out
    assert len(held) == 3 and max(abs(one.after_m) for one in held) < 1e-3 < max(abs(one.before_m) for one in held)


def test_a_file_of_one_specimen_makes_another_worse(tmp_path: pathlib.Path) -> None:
    calibrated(1).save(tmp_path / "one.yaml")
    calibrated(2).save(tmp_path / "two.yaml")

    def spread(seed: int, file: str) -> float:
        return float(np.std(range_errors(camera(seed), 0.95, "none" if not file else "", str(tmp_path / file) if file else "")))

    own, none, foreign = spread(1, "one.yaml"), spread(1, ""), spread(1, "two.yaml")
    assert own < 0.6 * none and foreign > 1.2 * none, (own, none, foreign)


def test_what_is_known_exactly_is_no_better_than_the_frames_say() -> None:
    exact = np.std(range_errors(camera(), 0.95, "exact"))
    assert exact < np.std(range_errors(camera(), 0.95, "none"))


def test_drift_by_temperature_comes_back_and_is_taken_off(tmp_path: pathlib.Path) -> None:
    def at(celsius: float) -> tofray.Camera:
        return camera(1, 0.03, **{"temperature.drift": "0.5 mm/K", "temperature.actual": f"{celsius} degC"})

    temperatures = [15.0, 25.0, 35.0, 50.0]
    found = tofray.calibrate_temperature(camera(), [(t, frames(at(t), 0.9, 6, round(t))) for t in temperatures], calibrated())
    one = found.frequencies[0]
    assert abs(one.drift_m_per_kelvin - 5e-4) < 3 * max(one.drift_error_m_per_kelvin, 2e-6), (one.drift_m_per_kelvin, one.drift_error_m_per_kelvin)
    assert len(found.held_out) == 4 and max(abs(row.after_m) for row in found.held_out) < 5e-4
    found.save(tmp_path / "warm.yaml")
    calibrated().save(tmp_path / "cold.yaml")
    assert np.mean(range_errors(at(60), 0.95, "", str(tmp_path / "cold.yaml"))) == pytest.approx(35 * 5e-4, abs=2e-3)
    assert abs(np.mean(range_errors(at(60), 0.95, "", str(tmp_path / "warm.yaml")))) < 1.5e-3


def test_what_walls_do_not_say_is_refused() -> None:
    of = camera()
    wall = frames(of, 0.8)
    with pytest.raises(tofray.Error, match="there is one frame of the wall at 0.8 m"):
        tofray.calibrate_phase(of, [(0.8, wall[:1])])
    with pytest.raises(tofray.Error, match="too few walls\n  got 2"):
        tofray.calibrate_phase(of, [(0.8, wall), (0.8, wall)])
    with pytest.raises(tofray.Error, match="the walls do not say what the wiggling is at 60 MHz"):
        tofray.calibrate_phase(of, [(0.8, wall)] * 3)
    with pytest.raises(tofray.Error, match="got a distance of -1 m"):
        tofray.calibrate_phase(of, [(-1, wall)])
    with pytest.raises(tofray.Error, match="the image is not the camera's\n  got 60 x 40 pixels, the camera reads 224 x 172"):
        tofray.calibrate_phase(tofray.load_camera("pico-flexx"), [(0.8, wall)] * 3)
    with pytest.raises(tofray.Error, match="there are no raw frames in it"):
        tofray.calibrate_phase(of, [(0.8, [tofray.Frame(), tofray.Frame()])])
    with pytest.raises(tofray.Error, match="held_out has a wall that there is not"):
        tofray.calibrate_phase(of, [(0.8, wall)] * 4, held_out=[4])
    with pytest.raises(tofray.Error, match="too few temperatures"):
        tofray.calibrate_temperature(of, [(25, wall), (25.1, wall)], calibrated())


def test_the_command_writes_a_file_that_decoding_takes(tmp_path: pathlib.Path) -> None:
    of = camera()
    sides = []
    for distance in DISTANCES[:9]:
        folder = tmp_path / f"{round(1e3 * distance)}"
        folder.mkdir()
        for i, frame in enumerate(frames(of, distance, 3)):
            frame.save(folder / "one")
            os.rename(folder / "one/frame.npz", folder / f"frame_{i:04}.npz")
        sides.append(f"{round(1e3 * distance)}mm={folder}")
    words = [sys.executable, "-m", "tofray", "calibrate", "phase", "pico-flexx", *sides, "-o", str(tmp_path / "cal.yaml"), "--mode", "calibration",
             "--set", f"modes.calibration={SIXTY}", "--set", "readout={region: {left: 82, top: 66, width: 60, height: 40}}"]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    run = subprocess.run([*words, "--json"], env=environment, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    said = json.loads(run.stdout)
    assert said["frequencies"][0]["orders"] == [4, 8, 12] and len(said["held_out"]) == 2
    assert np.load(tmp_path / "cal_60MHz.npy").shape == (40, 60)
    assert (tmp_path / "cal.yaml").read_text().startswith("# What decoding has to know of one specimen")
    text = subprocess.run(words, env=environment, capture_output=True, text=True, check=False)
    assert "held out" in text.stdout and "order  4" in text.stdout, text.stdout
    bad = subprocess.run([*words[:6], f"80mm={tmp_path / 'none'}", "-o", str(tmp_path / "x.yaml")], env=environment, capture_output=True, text=True, check=False)
    assert bad.returncode in (2, 3) and "none" in bad.stderr, bad.stderr
    wrong = subprocess.run([*words[:6], "soon=walls", "-o", "x.yaml"], env=environment, capture_output=True, text=True, check=False)
    assert wrong.returncode == 2 and "such as 0.8m=walls/b" in wrong.stderr
