# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""How the noise of the range grows with the distance of a wall: what the frames scatter, and what the camera itself says."""

from __future__ import annotations

import copy
import importlib.util

import numpy as np

import tofray

FRAMES = 12


def wall(distance_m: float) -> tofray.Scene:
    return tofray.Scene(materials=[tofray.Material(diffuse=0.8)], objects=[tofray.Object(shape=tofray.Plane(point=(0, 0, distance_m)))])


def noise_at(distance_m: float, camera: tofray.Camera) -> tuple[float, float]:
    """Standard deviation over frames and the camera's own estimate, in metres: medians of the pixels in the middle."""
    z, estimate = [], []
    for frame in tofray.Simulator(wall(distance_m), camera, truth=False).frames(0, FRAMES):
        z.append(frame.depth.range_m[80:92, 106:118].copy())
        estimate.append(frame.depth.noise_m[80:92, 106:118].copy())
    return float(np.median(np.std(z, axis=0, ddof=1))), float(np.median(estimate))


def main() -> None:
    camera = tofray.load_camera("pico-flexx", "MODE_9_5FPS_2000")
    dim = copy.deepcopy(camera)
    dim.illumination[0].power_w /= 4
    distances_m = [0.5, 1.0, 1.5, 2.0]
    table = {name: [noise_at(z, one) for z in distances_m] for name, one in (("full power", camera), ("a quarter", dim))}
    print("distance [m]   " + "   ".join(f"{name}: seen, estimated [mm]" for name in table))
    for i, z in enumerate(distances_m):
        print(f"{z:12.1f}   " + "   ".join(f"{1e3 * rows[i][0]:18.2f} {1e3 * rows[i][1]:9.2f}" for rows in table.values()))
    if importlib.util.find_spec("matplotlib") is not None:
        figure = importlib.import_module("matplotlib.figure").Figure()
        axes = figure.add_subplot(xlabel="distance [m]", ylabel="noise of the range [mm]")
        for name, rows in table.items():
            axes.plot(distances_m, [1e3 * seen for seen, _ in rows], "o", label=name)
            axes.plot(distances_m, [1e3 * estimated for _, estimated in rows], "-", color="grey")
        axes.legend()
        figure.savefig("noise_against_distance.png")


if __name__ == "__main__":
    main()
