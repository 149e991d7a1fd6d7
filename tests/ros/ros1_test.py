#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""ros1_test.py TOFRAY: a film's messages as Debian's ROS 1 takes them: image_geometry and camera_calibration, whose messages have the
fields of ROS 2's. No node and no network: classes of Python alone."""

from __future__ import annotations

import math
import pathlib
import sys
import tempfile
import unittest

try:
    import cv2
    import numpy as np
    from camera_calibration.calibrator import ChessboardInfo, MonoCalibrator
    from image_geometry import PinholeCameraModel
except ImportError as error:
    print(f"SKIPPED: {error} (Debian: python3-image-geometry python3-camera-calibration python3-cv-bridge)")
    sys.exit(77)

import messages_test
import ros1

# OpenCV takes distortion out in five steps, which this lens needs no more than: of one with k1 = -0.31 they are off by 0.2 mm in a corner.
LENS = {"k1": -0.08, "k2": 0.02, "p1": 0.002, "p2": -0.001, "k3": -0.005}
RATIONAL = {**LENS, "k4": 0.05, "k5": 0.02, "k6": 0.01}


def run_of(lens: dict, *words: object, scene: str = "card") -> messages_test.Run:
    distortion = ", ".join(f"{name}: {value}" for name, value in lens.items())
    return messages_test.Run("--noise", "off", "--set", f"camera.lens.distortion={{{distortion}}}", *words, scene=scene, frames=1)


class Geometry(unittest.TestCase):
    """A pixel's ray by image_geometry, times z, is its point."""

    def off_mm(self, info, points: np.ndarray) -> float:
        model, off = PinholeCameraModel(), []
        model.fromCameraInfo(info)
        for v, u in ros1.pixels(*points.shape[:2], 7):
            if np.isfinite(points[v, u, 2]):
                x, y, z = model.projectPixelTo3dRay(model.rectifyPoint((u, v)))
                off.append(np.abs(np.array([x / z, y / z, 1]) * points[v, u, 2] - points[v, u]).max())
        self.assertGreater(len(off), 100)
        return 1e3 * max(off)

    def check(self, lens: dict, model: str, *words: object) -> None:
        run = run_of(lens, *words)
        info, points = ros1.camera_info(run.value("/camera/camera_info")), run.frames[0]["points_m"].astype(float)
        self.assertEqual(info.distortion_model, model)
        self.assertLess(self.off_mm(info, points), 0.01)
        if any(lens.values()):   # the test can fail
            info.D = [*info.D[:2], info.D[4], info.D[3], info.D[2], *info.D[5:]]
            self.assertGreater(self.off_mm(info, points), 1)

    def test_plumb_bob(self):
        self.check(LENS, "plumb_bob")

    def test_plumb_bob_of_a_region_and_binned(self):
        self.check(LENS, "plumb_bob", "--set", "camera.readout={binning: 2, region: {left: 20, top: 10, width: 160, height: 120}}")

    def test_rational_polynomial(self):
        self.check(RATIONAL, "rational_polynomial")

    def test_a_pinhole(self):
        self.check(dict.fromkeys(LENS, 0), "plumb_bob")


# Twice as many pixels as the profile has, for corners are found to 0.1 pixels whatever their number, and light that reaches the picture's corners.
CHANGED = [word for change in ("sensor.width=448", "sensor.height=344", "lens.fx=424px", "lens.fy=424px", "lens.cx=223.5px", "lens.cy=171.5px",
                               "lens.vignetting=off", *(f"illumination.0.pattern.{name}=150deg" for name in ("width", "height")),
                            *(f"illumination.0.pattern.half_range_{axis}=85deg" for axis in "xy")) for word in ("--set", f"camera.{change}")]
SQUARE_M, ACROSS, DOWN = 0.024, 11, 8   # squares, of which the corners within are found


def chessboard() -> str:
    """A scene: squares of one plane, 0.5 m from the camera, with a white rim."""
    objects = []
    for row in range(-1, DOWN + 1):
        for column in range(-1, ACROSS + 1):
            black = (row + column) % 2 == 0 and 0 <= row < DOWN and 0 <= column < ACROSS
            x, y = ((2 * i + 1 - count) * SQUARE_M / 2 for i, count in ((column, ACROSS), (row, DOWN)))
            objects.append(f"  - rectangle: {{center: [{x:.4f}, {y:.4f}, 0.5], size: [{SQUARE_M}, {SQUARE_M}], reflectivity: {0.05 if black else 0.9}}}")
    return "\n".join(["camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", "objects:", *objects, ""])


class Calibration(unittest.TestCase):
    """Who shows a chessboard to the simulated camera finds the lens that was simulated."""

    def test_amplitudes_of_a_chessboard_give_the_lens_back(self):
        images = []
        calibrator = MonoCalibrator([ChessboardInfo("chessboard", ACROSS - 1, DOWN - 1, SQUARE_M)],
                                    flags=cv2.CALIB_ZERO_TANGENT_DIST | cv2.CALIB_FIX_K3)
        lens = {"k1": -0.2, "k2": 0.08, "p1": 0, "p2": 0, "k3": 0}
        with tempfile.TemporaryDirectory() as folder:
            scene = pathlib.Path(folder) / "board.yaml"
            scene.write_text(chessboard(), encoding="utf-8")
            for i in range(20):
                where, aside = 2 * math.pi * i / 20, (0.12, 0.25)[i % 2]   # m beside the board's axis: seen obliquely
                at = (aside * math.cos(where), aside * math.sin(where), 0.06 * math.cos(3 * where))
                to = (0.05 * (1, 1, -1, -1)[i % 4], 0.03 * (1, -1)[i // 2 % 2])   # the board comes into each corner of the picture
                roll = 2.4 * i   # and in each by another angle, so that no edge lies along the samples
                up = [round(math.sin(roll), 4), round(-math.cos(roll), 4), 0]
                run = run_of(lens, *CHANGED, "--subpixel", 3, "--topics", "amplitude", "--amplitude-step", 0.075, "--set",
                             f"camera.pose={{position: [{at[0]:.4f}, {at[1]:.4f}, {at[2]:.4f}], look_at: [{to[0]:.4f}, {to[1]:.4f}, 0.5], up: {up}}}",
                             scene=str(scene))
                images.append(calibrator.mkgray(ros1.image(run.value("/camera/amplitude_image"))))
        info = run.value("/camera/camera_info")
        corners = calibrator.collect_corners(images)
        self.assertGreaterEqual(len(corners), 10)
        calibrator.cal_fromcorners(corners)
        known, found, (k1, k2) = np.reshape(info["k"], (3, 3)), calibrator.intrinsics, calibrator.distortion.ravel()[:2]
        for i in range(2):
            self.assertLess(abs(found[i, i] / known[i, i] - 1), 0.003)
            self.assertLess(abs(found[i, 2] - known[i, 2]), 0.5)
        r = np.linspace(0, 0.5, 50)   # as far out as corners are found; k1 and k2 alone trade with each other
        aside_px = known[0, 0] * r**3 * ((k1 - lens["k1"]) + (k2 - lens["k2"]) * r**2)
        self.assertLess(np.abs(aside_px).max(), 0.5)


if __name__ == "__main__":
    messages_test.TOFRAY = sys.argv.pop(1)
    unittest.main(verbosity=1)
