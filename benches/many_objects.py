#!/usr/bin/python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""How long a frame takes with 1, 10 … 10,000 objects: a table of milliseconds, and of ratios to the frame with one object.

    benches/many_objects.py build/release/apps/tofray/tofray [ANOTHER_TOFRAY] [--threads 1,2] [--rounds 5] [--kinds spread-sphere,…]

Before a wall stand objects of a few pixels each: spread over the view; in a pile, all behind each other; or spread with the sun
shining from aside. Of several binaries each takes its turn in each round; the fastest tenth of a run's frames counts, and of it the
least of all rounds."""

import argparse
import pathlib
import random
import subprocess
import tempfile

COUNTS = (1, 10, 100, 1000, 10000)
KINDS = ("spread-sphere", "spread-box", "spread-mesh", "pile-sphere", "sun-sphere")


def shape(kind, x, y, z, radius):
    if kind == "sphere":
        return f"sphere: {{center: [{x:.5f}, {y:.5f}, {z:.5f}], radius: {radius:.5f} m, reflectivity: 0.5}}"
    if kind == "box":
        low, high = ([f"{a + s * 0.8 * radius:.5f}" for a in (x, y, z)] for s in (-1, 1))
        return f"box: {{min: [{', '.join(low)}], max: [{', '.join(high)}], reflectivity: 0.5}}"
    return f"mesh: {{file: rock.obj, position: [{x:.5f}, {y:.5f}, {z:.5f}], scale: {radius:.5f}, reflectivity: 0.5}}"


def scene(name, count):
    where, kind = name.split("-")
    rng = random.Random(count)
    light = "ambient: {spectrum: sun_am15, level: 5 %, direction: [0.4, 0.5, 1]}" if where == "sun" else "ambient: {spectrum: none}"
    lines = ["camera: {profile: pico-flexx, mode: MODE_9_5FPS_2000}", light, "objects:",
             "  - plane: {point: [0, 0, 3.2], normal: [0, 0, -1], reflectivity: 0.6}"]
    width, height = (0.03, 0.03) if where == "pile" else (0.52, 0.4)
    for _ in range(count):
        z = rng.uniform(1, 3)
        x, y = z * rng.uniform(-width, width), z * rng.uniform(-height, height)
        lines.append("  - " + shape(kind, x, y, z, 0.01 * z if kind != "mesh" else 0.02))
    return "\n".join(lines) + "\n"


def rock():
    """An octahedron whose sides are cut into four once."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    out, faces = list(corners), []
    for x in (0, 1):
        for y in (2, 3):
            for z in (4, 5):
                first = len(out)
                for a, b in ((x, y), (y, z), (z, x)):
                    middle = [p + q for p, q in zip(corners[a], corners[b])]
                    out.append(tuple(p / 2**0.5 for p in middle))
                faces += [(x, first, first + 2), (y, first + 1, first), (z, first + 2, first + 1), (first, first + 1, first + 2)]
    return "".join(f"v {a:.6f} {b:.6f} {c:.6f}\n" for a, b, c in out) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces)


def milliseconds(binary, file, threads, frames):
    done = subprocess.run([binary, "bench", file, "--threads", str(threads), "--frames", str(frames)], capture_output=True, text=True,
                          check=True)
    row = next(line for line in done.stdout.splitlines() if " exact " in line and "stages" not in line and "energy" not in line)
    return float(row.split()[6]), row.split()[-1]


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("binary", nargs="+")
    options.add_argument("--threads", default="1,2")
    options.add_argument("--rounds", type=int, default=5)
    options.add_argument("--frames", type=int, default=30)
    options.add_argument("--kinds", default=",".join(KINDS))
    given = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "rock.obj").write_text(rock())
        for name in given.kinds.split(","):
            for threads in given.threads.split(","):
                one = {}
                for count in COUNTS:
                    file = pathlib.Path(folder) / f"{name}-{count}.yaml"
                    file.write_text(scene(name, count))
                    best, hashes = {}, set()
                    for _ in range(given.rounds):
                        for binary in given.binary:
                            took, frame = milliseconds(binary, file, threads, given.frames)
                            best[binary] = min(took, best.get(binary, took))
                            hashes.add(frame)
                    if len(hashes) > 1:
                        raise SystemExit(f"{file.name}: frames differ: {', '.join(sorted(hashes))}")
                    if count == 1:
                        one = dict(best)
                    print(f"{name:14} {threads} threads {count:6} objects", *(f"{best[b]:9.3f} ms {best[b] / one[b]:7.2f} x" for b in given.binary),
                          flush=True)


if __name__ == "__main__":
    main()
