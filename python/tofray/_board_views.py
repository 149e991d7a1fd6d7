# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Images of a chessboard: read, and the board's corners in each."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from ._corners import corners_of, opencv
from ._errors import BadInput, IoError
from ._frame import Frame, load

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ._model import Camera


class View:
    """One image of the board: its name and the corners [rows·columns, 2] in pixels."""

    def __init__(self, name: str, corners: Any) -> None:
        self.name = name
        self.corners = corners


def _amplitude(frame: Frame, place: str) -> Any:
    import numpy as np

    amplitude = frame.depth.get("amplitude_e")
    if amplitude is None:
        raise BadInput(f"{place}: error: there are no amplitudes in it\n  expected amplitude_e, as `tofray render` and `tofray process` write it")
    return np.asarray(amplitude, float)


def _read(path: str) -> Any:
    import numpy as np

    if path.endswith(".npz"):
        return _amplitude(load(path), path)
    if not os.path.isfile(path):
        raise IoError(f"{path}: error: there is no such file")
    picture = opencv().imread(path, opencv().IMREAD_UNCHANGED)
    if picture is None:
        raise BadInput(f"{path}: error: this is no image\n  expected a frame (.npz) or a grey picture (.png)")
    if picture.ndim != 2:
        raise BadInput(f"{path}: error: this picture has colours\n  expected a grey one, of 8 or 16 bits")
    return np.asarray(picture, float)


def _folder(path: str) -> Any:
    import numpy as np

    try:
        names = sorted(os.listdir(path))
    except OSError as fault:
        raise IoError(f"{path}: error: it cannot be read\n  {fault.strerror}") from None
    frames = [one for one in names if one.endswith(".npz")]  # `render` puts pictures for the eye beside them
    files = [os.path.join(path, one) for one in frames or names if one.endswith((".npz", ".png"))]
    if not files:
        raise BadInput(f"{path}: error: there is no npz and no png file in this folder\n  expected frames of one view of the board")
    images = [_read(one) for one in files]
    for image, file in zip(images, files):
        if image.shape != images[0].shape:
            raise BadInput(f"{file}: error: the image is of another size than that of {os.path.basename(files[0])}\n  got {_size(image)}, the other has {_size(images[0])}")
    return np.mean(images, axis=0)


def _size(image: Any) -> str:
    return f"{image.shape[1]} x {image.shape[0]} pixels" if image.ndim == 2 else f"an array with {image.ndim} axes"


def _image(given: Any, number: int) -> tuple[str, Any]:
    import numpy as np

    if isinstance(given, Frame):
        return f"image {number}", _amplitude(given, f"image {number}")
    if isinstance(given, (str, os.PathLike)):
        path = os.fspath(given)
        return path, _folder(path) if os.path.isdir(path) else _read(path)
    return f"image {number}", np.asarray(given, float)


def views_of(images: Iterable[Any], camera: Camera, board: tuple[int, int]) -> list[View]:
    """Finds the board in every image, and refuses an image that it is not in."""
    expected = (int(camera.sensor.height), int(camera.sensor.width))
    out, read = [], [_image(given, number) for number, given in enumerate(images)]
    for name, image in read:
        if image.shape != expected:
            raise BadInput(f"{name}: error: the image is not of the camera's sensor\n  got {_size(image)}, expected {expected[1]} x {expected[0]}, neither binned nor a part")
    for name, image in read:
        corners = corners_of(image, *board)
        if corners is None:
            raise BadInput(f"{name}: error: no board of {board[0]} x {board[1]} inner corners is found in it\n"
                           f"  expected all {board[0] + 1} x {board[1] + 1} squares within the image, 5 pixels or more each, with a white rim")
        out.append(View(name, corners))
    return out
