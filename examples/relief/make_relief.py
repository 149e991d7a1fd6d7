#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Writes relief.glb: a wall of cobbles that is flat but for its picture of normals, and a ball with dimples and metal bands, whose picture
of metal and roughness says where; a camera looks at them."""
import json
import math
import struct
import zlib

binary, views, accessors, images, materials, nodes, meshes = b"", [], [], [], [], [], []


def view(data):
    global binary
    views.append({"buffer": 0, "byteOffset": len(binary), "byteLength": len(data)})
    binary += data + b"\0" * (-len(data) % 4)
    return len(views) - 1


def accessor(rows, kind):
    letter = "I" if kind == "SCALAR" else "f"
    rows = [row if isinstance(row, tuple) else (row,) for row in rows]
    packed = b"".join(struct.pack(f"<{len(row)}{letter}", *row) for row in rows)
    accessors.append({"bufferView": view(packed), "componentType": 5125 if letter == "I" else 5126, "type": kind, "count": len(rows),
                      "min": [min(c) for c in zip(*rows)], "max": [max(c) for c in zip(*rows)]})
    return len(accessors) - 1


def picture(width, height, color):
    """A PNG of color(u, v) → red, green, blue in 0…1."""
    rows = b""
    for y in range(height):
        rows += b"\0"
        for x in range(width):
            rows += bytes(min(255, max(0, round(255 * a))) for a in color((x + 0.5) / width, (y + 0.5) / height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    png = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    png += chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    images.append({"bufferView": view(png), "mimeType": "image/png"})
    return len(images) - 1


def normals(height, aspect):
    """The picture of normals of a height over (u, v), both in units of the picture's width; y is up."""
    def color(u, v):
        step = 1e-3
        right = (height(u + step, v) - height(u - step, v)) / (2 * step)
        up = -(height(u, v + step) - height(u, v - step)) / (2 * step * aspect)
        size = math.sqrt(right * right + up * up + 1)
        return (0.5 - right / size / 2, 0.5 - up / size / 2, 0.5 + 1 / size / 2)
    return color


def cobbles(u, v):
    """Rounded stones in rows, each second one half a stone further on: 4 across, 4 rows."""
    row = math.floor(4 * v)
    x, y = (4 * u + 0.5 * (row % 2)) % 1 - 0.5, 4 * v - row - 0.5
    from_edge = max(0.0, min(0.47 - abs(x), 0.45 - abs(y)))
    return 0.07 * (1 - (1 - min(1, from_edge / 0.2)) ** 2)


def dimples(u, v):
    """Hollows of a golf ball, 16 round it and 8 from pole to pole."""
    row = math.floor(8 * v)
    x, y = (16 * u + 0.5 * (row % 2)) % 1 - 0.5, 8 * v - row - 0.5
    return -0.006 * max(0.0, 1 - (x * x + y * y) / 0.16)


def material(name, base, normal, finish=None):
    said = {"baseColorFactor": [base, base, base, 1], "metallicFactor": 0 if finish is None else 1, "roughnessFactor": 1}
    if finish is not None:
        said["metallicRoughnessTexture"] = {"index": finish}
    materials.append({"name": name, "pbrMetallicRoughness": said, "normalTexture": {"index": normal}})
    return len(materials) - 1


def add(name, of, corners, out, texcoords, triangles, at):
    attributes = {"POSITION": accessor(corners, "VEC3"), "NORMAL": accessor(out, "VEC3"), "TEXCOORD_0": accessor(texcoords, "VEC2")}
    meshes.append({"name": name, "primitives": [{"attributes": attributes, "indices": accessor(triangles, "SCALAR"), "material": of}]})
    nodes.append({"name": name, "mesh": len(meshes) - 1, "translation": list(at)})


stones = material("cobbles", 0.5, picture(128, 128, normals(cobbles, 1)))
add("wall", stones, [(-0.9, -0.7, 0), (0.9, -0.7, 0), (0.9, 0.7, 0), (-0.9, 0.7, 0)], [(0, 0, 1)] * 4,
    [(0, 3.5), (4.5, 3.5), (4.5, 0), (0, 0)], [0, 1, 2, 0, 2, 3], (0, 0, 0))

bands = picture(8, 64, lambda u, v: (0, 0.45 if 0.3 < v < 0.42 or 0.58 < v < 0.7 else 0.8, 1 if 0.3 < v < 0.42 or 0.58 < v < 0.7 else 0))
ball = material("ball", 0.7, picture(256, 128, normals(dimples, 2)), bands)
corners, out, texcoords, triangles, ring, rows = [], [], [], [], 48, 24
for j in range(rows + 1):
    for i in range(ring + 1):
        a, b = 2 * math.pi * i / ring, math.pi * j / rows
        n = (math.sin(b) * math.sin(a), math.cos(b), math.sin(b) * math.cos(a))
        corners.append(tuple(0.27 * c for c in n))
        out.append(n)
        texcoords.append((i / ring, j / rows))
for j in range(rows):
    for i in range(ring):
        a = j * (ring + 1) + i
        triangles += [a, a + ring + 1, a + 1, a + 1, a + ring + 1, a + ring + 2]
add("ball", ball, corners, out, texcoords, triangles, (0.14, -0.03, 0.3))
nodes.append({"name": "camera", "camera": 0, "translation": [0, 0, 1.35]})

document = {"asset": {"version": "2.0", "generator": "tofray's make_relief.py"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}],
            "nodes": nodes, "meshes": meshes, "materials": materials, "images": images,
            "textures": [{"source": i} for i in range(len(images))], "accessors": accessors, "bufferViews": views,
            "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}}], "buffers": [{"byteLength": len(binary)}]}
text = json.dumps(document, separators=(",", ":")).encode()
text += b" " * (-len(text) % 4)
with open("relief.glb", "wb") as file:
    file.write(struct.pack("<4sIIII", b"glTF", 2, 12 + 8 + len(text) + 8 + len(binary), len(text), 0x4E4F534A) + text)
    file.write(struct.pack("<II", len(binary), 0x004E4942) + binary)
