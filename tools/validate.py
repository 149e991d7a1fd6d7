#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""docs/validation.md: what tofray says beside closed forms, published numbers and measurements of real cameras. Data: data/measured.

    python3 tools/validate.py            writes the page (tofray's Python package, numpy, scipy; PYTHONPATH=build/release/python before it is installed)
    python3 tools/validate.py --check    exit code 1 where a figure leaves its bounds or the page says something else; a test runs this

Rows that a profile was fitted to are marked "fitted": they say how well the model can follow, and validate nothing.
"""

import re
import sys

from one_pixel import ROOT
from validation_parts import closed, kinect, laws, o3d303, published, sun

PAGE = ROOT / "docs/validation.md"

HEAD = """<!-- SPDX-FileCopyrightText: 2026 The tofray authors -->
<!-- SPDX-License-Identifier: Apache-2.0 -->
# What stands against tofray, and how it holds

`python3 tools/validate.py` writes this page: closed forms, laws, published limits, and two cameras whose noise was measured by others ([data, licence, conditions](../data/measured/README.md)), beside what tofray computes. A test runs it, and holds each figure to bounds. **Rows marked "fitted" validate nothing**: they say how well the model can follow. **No camera is validated by this page**: of each that was measured, light or more was fitted first. Whoever has other measurements of these cameras can hold them against it.
"""

TAIL = """
## What could not be validated

- **The strength of any camera's light by itself.** Power, transmission, fill factor, quantum efficiency, the lens's opening and the walls' reflectivity are one number in the dark, κ ([fitting](fit.md)).
- **Read noise and wells** of any camera but the O3D303, and that only as a number fitted with its light.
- **Bias.** tofray's correction of the wiggling is exact. The references of the measured biases, markers in the camera's own image, scatter by 30 to 45 mm beyond 2 m, and what the cameras correct is not known.
- **Drift and warm-up, scattered light in the lens, edges**: series of both cameras exist; no profile was made from them, and they were not compared.
- **Multipath, motion, several cameras**: no published measurement with a described scene was found. They stand on closed forms and on brute force ([theory](theory/index.md)).
- **Cameras without a published noise**: pico-flexx, pico-monstar, opt8241, imx556. Their numbers are assumed.
- **Filters and exposures of real cameras**, which all published numbers of the Kinects and the flexx2 contain.
"""


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def page():
    """The page's text, and its figures by name with their bounds."""
    parts, figures = [HEAD], {}
    for section in (closed, laws, sun, published, o3d303, kinect):
        text, found = section(table)
        parts.append(text)
        figures |= found
    return "\n".join(parts) + TAIL, figures


NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?")


def same_line(one, other):
    """The same words, and numbers that are off by no more than two of their last digit: scipy's last digits are its own."""
    if NUMBER.sub("#", one) != NUMBER.sub("#", other):
        return False
    for a, b in zip(NUMBER.findall(one), NUMBER.findall(other)):
        digits = len(a.split(".")[1]) if "." in a else 0
        if abs(float(a) - float(b)) > 2.001 * 10.0**-digits:
            return False
    return True


def refuse_another_page(text):
    there = PAGE.read_text(encoding="utf-8").split("\n")
    for number, (line, now) in enumerate(zip(there, text.split("\n")), start=1):
        if not same_line(line, now):
            raise SystemExit(f"docs/validation.md:{number}: error: this is not what tofray says; python3 tools/validate.py writes it\n  there:  {line}\n  tofray: {now}")
    if len(there) != text.count("\n") + 1:
        raise SystemExit("docs/validation.md:1: error: it has more or fewer lines than tofray says; python3 tools/validate.py writes it")


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        raise SystemExit("usage: validate.py [--check]")
    text, figures = page()
    outside = 0
    for name, (value, low, high) in figures.items():
        inside = low <= value <= high  # NaN is not
        outside += not inside
        print(f"{name}: {value:.4g}" + ("" if inside else f"   outside {low:g} to {high:g}"))
    if outside:
        raise SystemExit(f"error: {outside} figures outside their bounds")
    if sys.argv[1:] == ["--check"]:
        refuse_another_page(text)
    else:
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
