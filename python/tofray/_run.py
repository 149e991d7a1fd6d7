# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Runs into folders, as `tofray render` makes them, and single pixels of a frame."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any, Callable, Mapping, Sequence

from . import _native
from ._errors import BadInput
from ._film import film_words
from ._load import _chosen, _in_words_of_python, _Text
from ._model import Inputs, PixelBounces, PixelChain, RunResult, Validity

if TYPE_CHECKING:
    from typing import Literal

    from ._frame import Frame
    from ._model import Camera


def _typed(scene: str | os.PathLike[str]) -> str:
    """What was said for a scene's file or name."""
    if not isinstance(scene, (str, os.PathLike)):
        raise TypeError(f"scene: got {type(scene).__name__}, expected a scene's file or name\n"
                        "  a Scene of one's own: Simulator(scene).frame(0).save(folder)")
    return os.fspath(scene)


def _settings(changes: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    return [(key, value if isinstance(value, str) else _Text().text_of(value, key)) for key, value in dict(changes or {}).items()]


def load_inputs(scene: str | os.PathLike[str], *, set: Mapping[str, Any] | None = None, mode: str = "",
                root: str | os.PathLike[str] = "") -> Inputs:
    """Reads a scene, or a mesh alone, and the camera that it asks for, with what is changed of them.

    Parameters
    ----------
    scene : path or name
        As of ``load_scene``; also a mesh's file (.obj, .ply, .stl, .gltf, .glb), which stands before the camera then.
    set : mapping
        Dotted keys and their values as written in YAML: ``{"camera.lens.f_number": 1.2, "objects.0.sphere.radius": "30 cm"}``.
    mode : str
        One of the camera's modes; empty: the one that the scene names, or the camera's first.
    root : path
        Files that the scene names have to lie in or below its own folder, or this one.

    Returns
    -------
    Inputs
        ``scene`` and ``camera`` for a ``Simulator``; ``remarks`` says what is odd about them and can be simulated all the same.

    Raises
    ------
    Error
        With every fault of a file at once, by line and column.
    """
    words = {"scene": _chosen(_native.choose_scene(_typed(scene))), "set": _settings(set), "mode": mode, "root": os.fspath(root)}
    out: Inputs = _in_words_of_python(lambda: _native.load_inputs(words))
    return out


def render(
    scene: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    set: Mapping[str, Any] | None = None,
    mode: str = "",
    root: str | os.PathLike[str] = "",
    frames: int | None = None,
    first_frame: int = 0,
    seed: int = 0,
    noise: Literal["off", "exact"] = "exact",
    exposure_samples: int = 1,
    subpixel: int = 1,
    threads: int = 0,
    backend: Literal["automatic", "cpu", "cuda"] = "automatic",
    device: int = -1,
    emit: Sequence[str] | None = None,
    arrays: Sequence[str] = (),
    compress: bool = False,
    theme: Literal["dark", "light"] = "dark",
    scale: int = 1,
    mcap: Mapping[str, Any] | None = None,
    clean: bool = False,
    each: Callable[[int], object] | None = None,
) -> RunResult:
    """Simulates frames of a scene into a folder, as ``tofray render`` does: the same bytes.

    Frames are written while the next ones are computed. Ctrl-C ends the run with the last whole frame, which ``manifest.json`` lists.

    Parameters
    ----------
    scene : path or name
        As of ``load_inputs``.
    folder : path
        Made if need be; files of the same names in it are replaced, each is complete or absent.
    set, mode, root
        As of ``load_inputs``.
    frames : int, optional
        So many, from ``first_frame`` on. None: one, whose files have no number in their names.
    first_frame : int
        The first one's number.
    seed, noise, exposure_samples, subpixel, threads, backend, device
        As of ``Simulator``.
    emit : sequence of str, optional
        Out of "npz", "png", "ply", and "mcap": all frames in run.mcap, for ROS 2. None: the first three for one frame, npz for several.
    arrays : sequence of str
        Of frame.npz, by name or group (``tofray list arrays``). Left empty: all.
    compress : bool
        Smaller and slower npz files.
    theme : {"dark", "light"}
        Of preview.png and raw.png.
    scale : int
        1 to 8: times as many pixels along either side of these.
    mcap : mapping, optional
        Words of ``McapWriter`` for run.mcap: ``{"driver": "pico_flexx", "topics": ["depth", "points"]}``.
    clean : bool
        Remove what an earlier run left in the folder.
    each : callable, optional
        Called with the number of complete frames after each.

    Returns
    -------
    RunResult

    Raises
    ------
    Error
        As ``load_inputs`` and ``Simulator``; of kind "io" where the folder cannot be written.
    """
    if theme not in ("dark", "light"):
        raise BadInput(f"theme: error: got {theme!r}\n  expected dark or light")
    words = {"scene": _chosen(_native.choose_scene(_typed(scene))), "set": _settings(set), "mode": mode, "root": os.fspath(root),
             "frames": frames, "first_frame": first_frame, "emit": None if emit is None else list(emit), "arrays": ",".join(arrays),
             "compress": compress, "light_theme": theme == "light", "scale": scale, "mcap": film_words(mcap or {}), "folder": os.fspath(folder), "clean": clean,
             "command": [os.path.basename(one) for one in sys.argv[:1]]}
    options = {"seed": seed, "noise": noise, "exposure_samples": exposure_samples, "subpixel": subpixel, "threads": threads,
               "backend": backend, "device": device}
    out: RunResult = _in_words_of_python(lambda: _native.render(words, options, each))
    return out


def render_again(manifest: str | os.PathLike[str], folder: str | os.PathLike[str], *, root: str | os.PathLike[str] = "", threads: int = 0,
                 backend: Literal["automatic", "cpu", "cuda"] = "automatic", device: int = -1, clean: bool = False,
                 each: Callable[[int], object] | None = None) -> RunResult:
    """Makes the files of a run again out of its ``manifest.json``, which holds all that went into it.

    Parameters
    ----------
    manifest : path
        Of an earlier run. The scene's and the camera's texts are in it; meshes have to be there, unchanged.
    folder, root, threads, backend, device, clean, each
        As of ``render``.

    Returns
    -------
    RunResult
        ``files`` have the SHA-256 that the manifest lists, but for the letters in pictures where another machine has other fonts.

    Raises
    ------
    Error
        As ``render``; where the manifest cannot be read, or is of a newer tofray.
    """
    words = {"manifest": os.fspath(manifest), "root": os.fspath(root), "folder": os.fspath(folder), "clean": clean,
             "command": [os.path.basename(one) for one in sys.argv[:1]]}
    out: RunResult = _native.render(words, {"threads": threads, "backend": backend, "device": device}, each)
    return out


def pixel_chain(frame: Frame, u: int, v: int, camera: Camera | None = None) -> PixelChain:
    """One pixel's way from light to depth, number by number, as ``tofray inspect --pixel`` shows it.

    Parameters
    ----------
    frame : Frame
        What it lacks is NaN.
    u, v : int
        Column and row.
    camera : Camera, optional
        That made the frame; None: the frame's own. Without one phases are estimated without calibration, and nothing is unwrapped.

    Returns
    -------
    PixelChain

    Raises
    ------
    Error
        Where the pixel is outside the image, or the camera is of another size or sequence.
    """
    out: PixelChain = _native.pixel_chain(frame, frame.camera if camera is None else camera, frame._own_options().get("noise") == "off", u, v)
    return out


def pixel_bounces(frame: Frame, u: int, v: int) -> PixelBounces:
    """One pixel's light, bounce by bounce.

    Simulates the frame with one bounce, two, … until less than 1/1000 of the pixel's light is left.

    Parameters
    ----------
    frame : Frame
        Of a Simulator, whose scene has ``transport.bounces``.
    u, v : int
        Column and row.

    Returns
    -------
    PixelBounces
        Direct light first; empty where no light bounced.

    Raises
    ------
    Error
        Where the pixel is outside the image, and for a frame whose scene or camera is not known.
    """
    if frame.scene is None or frame.camera is None:
        raise BadInput("error: the frame's scene and camera are not known\n  expected a frame of a Simulator")
    out: PixelBounces = _native.pixel_bounces(frame, frame.scene, frame.camera, frame._own_options(), u, v)
    return out


def validity(frame: Frame, camera: Camera | None = None, wrong_cycles: bool = True) -> Validity:
    """How many pixels have no depth, why, and what helps, in words.

    Parameters
    ----------
    frame : Frame
        As of ``invalid_pixels``.
    camera : Camera, optional
        The one that the frame is of; None: the frame's own.
    wrong_cycles : bool
        As of ``invalid_pixels``.

    Returns
    -------
    Validity

    Raises
    ------
    Error
        As ``invalid_pixels``; where nobody says the camera.
    """
    by = frame.camera if camera is None else camera
    if by is None:
        raise BadInput("camera: error: the frame's camera is not known\n  expected the one that it is of")
    out: Validity = _native.validity(frame, by, wrong_cycles)
    return out
