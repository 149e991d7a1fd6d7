# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What each row of benches/run.py should reach: all goals, in one place."""

from __future__ import annotations

import dataclasses
from typing import Mapping


@dataclasses.dataclass(frozen=True)
class Goal:
    """A limit of a row's median, or of its time as a share of the old build's: one for all instruction sets, or one for each."""

    limit: float | Mapping[str, float]
    at_least: bool = False
    of_old: bool = False

    def on(self, isa: str) -> float | None:
        return self.limit.get(isa) if isinstance(self.limit, Mapping) else self.limit


def at_most(limit: float) -> Goal:
    return Goal(limit)


def at_least(limit: float) -> Goal:
    return Goal(limit, at_least=True)


def no_slower(percent: float) -> Goal:
    return Goal(1 + percent / 100, of_old=True)


GOALS: Mapping[str, Mapping[str, Goal]] = {
    "primitives": {
        "bench-primitives": no_slower(2),
        "bench-primitives, one thread": no_slower(2),
        "bench-primitives, noise off": no_slower(2),
        "flying-ball": no_slower(2),
        "bench-mesh": no_slower(2),
    },
    "set-up": {
        "bench-primitives, from nothing": at_most(5.0),
        "bench-primitives, another scene": at_most(0.2),
        "bench-primitives, another lens": no_slower(2),
        "bench-primitives, another number of the sensor": no_slower(2),
        "bench-mesh, another lens": no_slower(2),
        "bench-mesh, another number of the sensor": no_slower(2),
    },
    "anywhere": {
        "101,920 triangles, to Embree": at_least(1.0),
        "1,610,258 triangles, to Embree": at_least(1.0),
    },
    "bounces": {
        "corner, floor, box, 7 bounces, 16 ways": Goal({"avx2": 45, "avx512": 25}),
        "room, 7 bounces, 16 ways": at_most(110),
        "bench-mesh, 3 bounces, 16 ways": at_most(200),
    },
    "meshes": {
        "1,510,432 triangles, camera rays to Embree": at_least(1.5),
        "7,242,880 triangles, camera rays to Embree": at_least(1.2),
        "1,510,432 triangles, built": at_least(8),
    },
    "objects": {
        "10,000 spheres, to one": at_most(1.5),
        "10,000 spheres in the sun, to one": at_most(3),
        "1,000 mesh instances, to one": at_most(1.6),
        "10,000 mesh instances, to one": at_most(3),
    },
    "samples": {
        "3 × 3 samples within pixels, to one": at_most(4),
        "9 times within each exposure, to one": at_most(4),
    },
    "recording": {
        "all arrays, of the slower": at_least(85),
        "raw,z_m,flags, of the slower": at_least(85),
    },
    "pixel": {
        "all effects, one thread, to none": at_most(1.3),
        "all effects, two threads, to none": at_most(1.3),
    },
    "gpu": {
        "bench-primitives, left there": at_least(120_000),
        "bench-mesh, left there": at_least(25_000),
    },
    "viewer": {
        "slider to picture, demo, camera.lens.f_number, 95th percentile": at_most(100),
        "slider to picture, demo, objects.2.sphere.radius, 95th percentile": at_most(100),
        "slider to picture, room, camera.lens.f_number, 95th percentile": at_most(100),
        "first draft of a frame of 7 bounces, corner, 95th percentile": at_most(150),
        "first draft of a frame of 7 bounces, room, 95th percentile": at_most(150),
        "frames drawn a second, 224 × 172, pico flexx, two panes": at_least(60),
        "frames drawn a second, 640 × 480, imx556, two panes": at_least(20),
    },
}
