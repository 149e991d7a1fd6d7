#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The tables of docs/cameras.md: what noise `tofray` says of each camera's pixel on the axis, in each of its modes.

    python3 tools/camera_tables.py             writes them anew
    python3 tools/camera_tables.py --check     says whether they are true; a test runs this

A table stands between <!-- table: CAMERA --> and <!-- end -->; what stands there is replaced.
"""

import math
import re
import sys

from one_pixel import ROOT, Pixel, modes_of

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


def table(camera):
    head = "| mode | repeats after | " + " | ".join(f"{r:.0%}, {d:g} m" for r in REFLECTIVITIES for d in DISTANCES) + " |\n"
    rows, seen = [], {}
    for mode in modes_of(camera)["modes"]:
        hertz = [round(f) for f in mode["modulation_frequency_hz"]]
        repeats = SPEED_OF_LIGHT / (2 * math.gcd(*hertz))
        cells = [f"{repeats:.2f} m"] + [cell(camera, mode["name"], d, r, repeats) for r in REFLECTIVITIES for d in DISTANCES]
        if tuple(cells) in seen:  # another frame rate, and nothing else
            seen[tuple(cells)].append(mode["name"])
        else:
            seen[tuple(cells)] = [mode["name"]]
            rows.append((seen[tuple(cells)], cells))
    lines = ["| " + ", ".join(f"`{name}`" for name in names) + " | " + " | ".join(cells) + " |" for names, cells in rows]
    return head + "|---" * (2 + len(REFLECTIVITIES) * len(DISTANCES)) + "|\n" + "\n".join(lines) + "\n"


def main():
    text = PAGE.read_text(encoding="utf-8")
    cameras = re.findall(r"<!-- table: (\S+) -->", text)
    missing = {path.stem for path in (ROOT / "profiles").glob("*.yaml")} - set(cameras) - {"custom"}
    if missing:
        raise SystemExit(f"docs/cameras.md:1: error: no table for {', '.join(sorted(missing))}")
    new = re.sub(r"(<!-- table: (\S+) -->\n).*?(<!-- end -->)", lambda m: m.group(1) + table(m.group(2)) + m.group(3), text, flags=re.S)
    if sys.argv[1:] == ["--check"]:
        for number, (old, now) in enumerate(zip(text.split("\n"), new.split("\n")), start=1):
            if old != now:
                fault = f"docs/cameras.md:{number}: error: the table is not what tofray says; {MEND}"
                raise SystemExit(f"{fault}\n  there:  {old}\n  tofray: {now}")
        if text.count("\n") != new.count("\n"):
            raise SystemExit(f"docs/cameras.md:1: error: a table has more or fewer rows than tofray says; {MEND}")
        return
    PAGE.write_text(new, encoding="utf-8")


if __name__ == "__main__":
    main()
