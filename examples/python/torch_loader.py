# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A loader for torch: batches are simulated while they are needed, in worker processes or beside the training, and no frame comes twice."""

from __future__ import annotations

import os
import sys
import time
from collections import deque
from concurrent.futures import Future, ThreadPoolExecutor
from typing import Iterator

import torch
from torch.utils.data import DataLoader, IterableDataset, get_worker_info
from training_frames import Frames

import tofray

Batch = tuple[torch.Tensor, torch.Tensor]  # codes [frame, phase, height, width], z_m [frame, height, width]


class Stream(IterableDataset):
    """Whole batches, for DataLoader(Stream(…), batch_size=None, num_workers=n): worker w has the batches w, w + n, w + 2n …; without
    workers all of them come, one after the other."""

    def __init__(self, frames: Frames, batch_size: int) -> None:
        super().__init__()
        self.frames, self.batch_size = frames, batch_size

    def __len__(self) -> int:
        return -(-len(self.frames) // self.batch_size)

    def __getitem__(self, number: int) -> Batch:
        first = number * self.batch_size
        codes, z_m = self.frames.batch(range(first, min(first + self.batch_size, len(self.frames))))
        return torch.from_numpy(codes), torch.from_numpy(z_m)

    def __iter__(self) -> Iterator[Batch]:
        worker = get_worker_info()
        own, step = (0, 1) if worker is None else (worker.id, worker.num_workers)
        return (self[number] for number in range(own, len(self), step))


def ahead(stream: Stream, batches: int = 2) -> Iterator[Batch]:
    """The batches of a stream, in order, computed by one thread while those before are used: nothing goes from process to process, and
    the simulator's own threads (Frames(…, threads=n)) share each frame, whose arrays stay in the processor's caches. A frame is
    computed without the interpreter's lock."""
    with ThreadPoolExecutor(1) as thread:
        coming: deque[Future[Batch]] = deque()
        for number in range(len(stream)):
            coming.append(thread.submit(stream.__getitem__, number))
            if len(coming) > batches:
                yield coming.popleft().result()
        while coming:
            yield coming.popleft().result()


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 24
    scene = tofray.load_scene("card")
    camera = tofray.load_camera(scene)
    in_processes = Stream(Frames(scene, camera, count), 4)
    beside = Stream(Frames(scene, camera, count, threads=os.cpu_count() or 1), 4)
    ways = {"two processes": DataLoader(in_processes, batch_size=None, num_workers=2), "beside, on all cores": ahead(beside)}
    for name, loader in ways.items():
        since, seen = time.perf_counter(), 0
        for codes, z_m in loader:
            light = (codes.float() - camera.adc.mid_code).std(dim=1)  # here a network would be trained
            seen += len(z_m)
        print(f"{name}: {seen} frames, {seen / (time.perf_counter() - since):.0f} per second, the last batch {list(light.shape)}")


if __name__ == "__main__":
    main()
