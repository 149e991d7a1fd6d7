# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Objects and the camera placed from outside, by names."""

from __future__ import annotations

import hashlib
import math
import pathlib
import shutil
from typing import Any, Callable

import numpy as np
import pytest

import tofray

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
FRAMES = 5


def turntable(keyframes: bool = True) -> str:
    """The example's scene, whose chair and mark turn by keyframes at the frames' starts, and whose camera sweeps; or that stands still."""
    text = (EXAMPLES / "turntable/turntable.yaml").read_text(encoding="utf-8").replace("file: ../chair", "file: chair")
    rate = tofray.load_camera("pico-flexx", mode="MODE_5_35FPS_600").mode.frame_rate_hz
    times = [f"{i / rate!r} s" for i in range(FRAMES + 2)]
    looks = ", ".join(f"{{time: {time}, pose: {{position: [{0.01 * i}, -0.2, 0], look_at: [0, 0.03, 0.55]}}}}" for i, time in enumerate(times))

    def keys(position: str) -> str:
        turns = (f"{{time: {time}, position: {position}, rotation: {{axis: [0, 1, 0], angle: {40 * i} deg}}}}" for i, time in enumerate(times))
        return f"keyframes: [{', '.join(turns)}]" if keyframes else "velocity: [0, 0, 0]"

    text = text.replace("position: [0, 0.2, 0.55], reflectivity: 0.7, angular_velocity: [0, 200 rpm, 0]", "reflectivity: 0.7, " + keys("[0, 0.2, 0.55]"))
    text = text.replace("reflectivity: 0.9, angular_velocity: [0, 200 rpm, 0]", "reflectivity: 0.9, " + keys("[0, 0, 0]"))
    if keyframes:
        text = text.replace("pose: {position: [0, -0.2, 0], look_at: [0, 0.03, 0.55]}", f"keyframes: [{looks}]")
    assert "rpm, 0]" not in text
    return text


def film_hash(frames: Any, folder: pathlib.Path) -> str:
    out = hashlib.sha256()
    for frame in frames:
        frame.save(folder)
        out.update((folder / "frame.npz").read_bytes())
    return out.hexdigest()


def test_a_turntable_driven_from_outside_is_the_film_of_its_file(tmp_path: pathlib.Path) -> None:
    (tmp_path / "turning.yaml").write_text(turntable(), encoding="utf-8")
    (tmp_path / "still.yaml").write_text(turntable(False), encoding="utf-8")
    shutil.copytree(EXAMPLES / "chair", tmp_path / "chair")
    file, still = tofray.load_scene(tmp_path / "turning.yaml", root=tmp_path), tofray.load_scene(tmp_path / "still.yaml", root=tmp_path)
    still.name, still.source = file.name, file.source
    of_the_file, outside = tofray.Simulator(file, seed=7), tofray.Simulator(still, seed=7)
    names = {one.name.split("/")[0]: one.keyframes for one in file.objects if one.keyframes}
    assert set(names) == {"chair", "mark"}

    def whole(i: int) -> tofray.Frame:
        return outside.frame(i, camera=file.camera.keyframes, objects=names)

    def at(key: Any) -> tofray.Placement:
        return tofray.Placement(position=key.position, rotation=key.rotation)

    expected = film_hash((of_the_file.frame(i) for i in range(FRAMES)), tmp_path / "film")
    assert film_hash((whole(i) for i in range(FRAMES)), tmp_path / "film") == expected
    for i in range(FRAMES):
        pairs: Any = {name: (at(keys[i]), at(keys[i + 1])) for name, keys in names.items()}
        look: Any = (file.camera.keyframes[i].pose, file.camera.keyframes[i + 1].pose)
        frame, other = outside.frame(i, camera=look, objects=pairs), of_the_file.frame(i)
        for name, array in frame.to_dict().items():
            if name != "gt_flow_px":  # what comes after the end is as before it, to rounding
                assert array.tobytes() == other.to_dict()[name].tobytes(), name
        flow, wanted = frame.truth.flow_px, other.truth.flow_px
        assert np.array_equal(np.isnan(flow), np.isnan(wanted))
        assert np.nanmax(np.abs(flow - wanted)) < 1.0, "the camera's look_at goes on as a turn"


def test_a_frame_is_what_was_asked_though_the_placement_changes_later(tmp_path: pathlib.Path) -> None:
    simulator = tofray.Simulator(tofray.load_scene("flying-ball"))
    place = tofray.Placement(position=(0.1, 0, 0))
    frame = simulator.frame(2, objects={"ball": place})
    place.position = (9, 9, 9)
    assert frame.scene is not None
    ball = frame.scene.objects[1]
    assert tuple(ball.keyframes[0].position) == (0.1, 0, 0) and tuple(ball.velocity_m_per_s) == (0, 0, 0)
    again = tofray.Simulator(frame.scene, frame.camera).frame(2)
    assert again.raw.raw.tobytes() == frame.raw.raw.tobytes()


def test_time_and_seed_are_the_frames_own() -> None:
    simulator = tofray.Simulator(tofray.load_scene("flying-ball"), seed=3)
    rate = simulator.camera.mode.frame_rate_hz
    late = simulator.frame(0, time_s=4 / rate)
    assert late.truth.z_m.tobytes() == simulator.frame(4).truth.z_m.tobytes()
    assert late.raw.start_time_s[0] == 4 / rate and late.index == 0
    other = simulator.frame(4, seed=5)
    assert other.raw.raw.tobytes() == tofray.Simulator(tofray.load_scene("flying-ball"), seed=5).frame(4).raw.raw.tobytes()
    [asked] = simulator.frames(requests=[tofray.FrameRequest(index=0, start_time_s=4 / rate)])
    assert asked.raw.raw.tobytes() == late.raw.raw.tobytes()


def test_exposure_times_are_the_middles_of_exposures() -> None:
    camera = tofray.load_camera("pico-flexx")
    frame = tofray.Simulator(tofray.load_scene("flying-ball"), camera).frame(0, time_s=2.0)
    middles = frame.raw.start_time_s + 0.5 * frame.raw.integration_time_s
    np.testing.assert_allclose(tofray.exposure_times(camera, 2.0), middles, rtol=0, atol=1e-12)
    assert frame.truth.time_s in tofray.exposure_times(camera, 2.0)


SIMULATOR: Any = tofray.Simulator(tofray.load_scene("flying-ball"))
HERE = tofray.Placement()
WRONG: list[tuple[Callable[[], Any], str]] = [
    (lambda: SIMULATOR.frame(0, objects={"bal": HERE}), 'the scene has no object "bal"; did you mean "ball"?'),
    (lambda: SIMULATOR.frame(0, objects={"ball": (HERE, HERE, HERE)}), "objects['ball']: got tuple"),
    (lambda: SIMULATOR.frame(0, objects={"ball": ()}), "objects['ball']: got tuple"),
    (lambda: SIMULATOR.frame(0, objects={"ball": np.eye(4)}), "objects['ball']: got ndarray"),
    (lambda: SIMULATOR.frame(0, objects=[("ball", HERE)]), "objects: got list"),
    (lambda: SIMULATOR.frame(0, objects={1: HERE}), "name"),
    (lambda: SIMULATOR.frame(0, camera=np.eye(4)), "camera: got ndarray"),
    (lambda: SIMULATOR.frame(0, time_s=math.nan), "request.start_time_s is out of range"),
    (lambda: SIMULATOR.frame(0, time_s="late"), "start_time_s"),
    (lambda: SIMULATOR.frame(0, objects={"ball": tofray.Placement(position=(0, math.nan, 0))}),
     'request.objects["ball"].start.position[1] is out of range'),
    (lambda: SIMULATOR.frame(0, objects={"ball": tofray.Placement(rotation=tofray.Rotation(quaternion=(1, 1, 0, 0)))}), "unit length"),
    (lambda: SIMULATOR.frame(0, camera=tofray.Pose(quaternion=(1, 1, 0, 0))), "unit length"),
    (lambda: SIMULATOR.frame(0, objects={"ball": [tofray.Keyframe(time_s=1), tofray.Keyframe(time_s=0)]}), "not later than the one before"),
    (lambda: tofray.exposure_times(tofray.load_camera("pico-flexx"), math.inf), "start_s is out of range"),
]


@pytest.mark.parametrize("use, said", WRONG)
def test_what_cannot_be_is_told(use: Callable[[], Any], said: str) -> None:
    with pytest.raises((tofray.Error, TypeError, ValueError)) as told:
        use()
    assert said in str(told.value) and "\n  " in str(told.value), str(told.value)


def test_arrays_of_ones_own_take_no_placements() -> None:
    frame = SIMULATOR.frame(0)
    seen = tofray.Geometry(frame.truth.z_m, frame.truth.normal, frame.truth.reflectivity)
    with pytest.raises(tofray.Error, match="arrays of one's own and a camera"):
        SIMULATOR.frame(0, seen, objects={"ball": HERE})
