# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The examples do what they say, and their types are right."""

from __future__ import annotations

import concurrent.futures
import copy
import ctypes.util
import importlib
import math
import multiprocessing
import os
import pathlib
import pickle
import re
import shutil
import subprocess
import sys
from typing import Any

import numpy as np
import pytest

import tofray

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/python"
SAYS = {"first_frame": r"within (\d+\.\d) mm of the truth", "noise_against_distance": r"2\.0 +(\d+\.\d+) +(\d+\.\d+)",
        "training_frames": r"middle: (?:\d\.\d{3} m(?:, )?){6}\n", "decode_recording": r"(\d+)% of the pixels are valid",
        "torch_loader": r"processes: (24) frames, .*\[4, 172, 224\]\nbeside, on all cores: 24 frames, .*\[4, 172, 224\]\n",
        "open3d_pictures": r"(\d+)% of the pixels have a depth, half of them within (\d+\.\d) mm of the truth",
        "blender_pictures": r"(\d+)% of the pixels have a depth, half of them within (\d+\.\d) mm of the truth",
        "fit_light_power": r"recording (0\.\d+) \+- (0\.\d+) W \(simulated with (0\.\d+) W"}
NEEDS = {"torch_loader": "torch", "fit_light_power": "scipy", "open3d_pictures": "open3d", "blender_pictures": "OpenImageIO"}
PROGRAMS = {"blender_pictures": "blender"}
BRIDGES = ("drake", "mujoco")   # whose tests are test_drake.py and test_mujoco.py


def rays_of_open3d(folder: pathlib.Path) -> dict[str, str]:
    """Debian's Open3D leaves its rays' mask at 0, and its Embree looks at it (ray_mask.c): what has to be preloaded there."""
    asked = ("import numpy, open3d; o = open3d; s = o.t.geometry.RaycastingScene(); box = o.geometry.TriangleMesh.create_box();"
             "s.add_triangles(o.t.geometry.TriangleMesh.from_legacy(box)); rays = o.core.Tensor(numpy.array([[.5, .4, -1, 0, 0, 1]], numpy.float32));"
             "print(float(s.cast_rays(rays)['t_hit'].numpy()[0]))")

    def hits(env: dict[str, str]) -> bool:
        return subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, env={**os.environ, **env}).stdout.strip() == "1.0"

    if hits({}):
        return {}
    library, embree = folder / "ray_mask.so", ctypes.util.find_library("embree3")
    compiler = shutil.which("cc")
    if embree is None or compiler is None:
        pytest.skip("no ray of this Open3D hits anything, and there is no Embree 3 or no cc to mend it")
    subprocess.run([compiler, "-shared", "-fPIC", "-o", str(library), str(ROOT / "tests/python/ray_mask.c"), "-ldl"], check=True)
    env = {"LD_PRELOAD": f"{library} {embree}"}
    if not hits(env):
        pytest.skip("no ray of this Open3D hits anything")
    return env


def expect_own_geometry(frame: tofray.Frame, scene: dict[str, Any], first_id: int) -> None:
    """What another renderer drew is where tofray's own rays find the same things: a wall, a ball and a box."""
    own: Any = tofray.Simulator(tofray.scene({"camera": {"profile": "pico-flexx"}, **scene}), noise="off", arrays=["gt_z_m", "gt_object_id"]).frame(0).truth
    seen: Any = frame.truth
    same = seen.object_id == own.object_id + first_id
    assert same.mean() > 0.995, "but for pixels of edges"
    for i, limit_m in ((0, 2e-5), (2, 2e-5), (1, 3e-4)):
        # A ball of 128 by 64 (Open3D: 120 by 60) flat pieces lies up to 20 cm · (1 − cos(π/64)) = 0.24 mm inside its sphere.
        off = np.abs(seen.z_m - own.z_m)[same & (own.object_id == i)]
        assert off.size > 2000 and np.percentile(off, 90) < limit_m, f"object {i}"


@pytest.mark.parametrize("name", sorted({file.stem for file in EXAMPLES.glob("*.py")} - {"torch_samples"}))  # which takes a set: test_samples.py
def test_an_example_runs_and_says_what_it_should(name: str, tmp_path: pathlib.Path) -> None:
    pytest.importorskip(NEEDS.get(name, "numpy"))
    if name in PROGRAMS and shutil.which(PROGRAMS[name]) is None:
        pytest.skip(f"there is no {PROGRAMS[name]} here (Debian: {PROGRAMS[name]})")
    env = {**os.environ, **(rays_of_open3d(tmp_path) if name == "open3d_pictures" else {})}
    done = subprocess.run([sys.executable, str(EXAMPLES / f"{name}.py")], cwd=tmp_path, capture_output=True, text=True, env=env)
    assert done.returncode == 0, done.stderr
    said = re.search(SAYS[name], done.stdout)
    assert said is not None, done.stdout
    if name == "noise_against_distance":
        # The standard deviation of 12 frames is within 42 % of the true one in 95 % of pixels; the median of
        # 144 pixels is within a few per cent.
        assert float(said[1]) == pytest.approx(float(said[2]), rel=0.15)
    if name == "decode_recording":
        assert int(said[1]) > 50
    ball: dict[str, Any] = {"sphere": {"radius": "20 cm", "reflectivity": 0.5}}
    wall: dict[str, Any] = {"plane": {"reflectivity": 0.5}}
    box: dict[str, Any] = {"box": {"reflectivity": 0.5}}
    if name == "open3d_pictures":
        # Its wall turns about the middle of the front, by 0.4 rad.
        wall["plane"].update(point=[0, 0, 1.6], normal=[-math.sin(0.4), 0, -math.cos(0.4)])
        ball["sphere"]["center"], box["box"]["min"], box["box"]["max"] = [-0.25, 0.1, 1.1], [0.15, 0.05, 1.0], [0.45, 0.35, 1.3]
        expect_own_geometry(tofray.load(tmp_path / "open3d/frame.npz"), {"objects": [wall, ball, box]}, 0)
    if name == "blender_pictures":
        wall["plane"].update(point=[0, 1.8, 0], normal=[math.sin(0.4), -math.cos(0.4), 0])
        ball["sphere"]["center"], box["box"]["min"], box["box"]["max"] = [-0.25, 1.1, 0.9], [0.15, 1.05, 0.7], [0.45, 1.35, 1.0]
        pose = {"position": [0, 0, 1], "axes": "opengl", "euler": {"roll": "1.5 rad"}}
        expect_own_geometry(tofray.load(tmp_path / "blender/frame.npz"), {"camera": {"profile": "pico-flexx", "pose": pose}, "objects": [wall, ball, box]}, 1)


def example(name: str) -> Any:
    if str(EXAMPLES) not in sys.path:
        sys.path.insert(0, str(EXAMPLES))  # so that what it holds can be pickled
    return importlib.import_module(name)


def frames_for_training(count: int = 4, **words: Any) -> Any:
    scene = tofray.load_scene("card")
    return example("training_frames").Frames(scene, tofray.load_camera(scene), count, **words)


def test_each_frame_for_training_is_another_and_the_same_in_each_worker() -> None:
    frames = frames_for_training(seed=4)
    here = [frames[i] for i in range(len(frames))]
    assert len({z_m.tobytes() for _, z_m in here}) == len({codes.tobytes() for codes, _ in here}) == 4
    with pytest.raises(IndexError):
        frames[4]
    # Through fork() and through a pickle, as torch's workers get it, and in threads.
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
        there = list(pool.map(frames.__getitem__, range(4)))
    with concurrent.futures.ThreadPoolExecutor(2) as threads:
        beside = list(threads.map(frames.__getitem__, range(4)))
    again = pickle.loads(pickle.dumps(frames))
    for i, (codes, z_m) in enumerate(here):
        for other in (there[i], beside[i], again[i]):
            assert other[0].tobytes() == codes.tobytes() and other[1].tobytes() == z_m.tobytes()
    assert frames_for_training(seed=5)[0][1].tobytes() != here[0][1].tobytes()


def test_a_frame_for_training_is_that_of_its_request() -> None:
    frames = frames_for_training(seed=4)
    scene = tofray.load_scene("card")
    scene.camera.pose = frames.pose(3)
    expected = tofray.Simulator(scene, seed=4).frame(3)
    codes, z_m = frames[3]
    assert (codes == expected.raw.raw).all() and codes.min() >= 0 and z_m.tobytes() == expected.truth.z_m.tobytes()


def test_codes_that_do_not_fit_are_refused() -> None:
    camera = tofray.load_camera("pico-flexx")
    camera.adc.bits = 16
    with pytest.raises(ValueError, match="16 bits"):
        example("training_frames").Frames(tofray.load_scene("card"), camera, 1)


def test_the_targets_are_those_of_the_poses() -> None:
    # The card stands 1 m before the scene's pose, and d = 0.8 to 1.2 m before that of a frame. What is looked at is at least d - 0.2 m
    # ahead and sqrt(2) * 0.4 m aside at the most: along the axis the card is as far as d * sqrt(1 + (0.57 / (d - 0.2))**2) < 1.4 m.
    middles = [float(z_m[z_m.shape[0] // 2, z_m.shape[1] // 2]) for _, z_m in frames_for_training()]
    assert all(0.79 < z < 1.41 for z in middles) and len(set(middles)) == 4


@pytest.mark.parametrize("workers", [0, 1, 2, "ahead"])
def test_torch_gets_each_frame_once(workers: Any) -> None:
    torch: Any = pytest.importorskip("torch")
    loader, frames = example("torch_loader"), frames_for_training(7, seed=4)
    data: Any = importlib.import_module("torch.utils.data")
    stream = loader.Stream(frames, 2)
    batches = list(loader.ahead(stream) if workers == "ahead" else data.DataLoader(stream, batch_size=None, num_workers=workers))
    assert len(batches) == 4 and all(codes.dtype == torch.int16 and z_m.dtype == torch.float32 for codes, z_m in batches)
    got = [(codes.numpy().tobytes(), z_m.numpy().tobytes()) for batch in batches for codes, z_m in zip(*batch)]
    expected = [(codes.tobytes(), z_m.tobytes()) for codes, z_m in (frames[i] for i in range(7))]
    assert len(got) == 7 and sorted(got) == sorted(expected)
    assert got == expected, "two workers give the batches in turn"


def test_torch_looks_into_a_frames_memory() -> None:
    torch: Any = pytest.importorskip("torch")
    frame = tofray.demo()
    tensor = torch.from_dlpack(frame.depth.z_m)
    assert tensor.shape == frame.depth.z_m.shape and tensor.dtype == torch.float32
    frame.depth.z_m[3, 5] = 42
    assert float(tensor[3, 5]) == 42
    kept = tensor.numpy().tobytes()
    del frame
    tofray.demo()
    assert tensor.numpy().tobytes() == kept, "the tensor keeps the memory alive"
    signed = torch.from_dlpack(tofray.demo().raw.raw.view("int16"))  # torch before 2.3 has no uint16
    assert int(signed.max()) < 4096


def test_the_fitted_power_is_that_of_the_recording() -> None:
    pytest.importorskip("scipy")
    fitted = example("fit_light_power")
    scene, camera = tofray.scene({"objects": [{"plane": {"point": [0, 0, 1.5], "normal": [0, 0, -1], "reflectivity": 0.8}}]}), \
        tofray.load_camera("pico-flexx", "MODE_9_5FPS_2000")
    for factor in (0.7, 1.3):
        real = copy.deepcopy(camera)
        real.illumination[0].power_w = factor * camera.illumination[0].power_w
        power_w, error_w = fitted.fit(tofray.Simulator(scene, real, seed=3).frame(0).raw, scene, camera)
        # 8 raw frames of 38,528 pixels, each pixel's signal known to a few per cent: some 0.02 % of the power, and 4.5 sigma of it
        # are wrong once in 150,000.
        assert 0 < error_w < 5e-4 * power_w
        assert abs(power_w - real.illumination[0].power_w) < 4.5 * error_w


def test_types_are_right() -> None:
    pytest.importorskip("mypy")
    done = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", os.devnull, "--config-file", str(ROOT / "tests/python/mypy.ini"),
                           str(ROOT / "python/tofray"), *map(str, sorted(EXAMPLES.glob("*.py"))), *map(str, sorted(file for name in BRIDGES for file in (ROOT / "examples" / name).glob("*.py"))), str(ROOT / "tests/python")],
                          cwd=ROOT / "python", capture_output=True, text=True, env={**os.environ, "MYPYPATH": os.pathsep.join(map(str, (EXAMPLES, *(ROOT / "examples" / name for name in BRIDGES))))})
    assert done.returncode == 0, done.stdout + done.stderr
