#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes chair.obj: metres, y up, the front toward +z. Each part is closed; they go into each other where they meet."""
import math

vertices, faces = [], []


def add(rings, closed=True):
    """A skin over rings of points of one length, with a fan at each end."""
    first, n = len(vertices), len(rings[0])
    for ring in rings:
        vertices.extend(ring)
    for r in range(len(rings) - 1):
        for i in range(n):
            j = (i + 1) % n
            a, b = first + r * n, first + (r + 1) * n
            faces.append((a + i, a + j, b + j, b + i))
    if closed:
        faces.append(tuple(first + i for i in reversed(range(n))))
        faces.append(tuple(first + (len(rings) - 1) * n + i for i in range(n)))


def tube(path, radii, sides=16):
    """Round a path of points, as thick as the radii say."""
    rings = []
    for k, (point, radius) in enumerate(zip(path, radii)):
        before, after = path[max(k - 1, 0)], path[min(k + 1, len(path) - 1)]
        along = [a - b for a, b in zip(after, before)]
        length = math.sqrt(sum(x * x for x in along))
        along = [x / length for x in along]
        aside = [along[1], -along[0], 0] if abs(along[2]) < 0.9 else [0, along[2], -along[1]]
        length = math.sqrt(sum(x * x for x in aside))
        aside = [x / length for x in aside]
        third = [along[1] * aside[2] - along[2] * aside[1], along[2] * aside[0] - along[0] * aside[2], along[0] * aside[1] - along[1] * aside[0]]
        rings.append([tuple(point[c] + radius * (math.cos(a) * aside[c] + math.sin(a) * third[c]) for c in range(3))
                      for a in (2 * math.pi * i / sides for i in range(sides))])
    add(rings)


def line(a, b, steps):
    return [tuple(a[c] + (b[c] - a[c]) * s / steps for c in range(3)) for s in range(steps + 1)]


def seat(sides=48):
    """A rounded square with soft edges, a little hollow."""
    def outline(size, height):
        ring = []
        for i in range(sides):
            a = -2 * math.pi * i / sides
            x, z = math.cos(a), math.sin(a)
            stretch = (x ** 6 + z ** 6) ** (-1 / 6)
            ring.append((size * x * stretch, height, size * z * stretch))
        return ring
    add([outline(0.19, 0.425), outline(0.208, 0.43), outline(0.215, 0.44), outline(0.208, 0.452), outline(0.19, 0.455),
         outline(0.12, 0.448), outline(0.05, 0.445)])


seat()
for x in (-1, 1):
    for z in (-1, 1):  # legs, thinner downward
        tube(line((0.16 * x, 0.44, 0.16 * z), (0.2 * x, 0, 0.2 * z), 6), [0.019 - 0.001 * s for s in range(7)])
    tube(line((0.186 * x, 0.15, -0.186), (0.186 * x, 0.15, 0.186), 2), [0.009] * 3)  # rungs
    tube([(0.17 * x, 0.44 + 0.46 * s / 8, -0.17 - 0.09 * (s / 8) ** 1.5) for s in range(9)], [0.016 - 0.0006 * s for s in range(9)])  # posts
for height in (0.56, 0.67, 0.78, 0.87):  # slats, bent backward between the posts
    s = (height - 0.44) / 0.46
    tube([(0.17 * t, height, -0.17 - 0.09 * s ** 1.5 - 0.035 * (1 - t * t)) for t in (-1, -0.75, -0.5, -0.25, 0, 0.25, 0.5, 0.75, 1)],
         [0.014] * 9)

with open("chair.obj", "w", encoding="ascii") as out:
    out.write("# SPDX-FileCopyrightText: 2026 The tofray authors\n# SPDX-License-Identifier: Apache-2.0\n")
    out.write("# A chair, 0.93 m high: metres, y up, its front toward +z. Written by make_chair.py.\n")
    for v in vertices:
        out.write("v %.4f %.4f %.4f\n" % v)
    for f in faces:
        out.write("f " + " ".join(str(i + 1) for i in f) + "\n")
