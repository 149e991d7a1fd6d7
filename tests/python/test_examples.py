# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The examples do what they say, and their types are right."""

from __future__ import annotations

import concurrent.futures
import importlib
import importlib.util
import multiprocessing
import os
import pathlib
import pickle
import re
import subprocess
import sys
from typing import Any

import pytest

import tofray

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples/python"
SAYS = {"first_frame": r"within (\d+\.\d) mm of the truth", "noise_against_distance": r"2\.0 +(\d+\.\d+) +(\d+\.\d+)",
        "torch_loader": r"middle: (?:\d\.\d{3} m(?:, )?){6}\n", "decode_recording": r"(\d+)% of the pixels are valid"}


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


def frames_of_the_loader(**words: Any) -> Any:
    module = importlib.util.spec_from_file_location("torch_loader", EXAMPLES / "torch_loader.py")
    assert module is not None and module.loader is not None
    loaded = importlib.util.module_from_spec(module)
    sys.modules["torch_loader"] = loaded  # so that it can be pickled
    module.loader.exec_module(loaded)
    scene = tofray.load_scene("card")
    return loaded.Frames(scene, tofray.load_camera(scene), 4, **words)


def test_each_frame_of_the_loader_is_another_and_the_same_in_each_worker() -> None:
    frames = frames_of_the_loader(seed=4)
    here = [frames[i] for i in range(len(frames))]
    assert len({z_m.tobytes() for _, z_m in here}) == len({raw.tobytes() for raw, _ in here}) == 4
    with pytest.raises(IndexError):
        frames[4]
    # Through fork() and through a pickle, as torch's workers get it.
    with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context("fork")) as pool:
        there = list(pool.map(frames.__getitem__, range(4)))
    again = pickle.loads(pickle.dumps(frames))
    for i, (raw, z_m) in enumerate(here):
        for other in (there[i], again[i]):
            assert other[0].tobytes() == raw.tobytes() and other[1].tobytes() == z_m.tobytes()
    assert frames_of_the_loader(seed=5)[0][1].tobytes() != here[0][1].tobytes()


def test_the_loaders_targets_are_those_of_its_poses() -> None:
    # The card stands 1 m before the scene's pose, and d = 0.8 to 1.2 m before that of a frame. What is looked at is at least d - 0.2 m
    # ahead and sqrt(2) * 0.4 m aside at the most: along the axis the card is as far as d * sqrt(1 + (0.57 / (d - 0.2))**2) < 1.4 m.
    middles = [float(z_m[z_m.shape[0] // 2, z_m.shape[1] // 2]) for _, z_m in frames_of_the_loader()]
    assert all(0.79 < z < 1.41 for z in middles) and len(set(middles)) == 4


@pytest.mark.parametrize("workers", [0, 2])
def test_torch_takes_the_loader(workers: int) -> None:
    pytest.importorskip("torch")
    DataLoader = importlib.import_module("torch.utils.data").DataLoader
    batches = list(DataLoader(frames_of_the_loader(), num_workers=workers, batch_size=2))
    assert len(batches) == 2 and all(len(raw) == 2 for raw, _ in batches)


def test_types_are_right() -> None:
    pytest.importorskip("mypy")
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "--config-file", "",
                           "--allow-untyped-decorators", "--allow-subclassing-any", "--no-warn-unused-ignores",
                           str(ROOT / "python/tofray"), str(EXAMPLES), str(ROOT / "tests/python")],
                          cwd=ROOT / "python", capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
