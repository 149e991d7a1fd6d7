# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A frame: raw data, depth and ground truth."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from . import _native
from ._arrays import Depth, Raw, Truth
from ._errors import BadInput, IoError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._model import Camera, Scene

PARTS = {"raw": Raw, "depth": Depth, "truth": Truth}


class Frame:
    """What a simulated camera delivers.

    Its arrays are numpy views of its memory, without a copy; each keeps the memory alive. They have ``__dlpack__`` as
    all of numpy's: ``torch.from_dlpack(frame.depth.z_m)`` shares it, too.

    Attributes
    ----------
    index : int
        Number of the frame; it starts at index / frame_rate.
    raw, depth, truth : Raw, Depth, Truth
        The arrays.
    scene, camera : Scene, Camera or None
        What was simulated; None where the frame came from a file.
    meta : dict
        Of a frame out of a file: what ``frame.npz`` says of it.
    """

    __slots__ = ("_memory", "_options", "camera", "depth", "index", "meta", "raw", "scene", "truth")

    def __init__(self, *, index: int = 0, raw: Raw | None = None, depth: Depth | None = None, truth: Truth | None = None,
                 scene: Scene | None = None, camera: Camera | None = None, meta: dict[str, Any] | None = None) -> None:
        self.index = index
        self.raw = Raw() if raw is None else raw
        self.depth = Depth() if depth is None else depth
        self.truth = Truth() if truth is None else truth
        self.scene = scene
        self.camera = camera
        self.meta: dict[str, Any] = {} if meta is None else meta
        self._memory: Any = None
        self._options: dict[str, Any] = {}

    @classmethod
    def _of(cls, memory: _native.FrameMemory, scene: Scene | None, camera: Camera | None, options: dict[str, Any]) -> Frame:
        self = cls.__new__(cls)
        sizes = memory.sizes()
        self.index = memory.index
        self.raw, self.depth, self.truth = (part._of(memory, sizes) for part in (Raw, Depth, Truth))
        self.scene, self.camera, self.meta = scene, camera, {}
        self._memory, self._options = memory, options
        return self

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """All arrays under their names in files: ``z_m``, ``tap_a``, ``gt_range_m``. Views, not copies."""
        return {part._rows[name][0]: part[name] for part in (self.raw, self.depth, self.truth) for name in part.names}

    def points(self, valid_only: bool = True) -> NDArray[np.float32]:
        """Surface points in the camera's frame, in metres.

        Parameters
        ----------
        valid_only : bool
            Leave out pixels without a valid depth.

        Returns
        -------
        float32 array [n, 3]
            x right, y down, z forward.
        """
        points: NDArray[np.float32] = self.depth.points_m.reshape(-1, 3)
        if not valid_only:
            return points
        valid = (self.depth.flags.reshape(-1) & _native.flags()["invalid"]) == 0
        kept: NDArray[np.float32] = points[valid]
        return kept

    def preview(self, theme: str = "dark") -> bytes:
        """The picture that the command line writes as ``preview.png``: z, amplitude and error, each on its scale.

        Parameters
        ----------
        theme : {"dark", "light"}
            Light writing on a dark ground, or dark on white.
        """
        return _native.picture(self, "preview", self._caption(), theme)

    def save(self, folder: str | os.PathLike[str], *, compress: bool = False) -> list[str]:
        """Writes ``frame.npz`` and the pictures into a folder, which is made if need be.

        ``frame.npz`` has the same bytes as the command line's for the same scene, camera, options and seed.

        Returns
        -------
        list of str
            The files.
        """
        if self.scene is None or self.camera is None:
            raise BadInput("frame.save: error: the frame does not know its scene and camera\n"
                           "  expected a simulated frame, or frame.scene = … and frame.camera = …")
        files = {"frame.npz": _native.frame_npz(self, self.scene, self.camera, self._options, compress)}
        if "z_m" in self.depth:
            for what in ("preview", "depth", "amplitude"):
                files[what + ".png"] = _native.picture(self, what, self._caption(), "dark")
        if "raw" in self.raw or "tap_a" in self.raw:
            files["raw.png"] = _native.picture(self, "raw", "", "dark")
        try:
            os.makedirs(folder, exist_ok=True)
            return [_write(os.path.join(os.fspath(folder), name), data) for name, data in files.items()]
        except OSError as fault:
            raise IoError(f"{os.fspath(folder)}: error: {fault.strerror}") from fault

    def plot(self, what: str = "z") -> Any:
        """A figure of matplotlib's, where that is installed.

        Parameters
        ----------
        what : {"z", "amplitude", "error", "raw", "cloud"}
            Depth along the axis, amplitude, depth minus truth, all raw frames, or points in space.

        Returns
        -------
        matplotlib.figure.Figure
        """
        from ._plot import plot

        return plot(self, what)

    def to_open3d(self) -> Any:
        """The valid points as a cloud of Open3D's, where that is installed."""
        import importlib

        try:
            open3d = importlib.import_module("open3d")
        except ImportError as fault:
            raise ImportError("to_open3d() needs the package open3d; points() needs none") from fault
        cloud = open3d.geometry.PointCloud()
        cloud.points = open3d.utility.Vector3dVector(self.points().astype("float64"))
        return cloud

    def _caption(self) -> str:
        if self.scene is None or self.camera is None:
            return ""
        text = f"{self.scene.name} seen by {self.camera.name}"
        if self.camera.mode.name:
            text += " " + self.camera.mode.name
        return text + (f", frame {self.index}" if self.index else "")

    def _repr_png_(self) -> bytes | None:
        return self.preview() if "z_m" in self.depth else None

    def _repr_html_(self) -> str:
        from ._html import frame_html

        return frame_html(self)

    def __repr__(self) -> str:
        width, height = self.raw.width or self.depth.width, self.raw.height or self.depth.height
        return f"<tofray.Frame {self.index}: {self.raw.phases} raw frames of {width} x {height}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _frame_of, (self.index, self.raw, self.depth, self.truth, self.scene, self.camera, self.meta, self._options)

    def __dir__(self) -> list[str]:
        return [name for name in super().__dir__() if not name.startswith("_")]


def _frame_of(index: int, raw: Raw, depth: Depth, truth: Truth, scene: Any, camera: Any, meta: dict[str, Any],
              options: dict[str, Any]) -> Frame:
    frame = Frame(index=index, raw=raw, depth=depth, truth=truth, scene=scene, camera=camera, meta=meta)
    frame._options = options
    return frame


def _write(path: str, data: bytes) -> str:
    """Whole or not at all: another name first."""
    temporary = f"{path}.{os.getpid()}.tmp"
    with open(temporary, "wb") as file:
        file.write(data)
    os.replace(temporary, path)
    return path


def load(file: str | os.PathLike[str]) -> Frame:
    """Reads a ``frame.npz``, of the command line or of ``Frame.save``.

    Parameters
    ----------
    file : path
        A file of numpy's with any of the arrays that ``tofray list arrays`` names.

    Returns
    -------
    Frame
        Its ``meta`` is the file's; arrays that are not there raise AttributeError.
    """
    import json
    import zipfile

    import numpy as np

    try:
        with np.load(file, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
    except (OSError, FileNotFoundError) as fault:
        raise IoError(f"{os.fspath(file)}: error: cannot be read: {fault}") from fault
    except (ValueError, zipfile.BadZipFile, EOFError, AttributeError, TypeError) as fault:
        raise BadInput(f"{os.fspath(file)}: error: is no npz file: {fault}") from fault
    parts: dict[str, dict[str, Any]] = {"raw": {}, "depth": {}, "truth": {}}
    for part, kind in PARTS.items():
        for member, (name, dtype, *_) in kind._rows.items():
            if name in arrays:
                # `lit` is bool in files
                parts[part][member] = np.ascontiguousarray(arrays[name]).astype(dtype, copy=False)
    meta = json.loads(str(arrays["meta"])) if "meta" in arrays else {}
    time_s = float(arrays["gt_time_s"]) if "gt_time_s" in arrays else 0.0
    raw, depth, truth = Raw(**parts["raw"]), Depth(**parts["depth"]), Truth(time_s=time_s, **parts["truth"])
    return Frame(index=int(meta.get("frame", 0)), raw=raw, depth=depth, truth=truth, meta=meta)
