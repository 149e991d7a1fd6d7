#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What the sensor's effects cost: time of a frame with all of them, and with each alone, over that without.  whole_pixel.py TOFRAY [ROUNDS [EFFECTS...]]

`tofray bench` of the scene bench-primitives, all variants in turn in each round; ratios of the fastest tenths, medians over the rounds. Effects
that take a pass over the image of their own (crosstalk, scatter, what overflows into neighbours) are not among them."""
import json
import statistics
import subprocess
import sys

effects = {
    "patterns": ["pixel.patterns={prnu: 1 %, dsnu: 2 DN, delay: 20 ps, phase_offset: 0.02 rad, seed: 1}"],
    "column and row noise": ["pixel.column_noise=10 e", "pixel.row_noise=10 e"],
    "dark current": ["pixel.dark_current=10000 e/s", "pixel.dark_current_doubling=8 K", "temperature.actual=40 degC"],
    "reset noise": ["pixel.reset_noise={sigma: 50 e, cancelled: true}"],
    "taps that differ": ["pixel.taps={gain_mismatch: 1 %, offset_mismatch: 100 e}"],
    "background suppression": ["pixel.suppression={threshold: 1000 e, budget: 100000 e, noise_factor: 1}"],
    "non-linearity": ["pixel.nonlinearity={charge: [0 e, 40000 e, 80000 e, 100000 e], read: [0 e, 39500 e, 77000 e, 94000 e]}"],
    "second camera": ["interference={share: 5 %, frequency_difference: 30 Hz, active: 50 %}"],
    "swept frequencies": ["spread_spectrum={width: 1 %}"],
}
variants = {"none": [], **effects, "all": [one for each in effects.values() for one in each]}


def milliseconds(tofray, settings, threads, noise):
    command = [tofray, "bench", "--json", "--frames", "60", "--threads", str(threads), "--noise", noise]
    for one in settings:
        command += ["--set", "camera." + one]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return json.loads(done.stdout)["results"][0]["ms_p10"]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tofray, rounds = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5
    print("| effects | exact, 1 thread | exact, 2 threads | off, 1 thread | off, 2 threads |\n|---|---|---|---|---|")
    wanted = {name: settings for name, settings in variants.items() if name == "none" or not sys.argv[3:] or name in sys.argv[3:]}
    times = {name: {} for name in wanted}
    for _ in range(rounds):
        for noise in ("exact", "off"):
            for threads in (1, 2):
                for name, settings in wanted.items():
                    times[name].setdefault((noise, threads), []).append(milliseconds(tofray, settings, threads, noise))
    for name, measured in times.items():
        cells = []
        for key, ms in measured.items():
            if name == "none":
                cells.append(f"{statistics.median(ms):.2f} ms")
            else:
                cells.append(f"{statistics.median(a / b for a, b in zip(ms, times['none'][key])):.2f}")
        print(f"| {name} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
