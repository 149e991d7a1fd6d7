#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes room.glb: planks, bricks, a poster, a table and a vase with a pattern, all with pictures and smooth normals, and a camera."""
import json
import math
import random
import struct
import zlib

binary, views, accessors, images, materials, nodes, meshes = b"", [], [], [], [], [], []
chance = random.Random(1)


def view(data):
    global binary
    views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
    binary += data + b"\0" * (-len(data) % 4)
    return len(views) - 1


def accessor(rows, kind):
    rows = [row if isinstance(row, tuple) else (row,) for row in rows]
    letter = "I" if kind == "SCALAR" else "f"
    packed = b"".join(struct.pack(f"<{len(row)}{letter}", *row) for row in rows)
    accessors.append({"bufferView": view(packed), "componentType": 5125 if letter == "I" else 5126, "type": kind, "count": len(rows),
                      "min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]})
    return len(accessors) - 1


def material(name, size, roughness, color):
    """A PNG of size × size, color(u, v) → red, green, blue in 0…1 as screens show them; no metal, roughness as glTF has it."""
    rows = b""
    for y in range(size):
        rows += b"\0"
        for x in range(size):
            rows += bytes(min(255, max(0, round(255 * a))) for a in color((x + 0.5) / size, (y + 0.5) / size))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0))
    png += chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    images.append({"bufferView": view(png), "mimeType": "image/png"})
    materials.append({"name": name,
                      "pbrMetallicRoughness": {"baseColorTexture": {"index": len(images) - 1}, "metallicFactor": 0,
                                               "roughnessFactor": roughness}})
    return len(materials) - 1


def add(name, of, corners, normals, texcoords, triangles, at=(0, 0, 0)):
    attributes = {"POSITION": accessor(corners, "VEC3"), "NORMAL": accessor(normals, "VEC3"), "TEXCOORD_0": accessor(texcoords, "VEC2")}
    meshes.append({"name": name, "primitives": [{"attributes": attributes, "indices": accessor(triangles, "SCALAR"), "material": of}]})
    nodes.append({"name": name, "mesh": len(meshes) - 1, "translation": list(at)})


def quads(sides):
    """Corner, two sides, and how often the picture repeats along them."""
    corners, normals, texcoords, triangles = [], [], [], []
    for p, a, b, nu, nv in sides:
        n = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        size = math.hypot(*n)
        triangles += [len(corners) + i for i in (0, 1, 2, 0, 2, 3)]
        for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)):
            corners.append(tuple(p[k] + i * a[k] + j * b[k] for k in range(3)))
            normals.append(tuple(c / size for c in n))
            texcoords.append((i * nu, (1 - j) * nv))
    return corners, normals, texcoords, triangles


def box(x, y, z, sx, sy, sz):
    return quads([((x, y, z + sz), (sx, 0, 0), (0, sy, 0), 1, 1), ((x + sx, y, z), (-sx, 0, 0), (0, sy, 0), 1, 1),
                  ((x, y, z), (0, 0, sz), (0, sy, 0), 1, 1), ((x + sx, y, z + sz), (0, 0, -sz), (0, sy, 0), 1, 1),
                  ((x, y + sy, z + sz), (sx, 0, 0), (0, 0, -sz), 1, 1), ((x, y, z), (sx, 0, 0), (0, 0, sz), 1, 1)])


def planks(u, v):
    plank, along = int(u * 8), v * 2 + 0.37 * int(u * 8)
    if u * 8 % 1 < 0.04 or along % 1 < 0.012:
        return 0.2, 0.13, 0.08
    tone = 0.8 + 0.2 * math.sin(12.9898 * plank + 78.233 * int(along)) + 0.05 * math.sin(260 * u + 6 * math.sin(9 * v + plank))
    return 0.88 * tone, 0.7 * tone, 0.5 * tone


def bricks(u, v):
    row = int(v * 8)
    x, y = (u * 4 + 0.5 * (row % 2)) % 1, v * 8 % 1
    if x < 0.05 or y < 0.1:
        return 0.78, 0.76, 0.72
    tone = 0.85 + 0.15 * math.sin(37.7 * row + 11.3 * int(u * 4 + 0.5 * (row % 2)))
    return 0.88 * tone, 0.6 * tone, 0.52 * tone


def poster(u, v):
    if min(u, v, 1 - u, 1 - v) < 0.05:
        return 0.05, 0.05, 0.05
    if math.hypot(u - 0.68, v - 0.3) < 0.12:
        return 1, 0.9, 0.4
    hills = 0.62 + 0.08 * math.sin(9 * u) + 0.04 * math.sin(23 * u + 1)
    return (0.15, 0.35, 0.15) if v > hills else (0.55 + 0.4 * v, 0.7 + 0.2 * v, 0.95)


def stripes(u, v):
    if 0.42 < v < 0.6:
        return (0.95, 0.93, 0.85) if (u * 12 + abs(v - 0.51) * 12) % 1 < 0.5 else (0.1, 0.2, 0.5)
    return (0.1, 0.2, 0.5) if int(v * 24) % 4 == 0 else (0.95, 0.93, 0.85)


def plain(r, g, b):
    return lambda u, v: tuple(c * (0.97 + 0.03 * chance.random()) for c in (r, g, b))


add("floor", material("planks", 256, 0.6, planks), *quads([((-2, 0, 2), (4, 0, 0), (0, 0, -4), 2, 2)]))
add("back", material("bricks", 128, 1, bricks), *quads([((-2, 0, -2), (4, 0, 0), (0, 2.6, 0), 4, 2.6)]))
plaster = material("plaster", 64, 1, plain(0.9, 0.9, 0.87))
add("side", plaster, *quads([((-2, 0, 2), (0, 0, -4), (0, 2.6, 0), 1, 1)]))
add("poster", material("poster", 128, 0.5, poster), *quads([((-1.99, 0.9, -0.1), (0, 0, -1.3), (0, 1, 0), 1, 1)]))
wood = material("wood", 128, 0.7, lambda u, v: tuple(c * (0.85 + 0.15 * math.sin(60 * v + 4 * math.sin(7 * u))) for c in (0.8, 0.62, 0.42)))
add("top", wood, *box(-0.2, 0.68, -1.3, 1.3, 0.05, 0.8))
for leg, (x, z) in enumerate(((-0.15, -1.25), (0.99, -1.25), (-0.15, -0.61), (0.99, -0.61))):
    add(f"leg {leg}", wood, *box(x, 0, z, 0.06, 0.68, 0.06))

ring, levels, height = 48, 32, 0.5
corners, normals, texcoords, triangles = [], [], [], []
for j in range(levels + 1):
    v = j / levels
    shape = lambda v: 0.07 + 0.09 * math.sin(math.pi * (0.15 + 0.75 * v)) ** 2 + 0.05 * v ** 6
    slope = (shape(v + 1e-4) - shape(v - 1e-4)) / (2e-4 * height)
    for i in range(ring + 1):
        c, s = math.cos(2 * math.pi * i / ring), math.sin(2 * math.pi * i / ring)
        corners.append((shape(v) * c, height * v, -shape(v) * s))
        length = math.hypot(1, slope)
        normals.append((c / length, -slope / length, -s / length))
        texcoords.append((2 * i / ring, 1 - v))
for j in range(levels):
    for i in range(ring):
        a, b = j * (ring + 1) + i, (j + 1) * (ring + 1) + i
        triangles += [a, a + 1, b + 1, a, b + 1, b]
add("vase", material("vase", 128, 0.3, stripes), corners, normals, texcoords, triangles, (0.45, 0.73, -0.95))

# A camera beside the door: its axis is −z, up is y.
tilt, turn = math.radians(-9), math.radians(27)
c, s, d, t = math.cos(turn / 2), math.sin(turn / 2), math.cos(tilt / 2), math.sin(tilt / 2)
nodes.append({"name": "camera", "camera": 0, "translation": [0.95, 1.4, 0.95], "rotation": [c * t, s * d, -s * t, c * d]})

# All of it at half its size: a doll's room, which the light of a small camera fills.
nodes.append({"name": "room", "children": list(range(len(nodes))), "scale": [0.5, 0.5, 0.5]})

document = {"asset": {"version": "2.0", "generator": "tofray's make_room.py"}, "scene": 0, "scenes": [{"nodes": [len(nodes) - 1]}],
            "nodes": nodes, "meshes": meshes, "materials": materials, "images": images,
            "textures": [{"source": i} for i in range(len(images))], "accessors": accessors, "bufferViews": views,
            "buffers": [{"byteLength": len(binary)}],
            "cameras": [{"type": "perspective", "perspective": {"yfov": math.radians(45), "znear": 0.01}}]}
text = json.dumps(document, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
binary += b"\0" * (-len(binary) % 4)
with open("room.glb", "wb") as file:
    file.write(struct.pack("<4sII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(binary)))
    file.write(struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary)
