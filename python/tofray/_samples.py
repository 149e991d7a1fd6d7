# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of a data set, out of its shards or computed where they are asked for."""

from __future__ import annotations

import collections
import io
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any

import numpy as np

from ._dataset import Dataset
from ._errors import BadInput, IoError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

_NO_SHARD = 0xFFFFFFFF
_SPLITS = ("train", "validation", "test")
_MOST_OPEN = 64  # shards in memory's map at once


def _mixed(numbers: NDArray[np.uint64], key: int) -> NDArray[np.uint64]:
    """Each number's bits by chance: the finisher of splitmix64 (Steele, Lea, Flood 2014), the same with every numpy."""
    with np.errstate(over="ignore"):
        z = numbers + np.uint64(key * 0x9E3779B97F4A7C15 % 2**64)
        z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
        mixed: NDArray[np.uint64] = z ^ (z >> np.uint64(31))
    return mixed


def _codes(values: NDArray[np.floating[Any]], as_: dict[str, Any]) -> NDArray[Any]:
    """Whole numbers as a shard stores them: the nearest to value / step, of two as near the even one."""
    return np.where(np.isnan(values), as_["no_value"], np.rint(values.astype(np.float64) / as_["step"])).astype(as_["dtype"])


def _values(codes: NDArray[Any], as_: dict[str, Any]) -> NDArray[np.float32]:
    """What they stand for, with NaN."""
    values: NDArray[np.float32] = np.where(codes == as_["no_value"], np.nan, codes * as_["step"]).astype(np.float32)
    return values


class Samples:
    """Samples of a data set by number: ``samples[i]`` is a dict of arrays, and ``"json"``, what the shard says of them.

    Made by ``open_dataset``. A sample with several views has as many rows, one after the other: row = sample * views + view. Stored arrays are views of the
    shard's bytes in memory's map: nothing is copied until they are worked with. Those that the set stores ``as`` whole numbers come as what these stand for,
    float32 with NaN.

    Parameters
    ----------
    folder : path
        Where ``tofray dataset plan`` wrote.
    computed : bool or None
        Whether samples are computed when they are asked for; None: where the set is not merged.
    split : str or None
        ``train``, ``validation`` or ``test``: ``rows``, ``order`` and ``stream`` have these samples alone.

    Raises
    ------
    Error
        Where there is no plan, the set is another one than at the plan, or samples are to come out of shards that are not merged.
    ValueError
        For a split that is none.
    """

    def __init__(self, folder: str | os.PathLike[str], computed: bool | None = None, split: str | None = None) -> None:
        if split is not None and split not in _SPLITS:
            raise ValueError(f"split: got {split!r}, expected {', '.join(_SPLITS)} or None")
        self._split = split
        self._folder = pathlib.Path(folder)
        try:
            self._plan: dict[str, Any] = json.loads((self._folder / "plan.json").read_text(encoding="utf-8"))
        except OSError as error:
            raise IoError(f"{self._folder}: error: there is no plan in this folder\n  expected the folder of a `tofray dataset plan SET.yaml -o FOLDER`") from error
        self._as: dict[str, dict[str, Any]] = self._plan.get("as", {})
        merged = (self._folder / "SHA256SUMS").exists()
        if computed is False and not merged:
            raise BadInput(f"{self._folder}: error: its shards are not merged\n  expected `tofray dataset merge {self._folder}` before")
        self._computed = computed if computed is not None else not merged
        self._set: Dataset | None = None
        self._rows: NDArray[np.int64]
        self._maps: collections.OrderedDict[int, np.memmap[Any, np.dtype[np.uint8]]] = collections.OrderedDict()
        self._read_index()

    def _read_index(self) -> None:
        index = self._folder / "index"
        if self._computed:
            self._set = self._planned_set()
            samples, views = self._plan["samples"], self._plan["views"]
            there = range(samples) if self._split is None else [i for i in range(samples) if self._set.split(i) == self._split]
            self._rows = (np.asarray(there, np.int64)[:, None] * views + np.arange(views)).ravel()
            return
        self._members = json.loads((index / "index.json").read_text(encoding="utf-8"))["members"]
        self._shard, self._offset, self._bytes = (np.load(index / f"{name}.npy", mmap_mode="r") for name in ("shard", "offset", "bytes"))
        there = self._shard != _NO_SHARD
        if self._split is not None:
            there &= np.load(index / "split.npy", mmap_mode="r") == _SPLITS.index(self._split)
        self._rows = np.flatnonzero(there)

    def _planned_set(self) -> Dataset:
        from . import __version__

        file = self._folder / self._plan["folder"] / self._plan["set"]["file"]
        if not file.exists() or file.read_text(encoding="utf-8") != self._plan["set"]["text"]:
            raise BadInput(f"{file}: error: this is not the set of {self._folder / 'plan.json'}\n  expected the file that was planned, or shards that are merged")
        if self._plan["tofray"] != __version__:
            raise BadInput(f"{self._folder / 'plan.json'}: error: tofray {self._plan['tofray']} made it, this is {__version__}\n  expected the same version: "
                        "another one may compute other bytes")
        return Dataset(file)

    def __repr__(self) -> str:
        return f"<tofray.Samples of {self._folder}: {len(self)}, {'computed' if self._computed else 'stored'}>"

    def __getstate__(self) -> dict[str, Any]:
        return {"folder": self._folder, "computed": self._computed, "split": self._split}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__init__(state["folder"], state["computed"], state["split"])  # type: ignore[misc]

    def __len__(self) -> int:
        """How many rows there are, holes among them."""
        return int(self._plan["samples"] * self._plan["views"])

    @property
    def arrays(self) -> list[str]:
        """Names of the arrays that each sample has."""
        return list(self._plan["arrays"])

    @property
    def rows(self) -> NDArray[np.int64]:
        """Rows that are there, of the split that was asked for: all but holes and shards that are missing. Where samples are computed, holes are not known before."""
        return self._rows

    def __getitem__(self, row: int) -> dict[str, Any]:
        at = range(len(self))[row] if -len(self) <= row < len(self) else None
        if at is None:
            raise IndexError(f"row: got {row}, expected 0 to {len(self) - 1}")
        return self._compute(at) if self._computed else self._stored(at)

    def _compute(self, row: int) -> dict[str, Any]:
        assert self._set is not None
        sample, view = divmod(row, self._plan["views"])
        frame = self._set.frame(sample, view, arrays=self.arrays, threads=1)
        of_frame = frame.to_dict()
        arrays: dict[str, Any] = {name: of_frame[name] for name in self.arrays}
        for name, as_ in self._as.items():
            arrays[name] = _values(_codes(arrays[name], as_), as_)
        arrays["json"] = {"sample": sample, "view": view, "split": self._set.split(sample), "set": self._set.name, "seed": self._set.noise_seed(sample, view),
                          "scene": self._set.scene_yaml(sample, view)}
        return arrays

    def _map(self, shard: int) -> np.memmap[Any, np.dtype[np.uint8]]:
        if shard not in self._maps:
            if len(self._maps) >= _MOST_OPEN:
                self._maps.popitem(last=False)
            path = self._folder / "shards" / f"{shard // 1000:03}" / f"{shard:06}.tar"
            self._maps[shard] = np.memmap(path, np.uint8, "r")
        self._maps.move_to_end(shard)
        return self._maps[shard]

    def _stored(self, row: int) -> dict[str, Any]:
        if self._shard[row] == _NO_SHARD:
            raise LookupError(f"row: {row} is a hole, or its shard is not there; `rows` has those that are")
        data, out = self._map(int(self._shard[row])), {}
        for name, offset, size in zip(self._members, self._offset[row], self._bytes[row]):
            member = data[int(offset):int(offset + size)]
            if name == "json":
                out[name] = json.loads(bytes(member))
                continue
            header = io.BytesIO(bytes(member[:256]))
            npy: Any = np.lib.format
            assert npy.read_magic(header) == (1, 0)
            shape, _, dtype = npy.read_array_header_1_0(header)
            array, name = member[header.tell():].view(dtype).reshape(shape), name.removesuffix(".npy")
            out[name] = _values(array, self._as[name]) if name in self._as else array
        return out

    def order(self, seed: int = 0, epoch: int = 0) -> NDArray[np.int64]:
        """Each row that is there once, in random order: shard after shard, so that few are open at once.

        Parameters
        ----------
        seed : int
            Seed of the order.
        epoch : int
            Number of the epoch; each has another order.

        Returns
        -------
        int64 array [row], 1
            The same with every version of numpy.
        """
        rows = self._rows
        views, each = self._plan["views"], self._plan["shard_samples"]
        key = int(_mixed(np.array([seed % 2**64], np.uint64), epoch + 1)[0])
        by_shard = _mixed((rows // (views * each)).astype(np.uint64), key)
        by_row = _mixed(rows.astype(np.uint64), key + 1)
        ordered: NDArray[np.int64] = rows[np.lexsort((by_row, by_shard))]
        return ordered

    def stream(self, batch: int, *, rank: int = 0, world: int = 1, seed: int = 0, epoch: int = 0, start: int = 0) -> Iterator[dict[str, Any]]:
        """Batches of one epoch: of all ranks together each row once. (epoch, batches that were taken) is all the state there is.

        Parameters
        ----------
        batch : int
            Samples in each; the last one may have fewer.
        rank : int
            Which of the ``world`` processes this is, from 0 on.
        world : int
            How many share the epoch.
        seed : int
            As ``order`` takes it.
        epoch : int
            As ``order`` takes it.
        start : int
            Batches of this rank that were taken before: goes on behind them.

        Yields
        ------
        dict
            Of each array those of the batch, stacked, or a list where their shapes differ; ``"row"`` and ``"json"``, lists.

        Raises
        ------
        ValueError
            Where these numbers make no sense.
        """
        if batch < 1 or world < 1 or not 0 <= rank < world or start < 0:
            raise ValueError(f"batch: got {batch}, rank {rank} of {world}, start {start}; expected at least 1, a rank of 0 to world - 1, at least 0")
        mine = self.order(seed, epoch)[rank::world]
        for first in range(start * batch, len(mine), batch):
            rows = [int(row) for row in mine[first:first + batch]]
            samples = [self[row] for row in rows]
            out: dict[str, Any] = {"row": rows, "json": [sample["json"] for sample in samples]}
            for name in self.arrays:
                each = [sample[name] for sample in samples]
                out[name] = np.stack(each) if len({one.shape for one in each}) == 1 else each
            yield out


def open_dataset(folder: str | os.PathLike[str], computed: bool | None = None, split: str | None = None) -> Samples:
    """The samples of a data set: out of its shards, or computed when they are asked for. Both have the same bytes.

    Parameters
    ----------
    folder : path
        Where ``tofray dataset plan`` wrote plan.json, with or without shards.
    computed : bool or None
        Whether samples are computed; None: where the set is not merged.
    split : str or None
        ``train``, ``validation`` or ``test``: ``rows``, ``order`` and ``stream`` have these samples alone; None: all.

    Returns
    -------
    Samples

    Raises
    ------
    Error
        Where there is no plan, the set is another one than at the plan, or samples are to come out of shards that are not merged.
    ValueError
        For a split that is none.
    """
    return Samples(folder, computed, split)
