# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A loader for torch: frames are simulated while they are needed, in worker processes or in threads, and none comes twice."""

from __future__ import annotations

import sys
import time
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Any, Iterator

import torch
from torch.utils.data import DataLoader, IterableDataset, default_collate, get_worker_info
from training_frames import Frames

import tofray


class Stream(IterableDataset):
    """Worker w of n has the frames w, w + n, w + 2n …; without workers all of them, one after the other."""

    def __init__(self, frames: Frames) -> None:
        super().__init__()
        self.frames = frames

    def __len__(self) -> int:
        return len(self.frames)

    def __iter__(self) -> Iterator[tuple[torch.Tensor, torch.Tensor]]:
        worker = get_worker_info()
        own, step = (0, 1) if worker is None else (worker.id, worker.num_workers)
        for index in range(own, len(self.frames), step):
            codes, z_m = self.frames[index]
            yield torch.from_numpy(codes), torch.from_numpy(z_m)


def in_threads(frames: Frames, batch_size: int, threads: int) -> Iterator[Any]:
    """The same batches from threads, in order: nothing goes from process to process. A frame is computed without the
    interpreter's lock, so the threads run at once, and two batches are under way while one is used."""

    def batch(first: int) -> Any:
        pairs = [frames[index] for index in range(first, min(first + batch_size, len(frames)))]
        return default_collate([(torch.from_numpy(codes), torch.from_numpy(z_m)) for codes, z_m in pairs])

    with ThreadPoolExecutor(threads) as pool:
        coming: deque[Future[Any]] = deque()
        for first in range(0, len(frames), batch_size):
            coming.append(pool.submit(batch, first))
            if len(coming) > threads + 1:
                yield coming.popleft().result()
        while coming:
            yield coming.popleft().result()


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 24
    scene = tofray.load_scene("card")
    camera = tofray.load_camera(scene)
    frames = Frames(scene, camera, count)
    ways = {"two processes": DataLoader(Stream(frames), batch_size=4, num_workers=2), "two threads": in_threads(frames, 4, 2)}
    for name, loader in ways.items():
        since, seen = time.perf_counter(), 0
        for codes, z_m in loader:
            light = (codes.float() - camera.adc.mid_code).std(dim=1)  # here a network would be trained
            seen += len(z_m)
        print(f"{name}: {seen} frames, {seen / (time.perf_counter() - since):.0f} per second, the last batch {list(light.shape)}")


if __name__ == "__main__":
    main()
