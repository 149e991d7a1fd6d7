# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings of walls that stand still: the range noise of the pixels about the optical axis, over the frames."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ._errors import BadInput
from ._frame import load
from ._load import load_camera
from ._simulator import process

if TYPE_CHECKING:
    from ._model import Camera

_SIDE = 11  # pixels of the part of the image that counts


def _files(path: str, place: str) -> list[str]:
    if not os.path.isdir(path):
        return [path]
    files = [os.path.join(path, name) for name in sorted(os.listdir(path)) if name.endswith(".npz")]
    if not files:
        raise BadInput(f"{place}: error: there is no npz file in the folder {path}\n"
                       "  expected frames of a wall, as `tofray render -o` writes them")
    return files


def _range_of(file: str, camera: Camera) -> Any:
    """By the pixels' raw frames where they are there, without filters: that is what a budget is of."""
    frame = load(file)
    if frame.raw.get("raw") is not None or frame.raw.get("tap_a") is not None:
        return process(frame.raw, camera).range_m
    return frame.depth.range_m


def sigma_of(path: str, place: str, profile: str, mode: str, words: dict[str, str]) -> float:
    """√(mean variance over the frames) of the pixels about the optical axis, divisor n - 1, in metres.

    Raises
    ------
    Error
        For fewer than two frames, and where half of the pixels have no range.
    """
    import numpy as np

    camera = load_camera(profile, mode, set={**words, "decoding.filter": "{kind: none}"})
    stack = np.stack([_range_of(file, camera) for file in _files(path, place)]).astype(float)
    if len(stack) < 2:
        raise BadInput(f"{place}: error: the recording {path} is one frame\n"
                       "  expected a folder with several of a wall that stands still: noise is over them")
    u, v = round(camera.lens.cx_px), round(camera.lens.cy_px)
    height, width = stack.shape[1:]
    half = _SIDE // 2
    u, v = min(max(u, 0), width - 1), min(max(v, 0), height - 1)
    part = stack[:, max(0, v - half) : v + half + 1, max(0, u - half) : u + half + 1]
    part = part.reshape(len(stack), -1)
    part = part[:, np.isfinite(part).all(axis=0)]
    if part.shape[1] < 0.5 * min(_SIDE, height) * min(_SIDE, width):
        raise BadInput(f"{place}: error: most pixels of the recording {path} have no range on the optical axis\n"
                       "  expected a wall there, neither too dark nor too bright")
    return float(np.sqrt(part.var(axis=0, ddof=1).mean()))


def add_recordings(rows: list[dict[str, Any]], profile: str, mode: str, words: dict[str, str]) -> None:
    """Gives the rows that name a recording the noise that is in it."""
    for row in rows:
        name = row.get("recording", "")
        if name and not row.get("sigma_m", float("nan")) > 0:
            place = f"{row['file']}:{row['line']}"
            row["sigma_m"] = sigma_of(os.path.join(os.path.dirname(row["file"]), name), place, profile, row.get("mode", "") or mode, words)
