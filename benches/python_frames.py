#!/usr/bin/python3
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
    anew, kept, in_turn, python, touched = (statistics.median(column) for column in zip(*rows))
    for name, time_ms in (("C++, a new frame each time", anew), ("C++, one frame kept", kept), ("C++, two frames in turn", in_turn),
                          ("Python", python), ("Python, one array looked at", touched)):
        print(f"{name:30}{time_ms:.3f} ms")
    for there, name in ((anew, "a new frame each time"), (in_turn, "two frames in turn, as here")):
        print(f"Python against C++, {name}: {100 * (python / there - 1):+.1f} %, and one array looked at {100 * (touched / there - 1):+.1f} %")


if __name__ == "__main__":
    main()
