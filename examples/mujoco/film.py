# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A MuJoCo model seen by a time-of-flight camera, as main.cpp does it: python3 film.py arm.xml hand

Physics goes on while a frame's raw frames are exposed, one after the other; what moves is at another place in each. Writes film.mcap, and
the last frame's files into the folder film.
"""

from __future__ import annotations

import math
import sys
from typing import Any

import mujoco
import numpy as np

import tofray
from mirror import Mirror


def drive(model: Any, data: Any) -> None:
    """This stands for the robot's program: joints that have motors swing, each faster than the one before."""
    for i in range(model.nu):
        data.ctrl[i] = 0.2 * math.sin((3 + i) * data.time)


def step_until(model: Any, data: Any, time_s: float) -> None:
    while data.time < time_s - 0.5 * model.opt.timestep:
        drive(model, data)
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)   # where things are now: mj_step leaves where they were


def at_once(seen: dict[str, Any]) -> dict[str, Any]:
    """All of it where it is in the middle of the exposures, which is the time of the ground truth."""
    def middle(keys: Any) -> Any:
        return keys[len(keys) // 2]

    return {"camera": middle(seen["camera"]).pose if seen["camera"] else None,
            "objects": {name: tofray.Placement(position=middle(keys).position, rotation=middle(keys).rotation) for name, keys in seen["objects"].items()}}


def median_mm(off: Any) -> float:
    known = np.sort(np.abs(off[np.isfinite(off)]))
    return 1e3 * float(known[known.size // 2]) if known.size else 0.0


def main() -> None:
    if len(sys.argv) != 3:
        raise SystemExit("expected a model and one of its cameras: film.py arm.xml hand")
    model = mujoco.MjModel.from_xml_path(sys.argv[1])
    data = mujoco.MjData(model)
    if model.nv > 0 and model.nu == 0:
        data.qvel[0] = 2   # rad/s: something moves

    mirror = Mirror(model, sys.argv[2], {"wood": tofray.load_material("wood")})
    camera = tofray.load_camera("pico-flexx", "MODE_9_10FPS_1000")
    simulator = tofray.Simulator(mirror.scene, camera, seed=7)
    with tofray.McapWriter("film.mcap", mirror.scene, camera, seed=7) as messages:
        for i in range(10):
            start = i / camera.mode.frame_rate_hz
            for when in tofray.exposure_times(camera, start):
                step_until(model, data, when)
                mirror.look(data)
            seen = mirror.seen()
            frame = simulator.frame(i, time_s=start, **seen)
            messages.write(frame)
            still = simulator.frame(i, time_s=start, **at_once(seen))   # with the same noise
            by = frame.depth.z_m - still.depth.z_m
            print(f"{start:.3f} s: depth is off by {median_mm(frame.depth.z_m - frame.truth.z_m):.1f} mm in the median; motion moves that of "
                  f"{np.mean(np.abs(by) > 0):.0%} of the pixels, by {median_mm(by[by != 0]):.1f} mm")
    frame.save("film")


if __name__ == "__main__":
    main()
