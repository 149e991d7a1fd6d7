# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A data set for torch: batches out of its shards, or computed where only the plan is. torch_samples.py FOLDER"""

from __future__ import annotations

import sys
from typing import Any, Iterator

import numpy as np
import torch
from torch.utils.data import DataLoader, IterableDataset, get_worker_info

import tofray


class SetStream(IterableDataset):
    """Whole batches, for DataLoader(SetStream(…), batch_size=None, num_workers=n): each worker has its own part of an epoch. Of each sample
    raw frames as float32 [phase, height, width], and the true z with 0 where there is none."""

    def __init__(self, folder: str, batch: int, seed: int = 0, computed: bool | None = None, split: str | None = None) -> None:
        super().__init__()
        self.samples, self.batch, self.seed, self.epoch = tofray.open_dataset(folder, computed=computed, split=split), batch, seed, 0

    def __iter__(self) -> Iterator[tuple[torch.Tensor, torch.Tensor]]:
        worker = get_worker_info()
        rank, world = (0, 1) if worker is None else (worker.id, worker.num_workers)
        for one in self.samples.stream(self.batch, rank=rank, world=world, seed=self.seed, epoch=self.epoch):
            # (np.stack has copied the shard's bytes, which cannot be written. torch before 2.3 has no uint16.)
            yield torch.from_numpy(np.asarray(one["raw"], np.float32)), torch.from_numpy(np.nan_to_num(one["gt_z_m"]))


def main() -> None:
    stream = SetStream(sys.argv[1], batch=8)
    loader: Any = DataLoader(stream, batch_size=None, num_workers=2)
    for epoch in range(2):
        stream.epoch = epoch  # another order
        shapes = [tuple(raw.shape) for raw, _ in loader]
        print(f"epoch {epoch}: {sum(shape[0] for shape in shapes)} samples in {len(shapes)} batches, raw {shapes[0]}")


if __name__ == "__main__":
    main()
