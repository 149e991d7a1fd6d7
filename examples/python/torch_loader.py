# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Frames without end for training: raw frames as input, true depth as target. Each worker has its share of the
numbers, and so no frame comes twice.

`FrameShare` needs no torch; `dataset()` makes a torch.utils.data.IterableDataset of it. A worker is forked or started before it makes its
simulator, as it has to be.
"""

from __future__ import annotations

import importlib
from typing import Any, Iterator

import numpy as np
from numpy.typing import NDArray

import tofray


class FrameShare:
    """The frames of one worker out of several: numbers worker, worker + workers, worker + 2 · workers …, each with a seed of its own."""

    def __init__(self, scene: tofray.Scene, camera: tofray.Camera, count: int, *, worker: int = 0, workers: int = 1, seed: int = 0) -> None:
        self.scene, self.camera, self.count = scene, camera, count
        self.worker, self.workers, self.seed = worker, workers, seed

    def __iter__(self) -> Iterator[tuple[int, NDArray[np.float32], NDArray[np.float32]]]:
        # One thread for each worker: the workers themselves are what runs at once.
        simulator = tofray.Simulator(self.scene, self.camera, seed=self.seed, threads=1)
        for index in range(self.worker, self.count, self.workers):
            frame = simulator.frame(index)
            yield index, frame.raw.raw.astype(np.float32), frame.truth.z_m  # torch has no uint16; the depth is a view


def dataset(scene: tofray.Scene, camera: tofray.Camera, count: int, seed: int = 0) -> Any:
    """What torch.utils.data.DataLoader(…, num_workers=N) takes."""
    data = importlib.import_module("torch.utils.data")

    class Frames(data.IterableDataset):  # type: ignore[misc, name-defined]
        def __iter__(self) -> Iterator[Any]:
            info = data.get_worker_info()
            worker, workers = (0, 1) if info is None else (info.id, info.num_workers)
            return iter(FrameShare(scene, camera, count, worker=worker, workers=workers, seed=seed))

    return Frames()


def main() -> None:
    scene = tofray.load_scene("card")
    shares = [list(FrameShare(scene, tofray.load_camera(scene), 6, worker=worker, workers=2)) for worker in range(2)]
    print("numbers of the frames:", [[index for index, _, _ in share] for share in shares])


if __name__ == "__main__":
    main()
