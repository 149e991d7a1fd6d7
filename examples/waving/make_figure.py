#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes figure.glb: a person of 1.76 m, skin over seventeen joints, who walks on the spot and waves, again and again in 1.2 s."""
import functools
import json
import math
import operator
import struct

PERIOD_S, STEPS, AROUND = 1.2, 24, 20
data, views, accessors = b"", [], []


def total(numbers):
    """From left to right: sum() adds otherwise from Python 3.12 on."""
    return functools.reduce(operator.add, numbers)


def accessor(rows, kind, component, letter):
    """Rows of numbers in the one buffer."""
    global data
    packed = b"".join(struct.pack(f"<{len(row)}{letter}", *row) for row in rows)
    views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
    data += packed + b"\0" * (-len(packed) % 4)
    accessors.append({"bufferView": len(views) - 1, "componentType": component, "type": kind, "count": len(rows)})
    if letter == "f" and kind in ("VEC3", "SCALAR"):
        accessors[-1]["min"] = [min(column) for column in zip(*rows)]
        accessors[-1]["max"] = [max(column) for column in zip(*rows)]
    return len(accessors) - 1


# Where each joint is as the figure stands with hanging arms, y up, its face along z: its own right is at −x.
joints = {"hips": (None, (0, 0.96, 0)), "spine": ("hips", (0, 1.14, 0)), "chest": ("spine", (0, 1.3, 0)), "neck": ("chest", (0, 1.5, 0))}
for side, x in (("right", -1), ("left", 1)):
    joints[f"{side} shoulder"] = ("chest", (0.2 * x, 1.42, 0))
    joints[f"{side} elbow"] = (f"{side} shoulder", (0.2 * x, 1.14, 0))
    joints[f"{side} wrist"] = (f"{side} elbow", (0.2 * x, 0.9, 0))
    joints[f"{side} hip"] = ("hips", (0.1 * x, 0.92, 0))
    joints[f"{side} knee"] = (f"{side} hip", (0.1 * x, 0.5, 0))
    joints[f"{side} ankle"] = (f"{side} knee", (0.1 * x, 0.09, 0))
names = list(joints)


def tube(rings):
    """A closed tube round rings: (center, half width along x, half depth along the other axis, weights by joint)."""
    points, weights, triangles = [], [], []
    first, last = rings[0], rings[-1]
    for center, width, depth, by_joint in rings:
        ahead = (0, 0, 1) if first[0][1] != last[0][1] else (0, 1, 0)
        for k in range(AROUND):
            a = 2 * math.pi * k / AROUND
            points.append(tuple(c + width * math.cos(a) * (i == 0) + depth * math.sin(a) * z for i, (c, z) in enumerate(zip(center, ahead))))
            weights.append(by_joint)
    for center, _, _, by_joint in (first, last):
        points.append(tuple(center))
        weights.append(by_joint)
    count = len(rings)
    for r in range(count - 1):
        for k in range(AROUND):
            a, b = r * AROUND + k, r * AROUND + (k + 1) % AROUND
            triangles += [(a, b, b + AROUND), (a, b + AROUND, a + AROUND)]
    for k in range(AROUND):
        triangles.append(((k + 1) % AROUND, k, count * AROUND))
        triangles.append(((count - 1) * AROUND + k, (count - 1) * AROUND + (k + 1) % AROUND, count * AROUND + 1))
    return points, weights, triangles


def blended(y, bones, width=0.05):
    """Weights at a height: bones are (joint, height below which it holds), from above to below."""
    out = {}
    left = 1.0
    for (joint, _), below in zip(bones, [h for _, h in bones[1:]] + [None]):
        share = left if below is None else left * min(1.0, max(0.0, 0.5 + (y - below) / (2 * width)))
        if share > 0:
            out[joint] = share
        left -= share
    return out


def along(profile, x, bones):
    """Rings of a tube upright at x: (height, half width, half depth)."""
    return tube([((x, y, z), w, d, blended(y, bones)) for y, w, d, z in profile])


def round_end(profile, top, steps=4):
    """Closes the end of a profile as half an ellipsoid."""
    y, w, d, z = profile[0] if top else profile[-1]
    more = []
    for k in range(1, steps + 1):
        a = 0.5 * math.pi * k / steps * 0.98
        more.append((y + (1 if top else -1) * 0.8 * w * math.sin(a), w * math.cos(a), d * math.cos(a), z))
    return more[::-1] + profile if top else profile + more


def fine(profile, step=0.02):
    """The same with rings at least so near to each other."""
    out = [profile[0]]
    for a, b in zip(profile, profile[1:]):
        n = max(1, math.ceil(abs(b[0] - a[0]) / step))
        out += [tuple(p + (q - p) * k / n for p, q in zip(a, b)) for k in range(1, n + 1)]
    return out


cotton, skin, shoes = [], [], []
torso = [(1.47, 0.1, 0.07, 0), (1.43, 0.17, 0.09, 0), (1.32, 0.17, 0.105, 0), (1.12, 0.14, 0.095, 0), (0.98, 0.165, 0.105, 0), (0.88, 0.15, 0.1, 0)]
cotton.append(along(round_end(round_end(fine(torso), True), False), 0, [("chest", 0), ("spine", 1.27), ("hips", 1.08)]))
neck = [(1.58, 0.05, 0.055, 0.005), (1.46, 0.055, 0.06, 0)]
skin.append(along(fine(neck), 0, [("neck", 0), ("chest", 1.5)]))
head = [(1.66 + 0.115 * math.cos(a), 0.08 * math.sin(a) + 1e-4, 0.1 * math.sin(a) + 1e-4, 0.02) for a in [math.pi * k / 16 for k in range(17)]]
skin.append(along(head, 0, [("neck", 0)]))
nose = [(1.675, 0.004, 0.006, 0.115), (1.65, 0.016, 0.022, 0.12), (1.635, 0.01, 0.01, 0.115)]
skin.append(along(nose, 0, [("neck", 0)]))
for side, x in (("right", -1), ("left", 1)):
    shoulder, elbow, wrist = f"{side} shoulder", f"{side} elbow", f"{side} wrist"
    sleeve = [(1.42, 0.058, 0.062, 0), (1.3, 0.05, 0.055, 0), (1.14, 0.043, 0.045, 0), (1.05, 0.041, 0.043, 0)]
    cotton.append(along(round_end(fine(sleeve), True), 0.2 * x, [(shoulder, 0), (elbow, 1.14)]))
    forearm = [(1.08, 0.035, 0.037, 0), (0.96, 0.028, 0.03, 0), (0.9, 0.024, 0.03, 0), (0.86, 0.018, 0.043, 0), (0.78, 0.014, 0.045, 0), (0.71, 0.011, 0.035, 0)]
    skin.append(along(round_end(fine(forearm), False), 0.2 * x, [(elbow, 0), (wrist, 0.9)]))
    thumb = [(0.87, 0.012, 0.012, 0.04), (0.83, 0.011, 0.012, 0.06), (0.8, 0.009, 0.01, 0.07)]
    skin.append(along(round_end(fine(thumb), False), 0.2 * x, [(wrist, 0)]))
    hip, knee, ankle = f"{side} hip", f"{side} knee", f"{side} ankle"
    leg = [(0.95, 0.085, 0.095, 0), (0.8, 0.082, 0.088, 0), (0.5, 0.056, 0.062, 0), (0.38, 0.053, 0.066, -0.005), (0.12, 0.042, 0.046, 0), (0.07, 0.045, 0.05, 0)]
    cotton.append(along(fine(leg), 0.1 * x, [(hip, 0), (knee, 0.5), (ankle, 0.09)]))
    sole = [(-0.09, 0.02, 0.015), (-0.08, 0.04, 0.035), (-0.02, 0.045, 0.045), (0.08, 0.05, 0.035), (0.15, 0.045, 0.028), (0.18, 0.025, 0.018)]
    shoes.append(tube([((0.1 * x, 0.045, z), w, h, {ankle: 1.0}) for z, w, h in sole]))


def primitive(tubes, material):
    points, weights, triangles = [], [], []
    for more, its, faces in tubes:
        triangles += [tuple(len(points) + i for i in face) for face in faces]
        points += more
        weights += its
    # Normals: the sum of the triangles about each vertex, outward.
    normals = [[0.0, 0.0, 0.0] for _ in points]
    for face in triangles:
        a, b, c = (points[i] for i in face)
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        for i in face:
            normals[i] = [p + q for p, q in zip(normals[i], n)]
    unit = [tuple(x / max(1e-30, math.sqrt(total(y * y for y in n))) for x in n) for n in normals]
    rows = [sorted(w.items(), key=lambda one: -one[1])[:4] for w in weights]
    indices = [tuple([names.index(j) for j, _ in row] + [0] * (4 - len(row))) for row in rows]
    shares = [tuple([s / total(s for _, s in row) for _, s in row] + [0.0] * (4 - len(row))) for row in rows]
    return {"attributes": {"POSITION": accessor(points, "VEC3", 5126, "f"), "NORMAL": accessor(unit, "VEC3", 5126, "f"),
                           "JOINTS_0": accessor(indices, "VEC4", 5121, "B"), "WEIGHTS_0": accessor(shares, "VEC4", 5126, "f")},
            "indices": accessor([(i,) for face in triangles for i in face], "SCALAR", 5123, "H"), "material": material}


def turn(axis, degrees):
    """A rotation about x, y or z, as a quaternion."""
    half = 0.5 * math.radians(degrees)
    return tuple(math.sin(half) * (i == axis) for i in range(3)) + (math.cos(half),)


def both(a, b):
    """First b, then a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)


X, Y, Z = 0, 1, 2
times = [PERIOD_S * k / STEPS for k in range(STEPS + 1)]
phases = [2 * math.pi * k / STEPS for k in range(STEPS + 1)]
poses = {
    "hips": [turn(Y, 5 * math.sin(a)) for a in phases],
    "chest": [turn(Y, -8 * math.sin(a)) for a in phases],
    "neck": [turn(Y, 4 * math.sin(a)) for a in phases],
    "right shoulder": [both(turn(Z, -118 + 4 * math.sin(2 * a)), turn(Y, 20)) for a in phases],
    "right elbow": [turn(Z, -42 - 26 * math.sin(2 * a)) for a in phases],
    "right wrist": [turn(Z, -12 * math.sin(2 * a - 0.7)) for a in phases],
    "left shoulder": [both(turn(Z, 6), turn(X, -24 * math.sin(a))) for a in phases],
    "left elbow": [turn(X, -18 - 14 * math.sin(a)) for a in phases],
}
for side, sign in (("right", 1), ("left", -1)):
    poses[f"{side} hip"] = [turn(X, -24 * sign * math.sin(a) - 4) for a in phases]
    poses[f"{side} knee"] = [turn(X, 26 - 24 * sign * math.cos(a + 0.4)) for a in phases]
    poses[f"{side} ankle"] = [turn(X, -8 + 8 * sign * math.cos(a)) for a in phases]

nodes = []
for name in names:
    parent, at = joints[name]
    node = {"name": name, "translation": [a - b for a, b in zip(at, joints[parent][1] if parent else (0, 0, 0))]}
    children = [names.index(other) for other in names if joints[other][0] == name]
    if children:
        node["children"] = children
    nodes.append(node)
meshes = [{"name": "figure", "primitives": [primitive(cotton, 0), primitive(skin, 1), primitive(shoes, 2)]}]
nodes.append({"name": "figure", "mesh": 0, "skin": 0})
binds = accessor([(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1) for _, (x, y, z) in joints.values()], "MAT4", 5126, "f")
clock = accessor([(t,) for t in times], "SCALAR", 5126, "f")
lift = accessor([(0.0, 0.96 + 0.012 * math.cos(2 * a), 0.0) for a in phases], "VEC3", 5126, "f")
samplers = [{"input": clock, "output": accessor(rows, "VEC4", 5126, "f")} for rows in poses.values()] + [{"input": clock, "output": lift}]
channels = [{"sampler": i, "target": {"node": names.index(name), "path": "rotation"}} for i, name in enumerate(poses)]
channels.append({"sampler": len(samplers) - 1, "target": {"node": 0, "path": "translation"}})


def material(name, color, reflectivity):
    return {"name": name, "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0, "roughnessFactor": 1},
            "extras": {"nir_reflectivity": reflectivity}}


document = {
    "asset": {"version": "2.0", "copyright": "2026 The tofray authors, Apache-2.0", "generator": "make_figure.py"},
    "scene": 0,
    "scenes": [{"nodes": [0, len(nodes) - 1]}],
    "nodes": nodes,
    "meshes": meshes,
    "skins": [{"joints": list(range(len(names))), "inverseBindMatrices": binds}],
    "materials": [material("cotton", (0.1, 0.15, 0.4), 0.65), material("skin", (0.6, 0.4, 0.3), 0.55), material("leather", (0.05, 0.04, 0.04), 0.3)],
    "animations": [{"name": "walk and wave", "samplers": samplers, "channels": channels}],
    "accessors": accessors,
    "bufferViews": views,
    "buffers": [{"byteLength": len(data)}],
}
text = json.dumps(document, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
with open("figure.glb", "wb") as out:
    out.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(data)))
    out.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data)
