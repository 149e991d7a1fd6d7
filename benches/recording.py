#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""recording.py TOFRAY BENCH_FRAMES [FOLDER] [--frames N] [--rounds N]: does `tofray render --frames` keep up with the slower of computing and the disk?

In turn, in each round and for each choice of arrays: frames per second that are computed (benches/frames.cpp, nothing written); that the
disk of FOLDER takes (files of a frame's size from memory, written by as many threads as tofray's, each synced before it counts); and that
`tofray render` records. Medians of the rounds, and the share of the slower of the two. Beside it the processor's time of a recorded frame, by
which `cores / time` frames per second can be recorded at most, and the share of that.

Files are removed at the end (some 32 GB, of 500 frames and 3 rounds): where many were removed a moment ago, ext4 searches long for a place for each new one."""

import argparse
import concurrent.futures
import os
import pathlib
import resource
import shutil
import statistics
import subprocess
import tempfile
import time

SCENE, WRITERS = "room", 6
CHOICES = ("all", "raw,z_m,flags")


def run(*command: object) -> str:
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def computed(program: str, frames: int, truth: bool) -> float:
    kept = float(run(program, SCENE, frames, *([] if truth else ["no-truth"])).split()[1])
    return 1e3 / kept


def settle() -> None:
    """What the run before left to the disk is no part of the next."""
    os.sync()


def processor_s() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def recorded(tofray: str, folder: pathlib.Path, frames: int, arrays: str) -> tuple[float, float, int]:
    """Frames per second, processor's time of one [s], bytes of its file."""
    settle()
    before, since = processor_s(), time.perf_counter()
    run(tofray, "render", SCENE, "--frames", frames, "-o", folder, "--quiet", *([] if arrays == "all" else ["--arrays", arrays]))
    rate = frames / (time.perf_counter() - since)
    return rate, (processor_s() - before) / frames, next(folder.glob("frame_*.npz")).stat().st_size


def write(path: pathlib.Path, data: bytes) -> None:
    with open(path, "wb", buffering=0) as file:
        file.write(data)
        os.fsync(file.fileno())


def taken_by_disk(folder: pathlib.Path, frames: int, size: int) -> float:
    folder.mkdir()
    data = os.urandom(size)
    settle()
    since = time.perf_counter()
    with concurrent.futures.ThreadPoolExecutor(WRITERS) as pool:
        list(pool.map(lambda i: write(folder / f"{i}.npz", data), range(frames)))
    return frames / (time.perf_counter() - since)


def measured(given: argparse.Namespace, where: pathlib.Path, arrays: str) -> str:
    """A row of the table."""
    rows = []
    for i in range(given.rounds):
        rate, busy, size = recorded(given.tofray, where / f"frames-{arrays}-{i}", given.frames, arrays)
        rows.append((computed(given.bench_frames, given.frames, arrays == "all"), taken_by_disk(where / f"disk-{arrays}-{i}", given.frames, size), rate, busy))
    c, d, r, busy = (statistics.median(column) for column in zip(*rows))
    share, allowed = 100 * r / min(c, d), len(os.sched_getaffinity(0)) / busy
    return f"| {arrays} | {size / 1e6:.2f} | {c:.0f} | {d:.0f} | {r:.0f} | {share:.0f} % | {1e3 * busy:.1f} | {100 * r / allowed:.0f} % |"


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("tofray")
    options.add_argument("bench_frames")
    options.add_argument("folder", nargs="?", default=".")
    options.add_argument("--frames", type=int, default=500)
    options.add_argument("--rounds", type=int, default=3)
    given = options.parse_args()
    where = pathlib.Path(tempfile.mkdtemp(dir=given.folder))
    try:
        print("| arrays | MB a frame | computed | disk takes | recorded | of the slower | processor, ms a frame | of what it allows |")
        print("|---|---|---|---|---|---|---|---|")
        for arrays in CHOICES:
            print(measured(given, where, arrays), flush=True)
    finally:
        shutil.rmtree(where)


if __name__ == "__main__":
    main()
