#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes pendulum.gltf: a stand of wood and a rod with a weight of painted steel that swings to and fro once in 2 s."""
import base64
import json
import math
import struct

PERIOD_S, STEPS, SWING = 2.0, 16, math.radians(30)
data, views, accessors = b"", [], []


def accessor(values, kind, component, letter):
    """Numbers of the one buffer; rows of them for vectors."""
    global data
    rows = [row if isinstance(row, tuple) else (row,) for row in values]
    packed = b"".join(struct.pack(f"<{len(row)}{letter}", *row) for row in rows)
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
    data += packed + b"\0" * (-len(packed) % 4)
    accessors.append({"bufferView": len(views) - 1, "componentType": component, "type": kind, "count": len(rows)})
    if kind != "SCALAR" or letter == "f":
        accessors[-1]["min"] = [min(column) for column in zip(*rows)]
        accessors[-1]["max"] = [max(column) for column in zip(*rows)]
    return len(accessors) - 1


def box(low, high):
    """Corners and triangles, counterclockwise as seen from outside."""
    corners = [tuple((low, high)[i >> c & 1][c] for c in range(3)) for i in range(8)]
    sides = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return corners, [i for a, b, c, d in sides for i in (a, b, c, a, c, d)]


def primitive(boxes, material):
    corners, indices = [], []
    for low, high in boxes:
        more, triangles = box(low, high)
        indices += [len(corners) + i for i in triangles]
        corners += more
    return {"attributes": {"POSITION": accessor(corners, "VEC3", 5126, "f")}, "indices": accessor(indices, "SCALAR", 5123, "H"),
            "material": material}


# About its own zero hangs what swings, 0.9 m above the ground.
stand = [((-0.25, 0, -0.15), (0.25, 0.04, 0.15)), ((-0.03, 0.04, -0.12), (0.03, 0.95, -0.06)), ((-0.03, 0.88, -0.06), (0.03, 0.92, 0.03))]
weight = [((-0.008, -0.6, -0.008), (0.008, 0, 0.008)), ((-0.08, -0.75, -0.03), (0.08, -0.6, 0.03))]
meshes = [{"name": "stand", "primitives": [primitive(stand, 0)]}, {"name": "weight", "primitives": [primitive(weight, 1)]}]

times = [PERIOD_S * k / STEPS for k in range(STEPS + 1)]
angles = [SWING * math.sin(2 * math.pi * t / PERIOD_S) for t in times]
sampler = {"input": accessor(times, "SCALAR", 5126, "f"),
           "output": accessor([(0.0, 0.0, math.sin(a / 2), math.cos(a / 2)) for a in angles], "VEC4", 5126, "f")}

document = {
    "asset": {"version": "2.0", "copyright": "2026 The tofray authors, Apache-2.0", "generator": "make_pendulum.py"},
    "scene": 0,
    "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"name": "stand", "mesh": 0}, {"name": "weight", "mesh": 1, "translation": [0, 0.9, 0]}],
    "meshes": meshes,
    "materials": [{"name": "wood", "pbrMetallicRoughness": {"baseColorFactor": [0.4, 0.25, 0.12, 1], "metallicFactor": 0,
                                                              "roughnessFactor": 0.8}},
                  {"name": "steel", "pbrMetallicRoughness": {"baseColorFactor": [0.02, 0.05, 0.3, 1], "metallicFactor": 0},
                   "extras": {"nir_reflectivity": 0.6}}],
    "animations": [{"name": "swing", "samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 1, "path": "rotation"}}]}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
}
with open("pendulum.gltf", "w", encoding="ascii") as out:
    json.dump(document, out, indent=1)
    out.write("\n")
