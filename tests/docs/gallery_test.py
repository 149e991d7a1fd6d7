#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the gallery's commands as any document's, then compares each picture in docs/images with the one that its command made."""

import importlib.util
import re
import sys

import run_document
from workplace import Workplace

# Letters are the machine's: they are some 2 % of a picture. Another seed is noise in all of the pixels, another scene more than that.
MOST_OTHER = 0.04
NOTICED = 40

ENTRY = re.compile(r"^!\[[^\]]*\]\(images/([\w-]+)\.png\)\n(?:(?!^#).*\n)*?```sh\n((?:.*\n)*?)```", re.M)


def share_of_other_pixels(wanted, made):
    import numpy as np
    from PIL import Image

    one, other = (np.asarray(Image.open(path).convert("RGB")).astype(int) for path in (wanted, made))
    if one.shape != other.shape:
        height, width = (min(a, b) for a, b in zip(one.shape, other.shape[:2]))
        if max(one.shape[0], other.shape[0]) > 1.1 * height or max(one.shape[1], other.shape[1]) > 1.1 * width:
            return 1.0
        one, other = one[:height, :width], other[:height, :width]
    return float(np.mean(np.abs(one - other).max(axis=2) > NOTICED))


def main():
    options = run_document.arguments(__doc__).parse_args()
    if importlib.util.find_spec("numpy") is None or importlib.util.find_spec("PIL") is None:
        print("needs numpy and PIL (python3-numpy, python3-pil)")
        sys.exit(77)
    source, build = run_document.pathlib.Path(options.source).resolve(), run_document.pathlib.Path(options.build).resolve()
    gallery, found = source / "docs/gallery.md", 0
    entries = ENTRY.findall(gallery.read_text(encoding="utf-8"))
    with Workplace(source, build, options.compiler) as place:
        for line, what in run_document.Document(gallery, place).faults():
            print(f"docs/gallery.md:{line}: error: {what}")
            found += 1
        for name, command in entries:
            folder = place.path / re.search(r" -o (\S+)", command)[1]
            made = [folder] if folder.is_file() else sorted(folder.glob("preview*.png"))
            share = share_of_other_pixels(source / f"docs/images/{name}.png", made[0]) if made else 1.0
            print(f"docs/images/{name}.png: {share:.2%} of its pixels are others")
            found += share > MOST_OTHER
    if len(entries) < 9:
        print(f"docs/gallery.md: error: {len(entries)} pictures with a command are too few")
        found += 1
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
