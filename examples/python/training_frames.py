# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames for training: raw frames as input, true depth as target, each seen from a place of its own. Needs numpy alone.

Item i depends on scene, camera, seed and i, whichever process or thread computes it: no two workers give the same, and
so many workers as there may be give the same set. torch_loader.py hands them to torch.
"""

from __future__ import annotations

import os
import threading
from typing import Any

import numpy as np
from numpy.typing import NDArray

import tofray


class Frames:
    """`count` frames of one scene: the noise is that of frame i, the camera's pose is drawn by seed and i."""

    def __init__(self, scene: tofray.Scene, camera: tofray.Camera, count: int, *, seed: int = 0, shift_m: float = 0.2) -> None:
        if camera.adc.bits > 15:
            raise ValueError(f"codes of {camera.adc.bits} bits do not fit into int16")
        self.scene, self.camera, self.count, self.seed, self.shift_m = scene, camera, count, seed, shift_m
        self._own = threading.local()

    def __len__(self) -> int:
        return self.count

    def pose(self, index: int) -> tofray.Pose:
        """The scene's own, shifted by up to shift_m along each axis; it looks at a point that is shifted likewise."""
        own = self.scene.camera.pose
        shifts = np.random.default_rng([self.seed, index]).uniform(-self.shift_m, self.shift_m, (2, 3))
        (x, y, z), (u, v, w) = (np.array([own.position, own.look_at]) + shifts).tolist()
        return tofray.Pose(position=(x, y, z), look_at=(u, v, w), up=own.up)

    def __getitem__(self, index: int) -> tuple[NDArray[np.int16], NDArray[np.float32]]:
        """Codes [phase, height, width], and z in metres [height, width], NaN where nothing is seen."""
        if not 0 <= index < self.count:
            raise IndexError(f"frame {index} of {self.count}")
        request = tofray.FrameRequest(index=index, pose=self.pose(index))
        frame = next(self._simulator().frames(requests=[request]))
        # Copies of what is wanted: the frame's 5 MB go to the next one. (torch before 2.3 has no uint16.)
        return frame.raw.raw.astype(np.int16), frame.truth.z_m.copy()

    def _simulator(self) -> tofray.Simulator:
        """One for each thread of each worker: what runs at once are the workers, and none comes along through fork()."""
        if getattr(self._own, "made_by", 0) != os.getpid():
            self._own.simulator = tofray.Simulator(self.scene, self.camera, seed=self.seed, threads=1)
            self._own.made_by = os.getpid()
        simulator: tofray.Simulator = self._own.simulator
        return simulator

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in self.__dict__.items() if name != "_own"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state, _own=threading.local())


def main() -> None:
    scene = tofray.load_scene("card")
    frames = Frames(scene, tofray.load_camera(scene), 6)
    middles = [float(z_m[z_m.shape[0] // 2, z_m.shape[1] // 2]) for _, z_m in (frames[i] for i in range(len(frames)))]
    print("true depth in the middle:", ", ".join(f"{z:.3f} m" for z in middles))


if __name__ == "__main__":
    main()
