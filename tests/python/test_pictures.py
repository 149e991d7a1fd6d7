# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Pictures of a pinhole as the camera's lens sees them: tofray's own frames stand for another renderer's."""

from __future__ import annotations

import copy
import math
import warnings
from typing import Any, Callable

import numpy as np
import pytest

import tofray

CAMERA = tofray.load_camera("pico-flexx")
SCENE = tofray.scene({"objects": [
    {"plane": {"point": [0, 0, 1.9], "normal": [0.2, 0, -1], "reflectivity": 0.8, "name": "wall"}},
    {"plane": {"point": [0, 0.5, 0], "normal": [0, -1, 0], "reflectivity": 0.4, "name": "floor"}},
    {"sphere": {"center": [-0.3, 0.1, 1.2], "radius": "25 cm", "material": "skin", "name": "head"}},
    {"box": {"min": [0.1, 0.0, 1.0], "max": [0.4, 0.5, 1.3], "material": {"brdf": "phong", "diffuse": 0.3, "specular": 0.4, "exponent": 20}}},
]})


def pinhole_camera(pinhole: tofray.Pinhole, camera: tofray.Camera = CAMERA) -> tofray.Camera:
    """A camera that draws as renderers do: no distortion, and no lens beside the optical axis."""
    out = copy.deepcopy(camera)
    lens = out.lens
    lens.k1 = lens.k2 = lens.k3 = lens.p1 = lens.p2 = 0
    lens.fx_px, lens.fy_px = pinhole.fx_px, pinhole.fy_px
    lens.cx_px, lens.cy_px = pinhole.cx_px - pinhole.pixel_centre, pinhole.cy_px - pinhole.pixel_centre
    out.sensor.width, out.sensor.height = pinhole.width, pinhole.height
    return out


PINHOLE = tofray.pinhole_for(CAMERA)
DRAWN: Any = tofray.Simulator(SCENE, pinhole_camera(PINHOLE), noise="off").frame(0).truth
OWN = tofray.Simulator(SCENE, CAMERA, noise="off").frame(0)
MATERIALS = {i: SCENE.materials[one.material] for i, one in enumerate(SCENE.objects)}


def sampled(**words: Any) -> Any:
    all_words: Any = {"albedo": 0.5, "still": True, **words}
    return tofray.from_pictures(CAMERA, all_words.pop("z", DRAWN.z_m), intrinsics=PINHOLE, **all_words)


def off_edges() -> np.ndarray[Any, Any]:
    """Pixels with no other object, no shadow's rim, no box's edge within two pixels, and no part of the sphere that is seen at less than 25°."""
    truth: Any = OWN.truth
    lit, n = truth.irradiance_w_m2 > 0, truth.normal
    rim = np.zeros(lit.shape, bool)
    for across in range(-2, 3):
        for down in range(-2, 3):
            def other(a: Any) -> Any:
                return np.roll(a, (down, across), (0, 1))
            rim |= (other(truth.object_id) != truth.object_id) | (other(lit) != lit) | ((other(n) * n).sum(-1) < 0.9)
    cosine = -(n * truth.position_m).sum(-1) / truth.range_m
    inside: Any = ~rim & lit & ((truth.object_id != 2) | (cosine > math.sin(math.radians(25))))
    assert inside.mean() > 0.7
    return inside  # type: ignore[no-any-return]


@pytest.mark.parametrize("normals", [True, False])
def test_a_pinholes_pictures_make_the_cameras_own_frame(normals: bool) -> None:
    seen = sampled(normal=DRAWN.normal if normals else None, labels=DRAWN.object_id, materials=MATERIALS)
    inside, truth = off_edges(), OWN.truth
    # Half a pixel is 1.4 mm at 1.2 m, and where it is seen at 25° the sphere leaves a pixel's plane by (1.4 mm)²/(2 · 0.25 m · 0.42³) = 0.05 mm along a row.
    assert np.abs(seen.z_m - truth.z_m)[inside].max() < 1e-4
    assert (seen.object_id == truth.object_id)[inside].all()
    assert (np.isnan(seen.z_m) == np.isnan(truth.z_m))[inside].all()
    frame = tofray.Simulator(SCENE, CAMERA, noise="off").frame(0, seen)
    sigma = frame.depth.noise_m / OWN.depth.noise_m - 1
    assert np.abs(sigma[inside & (truth.object_id != 2)]).max() < 0.01
    # On the sphere a ray's normal is its pixel's: off by 1 mm/0.25 m, which is 0.4 % of the light at 45°, and 1 % of σ toward its rim.
    assert np.percentile(np.abs(sigma[inside & (truth.object_id == 2)]), 90) < 0.01
    depth_off = np.abs(frame.depth.z_m - OWN.depth.z_m)[inside]
    assert np.nanpercentile(depth_off, 99) < 2e-4


def test_half_a_pixel_is_not_lost_between_conventions() -> None:
    in_opencv = tofray.pinhole_for(CAMERA, pixel_centre=0.0)
    assert (in_opencv.cx_px, in_opencv.cy_px) == (PINHOLE.cx_px - 0.5, PINHOLE.cy_px - 0.5)
    numbers = (PINHOLE.fx_px, PINHOLE.fy_px, PINHOLE.cx_px, PINHOLE.cy_px)
    right = sampled(normal=DRAWN.normal)
    cases: Any = ((in_opencv, None), (in_opencv.matrix, 0.0), (numbers, 0.5), (PINHOLE.matrix, 0.5))
    for intrinsics, centre in cases:
        same = tofray.from_pictures(CAMERA, DRAWN.z_m, normal=DRAWN.normal, albedo=0.5, intrinsics=intrinsics, pixel_centre=centre, still=True)
        assert same.z_m.tobytes() == right.z_m.tobytes()
    wrong = tofray.from_pictures(CAMERA, DRAWN.z_m, normal=DRAWN.normal, albedo=0.5, intrinsics=numbers, pixel_centre=0.0, still=True)
    floor = off_edges() & (OWN.truth.object_id == 1)
    # dz/dy of the floor is −z²/0.5 m, and half a pixel is 1/848 of y/z: 2.4 mm at 1 m.
    by = (wrong.z_m - right.z_m)[floor] / OWN.truth.z_m[floor] ** 2
    assert np.abs(np.abs(by) * 848 * 0.5 - 1).max() < 0.05


def test_pictures_are_taken_whatever_floats_they_are_of() -> None:
    right = sampled(normal=DRAWN.normal)
    turned = np.asfortranarray(DRAWN.z_m.astype(np.float64))
    assert sampled(z=turned, normal=DRAWN.normal.astype(np.float64)).z_m.tobytes() == right.z_m.tobytes()
    assert sampled(z=DRAWN.range_m, distance="range", normal=DRAWN.normal).z_m == pytest.approx(right.z_m, abs=1e-6, nan_ok=True)
    short = sampled(z=DRAWN.z_m[:, :, ...].astype(np.float16), normal=DRAWN.normal.astype(np.float16))
    assert np.abs(short.z_m - right.z_m)[off_edges()].max() < 2e-3


def test_normals_may_be_the_worlds() -> None:
    pose = tofray.Pose(position=(1, 2, 3), look_at=(2, 2.5, 3.5))
    in_world = (DRAWN.normal.astype(np.float64) @ pose.matrix[:3, :3].T).astype(np.float32)
    right, seen = sampled(normal=DRAWN.normal), sampled(normal=in_world, normal_axes=pose)
    assert np.abs(seen.normal - right.normal).max() < 1e-6
    in_opengl, in_body = DRAWN.normal * np.array([1, -1, -1], np.float32), np.stack([DRAWN.normal[..., 2], -DRAWN.normal[..., 0], -DRAWN.normal[..., 1]], -1)
    assert sampled(normal=in_opengl, normal_axes="opengl").normal.tolist() == right.normal.tolist()
    assert np.abs(sampled(normal=in_body, normal_axes="body").normal - right.normal).max() < 1e-6
    with pytest.warns(UserWarning, match=r"normals do not fit z: .* a body's .* they would fit"):
        sampled(normal=in_body)


def test_the_sky_is_nothing_by_value_or_by_picture() -> None:
    inside = off_edges()
    wall = OWN.truth.object_id == 0
    far = np.where(DRAWN.object_id == 0, np.float32(20), DRAWN.z_m)
    by_value, by_picture = sampled(z=far, background=20.0), sampled(background=DRAWN.object_id == 0)
    for seen in (by_value, by_picture):
        assert (np.isnan(seen.z_m) == wall)[inside].all()
    assert np.nanmax(by_value.z_m) < 3 < np.nanmax(sampled(z=far).z_m)
    frame = tofray.Simulator(SCENE, CAMERA).frame(0, by_value)
    assert np.isnan(frame.truth.z_m[inside & wall]).all() and (frame.truth.object_id[inside & wall] == -1).all()


def test_colour_stands_for_reflectivity_and_says_so() -> None:
    shape = (PINHOLE.height, PINHOLE.width)
    bytes_of_screen = np.full((*shape, 4), 188, np.uint8)  # ((188/255 + 0.055)/1.055)^2.4 = 0.5029
    linear = np.array([0.2, 0.3, 0.7], np.float32) * np.ones((*shape, 1), np.float32)
    for albedo, expected in ((bytes_of_screen, 0.5029), (linear, 0.4)):
        with pytest.warns(UserWarning, match="visible colour stands for reflectivity in 100 % of the pixels"):
            seen = sampled(albedo=albedo)
        assert np.nanmax(np.abs(seen.diffuse - expected)) < 1e-4
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert np.nanmax(np.abs(sampled(albedo=np.full(shape, 0.3)).diffuse - 0.3)) < 1e-6
        seen = sampled(labels=DRAWN.object_id.astype(np.uint8), materials={0: 0.6, 1: "skin", 2: tofray.Material(diffuse=0.1)})
        unsigned = sampled(labels=np.where(DRAWN.object_id == 0, 2**32 - 1, DRAWN.object_id).astype(np.uint32), materials={2**32 - 1: 0.6})
    assert (unsigned.object_id == np.where(seen.object_id == 0, -1, seen.object_id)).all() and np.allclose(unsigned.diffuse[seen.object_id == 0], 0.6)
    by_label = {0: 0.6, 1: 0.603, 2: 0.1, 3: 0.5}
    assert all(np.allclose(seen.diffuse[seen.object_id == label], share, atol=1e-6) for label, share in by_label.items())
    assert tofray.load_material("skin").diffuse == 0.603


def test_a_moment_for_each_raw_frame_is_what_motion_needs() -> None:
    times = tofray.exposure_times(CAMERA)
    z = np.stack([np.full((PINHOLE.height, PINHOLE.width), 1 + 2.0 * t, np.float32) for t in times])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        seen = sampled(z=z, still=False)
    assert seen.z_m.shape == (len(times), 172, 224) and seen.normal.shape == (len(times), 172, 224, 3)
    frame = tofray.Simulator(tofray.Scene(), CAMERA, noise="off").frame(0, seen)
    moving = tofray.scene({"objects": [{"plane": {"point": [0, 0, 1], "normal": [0, 0, -1], "reflectivity": 0.5, "velocity": [0, 0, 2]}}]})
    own = tofray.Simulator(moving, CAMERA, noise="off").frame(0)
    assert np.nanmax(np.abs(frame.depth.z_m - own.depth.z_m)) < 1e-4
    with pytest.warns(UserWarning, match="one moment stands for all raw frames"):
        sampled(still=False)


WRONG: list[tuple[Callable[[], Any], str]] = [
    (lambda: sampled(z=(DRAWN.z_m * 1000).astype(np.uint16)), "z: got uint16 values"),
    (lambda: sampled(z=DRAWN.z_m[:-1]), "572 x 439 pixels, intrinsics 572 x 440"),
    (lambda: sampled(z=DRAWN.z_m[..., None, None]), "z: got float32 of shape (440, 572, 1, 1)"),
    (lambda: sampled(normal=DRAWN.normal[..., :2]), "normal: got shape (440, 572, 2)"),
    (lambda: sampled(normal=np.zeros((440, 572, 3), np.uint8)), "normal: got uint8"),
    (lambda: sampled(normal_axes="world"), "normal_axes: got 'world'"),
    (lambda: sampled(distance="depth"), "distance: got 'depth'"),
    (lambda: sampled(labels=DRAWN.z_m), "labels: got float32"),
    (lambda: sampled(labels=np.full(DRAWN.z_m.shape, 2**40)), "labels: got 1099511627776"),
    (lambda: sampled(labels=DRAWN.object_id, materials={0: "skni"}), 'no material "skni"; did you mean "skin"?'),
    (lambda: sampled(labels=DRAWN.object_id, materials={0: [1]}), "materials[0]: got [1]"),
    (lambda: sampled(labels=DRAWN.object_id, materials={0: "retro-sheet"}), "the material of label 0 is neither lambert nor phong"),
    (lambda: sampled(labels=DRAWN.object_id, albedo=None), "nothing says the reflectivity of label "),
    (lambda: sampled(albedo=None), "pictures say nothing of reflectivity"),
    (lambda: sampled(albedo=np.zeros((440, 572), np.uint8)), "albedo: got uint8 of shape (440, 572)"),
    (lambda: sampled(albedo=1.5), "other_reflectivity is out of range"),
    (lambda: sampled(background=0), "background_m is 0"),
    (lambda: sampled(background=np.zeros(3, bool)), "background: got bool of shape (3,)"),
    (lambda: sampled(pixel_centre=0.0), "pixel_centre: got 0.0, and intrinsics with 0.5"),
    (lambda: tofray.from_pictures(CAMERA, DRAWN.z_m, intrinsics=(400, 400, 286, 220)), "pixel_centre: is left out"),
    (lambda: tofray.from_pictures(CAMERA, DRAWN.z_m, intrinsics=(400, 400, 286), pixel_centre=0.5), "intrinsics: got tuple of shape (3,)"),
    (lambda: tofray.from_pictures(CAMERA, DRAWN.z_m, intrinsics=np.ones((3, 3)), pixel_centre=0.5), "intrinsics: got [["),
    (lambda: tofray.from_pictures(CAMERA, DRAWN.z_m, intrinsics=(0, 400, 286, 220), pixel_centre=0.5), "pinhole.fx_px is out of range"),
    (lambda: tofray.pinhole_for(CAMERA, -1), "margin_px is out of range"),
]


@pytest.mark.parametrize("use, said", WRONG)
def test_what_cannot_be_is_told(use: Callable[[], Any], said: str) -> None:
    with pytest.raises(tofray.Error) as told:
        use()
    assert said in str(told.value) and "\n  " in str(told.value), str(told.value)
