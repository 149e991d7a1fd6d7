# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames that have not all arrays, whose parts are one's own, or that come out of files; records with numpy's values."""

from __future__ import annotations

import copy
import json
import os
import pathlib
import pickle
import sys
import types
from typing import Any, Callable

import numpy as np
import pytest

import tofray
from tofray import _native

FRAME = tofray.demo()
STAGES = ("trace", "power", "raw", "depth")
H, W, K = FRAME.raw.height, FRAME.raw.width, FRAME.raw.phases
BY_PHASE = ("modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "lit")


def test_a_picture_that_lacks_an_array_names_it() -> None:
    with pytest.raises(tofray.Error, match=r"depth.amplitude_e, depth.flags, depth.noise_m"):
        tofray.Frame(depth=tofray.Depth(z_m=FRAME.depth.z_m)).preview()


def size_of(png: bytes) -> tuple[int, int]:
    return int.from_bytes(png[16:20], "big"), int.from_bytes(png[20:24], "big")


def test_pictures_have_the_scale_and_look_that_are_asked_for(tmp_path: pathlib.Path) -> None:
    width, height = size_of(FRAME.preview())
    assert size_of(FRAME.preview(scale=2)) == (2 * width, 2 * height)
    assert FRAME.preview(what="raw") != FRAME.preview()
    FRAME.save(tmp_path / "large", scale=2, theme="light")
    assert (tmp_path / "large/preview.png").read_bytes() == FRAME.preview("light", scale=2)
    assert (tmp_path / "large/raw.png").read_bytes() == FRAME.preview("light", scale=2, what="raw")
    FRAME.save(tmp_path / "plain")
    assert (tmp_path / "plain/preview.png").read_bytes() == FRAME.preview()
    assert (tmp_path / "plain/raw.png").read_bytes() == FRAME.preview(what="raw")


def test_a_saved_preview_becomes_what_its_name_ends_in(tmp_path: pathlib.Path) -> None:
    assert FRAME.save_preview(tmp_path / "slide.svg", "light") == str(tmp_path / "slide.svg")
    svg = (tmp_path / "slide.svg").read_text(encoding="utf-8")
    width, height = size_of(FRAME.preview())
    assert svg.startswith("<svg ") and f'width="{width}" height="{height}"' in svg and '"#ffffff"' in svg
    assert ">demo seen by pico-flexx MODE_9_5FPS_2000</text>" in svg
    FRAME.save_preview(tmp_path / "two.svg", scale=2)
    assert f'width="{2 * width}" height="{2 * height}" viewBox="0 0 {width} {height}"' in (tmp_path / "two.svg").read_text(encoding="utf-8")
    FRAME.save_preview(tmp_path / "raw.PDF", what="raw")
    assert (tmp_path / "raw.PDF").read_bytes().startswith(b"%PDF-")
    FRAME.save_preview(tmp_path / "p.png", scale=2)
    assert (tmp_path / "p.png").read_bytes() == FRAME.preview(scale=2)
    with pytest.raises(tofray.Error, match="expected a name that ends in .png, .svg or .pdf"):
        FRAME.save_preview(tmp_path / "slide.jpg")
    assert not (tmp_path / "slide.jpg").exists()


def test_open3d_gets_the_valid_points(monkeypatch: pytest.MonkeyPatch) -> None:
    # A stand-in that says what it got: Open3D itself is large, and not among what tests install.
    def kept(points: Any) -> int:
        got.append(points)
        return len(got)

    got: list[Any] = []
    modules: Any = sys.modules
    stand_in = types.SimpleNamespace(geometry=types.SimpleNamespace(PointCloud=types.SimpleNamespace),
                                     utility=types.SimpleNamespace(Vector3dVector=kept))
    monkeypatch.setitem(modules, "open3d", stand_in)
    assert FRAME.to_open3d().points == 1
    valid = (FRAME.depth.flags & tofray.flags["invalid"]) == 0
    assert got[0].dtype == np.float64 and np.array_equal(got[0], FRAME.depth.points_m[valid]) and 0 < len(got[0]) < H * W
    monkeypatch.setitem(modules, "open3d", None)
    with pytest.raises(ImportError, match="needs the package open3d"):
        FRAME.to_open3d()


@pytest.mark.parametrize("part", ["raw", "depth"])
def test_saving_leaves_out_the_pictures_that_cannot_be_drawn(part: str, tmp_path: pathlib.Path) -> None:
    needs: dict[str, set[str]] = {"raw.png": {"raw", *BY_PHASE}, "depth.png": {"z_m"}, "amplitude.png": {"amplitude_e"},
                                  "preview.png": {"z_m", "amplitude_e", "flags", "noise_m"}}
    of: Any = getattr(FRAME, part)
    words: dict[str, Any] = {name: of[name] for name in of}
    taps = {name: array for name, array in words.items() if name != "raw"}
    choices = [{name: array} for name, array in words.items()]
    choices += [{name: array for name, array in words.items() if name != gone} for gone in words]
    choices += [words, taps, {name: array for name, array in taps.items() if name != "tap_a"}]
    for k, some in enumerate(choices):
        frame = tofray.Frame(**{part: type(of)(**some)}, scene=FRAME.scene, camera=FRAME.camera)
        have = set(some) | ({"raw"} if {"tap_a", "tap_b"} <= set(some) else set())
        expected = {"frame.npz"} | {file for file, needed in needs.items() if needed <= have}
        assert {os.path.basename(file) for file in frame.save(tmp_path / str(k))} == expected, list(some)
        assert (frame._repr_png_() is None) == ("preview.png" not in expected)
        frame._repr_html_()


def test_a_raw_frame_of_which_little_is_known_is_shown() -> None:
    for name in BY_PHASE:
        words: dict[str, Any] = {name: FRAME.raw[name]}
        html = tofray.Frame(raw=tofray.Raw(width=3, height=4, **words))._repr_html_()
        assert html.count("<tr><td>") == K and ("MHz" in html) == (name == "modulation_frequency_hz")


@pytest.mark.parametrize("last", STAGES)
def test_no_array_of_a_stage_that_was_not_reached_is_offered(last: Any, tmp_path: pathlib.Path) -> None:
    simulator = tofray.Simulator(tofray.load_scene("demo"), last_stage=last)
    for frame in (simulator.frame(0), next(simulator.frames(requests=[tofray.FrameRequest(index=0)]))):
        there = frame.to_dict()
        for name, _, _, _, shape, stage, _, _ in _native.array_table():
            of_all = FRAME.to_dict().get(name)
            wanted = of_all is not None and (shape == "[phase]" or STAGES.index(stage) <= STAGES.index(last))
            assert (name in there) == wanted, name
            if wanted and of_all is not None:
                assert there[name].tobytes() == of_all.tobytes(), name
        files = {os.path.basename(file) for file in frame.save(tmp_path)}
        assert ("preview.png" in files, "raw.png" in files) == (last == "depth", last in ("raw", "depth"))
        assert tofray.load(tmp_path / "frame.npz").to_dict().keys() == there.keys()


def test_light_of_ones_own_is_known_though_the_last_stage_is_before() -> None:
    light = tofray.PixelLight(FRAME.truth.power_w[np.newaxis].copy(), (2 * FRAME.truth.range_m)[np.newaxis].copy())
    truth = tofray.Simulator(tofray.load_scene("demo"), last_stage="trace").frame(0, light).truth
    assert "power_w" in truth and "signal_e" not in truth


def test_a_frames_scene_and_camera_are_its_own(tmp_path: pathlib.Path) -> None:
    simulator = tofray.Simulator(tofray.load_scene("demo"))
    one, other = simulator.frame(0), simulator.frame(0)
    asked = next(simulator.frames(requests=[tofray.FrameRequest(seed=1)]))
    for frame in (one, asked, copy.copy(simulator.frame(0))):
        assert frame.camera is not None and frame.scene is not None
        assert frame.camera is frame.camera, "copied once"
        frame.camera.sensor.width = 7
        frame.scene.objects.clear()
    assert simulator.camera.sensor.width == W and len(simulator.scene.objects) > 0
    other.save(tmp_path)
    assert tofray.load(tmp_path / "frame.npz").meta["camera"]["sensor"]["width"] == W


def test_a_request_is_copied_when_it_is_taken() -> None:
    simulator = tofray.Simulator(tofray.load_scene("demo"))
    pose = tofray.Pose(position=(0.1, 0, 0), look_at=(0, 0, 1))
    frame = next(simulator.frames(requests=[tofray.FrameRequest(pose=pose)]))
    pose.position = (9, 9, 9)
    assert frame.scene is not None and tuple(frame.scene.camera.pose.position) == (0.1, 0, 0)


def test_the_times_of_exposures_are_taken_once() -> None:
    corners = np.array([[-1, -1, 1], [1, -1, 1], [0, 1, 1]], np.float32)
    asked: list[float] = []

    def at(time_s: float) -> Any:
        asked.append(time_s)
        return corners

    mesh = tofray.TriangleMesh(corners, np.array([[0, 1, 2]], np.int32))
    scene = tofray.Scene(materials=[tofray.Material(diffuse=0.5)],
                         objects=[tofray.Object(shape=tofray.Mesh(triangles=mesh, motion=tofray.MeshMotion(at)))])
    simulator = tofray.Simulator(scene, FRAME.camera)
    next(simulator.frames(requests=[tofray.FrameRequest(index=1000)]))
    asked.clear()
    frame = next(simulator.frames(requests=[tofray.FrameRequest(index=2000)]))
    assert FRAME.camera is not None
    start = 2000 / FRAME.camera.mode.frame_rate_hz
    assert asked and min(asked) >= start - 1e-9, "frame 0 is not computed again"
    assert frame.raw.start_time_s[0] == pytest.approx(start, abs=1e-9)


def test_parts_of_a_simulated_frame_are_not_exchanged_and_others_are() -> None:
    frame = tofray.Simulator(tofray.load_scene("demo")).frame(0)
    for name, value in {"raw": tofray.Raw(), "depth": tofray.Depth(), "truth": tofray.Truth(), "index": 3}.items():
        with pytest.raises(AttributeError, match=f"frame.{name}"):
            setattr(frame, name, value)
    for name in ("width", "time_s"):
        with pytest.raises(AttributeError, match="of one's own"):
            setattr(frame.truth, name, 1)
    mine = tofray.Frame(depth=frame.depth)
    before = mine.preview()
    halves: dict[str, Any] = {name: frame.depth[name][::2].copy() for name in frame.depth}
    mine.depth = tofray.Depth(**halves)
    assert mine.preview() != before


def stored(folder: pathlib.Path, **arrays: Any) -> pathlib.Path:
    np.savez(folder / "some.npz", **arrays)
    return folder / "some.npz"


ALL: dict[str, Any] = FRAME.to_dict()
BROKEN: dict[str, Callable[[], dict[str, Any]]] = {
    "raw of floats": lambda: {"raw": np.full((K, H, W), -5.5, np.float32)},
    "raw beyond uint16": lambda: {"raw": np.full((K, H, W), 70000, np.int32)},
    "z_m of float64": lambda: {"z_m": ALL["z_m"].astype(np.float64)},
    "z_m of a line": lambda: {"z_m": ALL["z_m"].ravel()},
    "z_m of three axes": lambda: {"z_m": ALL["z_m"][np.newaxis]},
    "points of two": lambda: {"points_m": ALL["points_m"][..., :2]},
    "two heights": lambda: {"z_m": ALL["z_m"], "flags": ALL["flags"][1:]},
    "two heights in two parts": lambda: {"raw": ALL["raw"], "gt_z_m": ALL["gt_z_m"][1:]},
    "two counts of phases": lambda: {"raw": ALL["raw"], "lit": ALL["lit"][1:]},
    "text for z_m": lambda: {"z_m": "far"},
    "times of many": lambda: {"gt_time_s": np.zeros(3)},
    "meta that is no JSON": lambda: {"meta": "{frame"},
    "meta that is a list": lambda: {"meta": "[1]"},
    "meta within meta": lambda: {"meta": "[" * 100000},
    "a frame that is no number": lambda: {"meta": '{"frame": "first"}'},
    "a frame below 0": lambda: {"meta": '{"frame": -1}'},
}


@pytest.mark.parametrize("fault", BROKEN)
def test_a_file_of_other_arrays_is_refused_by_name(fault: str, tmp_path: pathlib.Path) -> None:
    with pytest.raises(tofray.Error, match="some.npz: ") as told:
        tofray.load(stored(tmp_path, **BROKEN[fault]()))
    assert getattr(told.value, "kind") == "bad_input"


def test_a_file_with_any_byte_changed_is_read_or_refused(tmp_path: pathlib.Path) -> None:
    np.savez_compressed(tmp_path / "good.npz", lit=ALL["lit"], z_m=ALL["z_m"][:8, :8], meta='{"frame": 3}')
    good = (tmp_path / "good.npz").read_bytes()
    refused = 0
    for at in range(len(good)):
        (tmp_path / "bad.npz").write_bytes(good[:at] + bytes([good[at] ^ 0x55]) + good[at + 1:])
        try:
            tofray.load(tmp_path / "bad.npz")
        except tofray.Error:
            refused += 1
    assert refused > len(good) / 4


@pytest.mark.parametrize("name", [name for name in ALL])
def test_a_part_of_a_file_goes_back_into_a_file(name: str, tmp_path: pathlib.Path) -> None:
    frame = tofray.load(stored(tmp_path, **{name: ALL[name]}, z_m=ALL["z_m"]) if name != "z_m" else stored(tmp_path, z_m=ALL["z_m"]))
    frame.scene, frame.camera = FRAME.scene, FRAME.camera
    frame.save(tmp_path)
    again = tofray.load(tmp_path / "frame.npz").to_dict()
    assert again.keys() == {name, "z_m"} and again[name].tobytes() == ALL[name].tobytes() and again[name].shape == ALL[name].shape


def test_light_alone_goes_back_into_a_file(tmp_path: pathlib.Path) -> None:
    frame = tofray.load(stored(tmp_path, gt_signal_e=ALL["gt_signal_e"]))
    frame.scene, frame.camera = FRAME.scene, FRAME.camera
    frame.save(tmp_path)
    assert tofray.load(tmp_path / "frame.npz").truth.signal_e.tobytes() == ALL["gt_signal_e"].tobytes()


def test_a_loaded_frame_keeps_its_seed_when_it_is_saved(tmp_path: pathlib.Path) -> None:
    first = tofray.Simulator(tofray.load_scene("demo"), seed=2**64 - 1, noise="off", subpixel=2).frame(4)
    first.save(tmp_path / "first")
    frame = tofray.load(tmp_path / "first/frame.npz")
    frame.scene, frame.camera = first.scene, first.camera
    frame.save(tmp_path / "again")
    files = [(tmp_path / folder / "frame.npz").read_bytes() for folder in ("first", "again")]
    assert files[0] == files[1]
    assert json.loads(str(np.load(tmp_path / "again/frame.npz")["meta"]))["seed"] == 2**64 - 1


def test_records_with_numpys_values_are_compared_and_shown() -> None:
    plain = tofray.Sphere(center=(0.0, 1.0, 2.0), radius=0.5)
    other = tofray.Sphere(center=np.array([0.0, 1.0, 2.0]), radius=np.float64(0.5))  # type: ignore[arg-type]
    assert plain == other and other == plain and repr(other).startswith("Sphere(center=")
    assert other.to_dict() == plain.to_dict() and json.dumps(other.to_dict())
    for center in (np.array([0.0, 1.0, 2.5]), np.array([0.0, 1.0]), np.zeros((3, 3))):
        assert plain != tofray.Sphere(center=center, radius=0.5)  # type: ignore[arg-type]
    scene, again = (tofray.Scene(objects=[tofray.Object(shape=shape)]) for shape in (plain, other))
    assert scene == again and "array" in repr(again)


def test_frames_of_chosen_arrays_have_the_bytes_of_whole_ones_and_nothing_else(tmp_path: pathlib.Path) -> None:
    scene = tofray.load_scene("card")
    whole, simulator = tofray.Simulator(scene, seed=2).frame(1), tofray.Simulator(scene, seed=2, arrays=("raw", "gt_z_m"))
    for chosen in (simulator.frame(1), pickle.loads(pickle.dumps(simulator)).frame(1), next(simulator.frames(1, 1))):
        assert chosen.raw.raw.tobytes() == whole.raw.raw.tobytes() and chosen.truth.z_m.tobytes() == whole.truth.z_m.tobytes()
        assert (chosen.depth.names, chosen.truth.names) == ((), ("z_m",)) and "tap_a" not in chosen.raw.names
    with pytest.raises(AttributeError, match="no depth.z_m .*it was not asked for"):
        chosen.depth.z_m
    assert {pathlib.Path(file).name for file in chosen.save(tmp_path)} == {"frame.npz", "raw.png"}
    assert set(tofray.load(tmp_path / "frame.npz").to_dict()) == set(chosen.to_dict())
    wrong: Any
    for wrong, said in (("raw", "a list of str"), (["raws"], "did you mean \"raw\""), ([3], r"arrays\[0\]"), (["raw", ""], r"arrays\[1\]")):
        with pytest.raises(tofray.Error, match=said):
            tofray.Simulator(scene, arrays=wrong)


def test_arrays_that_some_frames_have_say_what_they_come_with() -> None:
    for name, what in {"multipath_m": "scene.transport.bounces", "transient_e_per_s": "scene.transport.transient.bins",
                       "object_share": "subpixel=2"}.items():
        with pytest.raises(AttributeError, match=f"no truth.{name} .*it comes with .*{what}"):
            getattr(FRAME.truth, name)
    scene = tofray.load_scene("card")
    scene.transport.bounces, scene.transport.transient.bins, scene.transport.transient.width_m = 1, 4, 1
    frame = tofray.Simulator(scene, subpixel=2).frame(0)
    assert {"direct_e", "indirect_e", "multipath_m", "path_noise_m", "path_count", "transient_e_per_s", "transient_lost_e_per_s", "mixed",
            "object_share"} <= set(frame.truth.names)


def test_a_file_that_is_not_there_is_told_with_those_that_are(tmp_path: pathlib.Path) -> None:
    with pytest.raises(tofray.Error, match="no such file\n  the folder '.*' holds no .npz file"):
        tofray.load(tmp_path / "frame.npz")
    for k in range(3):
        np.savez(tmp_path / f"frame_{k:04}.npz")
    with pytest.raises(tofray.Error, match="holds frame_0000.npz … frame_0002.npz \\(3 files\\)") as told:
        tofray.load(tmp_path / "frame.npz")
    assert isinstance(told.value, OSError)
    with pytest.raises(tofray.Error, match="no such file$"):
        tofray.load(tmp_path / "nowhere/frame.npz")
