# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A frame: raw data, depth and ground truth."""

from __future__ import annotations

import copy
import os
from typing import TYPE_CHECKING, Any, Sequence

from . import _native
from ._arrays import Depth, Raw, Truth
from ._errors import BadInput, IoError, LimitError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._model import Camera, Scene
    from ._view import Page

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
        The arrays. Index and parts of a simulated frame are its own and cannot be exchanged; those of other frames can.
    scene, camera : Scene, Camera or None
        What was simulated, as this frame's own copies; None where the frame came from a file.
    meta : dict
        Of a frame out of a file: what ``frame.npz`` says of it.
    """

    __slots__ = ("_camera", "_depth", "_index", "_memory", "_options", "_raw", "_request", "_scene", "_shared", "_truth", "meta")

    def __init__(self, *, index: int = 0, raw: Raw | None = None, depth: Depth | None = None, truth: Truth | None = None,
                 scene: Scene | None = None, camera: Camera | None = None, meta: dict[str, Any] | None = None) -> None:
        self._index = index
        self._raw = Raw() if raw is None else raw
        self._depth = Depth() if depth is None else depth
        self._truth = Truth() if truth is None else truth
        self._scene, self._camera, self._shared = scene, camera, False
        self._request: Any = None
        self.meta: dict[str, Any] = {} if meta is None else meta
        self._memory: Any = None
        self._options: dict[str, Any] = {}

    @classmethod
    def _of(cls, memory: _native.FrameMemory, scene: Scene | None, camera: Camera | None, options: dict[str, Any],
            request: Any = None) -> Frame:
        self = cls.__new__(cls)
        sizes = memory.sizes()
        self._index = memory.index
        self._raw, self._depth, self._truth = (part._of(memory, sizes) for part in (Raw, Depth, Truth))
        # The simulator's own, which nobody changes: copied when they are first asked for.
        self._scene, self._camera, self._shared, self._request = scene, camera, True, request
        self.meta = {}
        self._memory, self._options = memory, options
        return self

    def _own(self) -> None:
        if self._shared:
            if self._request is None or self._scene is None:
                self._scene = copy.deepcopy(self._scene)
            else:
                self._scene = _native.placed_scene(self._scene, self._camera, self._request)
            self._camera, self._shared = copy.deepcopy(self._camera), False

    @property
    def scene(self) -> Scene | None:
        """What was simulated."""
        self._own()
        return self._scene

    @scene.setter
    def scene(self, scene: Scene | None) -> None:
        self._own()
        self._scene = scene

    @property
    def camera(self) -> Camera | None:
        """What saw it."""
        self._own()
        return self._camera

    @camera.setter
    def camera(self, camera: Camera | None) -> None:
        self._own()
        self._camera = camera

    def _exchange(self, name: str, value: Any) -> None:
        if self._memory is not None:
            raise AttributeError(f"frame.{name} is what was simulated\n"
                                 "  expected values written into its arrays, or a tofray.Frame(raw=…, depth=…, truth=…) of one's own")
        setattr(self, "_" + name, value)

    @property
    def index(self) -> int:
        """Number of the frame."""
        return self._index

    @index.setter
    def index(self, index: int) -> None:
        self._exchange("index", index)

    @property
    def raw(self) -> Raw:
        """What the sensor hands out."""
        return self._raw

    @raw.setter
    def raw(self, raw: Raw) -> None:
        self._exchange("raw", raw)

    @property
    def depth(self) -> Depth:
        """The depth frame."""
        return self._depth

    @depth.setter
    def depth(self, depth: Depth) -> None:
        self._exchange("depth", depth)

    @property
    def truth(self) -> Truth:
        """Ground truth."""
        return self._truth

    @truth.setter
    def truth(self, truth: Truth) -> None:
        self._exchange("truth", truth)

    def to_dict(self) -> dict[str, NDArray[Any]]:
        """All arrays under their names in files: ``z_m``, ``tap_a``, ``gt_range_m``.

        Returns
        -------
        dict of arrays
            Views, not copies; units and shapes are those of ``raw``, ``depth`` and ``truth``.
        """
        return {part._rows[name][0]: part[name] for part in (self.raw, self.depth, self.truth) for name in part.names}

    def points(self, valid_only: bool = True) -> NDArray[np.float32]:
        """Surface points in the camera's frame, in metres.

        Parameters
        ----------
        valid_only : bool
            Leave out pixels without a valid depth.

        Returns
        -------
        float32 array [n, 3], m
            x right, y down, z forward.

        Raises
        ------
        AttributeError
            Where the frame has no depth.
        """
        points: NDArray[np.float32] = self.depth.points_m.reshape(-1, 3)
        if not valid_only:
            return points
        valid = (self.depth.flags.reshape(-1) & _native.flags()["invalid"]) == 0
        kept: NDArray[np.float32] = points[valid]
        return kept

    def preview(self, theme: str = "dark", *, scale: int = 1, what: str = "preview") -> bytes:
        """The picture that the command line writes as ``preview.png``: z, amplitude and error, each on its scale.

        Parameters
        ----------
        theme : {"dark", "light"}
            Light writing on a dark ground, or dark on white.
        scale : int
            1 to 8: times as many pixels along either side, letters drawn as finely. 2 is for slides.
        what : {"preview", "raw"}
            "raw": the raw frames, as ``raw.png``.

        Returns
        -------
        bytes
            A PNG file.

        Raises
        ------
        Error
            Where the frame lacks an array of it, by name; for another word or scale.
        """
        return self._picture(what, theme, scale, ".png")

    def save_preview(self, file: str | os.PathLike[str], theme: str = "dark", *, scale: int = 1, what: str = "preview") -> str:
        """Writes the picture of ``preview()`` into a file, which becomes what its name ends in: PNG, SVG or PDF.

        In SVG and PDF letters, scale bars and legend are vectors, and the images are within as pixels of the sensor.

        Parameters
        ----------
        file : path
            ``"slide.svg"``, ``"paper.pdf"``, ``"preview.png"``. A file of this name is replaced.
        theme, scale, what
            As of ``preview``; an SVG or PDF is ``scale`` times as large.

        Returns
        -------
        str
            The file.

        Raises
        ------
        Error
            As ``preview``; for another ending; of kind "io" where the file cannot be written.
        """
        name = os.fspath(file)
        picture = self._picture(what, theme, scale, name)
        try:
            return _write(name, picture)
        except OSError as fault:
            raise IoError(f"{name}: error: {fault.strerror}") from fault

    def _picture(self, what: str, theme: str, scale: int, file: str) -> bytes:
        if what not in ("preview", "raw"):
            raise BadInput(f"what: error: got {what!r}\n  expected preview or raw")
        picture = _native.picture(self, what, self._caption(), theme, scale, file, True)
        assert picture is not None
        return picture

    def _own_options(self) -> dict[str, Any]:
        """Of a frame out of a file: what the file says."""
        return self._options or {name: self.meta[name] for name in ("seed", "noise", "exposure_samples", "subpixel") if name in self.meta}

    def save(self, folder: str | os.PathLike[str], *, compress: bool = False, theme: str = "dark", scale: int = 1) -> list[str]:
        """Writes ``frame.npz``, and the pictures that it has the arrays for, into a folder, which is made if need be.

        ``frame.npz`` has the same bytes as the command line's for the same scene, camera, options and seed. That of a frame out of a
        file says the seed, noise and samples that the file said.

        Parameters
        ----------
        folder : path
            Files of the same names in it are replaced.
        compress : bool
            Smaller and slower: deflated arrays.
        theme, scale
            Of ``preview.png`` and ``raw.png``, as of ``preview``.

        Returns
        -------
        list of str
            The files.

        Raises
        ------
        Error
            Of kind "bad_input" where the frame does not know its scene and camera, or its arrays do not fit together; of kind "io" where
            the folder cannot be written to.
        """
        if self._scene is None or self._camera is None:
            raise BadInput("frame.save: error: the frame does not know its scene and camera\n"
                           "  expected a simulated frame, or frame.scene = … and frame.camera = …")
        if self._request is not None:
            self._own()
        files = {"frame.npz": _native.frame_npz(self, self._scene, self._camera, self._own_options(), compress)}
        for what in ("preview", "depth", "amplitude", "raw"):
            picture = _native.picture(self, what, self._caption(), theme, scale, ".png", False)
            if picture is not None:
                files[what + ".png"] = picture
        try:
            os.makedirs(folder, exist_ok=True)
            return [_write(os.path.join(os.fspath(folder), name), data) for name, data in files.items()]
        except OSError as fault:
            raise IoError(f"{os.fspath(folder)}: error: {fault.strerror}") from fault

    def explore(self, *, arrays: Sequence[str] = (), height: int = 720) -> Page:
        """The frame as a page with panes, read-out and points in space, which needs no server; ``tofray.explore`` takes several.

        Parameters
        ----------
        arrays, height
            As of ``tofray.explore``.

        Returns
        -------
        Page
            A notebook shows it in place; ``save(file)`` writes it.

        Raises
        ------
        Error
            As ``tofray.explore``.
        """
        from ._view import explore

        return explore(self, arrays=arrays, height=height)

    def plot(self, what: str = "z") -> Any:
        """A figure of matplotlib's, where that is installed.

        Parameters
        ----------
        what : {"z", "amplitude", "error", "raw", "cloud"}
            Depth along the axis, amplitude, depth minus truth, all raw frames, or points in space.

        Returns
        -------
        matplotlib.figure.Figure
            Not shown by itself: a notebook does, and ``figure.savefig("z.png")`` writes it.

        Raises
        ------
        Error
            For another word.
        AttributeError
            Where the frame lacks the array.
        ImportError
            Without matplotlib.
        """
        from ._plot import plot

        return plot(self, what)

    def to_open3d(self) -> Any:
        """The valid points as a cloud of Open3D's, where that is installed.

        Returns
        -------
        open3d.geometry.PointCloud
            Metres: x right, y down, z forward.

        Raises
        ------
        ImportError
            Without Open3D.
        """
        import importlib

        try:
            open3d = importlib.import_module("open3d")
        except ImportError as fault:
            raise ImportError("to_open3d() needs the package open3d; points() needs none") from fault
        cloud = open3d.geometry.PointCloud()
        cloud.points = open3d.utility.Vector3dVector(self.points().astype("float64"))
        return cloud

    def _caption(self) -> str:
        if self._scene is None or self._camera is None:
            return ""
        text = f"{self._scene.name} seen by {self._camera.name}"
        if self._camera.mode.name:
            text += " " + self._camera.mode.name
        return text + (f", frame {self.index}" if self.index else "")

    def _repr_png_(self) -> bytes | None:
        try:
            return _native.picture(self, "preview", self._caption(), "dark", 1, ".png", False)
        except BadInput:  # arrays that do not fit together: a notebook shows the rest
            return None

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

    Raises
    ------
    Error
        Of kind "io" for a file that cannot be read, of kind "bad_input" for one that is no npz file, or whose arrays are not those of the
        table, by their names.
    """
    import numpy as np

    name = os.fspath(file)
    try:
        with np.load(file, allow_pickle=False) as archive:
            arrays = {one: archive[one] for one in archive.files}
    except FileNotFoundError as fault:
        raise IoError(f"{name}: error: there is no such file{_others_beside(name)}") from fault
    except OSError as fault:
        raise IoError(f"{name}: error: cannot be read: {fault}") from fault
    except MemoryError as fault:
        raise LimitError(f"{name}: error: its arrays do not fit into memory: {fault}") from fault
    except Exception as fault:  # numpy and zipfile do not say which ones they raise of a broken file
        raise BadInput(f"{name}: error: is no npz file: {fault}") from fault
    parts: dict[str, dict[str, Any]] = {"raw": {}, "depth": {}, "truth": {}}
    extents: dict[str, int] = {}
    for part, kind in PARTS.items():
        for member, (stored, dtype, shape, *_) in kind._rows.items():
            if stored in arrays:
                parts[part][member] = _as_told(f"{name}: {stored}", arrays[stored], dtype, shape, extents)
    meta = _meta_of(name, arrays.get("meta", "{}"))
    time_s = _as_told(f"{name}: gt_time_s", arrays["gt_time_s"], "float64", "[]", extents) if "gt_time_s" in arrays else 0.0
    raw, depth, truth = Raw(**parts["raw"]), Depth(**parts["depth"]), Truth(time_s=float(time_s), **parts["truth"])
    return Frame(index=meta.get("frame", 0), raw=raw, depth=depth, truth=truth, meta=meta)


def _others_beside(name: str) -> str:
    """A line on the npz files that are there; nothing where the folder is not."""
    folder = os.path.dirname(name) or "."
    try:
        found = sorted(one for one in os.listdir(folder) if one.endswith(".npz"))
    except OSError:
        return ""
    shown = found if len(found) < 3 else [found[0], "…", f"{found[-1]} ({len(found)} files)"]
    return f"\n  the folder {folder!r} holds {' '.join(shown) or 'no .npz file'}"


def _as_told(where: str, array: Any, dtype: str, shape: str, extents: dict[str, int]) -> Any:
    """An array of a file as the table says it is: digits are not lost, and all arrays have the same sizes."""
    import numpy as np

    wanted = [letter for letter in shape.strip("[]").split(", ") if letter]
    # `lit` is bool in files
    if not isinstance(array, np.ndarray) or not np.can_cast(array.dtype, dtype, "safe"):
        raise BadInput(f"{where}: error: is of {getattr(array, 'dtype', type(array).__name__)}\n  expected {dtype}")
    known = [int(letter) if letter.isdigit() else extents.get(letter, size) for letter, size in zip(wanted, array.shape)]
    if array.ndim != len(wanted) or list(array.shape) != known:
        sizes = ", ".join(f"{letter} {size}" for letter, size in extents.items())
        raise BadInput(f"{where}: error: has the shape {array.shape}\n  expected {shape}"
                       + (f", as other arrays have {sizes}" if sizes else ""))
    extents.update(zip(wanted, array.shape))
    return np.ascontiguousarray(array).astype(dtype, copy=False).reshape(array.shape)


def _meta_of(file: str, text: Any) -> dict[str, Any]:
    import json

    try:
        meta = json.loads(str(text))
    except (ValueError, RecursionError) as fault:
        raise BadInput(f"{file}: meta: error: is no JSON: {fault}") from fault
    if not isinstance(meta, dict):
        raise BadInput(f"{file}: meta: error: is a {type(meta).__name__}\n  expected an object of JSON")
    index = meta.get("frame", 0)
    if not isinstance(index, int) or isinstance(index, bool) or not 0 <= index < 2**64:
        raise BadInput(f"{file}: meta.frame: error: got {index!r}\n  expected a whole number from 0 to 2**64 - 1")
    return meta
