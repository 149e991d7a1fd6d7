#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""torch_frames.py TOFRAY [COUNT [ROUNDS]]: frames per second that a torch loader gets (examples/python/torch_loader.py), from two worker
processes and beside the training on two threads, against `tofray bench`, in turn; medians of rounds. Each frame has a pose of its own;
what it takes to start workers and simulators counts."""

import json
import pathlib
import statistics
import subprocess
import sys
import time
from typing import Any, Iterable

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "examples/python"))

from torch.utils.data import DataLoader  # noqa: E402
from torch_loader import Stream, ahead  # noqa: E402
from training_frames import Frames  # noqa: E402

import tofray  # noqa: E402

SCENE, BATCH = "bench-primitives", 8


def per_second(batches: Iterable[Any], count: int, since: float) -> float:
    seen = sum(len(z_m) for _, z_m in batches)
    assert seen == count
    return count / (time.perf_counter() - since)


def main() -> None:
    program = sys.argv[1]
    count, rounds = (int(word) for word in [*sys.argv[2:4], *["1000", "5"][len(sys.argv) - 2:]])
    scene = tofray.load_scene(SCENE)
    camera = tofray.load_camera(scene)
    rows = []
    for _ in range(rounds):
        done = subprocess.run([program, "bench", SCENE, "--threads", "2", "--frames", str(count), "--json"], check=True, capture_output=True, text=True)
        bench = json.loads(done.stdout)["results"][0]["frames_per_s"]
        since = time.perf_counter()
        processes = per_second(DataLoader(Stream(Frames(scene, camera, count), BATCH), batch_size=None, num_workers=2), count, since)
        since = time.perf_counter()
        rows.append([bench, processes, per_second(ahead(Stream(Frames(scene, camera, count, threads=2), BATCH)), count, since)])
    for column, name in enumerate(("tofray bench", "torch, two worker processes", "torch, beside it on two threads")):
        rates, shares = [row[column] for row in rows], [100 * row[column] / row[0] for row in rows]
        print(f"{name:32} {statistics.median(rates):7.1f} frames/s  {statistics.median(shares):5.1f} %")


if __name__ == "__main__":
    main()
