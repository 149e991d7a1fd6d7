# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Sweeps: numbers of numpy on frames of the simulator, files, pictures, what is refused."""

from __future__ import annotations

import json
import pathlib
from typing import Any

import numpy as np
import pytest

import tofray
from tofray import plot

REGION = (60, 40, 101, 83)


def frames_of(count: int, **set: Any) -> list[tofray.Frame]:
    inputs = tofray.load_inputs("grey-cards", set=set)
    simulator = tofray.Simulator(inputs.scene, inputs.camera, seed=5)
    return [simulator.frame(i) for i in range(count)]


def by_numpy(frames: list[tofray.Frame], camera: tofray.Camera, chosen: np.ndarray[Any, Any]) -> dict[str, float]:
    """The metrics by another way than tofray's, of the chosen pixels."""
    z = np.array([np.where(frame.depth.flags & tofray.flags["invalid"], np.nan, frame.depth.z_m.astype(float)) for frame in frames])[:, chosen]
    truth = np.array([frame.truth.z_m.astype(float) for frame in frames])[:, chosen]
    error = z - truth
    flat = error[np.isfinite(error)]
    valid = np.isfinite(z)
    ranges = np.array([frame.depth.range_m.astype(float) - frame.truth.range_m.astype(float) for frame in frames])[:, chosen]
    half_cycle = 299792458.0 / 4 / max(one.modulation_frequency_hz for one in camera.mode.sequence if one.lit) / camera.refractive_index
    lit = frames[0].raw.lit.astype(bool)
    taps = np.array([np.maximum(frame.raw.tap_a, frame.raw.tap_b)[lit].max(axis=0) for frame in frames])[:, chosen]
    whole = np.isfinite(error).all(axis=0)
    return {
        "bias_m": flat.mean(), "median_m": np.median(flat), "rmse_m": np.sqrt((flat ** 2).mean()), "p95_m": np.percentile(np.abs(flat), 95),
        "fill_percent": 100 * valid.mean(), "wrong_cycle_percent": 100 * (np.abs(ranges[np.isfinite(error)]) > half_cycle).mean(),
        "sigma_m": np.sqrt(error[:, whole].var(axis=0, ddof=1).mean()),
        "amplitude_e": np.array([frame.depth.amplitude_e.astype(float) for frame in frames])[:, chosen][valid].mean(),
        "tap_filling_percent": 100 * taps.astype(float).mean() / camera.pixel.full_well_e,
        "low_signal_percent": 100 * np.mean([(frame.depth.flags[chosen] & tofray.flags["low_signal"]) != 0 for frame in frames]),
    }


@pytest.fixture(scope="module")
def found() -> tofray.Sweep:
    return tofray.sweep("grey-cards", {"camera.pixel.read_noise": ["20 e", "300 e"], "decoding.noise_threshold": "20 mm:60 mm:2"}, seed=5, repeat=4,
                        region=REGION, by_object=True)


def test_numbers_of_cells_are_those_of_numpy(found: tofray.Sweep) -> None:
    column, row, width, height = REGION
    for i, noise in enumerate(found.texts["camera.pixel.read_noise"]):
        for j, threshold in enumerate(found.texts["camera.decoding.noise_threshold"]):
            frames = frames_of(4, **{"camera.pixel.read_noise": noise, "camera.decoding.noise_threshold": threshold})
            camera = tofray.load_inputs("grey-cards").camera
            chosen = np.zeros(frames[0].depth.z_m.shape, bool)
            chosen[row:row + height, column:column + width] = True
            for name, expected in by_numpy(frames, camera, chosen).items():
                assert found[name][i, j, 0] == pytest.approx(expected, rel=1e-9, abs=1e-12), (name, i, j)
            objects = frames[0].truth.object_id
            key = found.regions[1].split(" ")[0]
            of_object = chosen & (objects == int(key.split(".")[1]))
            for name, expected in by_numpy(frames, camera, of_object).items():
                assert found[name][i, j, 1] == pytest.approx(expected, rel=1e-9, abs=1e-12), (name, i, j)
    assert np.nanmin(found["fill_percent"]) < 90, "pixels without a depth are part of the test"


def test_axes_have_numbers_in_si_units_or_texts(found: tofray.Sweep) -> None:
    assert found.axes == {"camera.pixel.read_noise": [20.0, 300.0], "camera.decoding.noise_threshold": [0.02, 0.06]}
    assert found.units["camera.decoding.noise_threshold"] == "m"
    assert found["sigma_m"].shape == (2, 2, len(found.regions))
    assert found.counts["from_raw"] == 8 and found.counts["traced"] == 1
    words = tofray.sweep("card", {"mode": "@all"}, metrics=["fill"], noise="off")
    assert words.axes["mode"] == list(tofray.load_camera("pico-flexx").mode_names)


def test_one_frame_has_the_noise_that_the_camera_claims() -> None:
    one = tofray.sweep("card", {"adc.bits": [12]}, seed=1, metrics=["sigma", "noise"])
    inputs = tofray.load_inputs("card")
    depth = tofray.Simulator(inputs.scene, inputs.camera, seed=1).frame(0).depth
    valid = (depth.flags & tofray.flags["invalid"]) == 0
    noise = depth.noise_m[valid].astype(float)
    along = depth.z_m[valid].astype(float) / depth.range_m[valid].astype(float)
    assert one["sigma_m"][0, 0] == pytest.approx(np.sqrt(((noise * along) ** 2).mean()), rel=1e-9)
    assert one["noise_m"][0, 0] == pytest.approx(np.sqrt((noise ** 2).mean()), rel=1e-9)


def test_files_are_those_that_numpy_reads(tmp_path: pathlib.Path) -> None:
    seen: list[tuple[int, int]] = []
    swept = tofray.sweep("card", {"illumination.*.power": [0.1, 0.4], "lens.vignetting": ["cos4", "off"]}, metrics=["bias", "fill"], by_object=True,
                         folder=tmp_path / "out", each=lambda done, all: seen.append((done, all)))
    assert sorted(seen) == [(1, 4), (2, 4), (3, 4), (4, 4)]
    read = np.load(tmp_path / "out" / "sweep.npz")
    np.testing.assert_array_equal(read["bias_m"], swept["bias_m"])
    assert list(read["axes"]) == ["camera.illumination.*.power", "camera.lens.vignetting"]
    assert list(read["camera.lens.vignetting"]) == ["cos4", "off"]
    assert json.loads(str(read["meta"]))["axes"][0]["first_stage"] == "power"
    again = plot.load_sweep(tmp_path / "out")
    assert again.axes == swept.axes and again.regions == swept.regions and again.texts == swept.texts
    np.testing.assert_array_equal(again["fill_percent"], swept["fill_percent"])


def test_best_cells_are_places_along_the_axes(found: tofray.Sweep) -> None:
    best = found.best("sigma, fill>1%")
    assert len(best) == 1
    assert found["sigma_m"][..., 0][best[0]] == np.nanmin(found["sigma_m"][..., 0])
    assert found.best("fill>1000%, sigma") == []


def test_pictures_are_a_curve_a_map_and_several_maps(found: tofray.Sweep, tmp_path: pathlib.Path) -> None:
    pytest.importorskip("matplotlib")
    curve = tofray.sweep("card", {"illumination.0.power": "0.1W:1W:log4"}, metrics=["sigma", "fill"], noise="off", folder=tmp_path / "curve")
    (axes,) = curve.plot().axes
    np.testing.assert_allclose(axes.lines[0].get_ydata(), 1e3 * curve["sigma_m"][:, 0])
    assert axes.get_xscale() == "log" and axes.get_ylabel() == "sigma [mm]" and axes.get_xlabel() == "illumination.0.power [W]"
    image = found.plot("fill", region=1).axes[0].get_images()[0]
    np.testing.assert_array_equal(image.get_array(), found["fill_percent"][..., 1])
    many = tofray.sweep("card", {"adc.bits": [12, 13], "pixel.read_noise": ["1 e", "50 e"], "decoding.flying_pixel.check": "@all"}, metrics=["fill"],
                        noise="off")
    assert sum(len(one.get_images()) for one in many.plot("fill").axes) == 2
    assert plot.main([str(tmp_path / "curve"), "--metric", "fill"]) == 0
    assert (tmp_path / "curve" / "sweep.png").read_bytes().startswith(b"\x89PNG")


def test_what_cannot_be_is_refused(found: tofray.Sweep, tmp_path: pathlib.Path) -> None:
    wrong: list[Any] = [lambda: tofray.sweep("card", {}), lambda: tofray.sweep("card", {"adc.bit": [1]}), lambda: tofray.sweep("card", {"adc.bits": []}),
                        lambda: tofray.sweep("card", {"adc.bits": [12]}, metrics=["x"]),
                        lambda: tofray.sweep("card", {"adc.bits": [12]}, region=(0, 0, 999, 1)),
                        lambda: tofray.sweep("card", [1]),  # type: ignore[arg-type]
                        lambda: found.best("fill>5%"), lambda: found.plot("x"), lambda: found.plot(region=99), lambda: plot.load_sweep(tmp_path)]
    for call in wrong:
        with pytest.raises(tofray.Error):
            call()
    with pytest.raises(tofray.Error) as fault:
        tofray.sweep("card", {"illumination.0.power": [float("nan")]})
    assert "illumination.0.power" in str(fault.value)
    assert plot.main([str(tmp_path / "nowhere")]) == 2
