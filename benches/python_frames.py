#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""python_frames.py PROGRAM [SCENE]: what a frame costs from Python and from C++ (benches/frames.cpp), in turn; medians of rounds."""

import statistics
import subprocess
import sys
import time

import tofray

ROUNDS, COUNT = 11, 100


def milliseconds(simulator: tofray.Simulator, touch: bool) -> float:
    since = time.perf_counter()
    for i in range(COUNT):
        frame = simulator.frame(i)
        if touch:
            frame.depth.z_m
    return (time.perf_counter() - since) * 1e3 / COUNT


def main() -> None:
    program, scene = sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else "bench-primitives"
    simulator = tofray.Simulator(tofray.load_scene(scene), threads=2)
    rows: list[list[float]] = []
    for _ in range(ROUNDS):
        done = subprocess.run([program, scene, str(COUNT)], check=True, capture_output=True, text=True)
        there = [float(word) for word in done.stdout.split()]
        rows.append([*there, milliseconds(simulator, False), milliseconds(simulator, True)])
    anew, kept, python, touched = (statistics.median(column) for column in zip(*rows))
    print(f"C++, a new frame each time    {anew:.3f} ms\nC++, one frame kept           {kept:.3f} ms")
    print(f"Python                        {python:.3f} ms ({100 * (python / anew - 1):+.1f} %, {100 * (python / kept - 1):+.1f} %)")
    print(f"Python, one array looked at   {touched:.3f} ms ({100 * (touched / anew - 1):+.1f} %, {100 * (touched / kept - 1):+.1f} %)")


if __name__ == "__main__":
    main()
