# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames for training: raw frames as input, true depth as target, each seen from a place of its own.

`Frames` needs no torch, and torch.utils.data.DataLoader takes it as it is:
DataLoader(Frames(…), batch_size=8, shuffle=True, num_workers=4).
Item i depends on scene, camera, seed and i alone, whichever worker computes it.
"""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tofray


class Frames:
    """`count` frames of one scene: the noise is that of frame i, the camera's pose is drawn by seed and i."""

    def __init__(self, scene: tofray.Scene, camera: tofray.Camera, count: int, *, seed: int = 0, shift_m: float = 0.2) -> None:
        self.scene, self.camera, self.count, self.seed, self.shift_m = scene, camera, count, seed, shift_m
        self._simulator: tofray.Simulator | None = None
        self._made_by = 0

    def __len__(self) -> int:
        return self.count

    def pose(self, index: int) -> tofray.Pose:
        """The scene's own, shifted by up to shift_m along each axis; it looks at a point that is shifted likewise."""
        own = self.scene.camera.pose
        shifts = np.random.default_rng([self.seed, index]).uniform(-self.shift_m, self.shift_m, (2, 3))
        (x, y, z), (u, v, w) = (np.array([own.position, own.look_at]) + shifts).tolist()
        return tofray.Pose(position=(x, y, z), look_at=(u, v, w), up=own.up)

    def __getitem__(self, index: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
        if not 0 <= index < self.count:
            raise IndexError(f"frame {index} of {self.count}")
        request = tofray.FrameRequest(index=index, pose=self.pose(index))
        frame = next(self._here().frames(requests=[request]))
        return frame.raw.raw.astype(np.float32), frame.truth.z_m  # torch before 2.3 has no uint16; the depth is a view

    def _here(self) -> tofray.Simulator:
        """Made by the worker that uses it: a simulator does not come along through fork()."""
        if self._simulator is None or self._made_by != os.getpid():
            # One thread for each worker: the workers themselves are what runs at once.
            self._simulator = tofray.Simulator(self.scene, self.camera, seed=self.seed, threads=1)
            self._made_by = os.getpid()
        return self._simulator

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_simulator": None}


def main() -> None:
    scene = tofray.load_scene("card")
    frames = Frames(scene, tofray.load_camera(scene), 6)
    middles = [float(z_m[z_m.shape[0] // 2, z_m.shape[1] // 2]) for _, z_m in (frames[i] for i in range(len(frames)))]
    print("true depth in the middle:", ", ".join(f"{z:.3f} m" for z in middles))


if __name__ == "__main__":
    main()
