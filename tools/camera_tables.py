#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/cameras.md: what noise `tofray` says of each camera's pixel on the axis, in each of its modes; and the fields of view
that intrinsics make, there and in the first lines of profiles, which `tofray list cameras` shows.

    python3 tools/camera_tables.py             writes them anew
    python3 tools/camera_tables.py --check     says whether they are true; a test runs this

A table stands between <!-- table: CAMERA --> and <!-- end -->; what stands there is replaced.
"""

import json
import math
import re
import subprocess
import sys
import tempfile

from one_pixel import ROOT, Pixel, modes_of, program

PAGE = ROOT / "docs/cameras.md"
DISTANCES = (0.5, 1, 2, 4)
REFLECTIVITIES = (0.8, 0.2)
SPEED_OF_LIGHT = 299792458
MEND = "python3 tools/camera_tables.py writes it"


def limit_mm(camera):
    """More noise than this, and the pixel is invalid."""
    profile = (ROOT / f"profiles/{camera}.yaml").read_text(encoding="utf-8")
    found = re.search(r"(?:low_signal_noise|noise_threshold): *\{?(?:value: *)?([\d.]+) mm", profile)
    return float(found.group(1)) if found else 70.0


def cell(camera, mode, distance, reflectivity, repeats):
    pixel = Pixel(camera, mode, distance, reflectivity)
    if distance >= repeats:
        return "wraps"
    if pixel.flags & 1:
        return "saturated"
    return f"{pixel.sigma_mm:.2g}" if pixel.sigma_mm < 9.95 else f"{pixel.sigma_mm:.0f}" if pixel.sigma_mm <= limit_mm(camera) else "–"


def shares(camera, mode):
    """Of the pixels of the built-in scene room: how many are valid, and how many of these on a wrong cycle."""
    with tempfile.TemporaryDirectory() as folder:
        command = [program(), "render", "room", "--json", "--emit", "ply", "-o", folder + "/out"]
        command += ["--set", f"camera.profile={camera}", "--set", f"camera.mode={mode}"]
        said = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    wrong = 100 * said["valid_on_wrong_cycle"] / max(said["valid_pixels"], 1)
    return [f"{said['valid_pixels'] / said['pixels']:.0%}", f"{wrong:.1f}%"]


def table(camera):
    noise = " | ".join(f"{r:.0%}, {d:g} m" for r in REFLECTIVITIES for d in DISTANCES)
    head = f"| mode | repeats after | {noise} | `room` valid | wrong cycle |\n"
    rows, seen = [], {}
    for mode in modes_of(camera)["modes"]:
        hertz = [round(f) for f in mode["modulation_frequency_hz"]]
        repeats = SPEED_OF_LIGHT / (2 * math.gcd(*hertz))
        cells = [f"{repeats:.2f} m"] + [cell(camera, mode["name"], d, r, repeats) for r in REFLECTIVITIES for d in DISTANCES]
        cells += shares(camera, mode["name"])
        if tuple(cells) in seen:  # another frame rate, and nothing else
            seen[tuple(cells)].append(mode["name"])
        else:
            seen[tuple(cells)] = [mode["name"]]
            rows.append((seen[tuple(cells)], cells))
    lines = ["| " + ", ".join(f"`{name}`" for name in names) + " | " + " | ".join(cells) + " |" for names, cells in rows]
    return head + "|---" * (4 + len(REFLECTIVITIES) * len(DISTANCES)) + "|\n" + "\n".join(lines) + "\n"


def view(camera, times):
    """Between the outer edges of the pixels at the ends of the middle row, and of the middle column."""
    said = json.loads(subprocess.run([program(), "check", camera, "--json"], check=True, capture_output=True, text=True).stdout)
    return f" {times} ".join(f"{degrees:.1f}" for degrees in said["camera_report"]["field_of_view_deg"])


def with_views(text):
    """The first table of the page: of each row that names a camera, the third column."""
    row = re.compile(r"^(\| ([a-z][\w-]+)[^|]*\| [^|]*\| )\d[\d.]* × [\d.]+ \|", flags=re.M)
    return row.sub(lambda m: f"{m.group(1)}{view(m.group(2), '×')} |", text)


def settle(path, old, new, check, mend=MEND):
    """Writes what is new, or says which line of it is not there."""
    if not check:
        path.write_text(new, encoding="utf-8")
        return
    name = path.relative_to(ROOT)
    for number, (line, now) in enumerate(zip(old.split("\n"), new.split("\n")), start=1):
        if line != now:
            raise SystemExit(f"{name}:{number}: error: this is not what tofray says; {mend}\n  there:  {line}\n  tofray: {now}")
    if old.count("\n") != new.count("\n"):
        raise SystemExit(f"{name}:1: error: a table has more or fewer rows than tofray says; {mend}")


def main():
    check = sys.argv[1:] == ["--check"]
    for path in sorted((ROOT / "profiles").glob("*.yaml")):
        profile = path.read_text(encoding="utf-8")
        head, rest = profile.split("\n", 1)
        settle(path, profile, re.sub(r"[\d.]+ x [\d.]+ degrees", lambda _: view(path.stem, "x") + " degrees", head) + "\n" + rest, check)
    text = PAGE.read_text(encoding="utf-8")
    cameras = re.findall(r"<!-- table: (\S+) -->", text)
    missing = {path.stem for path in (ROOT / "profiles").glob("*.yaml")} - set(cameras) - {"custom"}
    if missing:
        raise SystemExit(f"docs/cameras.md:1: error: no table for {', '.join(sorted(missing))}")
    new = re.sub(r"(<!-- table: (\S+) -->\n).*?(<!-- end -->)", lambda m: m.group(1) + table(m.group(2)) + m.group(3), text, flags=re.S)
    settle(PAGE, text, with_views(new), check)


if __name__ == "__main__":
    main()
