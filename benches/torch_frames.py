#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""torch_frames.py TOFRAY [COUNT [ROUNDS]]: frames per second that a torch loader gets (examples/python/torch_loader.py), from two processes
and from two threads, against `tofray bench`, in turn; medians of rounds. Each frame has a pose of its own; starting workers counts."""

import json
import pathlib
import statistics
import subprocess
import sys
import time
from typing import Any, Iterable

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "examples/python"))

from torch.utils.data import DataLoader  # noqa: E402
from torch_loader import Stream, in_threads  # noqa: E402
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
    frames = Frames(scene, tofray.load_camera(scene), count)
    rows = []
    for _ in range(rounds):
        done = subprocess.run([program, "bench", SCENE, "--threads", "2", "--frames", str(count), "--json"], check=True, capture_output=True, text=True)
        bench = json.loads(done.stdout)["results"][0]["frames_per_s"]
        since = time.perf_counter()
        processes = per_second(DataLoader(Stream(frames), batch_size=BATCH, num_workers=2), count, since)
        since = time.perf_counter()
        rows.append([bench, processes, per_second(in_threads(frames, BATCH, 2), count, since)])
    bench, processes, threads = (statistics.median(column) for column in zip(*rows))
    for name, rate in (("tofray bench", bench), ("torch loader, two processes", processes), ("torch loader, two threads", threads)):
        print(f"{name:28} {rate:7.1f} frames/s  {100 * rate / bench:5.1f} %")


if __name__ == "__main__":
    main()
