# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.budget: arrays of what C++ says."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import tofray


def test_arrays_have_the_axes_of_what_is_asked() -> None:
    got = tofray.budget(tofray.load_camera("pico-flexx"), [0.1, 1, 2], [0.2, 0.8], [0, 20e3])
    assert got["sigma_m"].shape == (2, 2, 3) and got["sigma_m"].dtype == np.float64
    assert got["frequency_sigma_m"].shape == (2, 2, 3, 2)
    assert got["modulation_frequency_hz"][0, 0, 0].tolist() == [80.32e6, 60.24e6]
    assert got["z_m"][1, 1].tolist() == [0.1, 1, 2] and got["reflectivity"][0, :, 0].tolist() == [0.2, 0.8]
    assert (got["ambient_e"][0] == 0).all() and (got["ambient_e"][1] > 0).all()
    assert got["saturated"][0, 1].tolist() == [True, False, False] and np.isnan(got["sigma_m"][0, 1, 0])
    assert got.summary["reach_m"].shape == (2, 2)
    assert got.summary["background_light_rejection"] is None


def test_numbers_are_those_of_the_camera_report() -> None:
    camera = tofray.load_camera("flexx2")
    report = tofray.camera_report(camera, tofray.CameraQuestion(distances_m=[0.7, 3], reflectivities=[0.3], ambients=[tofray.AmbientCase()]))
    got = tofray.budget(camera, [0.7, 3], [0.3])
    assert [one.sigma_m for one in report.noise[0].at] == got["sigma_m"][0, 0].tolist()
    assert [one.wrong_cycle for one in report.noise[0].at] == got["wrong_cycle"][0, 0].tolist()


def test_each_word_reaches_the_budget() -> None:
    camera = tofray.load_camera("pico-flexx")
    plain = tofray.budget(camera, [1.0], [0.5])
    assert tofray.budget(camera, [1.0], [0.5], angle_rad=0.5)["irradiance_w_m2"] < plain["irradiance_w_m2"]
    assert tofray.budget(camera, [1.0], [0.5], pixel=(0, 0))["range_m"] > 1.1 * plain["range_m"]
    assert tofray.budget(camera, [0.1], [0.9], auto_exposure=True)["exposure"] < 0.5
    camera.pixel.dark_current_doubling_k = 8
    assert tofray.budget(camera, [1.0], [0.5], temperature_celsius=80)["dark_e"] > 2 * plain["dark_e"]


@pytest.mark.parametrize("name, lux, reflectivity", [("pico-flexx", 1e5, 0.3), ("kinect-v2", 2e4, 0.9), ("opt8241", 50, 0.02)])
def test_ambient_light_has_its_closed_form(name: str, lux: float, reflectivity: float) -> None:
    """Of an even spectrum E_λ = lux/(683 lm/W · ∫V dλ), ∫V dλ = 106.86 nm; through a filter with straight sides, lens and pixel
    [theory: ambient-light, image-irradiance, pixel-power]."""
    camera = tofray.load_camera(name)
    camera.filter = tofray.Filter(center_m=camera.filter.center_m, half_width_m=12e-9, peak=0.75)
    camera.pixel.quantum_efficiency = tofray.Curve(x=[400e-9, 1100e-9], y=[0.5, 0.5])
    light = tofray.Ambient(spectrum="equal_energy", quantity="illuminance_lx", amount=lux)
    got = tofray.budget(camera, [1.0], reflectivity=[reflectivity], ambient=[tofray.AmbientCase(name="even", ambient=light)])
    irradiance = lux / 683 / 106.857e-9 * 0.75 * 24e-9
    assert got["ambient_irradiance_w_m2"].item() == pytest.approx(irradiance, rel=1e-3)
    lens, sensor = camera.lens, camera.sensor
    radiance = reflectivity * irradiance / math.pi
    power = math.pi * lens.transmission * radiance / (4 * lens.f_number**2) * sensor.pixel_pitch_m**2 * sensor.fill_factor
    assert got["ambient_power_w"].item() == pytest.approx(power, rel=1e-3)
    charge = power * 0.5 * camera.filter.center_m / (6.62607015e-34 * 299792458) * got["frequency_integration_time_s"].max()
    assert got["ambient_e"].item() == pytest.approx(charge, rel=1e-3)


def test_what_cannot_be_is_refused() -> None:
    camera = tofray.load_camera("pico-flexx")
    wrongs: list[dict[str, Any]] = [{"distance_m": []}, {"distance_m": [0]}, {"reflectivity": [2]}, {"ambient": ["sun"]}, {"angle_rad": 20}, {"pixel": (999, 0)}]
    for wrong in wrongs:
        with pytest.raises(tofray.Error):
            tofray.budget(camera, **wrong)


def test_a_figure_shows_noise_and_shares() -> None:
    pytest.importorskip("matplotlib")
    figure = tofray.budget(tofray.load_camera("pico-flexx"), np.linspace(0.3, 5, 20), ambient=[0, 20e3]).plot()
    noise, shares = figure.axes
    assert len(noise.lines) == 5 and noise.get_yscale() == "log"
    assert shares.get_ylim() == (0, 100)
