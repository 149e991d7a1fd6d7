# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A hundred wrong uses and more: each gives a Python exception that says what is wrong, and none a crash."""

from __future__ import annotations

import copy
import os
import pickle
import re
from typing import Any, Callable

import numpy as np
import pytest

import tofray

FRAME = tofray.demo()
assert FRAME.camera is not None and FRAME.scene is not None
CAMERA: tofray.Camera = FRAME.camera
SCENE: tofray.Scene = FRAME.scene
SIMULATOR = tofray.Simulator(SCENE, CAMERA)
TAPS = {name: FRAME.raw[name] for name in FRAME.raw}
DEPTH: dict[str, Any] = {name: FRAME.depth[name] for name in FRAME.depth}
H, W, K = FRAME.raw.height, FRAME.raw.width, FRAME.raw.phases
LIGHT: dict[str, Any] = {"power_w": FRAME.truth.power_w[np.newaxis].copy(), "path_length_m": (2 * FRAME.truth.range_m)[np.newaxis].copy()}
SEEN: dict[str, Any] = {"z_m": FRAME.truth.z_m, "normal": FRAME.truth.normal, "diffuse": FRAME.truth.reflectivity}


def unaligned(array: Any) -> Any:
    memory = np.zeros(array.nbytes + 1, np.uint8)
    out = memory[1:].view(array.dtype).reshape(array.shape)
    out[...] = array
    return out


# What can be wrong of any array: its name in messages, and how to make it.
SPOILT: dict[str, Callable[[Any], Any]] = {
    "another dtype": lambda a: a.astype(np.int8),
    "complex": lambda a: a.astype(np.complex128),
    "objects": lambda a: a.astype(object),
    "other bytes first": lambda a: a.astype(a.dtype.newbyteorder()),
    "every second": lambda a: np.repeat(a, 2, axis=-1)[..., ::2],
    "backwards": lambda a: a[..., ::-1],
    "Fortran's order": lambda a: np.asfortranarray(np.stack([a, a]))[0],
    "one axis more": lambda a: a.reshape((1, 1) + a.shape),
    "flat": lambda a: a.ravel(),
    "no axis": lambda a: a.dtype.type(1),
    "short": lambda a: a[..., :-1].copy(),
    "empty": lambda a: a[..., :0].copy(),
    "not aligned": unaligned,
    "masked": lambda a: getattr(np.ma, "masked_array")(a),
    "a list": lambda a: a.tolist(),
    "text": lambda a: "tap_a",
    "huge": lambda a: np.broadcast_to(a.dtype.type(1), (10**4, 10**5, 10**5)),
}


@pytest.mark.parametrize("fault", SPOILT)
@pytest.mark.parametrize("where", ["raw.tap_a", "raw.start_time_s", "geometry.z_m", "geometry.normal", "light.power_w",
                                   "light.path_length_m"])
def test_an_array_is_taken_as_it_lies_or_refused(where: str, fault: str) -> None:
    owner, name = where.split(".")
    if owner == "raw":
        if name == "start_time_s" and fault in ("Fortran's order", "flat"):
            pytest.skip("one axis has one order, and is flat")
        words: dict[str, Any] = dict(TAPS)
        words[name] = SPOILT[fault](words[name])
        with pytest.raises((ValueError, tofray.Error)) as told:
            tofray.process(tofray.Raw(width=W, height=H, phases=K, **words), CAMERA)
    else:
        words = dict(SEEN if owner == "geometry" else LIGHT)
        words[name] = SPOILT[fault](words[name])
        make: Any = tofray.Geometry if owner == "geometry" else tofray.PixelLight
        with pytest.raises((ValueError, tofray.Error)) as told:
            SIMULATOR.frame(0, make(**words))
    assert "expected" in str(told.value) and len(str(told.value)) < 4000


def with_member(path: str, value: Any) -> Callable[[], object]:
    def use() -> object:
        scene, camera = copy.deepcopy(SCENE), copy.deepcopy(CAMERA)
        *way, last = path.split(".")
        at: Any = {"scene": scene, "camera": camera}[way[0]]
        for step in way[1:]:
            at = at[int(step)] if step.isdigit() else getattr(at, step)
        setattr(at, last, value)
        return tofray.Simulator(scene, camera)

    return use


class Angry:
    def __float__(self) -> float:
        raise RuntimeError("no number of yours")


def endless() -> Any:
    deep: Any = []
    deep.append(deep)
    return deep


MEMBERS: list[tuple[str, Any]] = [
    ("scene.objects", None), ("scene.objects", 5), ("scene.objects", "abc"), ("scene.objects", {"a": 1}), ("scene.objects", [None]),
    ("scene.objects", endless()), ("scene.objects.0.shape", None), ("scene.objects.0.shape", CAMERA), ("scene.objects.0.material", 10**6),
    ("scene.objects.0.material", -1), ("scene.objects.0.material", 2**63), ("scene.objects.0.material", 1.0),
    ("scene.objects.0.material", True), ("scene.objects.0.position", (1, 2)), ("scene.objects.0.position", (1, 2, "3")),
    ("scene.objects.0.position", np.zeros((3, 3))), ("scene.objects.0.position", (1, 2, float("nan"))),
    ("scene.objects.0.velocity_m_per_s", (0, 0, 1e300)), ("scene.objects.0.name", 5), ("scene.objects.0.name", "\ud8ff"),
    ("scene.objects.0.keyframes", [tofray.Pose()]), ("scene.ambient.spectrum", "moon"), ("scene.ambient.spectrum", 1),
    ("scene.ambient.amount", Angry()), ("scene.ambient.amount", 1j), ("scene.ambient.amount", "5 %"), ("scene.ambient.direction", 0),
    ("scene.transport.seed", -1), ("scene.transport.seed", 2**64), ("scene.transport.bounces", 65), ("scene.transport.smooth", 1),
    ("scene.camera", CAMERA), ("scene.materials", []), ("scene.materials.0.map", np.zeros((2, 2), np.float32)),
    ("camera.sensor", None), ("camera.sensor.width", 0), ("camera.sensor.width", 10**9), ("camera.sensor.width", 2**31),
    ("camera.lens.vignetting", "cos5"), ("camera.pixel.quantum_efficiency", 0.4), ("camera.illumination", [1]),
    ("camera.mode.sequence", []), ("camera.mode.frame_rate_hz", 0), ("camera.adc.bits", 99), ("camera.refractive_index", 10**400),
]

def without(part: str, *names: str) -> tofray.Frame:
    """A copy of the frame's arrays but for some; the frame has no other part."""
    arrays = {name: FRAME.depth[name] if part == "depth" else FRAME.raw[name] for name in getattr(FRAME, part) if name not in names}
    return tofray.Frame(**{part: (tofray.Depth if part == "depth" else tofray.Raw)(**arrays)})  # type: ignore[arg-type]


USES: dict[str, Callable[[], object]] = {
    **{f"{path} = {value!r:.30}": with_member(path, value) for path, value in MEMBERS},
    "a scene that is none": lambda: tofray.Simulator("demo"),  # type: ignore[arg-type]
    "a camera that is none": lambda: tofray.Simulator(SCENE, "pico-flexx"),  # type: ignore[arg-type]
    "a scene for a camera": lambda: tofray.Simulator(SCENE, SCENE),  # type: ignore[arg-type]
    "too many threads": lambda: tofray.Simulator(SCENE, threads=10**6),
    "threads beyond int": lambda: tofray.Simulator(SCENE, threads=2**40),
    "a seed below 0": lambda: tofray.Simulator(SCENE, seed=-1),
    "a seed of text": lambda: tofray.Simulator(SCENE, seed="7"),  # type: ignore[arg-type]
    "noise of another name": lambda: tofray.Simulator(SCENE, noise="gaussian"),  # type: ignore[arg-type]
    "a GPU that is not there": lambda: tofray.Simulator(SCENE, backend="cuda", device=77),
    "too fine a subpixel": lambda: tofray.Simulator(SCENE, subpixel=17),
    "a frame below 0": lambda: SIMULATOR.frame(-1),
    "a frame of text": lambda: SIMULATOR.frame("0"),  # type: ignore[arg-type]
    "a frame beyond all": lambda: SIMULATOR.frame(2**64),
    "a frame of half": lambda: SIMULATOR.frame(0.5),  # type: ignore[arg-type]
    "geometry that is none": lambda: SIMULATOR.frame(0, SCENE),  # type: ignore[arg-type]
    "geometry without arrays": lambda: SIMULATOR.frame(0, tofray.Geometry(None, None, None)),  # type: ignore[arg-type]
    "light without power": lambda: SIMULATOR.frame(0, tofray.PixelLight(None)),  # type: ignore[arg-type]
    "light without lengths": lambda: SIMULATOR.frame(0, tofray.PixelLight(LIGHT["power_w"])),
    "light from a lamp that is not": lambda: SIMULATOR.frame(0, tofray.PixelLight(**LIGHT, light_of_path=[9])),
    "phasors of another shape": lambda: SIMULATOR.frame(0, tofray.PixelLight(LIGHT["power_w"], phasor_w=np.zeros((1, 2), np.complex64))),
    "histograms of no width": lambda: SIMULATOR.frame(0, tofray.Transient(np.zeros((2, H, W), np.float32), first_m=0, bin_width_m=0)),
    "a request that is none": lambda: list(SIMULATOR.frames(requests=[3])),  # type: ignore[list-item]
    "requests that are none": lambda: list(SIMULATOR.frames(requests=5)),  # type: ignore[arg-type]
    "a request with a pose that cannot be": lambda: list(
        SIMULATOR.frames(requests=[tofray.FrameRequest(pose=tofray.Pose(look_at=(0, 0, 0)))])),
    "raw data without arrays": lambda: tofray.process(tofray.Raw(), CAMERA),  # type: ignore[arg-type]
    "raw data that are none": lambda: tofray.process(FRAME, CAMERA),  # type: ignore[arg-type]
    "raw data of a negative size": lambda: tofray.process(
        tofray.Raw(width=-5, height=H, phases=K, **TAPS), CAMERA),  # type: ignore[arg-type]
    "raw data of half a pixel": lambda: tofray.process(tofray.Raw(width=2.5, **TAPS), CAMERA),  # type: ignore[arg-type]
    "an array that there is not": lambda: tofray.Raw(tap_c=FRAME.raw.tap_a),
    "an option that there is not": lambda: tofray.process(FRAME.raw, CAMERA, speed=9),  # type: ignore[call-arg]
    "a mesh without corners": lambda: tofray.TriangleMesh(np.zeros((0, 3), np.float32), np.zeros((1, 3), np.int32)),
    "a mesh beyond its corners": lambda: tofray.TriangleMesh(np.zeros((3, 3), np.float32), np.array([[0, 1, 3]], np.int32)),
    "a mesh before its corners": lambda: tofray.TriangleMesh(np.zeros((3, 3), np.float32), np.array([[0, 1, -1]], np.int32)),
    "a mesh of float64": lambda: tofray.TriangleMesh(np.zeros((3, 3)), np.zeros((1, 3), np.int32)),  # type: ignore[arg-type]
    "a mesh of int64": lambda: tofray.TriangleMesh(np.zeros((3, 3), np.float32), np.zeros((1, 3), np.int64)),  # type: ignore[arg-type]
    "fewer normals": lambda: tofray.TriangleMesh(np.zeros((3, 3), np.float32), np.zeros((1, 3), np.int32), np.zeros((2, 3), np.float32)),
    "texcoords of three": lambda: tofray.TriangleMesh(
        np.zeros((3, 3), np.float32), np.zeros((1, 3), np.int32), None, np.zeros((3, 3), np.float32)),
    "shades in rows": lambda: tofray.TriangleMesh(
        np.zeros((3, 3), np.float32), np.zeros((1, 3), np.int32), None, None, np.zeros((3, 1), np.float32)),
    "vectors of two": lambda: tofray.VectorMap(np.zeros((2, 2, 2), np.float32)),
    "a map of a line": lambda: tofray.ReflectivityMap(np.zeros(3, np.float32)),
    "a map that wraps otherwise": lambda: tofray.ReflectivityMap(np.zeros((2, 2), np.float32), "around"),
    "a motion of no function": lambda: tofray.MeshMotion(5),  # type: ignore[arg-type]
    "a dict that is none": lambda: tofray.scene([1, 2]),  # type: ignore[arg-type]
    "a dict of no scene": lambda: tofray.scene({"objekts": []}),
    "a dict with a bare unit": lambda: tofray.camera({"sensor": {"width": 2, "height": 2, "pixel_pitch": 5}}),
    "a dict with an object": lambda: tofray.scene({"objects": [object()]}),
    "a dict with keys of numbers": lambda: tofray.scene({1: 2}),  # type: ignore[dict-item]
    "a dict within itself": lambda: tofray.scene({"objects": endless()}),
    "a dict with nan": lambda: tofray.scene({"objects": [{"sphere": {"center": [0, 0, float("nan")], "radius": "1 m"}}]}),
    "a dict with bytes": lambda: tofray.scene({"objects": b"abc"}),
    "a scene of another name": lambda: tofray.load_scene("demmo"),
    "a scene of a folder": lambda: tofray.load_scene(os.getcwd()),
    "a camera of another mode": lambda: tofray.load_camera("pico-flexx", "MODE_0"),
    "a key that there is not": lambda: tofray.load_camera("pico-flexx", set={"lens.f": 1}),
    "a file that is not there": lambda: tofray.load("no such file.npz"),
    "a file that is no npz": lambda: tofray.load(__file__),
    "a theme of another colour": lambda: FRAME.preview("green"),
    "a preview of scale 0": lambda: FRAME.preview(scale=0),
    "a preview of scale 9": lambda: FRAME.preview(scale=9),
    "a preview of another thing": lambda: FRAME.preview(what="depth"),
    "a preview as jpg": lambda: FRAME.save_preview("/tmp/nowhere.jpg"),
    "a preview into no folder": lambda: FRAME.save_preview("/nowhere/slide.svg"),
    "a plot of another thing": lambda: FRAME.plot("colour"),
    "a preview of nothing": lambda: tofray.Frame().preview(),
    "a preview of z alone": lambda: tofray.Frame(depth=tofray.Depth(z_m=FRAME.depth.z_m)).preview(),
    "a preview without flags": lambda: without("depth", "flags").preview(),
    "a preview without truth or noise": lambda: without("depth", "noise_m").preview(),
    "a preview with a short array": lambda: tofray.Frame(
        depth=tofray.Depth(**{**DEPTH, "flags": DEPTH["flags"][:-1]})).preview(),
    "parts of two sizes": lambda: tofray.Frame(
        raw=FRAME.raw, depth=tofray.Depth(**{name: array[:-1] for name, array in DEPTH.items()})).preview(),
    "processing for truth": lambda: tofray.process(FRAME.raw, CAMERA, truth=False),  # type: ignore[call-arg]
    "processing up to raw": lambda: tofray.process(FRAME.raw, CAMERA, last_stage="raw"),  # type: ignore[call-arg]
    "saving what has no scene": lambda: tofray.Frame().save("/tmp/nowhere"),
    "saving where nothing can be": lambda: FRAME.save("/proc/nowhere"),
    "rays of no camera": lambda: tofray.pixel_rays(SCENE),  # type: ignore[arg-type]
    "rays of a broken camera": lambda: tofray.pixel_rays(tofray.Camera()),
    "an error within": lambda: tofray.Simulator(SCENE, noise=None),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("use", USES)
def test_a_wrong_use_says_what_is_wrong(use: str) -> None:
    with pytest.raises((tofray.Error, ValueError, TypeError)) as told:
        USES[use]()
    text = str(told.value)
    assert len(text) > 10 and not isinstance(told.value, RuntimeError) or getattr(told.value, "kind", "") == "device", text


def test_there_are_a_hundred_of_them() -> None:
    assert len(USES) + 6 * len(SPOILT) >= 100


def test_errors_are_what_python_would_raise_and_travel() -> None:
    with pytest.raises(ValueError) as told:
        tofray.scene({"objects": [{"sphere": {"center": [0, 0, 1], "radius": "3 kg", "reflectivity": 0.5}}]})
    assert isinstance(told.value, tofray.Error) and told.value.kind == "bad_input"
    assert str(told.value).startswith("objects[0].sphere.radius: error: ")
    again = pickle.loads(pickle.dumps(told.value))
    assert type(again) is type(told.value) and str(again) == str(told.value)
    with pytest.raises(OSError) as not_there:
        tofray.load_scene("no such scene")
    assert isinstance(not_there.value, tofray.Error) and not_there.value.kind == "io"


def test_an_option_that_stands_elsewhere_says_where() -> None:
    wrong: Any = tofray.Simulator
    for option, place in (("bounces", "scene.transport.bounces"), ("samples", "scene.transport.samples"), ("mode", "an option of load_camera")):
        with pytest.raises(TypeError, match=f"Simulator has no option {option}: it is {re.escape(place)}"):
            wrong(SCENE, **{option: 4})
    with pytest.raises(TypeError, match="unexpected keyword argument 'bonces'"):
        wrong(SCENE, bonces=4)


def test_a_member_that_there_is_not_is_refused() -> None:
    with pytest.raises(AttributeError, match="radius"):
        tofray.Sphere().radios = 3  # type: ignore[attr-defined]
    with pytest.raises(TypeError):
        tofray.Sphere(radios=3)  # type: ignore[call-arg]


def test_a_deleted_member_is_named() -> None:
    scene = copy.deepcopy(SCENE)
    del scene.objects[0].name
    with pytest.raises(tofray.Error, match=r"scene.objects\[0\].name"):
        tofray.Simulator(scene)


def test_shared_arrays_are_read_only() -> None:
    mesh = tofray.TriangleMesh(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]], np.int32))
    for array in (mesh.vertices, mesh.triangles):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0
        with pytest.raises(ValueError):
            array.flags.writeable = True
    with pytest.raises(AttributeError):
        mesh.vertices = np.zeros((3, 3), np.float32)  # type: ignore[misc]


def test_an_array_of_the_frame_is_not_exchanged() -> None:
    with pytest.raises(AttributeError, match="own memory"):
        FRAME.depth.z_m = np.zeros((H, W), np.float32)


def moving(at: Any) -> tofray.Simulator:
    corners = np.array([[-1, -1, 1], [1, -1, 1], [0, 1, 1]], np.float32)
    mesh = tofray.TriangleMesh(corners, np.array([[0, 1, 2]], np.int32))
    scene = tofray.Scene(materials=[tofray.Material(diffuse=0.5)],
                         objects=[tofray.Object(shape=tofray.Mesh(triangles=mesh, motion=tofray.MeshMotion(at)))])
    return tofray.Simulator(scene, CAMERA)


class Mine(Exception):
    pass


def test_what_a_callback_raises_comes_out_as_it_is() -> None:
    def at(time_s: float) -> Any:
        raise Mine("at", time_s)

    for _ in range(3):
        with pytest.raises(Mine):
            moving(at).frame(1)


def test_what_a_callback_raises_later_comes_out_as_it_is() -> None:
    armed: list[bool] = []

    def at(time_s: float) -> Any:
        if armed:
            raise Mine("at", time_s)
        return np.array([[-1, -1, 1], [1, -1, 1], [0, 1, 1]], np.float32)

    simulator = moving(at)
    armed.append(True)
    with pytest.raises(Mine):
        simulator.frame(1)
    armed.clear()
    assert simulator.frame(1).truth.z_m.size == H * W


@pytest.mark.parametrize("given", [None, 5, "abc", np.zeros((2, 3), np.float32), np.zeros((3, 3)), (1, 2, 3),
                                   np.full((3, 3), np.nan, np.float32)], ids=lambda given: f"{given!r:.20}")
def test_what_a_callback_returns_is_looked_at(given: Any) -> None:
    with pytest.raises(tofray.Error):
        moving(lambda time_s: given).frame(1)


def test_a_callback_may_not_ask_its_own_simulator() -> None:
    hold: list[tofray.Simulator] = []

    def at(time_s: float) -> Any:
        if hold:
            hold[0].frame(0)
        return np.array([[-1, -1, 1], [1, -1, 1], [0, 1, 1]], np.float32)

    hold.append(moving(at))
    with pytest.raises(tofray.Error, match="of its own"):
        hold[0].frame(1)


def test_a_scene_that_is_gone_is_missed_by_nobody() -> None:
    scene = copy.deepcopy(SCENE)
    simulator = tofray.Simulator(scene)
    scene.objects.clear()
    scene.materials.clear()
    del scene
    assert simulator.frame(0).depth.z_m.tobytes() == FRAME.depth.z_m.tobytes()


def test_a_frame_outlives_its_simulator() -> None:
    frame = tofray.Simulator(SCENE).frame(0)  # type: ignore[arg-type]
    assert frame.depth.z_m.tobytes() == FRAME.depth.z_m.tobytes()


def test_recordings_of_other_programs_are_told_at_their_array() -> None:
    assert K == 9
    f, tau, times, lit = (FRAME.raw[name] for name in ("modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "lit"))
    lists: dict[str, Any] = {"modulation_frequency_hz": f, "reference_phase_rad": tau, "integration_time_s": times, "lit": lit}
    codes = FRAME.raw.raw
    expected: list[tuple[dict[str, Any], str]] = [
        ({**lists, "raw": np.ascontiguousarray(np.moveaxis(codes, 0, -1))},
         r"raw\.raw: error: got .*\(172, 224, 9\).*; its last axis are the 9 raw frames: np\.ascontiguousarray\(np\.moveaxis\(raw, -1, 0\)\)"),
        ({**lists, "raw": codes.astype(np.int16) - np.int16(2048)},
         r"raw\.raw: error: got .*int16.*, expected uint16 codes of the ADC\n  differences A-B of the taps\? Add mid_code"),
        ({**lists, "raw": codes, "reference_phase_rad": np.rint(np.rad2deg(tau))},
         r"array \"reference_phase_rad\" has 90 rad for raw frame 2\n  expected radians; are these degrees\? np\.deg2rad"),
        ({**lists, "raw": codes, "modulation_frequency_hz": f * 1e-6},
         r"array \"modulation_frequency_hz\" has 80\.32 Hz for raw frame 1\n  expected hertz, 1000 or more; are these megahertz\?"),
    ]
    tofray.process(tofray.Raw(**lists, raw=codes), CAMERA)
    for words, said in expected:
        with pytest.raises(tofray.Error, match=said):
            tofray.process(tofray.Raw(**words), CAMERA)


def test_a_calibration_takes_an_offset_off() -> None:
    camera = copy.deepcopy(CAMERA)
    camera.decoding.filter = tofray.ImageFilter()
    before = tofray.process(FRAME.raw, camera).range_m
    camera.calibration.range_offset_m = 0.25
    after = tofray.process(FRAME.raw, camera).range_m
    both = np.isfinite(before) & np.isfinite(after)
    assert both.sum() > 10000
    assert abs(float(np.median(before[both] - after[both])) - 0.25) < 1e-4
