#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes crate.obj, crate.mtl and crate.png: a wooden crate of 0.4 m with a label, and a steel ball with smooth normals on its lid."""
import math
import struct
import zlib

SIDE, BALL, PIXELS = 0.4, 0.09, 64


def wood(x, y):
    """Colour of a side's picture: boards with dark joints within a frame, a white label with a black bar in the upper left."""
    if 10 <= x < 26 and 10 <= y < 22:
        return (20, 20, 20) if y >= 18 else (240, 240, 235)
    if min(x, y, PIXELS - 1 - x, PIXELS - 1 - y) < 6:
        return 150, 110, 62
    if y % 13 == 0:
        return 60, 40, 20
    grain = round(12 * math.sin(0.9 * y + 0.15 * x))
    return 190 + grain, 145 + grain, 90 + grain


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


rows = b"".join(b"\0" + bytes(c for x in range(PIXELS) for c in wood(x, y)) for y in range(PIXELS))
with open("crate.png", "wb") as out:
    out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", PIXELS, PIXELS, 8, 2, 0, 0, 0)) +
              chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))

mtl = ["# SPDX-FileCopyrightText: 2026 The tofray authors", "# SPDX-License-Identifier: Apache-2.0",
       "newmtl wood", "Kd 1 1 1", "map_Kd crate.png", "", "newmtl steel", "Kd 0.5 0.5 0.52", "Ks 0.5 0.5 0.5", "Ns 200",
       "#!nir_reflectivity 0.6"]
with open("crate.mtl", "w", encoding="ascii") as out:
    out.write("\n".join(mtl) + "\n")

lines = ["# SPDX-FileCopyrightText: 2026 The tofray authors", "# SPDX-License-Identifier: Apache-2.0",
         "# A crate with a ball on it: metres, y up. Written by make_crate.py.", "mtllib crate.mtl", "o crate"]
h = SIDE / 2
corners = [((-h, h)[i & 1], (0, SIDE)[i >> 1 & 1], (-h, h)[i >> 2 & 1]) for i in range(8)]
# From the lower left, counterclockwise as seen from outside; its normal's axis and sign.
sides = [((4, 5, 7, 6), (0, 0, 1)), ((1, 0, 2, 3), (0, 0, -1)), ((5, 1, 3, 7), (1, 0, 0)), ((0, 4, 6, 2), (-1, 0, 0)),
         ((6, 7, 3, 2), (0, 1, 0)), ((0, 1, 5, 4), (0, -1, 0))]
lines += [f"v {x:.3f} {y:.3f} {z:.3f}" for x, y, z in corners]
lines += ["vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1"]
lines += [f"vn {x} {y} {z}" for _, (x, y, z) in sides]
lines += ["usemtl wood"]
lines += ["f " + " ".join(f"{v + 1}/{t + 1}/{n + 1}" for t, v in enumerate(side)) for n, (side, _) in enumerate(sides)]

lines += ["o ball", "usemtl steel"]
AROUND, UP = 16, 8
normals = [(0.0, 1.0, 0.0)]
for i in range(1, UP):
    for j in range(AROUND):
        polar, turn = math.pi * i / UP, 2 * math.pi * j / AROUND
        normals.append((math.sin(polar) * math.sin(turn), math.cos(polar), math.sin(polar) * math.cos(turn)))
normals.append((0.0, -1.0, 0.0))
lines += [f"v {BALL * x:.4f} {SIDE + BALL + BALL * y:.4f} {BALL * z:.4f}" for x, y, z in normals]
lines += [f"vn {x:.4f} {y:.4f} {z:.4f}" for x, y, z in normals]


def corner(i, j):
    """Vertex j of ring i, as a face names it."""
    number = 0 if i == 0 else len(normals) - 1 if i == UP else 1 + (i - 1) * AROUND + j % AROUND
    return f"{len(corners) + number + 1}//{len(sides) + number + 1}"


for i in range(UP):
    for j in range(AROUND):
        ring = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]
        lines.append("f " + " ".join(c for k, c in enumerate(ring) if c not in ring[:k]))
with open("crate.obj", "w", encoding="ascii") as out:
    out.write("\n".join(lines) + "\n")
