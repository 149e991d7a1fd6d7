# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The examples do what they say, and their types are right."""

from __future__ import annotations

import importlib
import os
import pathlib
import re
import runpy
import subprocess
import sys

import pytest

import tofray

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/python"
SAYS = {"first_frame": r"within (\d+\.\d) mm of the truth", "noise_against_distance": r"2\.0 +(\d+\.\d+) +(\d+\.\d+)",
        "torch_loader": r"\[\[0, 2, 4\], \[1, 3, 5\]\]", "decode_recording": r"(\d+)% of the pixels are valid"}


@pytest.mark.parametrize("name", sorted(file.stem for file in EXAMPLES.glob("*.py")))
def test_an_example_runs_and_says_what_it_should(name: str, tmp_path: pathlib.Path) -> None:
    done = subprocess.run([sys.executable, str(EXAMPLES / f"{name}.py")], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    said = re.search(SAYS[name], done.stdout)
    assert said is not None, done.stdout
    if name == "noise_against_distance":
        # The standard deviation of 12 frames is within 42 % of the true one in 95 % of pixels; the median of
        # 144 pixels is within a few per cent.
        assert float(said[1]) == pytest.approx(float(said[2]), rel=0.15)
    if name == "decode_recording":
        assert int(said[1]) > 50


def test_no_frame_of_the_loader_comes_twice_and_each_is_the_simulators() -> None:
    share = runpy.run_path(str(EXAMPLES / "torch_loader.py"))["FrameShare"]
    scene = tofray.load_scene("card")
    camera = tofray.load_camera(scene)
    rows = [row for worker in range(3) for row in share(scene, camera, 7, worker=worker, workers=3, seed=4)]
    assert sorted(index for index, _, _ in rows) == list(range(7))
    simulator = tofray.Simulator(scene, camera, seed=4)
    for index, raw, z_m in rows:
        frame = simulator.frame(index)
        assert raw.tobytes() == frame.raw.raw.astype("float32").tobytes() and z_m.tobytes() == frame.truth.z_m.tobytes()


@pytest.mark.parametrize("workers", [0, 2])
def test_torch_takes_the_loader(workers: int) -> None:
    pytest.importorskip("torch")
    DataLoader = importlib.import_module("torch.utils.data").DataLoader

    scene = tofray.load_scene("card")
    frames = runpy.run_path(str(EXAMPLES / "torch_loader.py"))["dataset"](scene, tofray.load_camera(scene), 6)
    assert sorted(int(index) for index, _, _ in DataLoader(frames, num_workers=workers, batch_size=None)) == list(range(6))


def test_types_are_right() -> None:
    pytest.importorskip("mypy")
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "--config-file", "",
                           "--allow-untyped-decorators", "--allow-subclassing-any", "--no-warn-unused-ignores",
                           str(ROOT / "python/tofray"), str(EXAMPLES), str(ROOT / "tests/python")],
                          cwd=ROOT / "python", capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
