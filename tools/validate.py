#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Measured beside simulated range noise of real cameras: what docs/validation.md says. Data: data/measured.

One pixel on the axis, a matt wall in the dark, `tofray budget`: expected noise of a single frame, before any filter.
Rows that a profile was fitted to are marked "fitted": they say how well the model can follow, and validate nothing.

    python3 tools/validate.py                  prints the tables (Python's own library and the program `tofray`, or TOFRAY=…)
    python3 tools/validate.py --check          exit code 1 where a figure leaves its bounds
    /usr/bin/python3 tools/validate.py --fit   fits o3d303 anew (numpy, scipy); nothing is written
"""

import csv
import io
import math
import statistics
import subprocess
import sys

from one_pixel import ROOT, program, wall

LIGHT_M_S = 299792458.0


def measured(name):
    """Pairs (distance [m], deviation [mm]) of a file of data/measured."""
    lines = (ROOT / "data/measured" / name).read_text(encoding="utf-8").split("\n")
    return [(1e-3 * float(line.split()[0]), float(line.split()[1])) for line in lines if line.strip()]


def simulated(camera, mode, reflectivity, distances):
    """Deviation of the range [mm] at each distance [m], as `tofray budget` expects it."""
    command = [program(), "budget", camera, "--mode", mode, "--reflectivity", f"{reflectivity:.6g}", "--csv"]
    command += ["--distance", ",".join(f"{distance:.9g}m" for distance in distances)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(command)}\n{done.stderr}")
    rows = [row for row in csv.DictReader(io.StringIO(done.stdout)) if row.get("sigma_m")]
    if len(rows) != len(distances):
        raise SystemExit(f"error: {len(rows)} rows of tofray budget for {len(distances)} distances")
    return [1e3 * float(row["sigma_m"]) for row in rows]


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def o3d303_rows():
    """Without the two rows above 250 mm."""
    return [row for row in measured("ifm-o3d303/distance_noise_o3d303.dat") if row[1] < 250]


def humps(rows, noise):
    """Amplitude of ln(noise) over one cycle per c/8f at 30 MHz, beside a power law of the distance: by least squares."""
    period = LIGHT_M_S / (8 * 30e6)
    columns = [[1.0, math.log(d), math.cos(2 * math.pi * d / period), math.sin(2 * math.pi * d / period)] for d, _ in rows]
    right = [math.log(value) for value in noise]
    matrix = [[sum(c[i] * c[j] for c in columns) for j in range(4)] + [sum(c[i] * y for c, y in zip(columns, right))] for i in range(4)]
    for i in range(4):
        for k in range(i + 1, 4):
            factor = matrix[k][i] / matrix[i][i]
            matrix[k] = [a - factor * b for a, b in zip(matrix[k], matrix[i])]
    found = [0.0] * 4
    for i in reversed(range(4)):
        found[i] = (matrix[i][4] - sum(matrix[i][j] * found[j] for j in range(i + 1, 4))) / matrix[i][i]
    return math.hypot(found[2], found[3])


def table(rows, noise, step, fitted):
    """Medians of `step` rows each."""
    print("| m | measured, mm | simulated, mm | | |\n|---|---|---|---|---|")
    for first in range(0, len(rows), step):
        part = range(first, min(first + step, len(rows)))
        distance, real, here = (statistics.median(values) for values in
                                ([rows[i][0] for i in part], [rows[i][1] for i in part], [noise[i] for i in part]))
        print(f"| {distance:.2f} | {real:.1f} | {here:.1f} | {here / real - 1:+.0%} | {'fitted' if fitted else ''} |")


def o3d303():
    """Figures of the O3D303's noise by name, with the bounds that --check holds them to."""
    rows = o3d303_rows()
    noise = simulated("o3d303", "under5m_low", 0.8, [distance for distance, _ in rows])
    errors = [math.log(here / real) for here, (_, real) in zip(noise, rows)]
    inner = [error for error in errors if abs(error) < 0.35]
    print("O3D303, 30 MHz alone (under5m_low), 80 % assumed: 139 rows, medians of ten")
    table(rows, noise, 10, True)
    return {
        "O3D303, scatter of all rows": (rms(errors), 0.11, 0.13),
        "O3D303, rows within a factor of e^0.35": (len(inner), 135, 137),
        "O3D303, scatter of those": (rms(inner), 0.09, 0.11),
        "O3D303, mean error": (statistics.fmean(errors), -0.04, 0.04),
        "O3D303, humps of c/8f, measured": (humps(rows, [real for _, real in rows]), 0.13, 0.23),
        "O3D303, humps of c/8f, simulated": (humps(rows, noise), 0.13, 0.23),
    }


def filtered(camera, mode, reflectivity, distance, sets=()):
    """Deviation of the range [mm] over 48 x 48 simulated pixels of a wall, after the profile's filter."""
    side = 48
    arrays = wall(camera, mode, distance, reflectivity, side, ("range_m", "gt_range_m"), ["--seed", "5"], sets)
    ranges, truth = arrays["range_m"], arrays["gt_range_m"]
    errors = [1e3 * (a - b) for a, b in zip(ranges, truth) if a > 0]
    if 2 * len(errors) < side * side:
        raise SystemExit(f"error: {camera} sees {len(errors)} of {side * side} pixels of a wall at {distance:g} m")
    wide = 6 * 1.4826 * statistics.median(abs(error) for error in errors)  # beyond: whole cycles off
    return rms([error for error in errors if abs(error) < wide])


KINECT_PAPER = 0.4  # black paper's reflectivity at 860 nm: not known, assumed


def kinect():
    """The Kinect v2 on black paper; light and filter were fitted to the rows beyond 2.4 m."""
    rows = measured("kinect-v2/distance_noise_kinect_dark.dat")
    print(f"\nKinect v2, black paper, {KINECT_PAPER:.0%} assumed: medians of six, one frame after the profile's filter")
    print("| m | measured, mm | before the filter, mm | simulated, mm | | |\n|---|---|---|---|---|---|")
    near, far = [], []
    for first in range(0, len(rows), 6):
        distance, real = (statistics.median(row[i] for row in rows[first : first + 6]) for i in (0, 1))
        raw = simulated("kinect-v2", "DEPTH_30FPS", KINECT_PAPER, [distance])[0]
        here = filtered("kinect-v2", "DEPTH_30FPS", KINECT_PAPER, distance)
        (far if distance > 2.4 else near).append(math.log(here / real))
        print(f"| {distance:.2f} | {real:.2f} | {raw:.2f} | {here:.2f} | {here / real - 1:+.0%} | {'fitted' if distance > 2.4 else ''} |")
    return {  # the near rows disagree: their bound only tells when that changes
        "Kinect v2, scatter beyond 2.4 m": (rms(far), 0, 0.15),
        "Kinect v2, worst of the rows that were not fitted": (max(map(abs, near)), 0.5, 0.75),
    }


def fit():
    """Light, read noise and third harmonic of o3d303 to its rows: equation 3.9 with the slope of 3.5's phase, Huber's loss on logarithms."""
    import numpy as np
    from scipy.optimize import least_squares

    distance, real = np.array(o3d303_rows()).T
    contrast, step_e, electrons_at_1_m_per_w = 0.4816, 60.0, 27530 / 1.28  # of o3d303: what `tofray budget` says at 80 %, 1 ms

    def logs(x, frequency):
        x = [*x, 0, 0][:4]
        signal = np.exp(x[0]) * electrons_at_1_m_per_w / distance**2
        variance = signal + 2 * np.exp(2 * x[1]) + step_e**2 / 12
        phase = 4 * np.pi * frequency * distance / LIGHT_M_S
        first, third = np.exp(1j * phase), (x[2] + 1j * x[3]) * np.exp(3j * phase)
        z = first + np.conj(third)
        slope = np.imag((1j * first - 3j * np.conj(third)) / z)
        noise = LIGHT_M_S / (4 * np.pi * frequency) * np.sqrt(variance / 2) / (signal * contrast * np.abs(z) * np.maximum(slope, 1e-3))
        return np.log(1e3 * noise / real)

    alone = least_squares(logs, [0.5, 4.5], loss="huber", f_scale=0.1, args=(30e6,))
    print(f"30 MHz without a third harmonic: {math.exp(alone.x[0]):.3g} W, read noise {math.exp(alone.x[1]):.3g} e, "
          f"scatter {rms(logs(alone.x, 30e6)):.1%}")
    for frequency in (22.5e6, 25e6, 28e6, 30e6, 32e6, 35e6):
        tries = [least_squares(logs, [0.5, 4.5, 0.04 * np.cos(p), 0.04 * np.sin(p)], loss="huber", f_scale=0.1, args=(frequency,))
                 for p in (0, 1.5, 3, 4.5)]
        best = min(tries, key=lambda one: one.cost)
        x, scatter = best.x, rms(logs(best.x, frequency))
        third, turn = math.hypot(x[2], x[3]), math.degrees(math.atan2(x[3], x[2])) % 360
        print(f"{frequency / 1e6:g} MHz: {math.exp(x[0]):.3g} W, read noise {math.exp(x[1]):.3g} e, "
              f"third harmonic {third:.4f} at {turn:.0f} degrees, scatter {scatter:.1%}")


def main():
    if sys.argv[1:] not in ([], ["--check"], ["--fit"]):
        raise SystemExit("usage: validate.py [--check | --fit]")
    if sys.argv[1:] == ["--fit"]:
        return fit()
    figures = {**o3d303(), **kinect()}
    print()
    outside = 0
    for name, (value, low, high) in figures.items():
        inside = low <= value <= high
        outside += not inside
        print(f"{name}: {value:.3g}" + ("" if inside else f"   outside {low:g} to {high:g}"))
    if sys.argv[1:] == ["--check"] and outside:
        raise SystemExit(f"error: {outside} figures outside their bounds")


if __name__ == "__main__":
    main()
