# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.quality against definitions written anew with numpy; tofray.compare; files of depth."""

from __future__ import annotations

import pathlib
import warnings
from typing import Any

import numpy as np
import pytest

import tofray


def wall_frames(count: int = 5) -> list[tofray.Frame]:
    """A wall that is turned a little, seen with noise, by a camera whose corners are too dark."""
    scene = tofray.scene({"camera": {"profile": "pico-flexx"}, "objects": [
        {"plane": {"point": [0, 0, 2.1], "normal": [0.2, 0.1, -1], "reflectivity": "40 %"}}]})
    simulator = tofray.Simulator(scene, tofray.load_camera("pico-flexx", set={"decoding.filter.kind": "none"}), seed=4)
    return [simulator.frame(i) for i in range(count)]


def realsense(frames: list[tofray.Frame], region: tuple[int, int, int, int], truth: float) -> dict[str, float]:
    """RealSense's numbers by another way than tofray's: the plane is z over x and y by least squares."""
    u, v, width, height = region
    cut = (slice(v, v + height), slice(u, u + width))
    fill, rms, percent, accuracy, stack = [], [], [], [], []
    for frame in frames:
        invalid = (frame.depth.flags[cut] & tofray.flags["invalid"]) != 0
        z = np.where(invalid, np.nan, frame.depth.z_m[cut].astype(float))
        stack.append(z)
        good = np.isfinite(z)
        points = frame.depth.points_m[cut].astype(float)[good]
        fill.append(100 * good.mean())
        middle = points.mean(axis=0)
        (a, b), *_ = np.linalg.lstsq(points[:, :2] - middle[:2], points[:, 2] - middle[2], rcond=None)
        # z - a x - b y - c = 0, of unit normal
        c = middle[2] - a * middle[0] - b * middle[1]
        sort = points[np.argsort(points[:, 2], kind="stable")]
        outliers = len(sort) // 200
        kept = sort[outliers:len(sort) - outliers]
        distance = (kept[:, 2] - a * kept[:, 0] - b * kept[:, 1] - c) / np.sqrt(a * a + b * b + 1)
        rms.append(np.sqrt(np.mean(distance ** 2)))
        percent.append(100 * rms[-1] / c)
        accuracy.append(100 * np.sort(c - truth + distance)[len(distance) // 2] / truth)
    tensor = np.array(stack)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)  # pixels that are never valid
        shares = np.nan_to_num(np.nanstd(tensor, axis=0) / np.nanmedian(tensor, axis=0), nan=0.0)
    return {"fill_rate_percent": np.mean(fill), "plane_fit_rms_m": np.mean(rms), "plane_fit_rms_percent": np.mean(percent),
            "z_accuracy_percent": np.mean(accuracy), "temporal_noise_percent": 100 * np.median(shares)}


@pytest.mark.parametrize("region", [(0, 0, 224, 172), (20, 10, 151, 101)])
def test_numbers_of_realsense_are_those_of_their_definitions(region: tuple[int, int, int, int]) -> None:
    frames = wall_frames()
    expected = realsense(frames, region, 2.05)
    got = tofray.quality(frames, region=region, truth_m=2.05)
    if region[0] == 0:
        assert 50 < expected["fill_rate_percent"] < 99.9, "pixels without a depth are part of the test"
    for name, value in expected.items():
        assert got[name] == pytest.approx(value, rel=1e-9, abs=1e-12), name


def test_noise_over_frames_and_pixels_is_that_of_numpy() -> None:
    frames = wall_frames()
    region = (80, 60, 50, 40)
    got = tofray.quality(frames, region=region)
    stack = np.array([frame.depth.z_m[60:100, 80:130] for frame in frames]).astype(float)
    assert np.isfinite(stack).all()
    assert got["temporal_noise_m"] == pytest.approx(np.sqrt(stack.var(axis=0, ddof=1).mean()), rel=1e-9)
    truth = frames[0].truth.z_m[60:100, 80:130].astype(float)
    assert got["bias_m"] == pytest.approx((stack - truth).mean(), rel=1e-9, abs=1e-12)
    assert got["rmse_m"] == pytest.approx(np.sqrt(((stack - truth) ** 2).mean()), rel=1e-9)
    variance = np.array([frame.depth.range_m[60:100, 80:130] for frame in frames]).astype(float).var(axis=0, ddof=1)
    claimed = (np.array([frame.depth.noise_m[60:100, 80:130] for frame in frames]).astype(float) ** 2).mean(axis=0)
    assert got["outliers_percent"] == 0
    assert got["noise_chi2"] == pytest.approx((variance / claimed).mean(), rel=1e-9)


def test_conditions_of_a_maker_are_told() -> None:
    got = tofray.quality(wall_frames(1), like="vzense")
    assert got.region == (107, 81, 10, 10) and got.frames == 1
    assert got.notes == ["Vzense DS86/DS87 takes 32 frames; these are 1"]
    assert np.isnan(got["temporal_noise_m"])


def test_a_comparison_is_that_of_numpy() -> None:
    frame = wall_frames(1)[0]
    got = tofray.compare(frame)
    difference = frame.depth.z_m.astype(float) - frame.truth.z_m.astype(float)
    kept = difference[np.isfinite(difference)]
    assert got["both"] == kept.size and got["only_b"] == difference.size - kept.size
    assert got["all"]["bias_m"] == pytest.approx(kept.mean(), rel=1e-9, abs=1e-12)
    assert got["all"]["sigma_m"] == pytest.approx(kept.std(ddof=1), rel=1e-9)
    assert got["all"]["p95_m"] == pytest.approx(np.percentile(np.abs(kept), 95), rel=1e-9)
    np.testing.assert_array_equal(got["map_m"], difference.astype(np.float32))
    assert got["histogram"].sum() == kept.size
    assert tofray.compare(frame.depth, frame.truth)["all"] == got["all"]
    assert tofray.compare(frame, quantity="range")["all"]["sigma_m"] > got["all"]["sigma_m"]
    assert abs(tofray.compare(frame, fit_shift=True)["all"]["median_m"]) < 1e-9
    assert sum(one["pixels"] for one in tofray.compare(frame, distances_m=[1, 2, 3, 9])["by_distance"]) == got["all"]["pixels"]
    assert tofray.compare(frame, region=(1, 2, 30, 20))["map_m"].shape == (20, 30)


def test_files_of_depth_are_read(tmp_path: pathlib.Path) -> None:
    frame = wall_frames(1)[0]
    frame.save(tmp_path / "a")
    (one,) = tofray.load_depth(tmp_path / "a" / "frame.npz")
    np.testing.assert_array_equal(one.depth.z_m, frame.depth.z_m)
    np.testing.assert_array_equal(one.truth.z_m, frame.truth.z_m)
    np.save(tmp_path / "z.npy", frame.depth.z_m * 1000)
    (z,) = tofray.load_depth(tmp_path / "z.npy", unit_m=1e-3, intrinsics=(200, 200, 111.5, 85.5))
    np.testing.assert_allclose(z.depth.z_m, frame.depth.z_m, rtol=1e-6)
    assert z.depth.points_m.shape == (172, 224, 3)


def test_a_figure_shows_the_map_and_the_histogram() -> None:
    pytest.importorskip("matplotlib")
    image, bars, *_ = tofray.compare(wall_frames(1)[0]).plot().axes
    assert image.get_images()[0].get_array().shape == (172, 224)
    assert len(bars.patches) == 41


def test_what_cannot_be_is_refused() -> None:
    frame = wall_frames(1)[0]
    wrong: list[Any] = [lambda: tofray.quality([]), lambda: tofray.quality(frame, region=(0, 0, 300, 1)), lambda: tofray.quality(frame, like="x"),
                        lambda: tofray.quality([3]),  # type: ignore[list-item]
                        lambda: tofray.compare(frame.depth), lambda: tofray.compare(frame, quantity="y"),
                        lambda: tofray.compare(frame, distances_m=[2, 1]), lambda: tofray.load_depth("nowhere.npz")]
    for call in wrong:
        with pytest.raises(tofray.Error):
            call()
