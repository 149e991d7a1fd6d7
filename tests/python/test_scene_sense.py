# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What of a scene is seldom meant, and why pixels have no depth, from Python."""

from __future__ import annotations

import pytest

import tofray


def ball(z: float) -> tofray.Scene:
    return tofray.scene({"objects": [{"sphere": {"name": "ball", "center": [0, 0, z], "radius": "25 cm", "reflectivity": 0.5}}]})


def test_a_ball_behind_the_camera_is_found() -> None:
    scene = ball(-2)
    report = tofray.scene_report(scene, tofray.load_camera(scene))
    assert [one.kind for one in report.findings] == ["behind_camera"]
    assert report.findings[0].warning and report.findings[0].objects == [0] and report.findings[0].where == ""
    assert report.findings[0].what == "objects.0 (ball) is behind the camera, whose rays hit nothing"
    assert report.no_surface == report.pixels and report.nearest_m is None
    assert report.objects[0].behind_camera and report.objects[0].low[2] == -2.25


def test_a_frame_and_one_ray_for_each_pixel_say_the_same() -> None:
    scene = ball(1.5)
    camera = tofray.load_camera(scene)
    frame = tofray.Simulator(scene, camera).frame(0)
    by_frame, by_rays = tofray.scene_report(scene, camera, frame), tofray.scene_report(scene, camera)
    by_frame.time_s = by_rays.time_s
    assert by_frame == by_rays
    assert by_rays.findings == [] and by_rays.nearest_m == pytest.approx(1.25, abs=1e-3)
    pixels = tofray.invalid_pixels(frame, camera)
    assert pixels.no_surface > pixels.pixels // 2 and pixels.low_signal == 0
    # A recording has no truth.
    recorded = tofray.Frame(raw=frame.raw, depth=frame.depth)
    blind = tofray.invalid_pixels(recorded, camera)
    assert blind.no_surface == 0 and blind.low_signal + blind.no_return == pixels.no_surface + pixels.dark


def test_a_bare_radius_is_refused_as_a_bare_pixel_pitch_is() -> None:
    with pytest.raises(tofray.Error, match=r"objects\[0\]\.sphere\.radius: error: radius has no unit"):
        tofray.scene({"objects": [{"sphere": {"center": [0, 0, 1], "radius": 0.25, "reflectivity": 0.5}}]})
    assert tofray.Sphere(center=(0, 0, 1), radius=0.25).radius == 0.25  # metres, as all members of classes are


def test_the_truth_of_another_scene_is_refused() -> None:
    scene = tofray.load_scene("demo")
    frame = tofray.Simulator(scene, tofray.load_camera(scene)).frame(0)
    with pytest.raises(tofray.Error, match="the truth is of another scene"):
        tofray.scene_report(ball(1), tofray.load_camera(scene), frame)
