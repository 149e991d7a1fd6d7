# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames for training: raw frames as input, true depth as target, each seen from a place of its own. Needs numpy alone.

Item i depends on scene, camera, seed and i, whichever process or thread computes it: no two workers give the same, and
so many workers as there may be give the same set. torch_loader.py hands them to torch.
"""

from __future__ import annotations

import os
from typing import Any, Sequence

import numpy as np
from numpy.typing import NDArray

import tofray


class Frames:
    """`count` frames of one scene: the noise is that of frame i, the camera's pose is drawn by seed and i.

    `threads` is how many share each frame: 1 where as many worker processes as cores run at once.
    """

    def __init__(self, scene: tofray.Scene, camera: tofray.Camera, count: int, *, seed: int = 0, shift_m: float = 0.2, threads: int = 1) -> None:
        if camera.adc.bits > 15:
            raise ValueError(f"codes of {camera.adc.bits} bits do not fit into int16")
        self.scene, self.camera, self.count, self.seed, self.shift_m, self.threads = scene, camera, count, seed, shift_m, threads
        self._simulator: tofray.Simulator | None = None
        self._made_by = 0

    def __len__(self) -> int:
        return self.count

    def pose(self, index: int) -> tofray.Pose:
        """The scene's own, shifted by up to shift_m along each axis; it looks at a point that is shifted likewise."""
        own = self.scene.camera.pose
        shifts = np.random.default_rng([self.seed, index]).uniform(-self.shift_m, self.shift_m, (2, 3))
        x, y, z, u, v, w = (float(number) for number in (np.array([own.position, own.look_at]) + shifts).flat)
        return tofray.Pose(position=(x, y, z), look_at=(u, v, w), up=own.up)

    def batch(self, indices: Sequence[int]) -> tuple[NDArray[np.int16], NDArray[np.float32]]:
        """Codes [frame, phase, height, width], and z in metres [frame, height, width], NaN where nothing is seen."""
        for index in indices:
            if not 0 <= index < self.count:
                raise IndexError(f"frame {index} of {self.count}")
        height, width = self.camera.sensor.height, self.camera.sensor.width
        codes = np.empty((len(indices), len(self.camera.mode.sequence), height, width), np.int16)
        z_m = np.empty((len(indices), height, width), np.float32)
        requests = [tofray.FrameRequest(index=index, pose=self.pose(index)) for index in indices]
        for i, frame in enumerate(self.simulator().frames(requests=requests)):
            codes[i], z_m[i] = frame.raw.raw.view(np.int16), frame.truth.z_m  # torch before 2.3 has no uint16
            del frame  # so that the next one takes its memory, which is in the processor's caches
        return codes, z_m

    def __getitem__(self, index: int) -> tuple[NDArray[np.int16], NDArray[np.float32]]:
        codes, z_m = self.batch([index])
        return codes[0], z_m[0]

    def simulator(self) -> tofray.Simulator:
        """One for each process, for none comes along through fork(). It makes of the truth what is wanted, and a frame at a time."""
        if self._simulator is None or self._made_by != os.getpid():
            self._simulator = tofray.Simulator(self.scene, self.camera, seed=self.seed, threads=self.threads, arrays=["raw", "gt_z_m"])
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
