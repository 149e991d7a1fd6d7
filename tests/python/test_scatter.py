# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Scattered objects by numpy alone: none overlaps another one, none hovers, none reaches over the table's rim."""

from __future__ import annotations

import os
import pathlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tofray

TEXT = """
name: tabletop
license: CC0-1.0
samples: 10000
seed: 3
scene:
  camera: {profile: pico-flexx, pose: {position: [0, -50 cm, 0], look_at: [0, 10 cm, 1 m]}}
  objects:
    - plane: {name: floor, point: [0, 80 cm, 0], normal: [0, -1, 0], reflectivity: 50 %}
    - box: {name: table, min: [-50 cm, 10 cm, 70 cm], max: [50 cm, 14 cm, 1.3 m], reflectivity: 40 %}
    - scatter:
        name: clutter
        count: {integer: [3, 12]}
        of:
          choice:
            - sphere: {center: [0, 0, 0], radius: {uniform: [3 cm, 8 cm]}, reflectivity: 0.5}
            - box: {min: [-5 cm, -8 cm, -4 cm], max: [5 cm, 8 cm, 4 cm], rotation: any, reflectivity: 0.5}
            - cylinder: {center: [0, 0, 0], axis: [0, 1, 0], height: {uniform: [5 cm, 20 cm]}, radius: 3 cm, reflectivity: 0.5}
        surface: table
        gap: 1 mm
"""
Points = NDArray[np.float64]
SCENES = int(os.environ.get("TOFRAY_SCENES", "100"))  # 10000 take some minutes


def matrix(q: Points) -> Points:
    """Of a quaternion x, y, z, w."""
    x, y, z, w = q / np.linalg.norm(q)
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


class Body:
    """A point set of its surface, whether points are in it, and how far it reaches along a direction."""

    def __init__(self, thing: tofray.Object) -> None:
        self.shape: Any = thing.shape
        self.turn, self.at = matrix(np.array(thing.rotation.quaternion)), np.array(thing.position)
        rng = np.random.default_rng(1)
        way = rng.normal(size=(600, 3))
        way /= np.linalg.norm(way, axis=1, keepdims=True)
        if isinstance(self.shape, tofray.Sphere):
            own = way * self.shape.radius
        elif isinstance(self.shape, tofray.Box):
            self.half = 0.5 * (np.array(self.shape.max) - np.array(self.shape.min))
            own = np.clip(way * 10, -1, 1) * self.half
        else:
            along = np.clip(rng.uniform(-1.5, 1.5, 600), -1, 1) * 0.5 * self.shape.height
            around = way[:, [0, 2]] / np.linalg.norm(way[:, [0, 2]], axis=1, keepdims=True) * self.shape.radius
            own = np.stack([around[:, 0], along, around[:, 1]], axis=1)
        self.points = own @ self.turn.T + self.at

    def holds(self, points: Points) -> bool:
        own = (points - self.at) @ self.turn
        if isinstance(self.shape, tofray.Sphere):
            inside = np.linalg.norm(own, axis=1) < self.shape.radius
        elif isinstance(self.shape, tofray.Box):
            inside = (np.abs(own) < self.half).all(axis=1)
        else:
            inside = (np.abs(own[:, 1]) < 0.5 * self.shape.height) & (np.hypot(own[:, 0], own[:, 2]) < self.shape.radius)
        return bool(inside.any())

    def reach(self, way: Points) -> float:
        own = self.turn.T @ way
        if isinstance(self.shape, tofray.Sphere):
            far = self.shape.radius
        elif isinstance(self.shape, tofray.Box):
            far = float(np.abs(own) @ self.half)
        else:
            far = abs(own[1]) * 0.5 * self.shape.height + self.shape.radius * float(np.hypot(own[0], own[2]))
        return float(way @ self.at) + far


def test_nothing_overlaps_hovers_or_reaches_over_the_rim(tmp_path: pathlib.Path) -> None:
    (tmp_path / "set.yaml").write_text(TEXT, encoding="utf-8")
    scenes = tofray.Dataset(tmp_path / "set.yaml")
    placed = touched = 0
    for sample in range(SCENES):
        bodies = [Body(thing) for thing in scenes.scene(sample).objects if thing.name.startswith("clutter")]
        placed += len(bodies)
        for i, body in enumerate(bodies):
            lowest = body.reach(np.array([0.0, 1, 0]))
            assert abs(lowest - 0.1) < 1e-6, f"sample {sample}: {lowest - 0.1} m above or in the table"
            for way, rim in (([1.0, 0, 0], 0.5), ([-1.0, 0, 0], 0.5), ([0, 0, 1.0], 1.3), ([0, 0, -1.0], -0.7)):
                assert body.reach(np.array(way)) <= rim + 1e-9, f"sample {sample} reaches over the rim"
            for other in bodies[:i]:
                assert not other.holds(body.points) and not body.holds(other.points), f"sample {sample}: two overlap"
                near = float(np.linalg.norm(body.at - other.at))
                touched += int(near < 0.25)
                if isinstance(body.shape, tofray.Sphere) and isinstance(other.shape, tofray.Sphere):
                    assert near >= body.shape.radius + other.shape.radius + 0.001 - 1e-12
    assert placed > 6 * SCENES and touched > SCENES, "many, and near each other"
