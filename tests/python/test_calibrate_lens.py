# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""tofray.calibrate_lens: who shows a chessboard to a simulated camera finds the lens that was simulated, and how well it is known."""

from __future__ import annotations

import functools
import json
import math
import os
import pathlib
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import tofray

cv2 = pytest.importorskip("cv2", reason="OpenCV is missing (Debian: python3-opencv)")

LENS = "{k1: -0.08, k2: 0.02, p1: 0.002, p2: -0.001, k3: -0.005}"
ACROSS, DOWN, SQUARE_M = 12, 9, 0.024
WIDTH, HEIGHT = 224, 172


@functools.lru_cache(maxsize=None)
def camera() -> tofray.Camera:
    """Light that reaches all corners of the image."""
    wide = {f"illumination.0.pattern.{name}": "150deg" for name in ("width", "height")} | {f"illumination.0.pattern.half_range_{axis}": "85deg" for axis in "xy"}
    out = tofray.load_camera("pico-flexx", set={"lens.distortion": LENS, "lens.vignetting": "off", **wide})
    out.decoding.flying_check = False
    return out


@functools.lru_cache(maxsize=None)
def simulator() -> tofray.Simulator:
    squares = []
    for row in range(-1, DOWN + 1):
        for column in range(-1, ACROSS + 1):
            black = (row + column) % 2 == 0 and 0 <= row < DOWN and 0 <= column < ACROSS
            middle = [(2 * i + 1 - count) * SQUARE_M / 2 for i, count in ((column, ACROSS), (row, DOWN))]
            squares.append({"rectangle": {"center": [*middle, 0], "size": [SQUARE_M, SQUARE_M], "reflectivity": 0.05 if black else 0.9}})
    return tofray.Simulator(tofray.scene({"objects": squares}), camera(), noise="off", subpixel=8, last_stage="depth")


def pose(number: int, tilt_deg: float, distance: float, aside: tuple[float, float], roll_deg: float = 17.0) -> Any:
    """Of a camera that looks at a place of the board: to the side by turns, and no edge along the pixels' rows."""
    where, tilt, roll = 2.4 * number, math.radians(tilt_deg), math.radians(roll_deg * (1, -1)[number % 2])
    forward = np.array([math.sin(tilt) * math.cos(where), math.sin(tilt) * math.sin(where), math.cos(tilt)])
    right = np.array([math.cos(roll), math.sin(roll), 0])
    right -= forward * (right @ forward)
    right /= np.linalg.norm(right)
    out = np.eye(4)
    out[:3, :3] = np.stack([right, np.cross(forward, right), forward], axis=1)
    out[:3, 3] = np.array([*aside, 0]) - distance * forward
    return out


def places(of: Any) -> Any:
    """True corners in the image."""
    points = [[(i + 1 - ACROSS / 2) * SQUARE_M, (j + 1 - DOWN / 2) * SQUARE_M, 0] for j in range(DOWN - 1) for i in range(ACROSS - 1)]
    lens, world = camera().lens, np.linalg.inv(of)
    matrix = np.array([[lens.fx_px, 0, lens.cx_px], [0, lens.fy_px, lens.cy_px], [0, 0, 1]])
    return cv2.projectPoints(np.array(points), cv2.Rodrigues(world[:3, :3])[0], world[:3, 3], matrix, np.array([lens.k1, lens.k2, lens.p1, lens.p2, lens.k3]))[0][:, 0]


@functools.lru_cache(maxsize=None)
def poses(count: int = 16, first: int = 0) -> list[Any]:
    """Boards within the image that reach its rim: another set for each first seed."""
    out: list[Any] = []
    for seed in range(first, first + 200):
        if len(out) == count:
            break
        random = np.random.default_rng(seed)
        for i in range(20):
            tilt, distance, far, roll = random.uniform(15, 40), random.uniform(0.3, 0.6), random.uniform(0.7, 1), random.uniform(12, 32)
            one = pose(i, tilt, distance, (0.12 * far * (1, 1, -1, -1, 0)[i % 5], 0.09 * far * (1, -1, -1, 1, 0)[i % 5]), roll)
            at = places(one)
            if 3 < min(at.min(), (WIDTH - 1 - at[:, 0]).min(), (HEIGHT - 1 - at[:, 1]).min()) < 8 and len(out) < count:
                out.append(one)
    return out


def image(of: Any) -> Any:
    return np.asarray(simulator().frame(0, camera=tofray.Pose.from_matrix(of)).depth.amplitude_e, float)


@functools.lru_cache(maxsize=None)
def images() -> list[Any]:
    return [image(one) for one in poses()]


def started_elsewhere() -> tofray.Camera:
    return tofray.load_camera("pico-flexx", set={"lens.fx": "200 px", "lens.fy": "200 px", "lens.cx": "108 px", "lens.distortion": "{k1: 0}"})


def calibrated(given: Any = None, of: tofray.Camera | None = None, **words: Any) -> tofray.LensCalibration:
    return tofray.calibrate_lens(of or started_elsewhere(), images() if given is None else given, board=(ACROSS - 1, DOWN - 1), square_m=SQUARE_M, **words)


@functools.lru_cache(maxsize=None)
def found() -> tofray.LensCalibration:
    return calibrated()


def off_px(lens: tofray.Lens) -> Any:
    """By how much a pixel's true ray comes to lie beside it by the lens that was found: by OpenCV's own projection."""
    rays = tofray.pixel_rays(camera()).astype(float).reshape(-1, 2)
    matrix = np.array([[lens.fx_px, 0, lens.cx_px], [0, lens.fy_px, lens.cy_px], [0, 0, 1]])
    bent = np.array([lens.k1, lens.k2, lens.p1, lens.p2, lens.k3, lens.k4, lens.k5, lens.k6])
    at = cv2.projectPoints(np.column_stack([rays, np.ones(len(rays))]), np.zeros(3), np.zeros(3), matrix, bent)[0][:, 0]
    v, u = np.mgrid[:HEIGHT, :WIDTH]
    return np.hypot(at[:, 0] - u.ravel(), at[:, 1] - v.ravel())


def test_pixels_look_where_they_truly_look_to_two_hundredths_of_a_pixel() -> None:
    off = off_px(found().lens)
    rms = float(np.sqrt((off**2).mean()))
    assert rms < 0.02 and off.max() < 0.08, (rms, off.max())
    assert rms < 3 * found().ray_error_px < 0.15, (rms, found().ray_error_px)
    assert found().change_px > 3, found().change_px   # of the lens that it started from


@pytest.mark.skipif(not os.environ.get("TOFRAY_LONG"), reason="three sets of 48 images: with TOFRAY_LONG=1")
@pytest.mark.parametrize("first", [1000, 2000, 3000])
def test_forty_eight_boards_tell_it_to_two_hundredths_of_a_pixel_whichever_they_are(first: int) -> None:
    off = off_px(calibrated([image(one) for one in poses(48, first)], held_out=[]).lens)
    assert np.sqrt((off**2).mean()) < 0.02 and off.max() < 0.15


def test_what_is_left_is_a_hundredth_of_a_pixel_of_images_held_out_too() -> None:
    assert found().residual_px < 0.015 and found().held_out_px < 0.02, str(found())
    assert found().views == 16 and found().corners == 88 and len(found().residuals_px) == 16


def test_values_are_within_four_standard_errors() -> None:
    lens = camera().lens
    true = {"fx": lens.fx_px, "fy": lens.fy_px, "cx": lens.cx_px, "cy": lens.cy_px, "k1": lens.k1, "k2": lens.k2, "p1": lens.p1, "p2": lens.p2, "k3": lens.k3}
    assert found().model == "plumb_bob" and set(found().values) == set(true)
    for name, value in true.items():
        assert abs(found().values[name] - value) < 4 * found().errors[name], name


def test_a_fisheye_is_found() -> None:
    # Of the same pixels: a plain lens through which the angle to the axis and r part by less than their fourth order.
    said = calibrated(images()[:5], model="equidistant", held_out=[])
    assert said.model == "equidistant" and said.residual_px < 0.1 and math.isnan(said.held_out_px)
    assert said.values["fx"] == pytest.approx(212, abs=2) and said.lens.distortion == "fisheye"


def test_frontal_views_do_not_say_the_focal_length() -> None:
    front = [image(pose(i, 0, 0.32 + 0.03 * i, (0.01 * i, 0))) for i in range(4)]
    with pytest.raises(tofray.Error, match="the images do not say what the focal length is"):
        calibrated(front)


def test_what_cannot_be_is_refused(tmp_path: pathlib.Path) -> None:
    with pytest.raises(tofray.Error, match=r"image 1: error: no board of 11 x 8 inner corners is found in it"):
        calibrated([images()[0], np.ones((HEIGHT, WIDTH)), *images()[:2]])
    with pytest.raises(tofray.Error, match="image 1: error: the image is not of the camera's sensor\n  got 223 x 172 pixels, expected 224 x 172"):
        calibrated([images()[0], images()[1][:, 1:], *images()[:2]])
    with pytest.raises(tofray.Error, match="too few images\n  got 3, 0 of them held out"):
        calibrated(images()[:3])
    with pytest.raises(tofray.Error, match="held_out has an image that there is not"):
        calibrated(images()[:4], held_out=[4])
    with pytest.raises(tofray.Error, match="got squares of -1 m"):
        tofray.calibrate_lens(camera(), images(), board=(11, 8), square_m=-1)
    with pytest.raises(tofray.Error, match="got a board of 1 x 8 inner corners"):
        tofray.calibrate_lens(camera(), images(), board=(1, 8), square_m=1)
    with pytest.raises(tofray.Error, match="got the model 'pinhole'"):
        calibrated(model="pinhole")
    (tmp_path / "text.png").write_text("no image")
    with pytest.raises(tofray.Error, match="text.png: error: this is no image"):
        calibrated([tmp_path / "text.png"] * 4)
    with pytest.raises(tofray.Error, match="gone.png: error: there is no such file"):
        calibrated([tmp_path / "gone.png"] * 4)


def test_a_rim_that_no_corner_reaches_is_said() -> None:
    middle = [image(pose(i, 30, 0.6, (0, 0))) for i in range(4)]
    notes = calibrated(middle).notes
    assert any("no corner of the board comes near to these corners of the image: upper left" in one for one in notes), notes


def test_the_command_writes_what_becomes_a_profile(tmp_path: pathlib.Path) -> None:
    files = []
    for i, one in enumerate(images()[:6]):
        files.append(str(tmp_path / f"{i}.png"))
        cv2.imwrite(files[-1], np.clip(8 * one, 0, 65535).astype(np.uint16))
    words = [sys.executable, "-m", "tofray", "calibrate", "lens", "pico-flexx", *files, "--square", "24mm", "-o", str(tmp_path / "lens.yaml")]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}

    def run(*more: str) -> Any:
        return subprocess.run([*words, *more], env=environment, capture_output=True, text=True, check=False)

    good = run("--board", "11x8", "--json", "--held-out", "2")
    assert good.returncode == 0, good.stderr
    said = json.loads(good.stdout)
    assert said["images"] == 6 and said["held_out_px"] < 0.05 and abs(said["values"]["fx"] - 212) < 5 * said["errors"]["fx"] < 2
    text = (tmp_path / "lens.yaml").read_text()
    assert "distortion_model: plumb_bob" in text and "image_width: 224" in text and "rows: 1, cols: 5" in text
    bad = run("--board", "11")
    assert bad.returncode == 2 and "such as 11x8" in bad.stderr, bad.stderr
    missing = run("--board", "10x8")
    assert missing.returncode == 2 and ".png: error: no board of 10 x 8" in missing.stderr, missing.stderr
