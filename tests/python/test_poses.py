# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Poses from matrices and quaternions and back, and files of them, as Python has them."""
import math
import pathlib

import numpy as np
import pytest
from numpy.typing import NDArray

import tofray

# Columns: right, down and forward of a camera that looks along x and has z up.
AHEAD = np.array([[0, 0, 1, 0.5], [-1, 0, 0, 0], [0, -1, 0, 0.25], [0, 0, 0, 1]], float)


def rotation(angle: float, x: float, y: float, z: float) -> NDArray[np.float64]:
    """Rodrigues' formula."""
    k = np.array([x, y, z]) / math.sqrt(x * x + y * y + z * z)
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    turned: NDArray[np.float64] = np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross
    return turned


def test_a_pose_goes_to_a_matrix_and_back() -> None:
    for i in range(20):
        matrix = np.eye(4)
        matrix[:3, :3], matrix[:3, 3] = rotation(0.3 * i, 1, 0.2 * i, -2), (1, 2, -i)
        pose = tofray.Pose.from_matrix(matrix)
        assert isinstance(pose, tofray.Pose) and pose.position == (1, 2, -i)
        assert np.abs(pose.matrix - matrix).max() < 1e-14
        assert pose.matrix.shape == (4, 4) and pose.matrix.dtype == np.float64


def test_a_placement_comes_of_a_matrix() -> None:
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation(0.7, 1, 2, 3), (1, 2, 3)
    placement = tofray.Placement.from_matrix(matrix)
    assert isinstance(placement, tofray.Placement) and placement.position == (1, 2, 3)
    assert placement.rotation.quaternion == tofray.Pose.from_matrix(matrix).quaternion
    with pytest.raises(tofray.Error):
        tofray.Placement.from_matrix(2 * matrix)


def test_the_scalar_is_last() -> None:
    half = math.radians(45)
    pose = tofray.Pose.from_quaternion([1, 2, 3], [0, 0, math.sin(half), math.cos(half)])
    assert np.allclose(pose.matrix, [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]], rtol=0, atol=1e-15)
    quaternion = tofray.Pose.from_quaternion([0, 0, 0], [0, 0, 0.6004, 0.8]).quaternion
    assert quaternion is not None and math.isclose(math.hypot(*quaternion), 1, rel_tol=1e-15)


def test_poses_of_a_body_and_of_opengl_are_turned_to_the_optical_axes() -> None:
    place = [0.5, 0, 0.25]
    assert np.array_equal(tofray.Pose.from_quaternion(place, [0, 0, 0, 1], axes="body").matrix, AHEAD)
    body = np.eye(4)
    body[:3, 3] = place
    assert np.array_equal(tofray.Pose.from_matrix(body, axes="body").matrix, AHEAD)
    opengl = AHEAD @ np.diag([1, -1, -1, 1])
    assert np.array_equal(tofray.Pose.from_matrix(opengl, axes="opengl").matrix, AHEAD)
    # Lists are good, too; the file says the same.
    scene = tofray.scene({"camera": {"pose": {"matrix": body.tolist(), "axes": "body"}}, "objects": []})
    assert np.array_equal(tofray.camera_pose(scene), AHEAD)


def test_a_pose_by_look_at_has_a_matrix_which_gives_the_same_frame() -> None:
    objects = [{"plane": {"point": [2, 0, 0], "normal": [-1, 0, 0], "reflectivity": 0.8}},
               {"sphere": {"center": [1.3, 0.1, 0.5], "radius": "25 cm", "reflectivity": 0.4}}]
    scene = tofray.scene({"world_up": "z", "camera": {"pose": {"position": [0.5, 0, 0.25], "look_at": [1, 0, 0.25]}}, "objects": objects})
    assert np.array_equal(scene.camera.pose.matrix, AHEAD) and scene.world_up == "z"
    first = tofray.Simulator(scene, seed=5).frame(0)
    scene.camera.pose = tofray.Pose.from_matrix(scene.camera.pose.matrix)
    assert scene.camera.pose.quaternion is not None
    assert np.array_equal(tofray.Simulator(scene, seed=5).frame(0).raw.raw, first.raw.raw)


@pytest.mark.parametrize(("matrix", "says"), [
    (np.eye(3), r"shape \(3, 3\)"),
    (np.diag([1.0, 1, -1, 1]), "the matrix mirrors: its determinant is -1"),
    (np.diag([2.0, 2, 2, 1]), "the matrix scales"),
    (np.array([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 2, 3, 1.0]]), "a transposed matrix has it in the last row"),
    (np.full((4, 4), np.nan), "not finite, at row 0, column 0"),
])
def test_what_is_no_pose_is_refused(matrix: NDArray[np.float64], says: str) -> None:
    with pytest.raises(ValueError, match=says):
        tofray.Pose.from_matrix(matrix)


def test_wrong_words_and_quaternions_are_refused() -> None:
    with pytest.raises(ValueError, match="got a length of 2, expected 1; its order is x, y, z, w"):
        tofray.Pose.from_quaternion([0, 0, 0], [0, 0, 0, 2])
    with pytest.raises(ValueError, match="expected optical, body or opengl"):
        tofray.Pose.from_matrix(np.eye(4), axes="ros")  # type: ignore[arg-type]
    with pytest.raises(tofray.Error, match="looks nowhere"):
        tofray.Pose(look_at=(0, 0, 0)).matrix
    both = tofray.Pose.from_quaternion([0, 0, 0], [0, 0, 0, 1])
    both.look_at = (0, 0, 3)
    scene = tofray.scene({"objects": []})
    scene.camera.pose = both
    with pytest.raises(tofray.Error, match="the pose has a quaternion, and look_at or up"):
        tofray.Simulator(scene)


def test_poses_out_of_a_file_are_keyframes(tmp_path: pathlib.Path) -> None:
    (tmp_path / "way.csv").write_text("1305031449.5 0 0 0 0 0 0 1\n1305031450.5 0 0 1 0 0 0.6 0.8\n")
    (tmp_path / "scene.yaml").write_text("camera: {keyframes: {file: way.csv}}\nobjects: []\n")
    scene = tofray.load_scene(tmp_path / "scene.yaml")
    assert [one.time_s for one in scene.camera.keyframes] == [0, 1]
    assert scene.camera.keyframes[1].pose.quaternion == (0, 0, 0.6, 0.8)
    assert [one.file for one in scene.files] == ["way.csv"] and len(scene.files[0].sha256) == 64
    half = 0.5 * 2 * math.asin(0.6)
    expected = np.eye(4)
    expected[:3, :3], expected[2, 3] = rotation(half, 0, 0, 1), 0.5
    assert np.abs(tofray.camera_pose(scene, 0.5) - expected).max() < 1e-15
