# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""MCAP files from Python: the bytes of the command's, of frames that are placed from outside too."""

from __future__ import annotations

import pathlib
import sys
from typing import Any

import numpy as np
import pytest

import tofray

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "ros"))
import mcap  # noqa: E402

SMALL = {"camera.sensor.width": 24, "camera.sensor.height": 16}


def simulated() -> tuple[tofray.Scene, tofray.Camera, tofray.Simulator]:
    inputs = tofray.load_inputs("flying-ball", set=SMALL)
    return inputs.scene, inputs.camera, tofray.Simulator(inputs.scene, inputs.camera, seed=3)


def write(path: pathlib.Path, frames: int = 3, **words: Any) -> Any:
    scene, camera, simulator = simulated()
    film = tofray.McapWriter(path, scene, camera, seed=3, **words)
    for i in range(frames):
        film.write(simulator.frame(i))
    return film.close()


def test_a_film_has_the_messages_of_render(tmp_path: pathlib.Path) -> None:
    record = write(tmp_path / "mine.mcap", driver="pico_flexx", compression="none")
    tofray.render("flying-ball", tmp_path / "run", set=SMALL, frames=3, seed=3, emit=["mcap"], mcap={"driver": "pico_flexx", "compression": "none"})
    mine, theirs = mcap.Mcap(tmp_path / "mine.mcap"), mcap.Mcap(tmp_path / "run/run.mcap")
    assert (record.name, record.bytes) == ("mine.mcap", (tmp_path / "mine.mcap").stat().st_size)
    assert [(one.topic, one.log, one.data) for one in mine.messages] == [(one.topic, one.log, one.data) for one in theirs.messages]
    assert mine.metadata == theirs.metadata and mine.attachments["camera.yaml"] == theirs.attachments["camera.yaml"]


def test_a_second_film_has_the_same_bytes(tmp_path: pathlib.Path) -> None:
    assert write(tmp_path / "a.mcap").sha256 == write(tmp_path / "b.mcap").sha256


def test_a_camera_that_is_placed_from_outside_is_there_on_tf(tmp_path: pathlib.Path) -> None:
    scene, camera, simulator = simulated()
    pose = np.eye(4)
    pose[:3, 3] = 0.25, 0, -0.5    # to the right and back: on the map −y and −x
    with tofray.McapWriter(tmp_path / "run.mcap", scene, camera, compression="none") as film:
        film.write(simulator.frame(0))
        film.write(simulator.frame(1, camera=tofray.Pose.from_matrix(pose)))
    at = [one.value["transforms"][0]["transform"]["translation"] for one in mcap.Mcap(tmp_path / "run.mcap").on("/tf")]
    assert at[0] == {"x": 0, "y": 0, "z": 0}
    assert at[1] == {"x": -0.5, "y": -0.25, "z": 0}


def test_a_block_that_fails_leaves_what_was_written(tmp_path: pathlib.Path) -> None:
    scene, camera, simulator = simulated()
    with pytest.raises(ZeroDivisionError):
        with tofray.McapWriter(tmp_path / "run.mcap", scene, camera) as film:
            film.write(simulator.frame(0))
            1 // 0
    del film
    assert not (tmp_path / "run.mcap").exists()
    contents = tofray.mcap_contents(tmp_path / "run.part.mcap")
    assert contents["complete"] is False
    assert contents["topics"]["/camera/points"]["messages"] == 1


def test_contents_are_those_of_the_file(tmp_path: pathlib.Path) -> None:
    write(tmp_path / "run.mcap", topics=["depth", "raw"], name="left")
    contents = tofray.mcap_contents(tmp_path / "run.mcap")
    assert contents["complete"] and contents["profile"] == "ros2" and contents["metadata"]["tofray"]["seed"] == "3"
    topic = contents["topics"]["/left/depth_image"]
    assert (topic["type"], topic["messages"]) == ("sensor_msgs/msg/Image", 3)
    assert topic["rate_hz"] == pytest.approx(simulated()[1].mode.frame_rate_hz, rel=1e-6)
    assert contents["bytes"] == (tmp_path / "run.mcap").stat().st_size and "camera.yaml" in contents["attachments"]


def test_what_cannot_be_is_told(tmp_path: pathlib.Path) -> None:
    scene, camera, simulator = simulated()
    with pytest.raises(tofray.Error, match="driver"):
        tofray.McapWriter(tmp_path / "a.mcap", scene, camera, driver="kinect")  # type: ignore[arg-type]
    with pytest.raises(tofray.Error, match="there are no topics"):
        tofray.McapWriter(tmp_path / "a.mcap", scene, camera, topics=["dept"])
    with pytest.raises(tofray.Error, match="expected a folder that exists"):
        tofray.McapWriter(tmp_path / "no/a.mcap", scene, camera)
    with pytest.raises(tofray.Error, match="unknown word 'drivr'"):
        tofray.render("card", tmp_path / "out", emit=["mcap"], mcap={"drivr": "pmd"})
    with pytest.raises(tofray.Error, match="no MCAP file"):
        (tmp_path / "b.mcap").write_text("not one")
        tofray.mcap_contents(tmp_path / "b.mcap")
    film = tofray.McapWriter(tmp_path / "a.mcap", scene, camera)
    film.write(simulator.frame(0))
    film.close()
    with pytest.raises(tofray.Error, match="closed"):
        film.write(simulator.frame(1))
    assert [one.name for one in tmp_path.iterdir() if one.suffix == ".mcap" and one.stem != "b"] == ["a.mcap"]
