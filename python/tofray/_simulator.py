# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Simulator, process and demo."""

from __future__ import annotations

import copy
import functools
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Sequence

from . import _native
from ._arrays import Depth, Raw
from ._errors import error_of
from ._frame import Frame
from ._load import load_camera, load_scene
from ._model import AmbientCase, Camera, CameraQuestion, CameraReport, FrameRequest, InvalidPixels, RanOn, Scene, SceneReport
from ._own import Geometry, PixelLight, Transient

if TYPE_CHECKING:
    from typing import Literal

    import numpy as np
    from numpy.typing import NDArray

    from ._native import DeviceFrames


# What is no option of a simulator, but a member or an argument elsewhere.
_ELSEWHERE = {
    "bounces": "scene.transport.bounces",
    "samples": "scene.transport.samples",
    "max_samples": "scene.transport.max_samples",
    "path_noise": "scene.transport.path_noise_m",
    "ambient": "scene.ambient",
    "mode": "an option of load_camera",
    "frames": "simulator.frames(first, count)",
    "fps": "camera.mode.frame_rate_hz",
}


def _says_where(init: Callable[..., None]) -> Callable[..., None]:
    """Of options that stand elsewhere says where; Python itself only says that they are unexpected."""

    @functools.wraps(init)
    def checked(self: Simulator, *arguments: Any, **options: Any) -> None:
        for name in options:
            if name in _ELSEWHERE:
                raise TypeError(f"Simulator has no option {name}: it is {_ELSEWHERE[name]}")
        init(self, *arguments, **options)

    return checked


class Simulator:
    """Simulates frames of one scene seen by one camera.

    ``frame(i)`` depends on nothing but scene, camera, options and i: the same bytes as the command line's, on any
    machine. The interpreter's lock is free while it computes; Ctrl-C ends a frame. A simulator computes one frame at a
    time, whichever threads ask; several simulators compute at once.

    Parameters
    ----------
    scene : Scene
        A copy is made: what is changed later changes no simulator.
    camera : Camera, optional
        Left out: the one that the scene asks for.
    seed : int
        0 to 2**64 - 1.
    noise : {"exact", "off"}
        Poisson counts with read noise, or expected values.
    threads : int
        0: as many as the machine has cores.
    backend : {"automatic", "cpu", "cuda"}
        What computes.
    device : int
        Which GPU; -1: the first one that can be used.
    block_size : int
        CUDA threads per block; 0: chosen.
    batch_bytes : int
        Host memory of one batch on its way from a GPU.
    isa : {"best", "scalar", "scalar_fma", "avx2", "avx512", "neon"}
        Which machine code runs. All give the same bytes.
    truth : bool
        Fill ``frame.truth``.
    arrays : sequence of str
        Fill these alone, by their names in files: ``("raw", "gt_z_m")``. Frames lack the others, but for those that these
        are made of, and no stage is run that none of them comes from. Left empty: all of them.
    last_stage : {"trace", "power", "raw", "depth"}
        Stop after this stage: frames have no arrays of later ones.
    exposure_samples : int
        1 to 1000: times within each exposure at which what moves is seen.
    subpixel : int
        1 to 16: samples of each pixel along its rows and columns.
    culling : bool
        Off: every pixel tests every object (for tests).

    Raises
    ------
    Error
        For a number out of its range, by its member, and where scene, camera and options do not fit together.
    """

    __slots__ = ("_camera", "_native", "_options", "_scene")

    def __init__(
        self,
        scene: Scene,
        camera: Camera | None = None,
        *,
        seed: int = 0,
        noise: Literal["off", "exact"] = "exact",
        threads: int = 0,
        backend: Literal["automatic", "cpu", "cuda"] = "automatic",
        device: int = -1,
        block_size: int = 0,
        batch_bytes: int = 64_000_000,
        isa: Literal["best", "scalar", "scalar_fma", "avx2", "avx512", "neon"] = "best",
        truth: bool = True,
        arrays: Sequence[str] = (),
        last_stage: Literal["trace", "power", "raw", "depth"] = "depth",
        exposure_samples: int = 1,
        subpixel: int = 1,
        culling: bool = True,
    ) -> None:
        self._options: dict[str, Any] = {
            "seed": seed, "noise": noise, "threads": threads, "backend": backend, "device": device, "block_size": block_size,
            "batch_bytes": batch_bytes, "isa": isa, "truth": truth, "arrays": arrays if isinstance(arrays, str) else list(arrays),
            "last_stage": last_stage, "exposure_samples": exposure_samples, "subpixel": subpixel, "culling": culling,
        }
        if camera is None and isinstance(scene, Scene):
            camera = load_camera(scene)
        # Frames tell later what they were made of, whatever becomes of the caller's own.
        self._scene = copy.deepcopy(scene)
        self._camera = copy.deepcopy(camera)
        self._native = _native.Simulator(self._scene, self._camera, self._options)

    if not TYPE_CHECKING:
        __init__ = _says_where(__init__)

    @property
    def scene(self) -> Scene:
        """A copy of what is simulated."""
        return copy.deepcopy(self._scene)

    @property
    def camera(self) -> Camera:
        """A copy of the camera."""
        camera: Camera = copy.deepcopy(self._camera)
        return camera

    def frame(self, index: int = 0, own: Geometry | PixelLight | Transient | None = None) -> Frame:
        """Computes one frame, which starts at index / frame_rate.

        Parameters
        ----------
        index : int
            0 or more.
        own : Geometry, PixelLight or Transient, optional
            Arrays of one's own in the place of what the scene's objects give.

        Returns
        -------
        Frame
            Its memory is its own, and stays while the frame or one of its arrays is held.

        Raises
        ------
        Error
            Of kind "stopped" where ``stop`` ended it; of kind "bad_input" for an index below 0, and for arrays that do not fit the camera.
        KeyboardInterrupt
            By Ctrl-C.
        """
        return Frame._of(self._native.frame(index, own), self._scene, self._camera, self._options)

    def frames(self, first: int = 0, count: int | None = None, *, requests: Iterable[FrameRequest] | None = None) -> Iterator[Frame]:
        """Frames one after the other; without a count they do not end.

        Parameters
        ----------
        first, count : int
            From which frame on, and how many.
        requests : iterable of FrameRequest, optional
            In place of them: each frame's index and, where they differ from the simulator's, its seed and the camera's pose.
            Requests are copied when they are taken.
            A request with a seed or a pose is remembered by its number alone in what ``save`` writes.

        Yields
        ------
        Frame
            Each as of ``frame``.

        Raises
        ------
        Error
            As ``frame``, and for a request whose pose cannot be.
        """
        if requests is None:
            index = first
            while count is None or index < first + count:
                yield self.frame(index)
                index += 1
            return
        # On a GPU several are on their way at once.
        batch = 16 if self.ran_on.backend == "cuda" else 1
        waiting: list[FrameRequest] = []
        for request in requests:
            waiting.append(copy.deepcopy(request))
            if len(waiting) == batch:
                yield from self._batch(waiting)
                waiting = []
        if waiting:
            yield from self._batch(waiting)

    def _batch(self, requests: list[FrameRequest]) -> Iterator[Frame]:
        for request, memory in zip(requests, self._native.frames(requests)):
            options = self._options
            if request.seed is not None:
                options = {**options, "seed": request.seed}
            yield Frame._of(memory, self._scene, self._camera, options, request.pose)

    def frames_on_device(
        self, first: int = 0, count: int = 1, *, requests: Iterable[FrameRequest] | None = None
    ) -> DeviceFrames:
        """Frames that stay in the GPU's memory, for a library that goes on computing there.

        ``torch.from_dlpack(simulator.frames_on_device(0, 64)["z_m"])`` is a tensor [64, height, width] of that memory.

        Parameters
        ----------
        first, count : int
            From which frame on, and how many: all are computed before this returns.
        requests : iterable of FrameRequest, optional
            In place of them, as in ``frames``.

        Returns
        -------
        DeviceFrames
            The arrays of all of them, [frame, …], by their names in files.

        Raises
        ------
        Error
            Of kind "device" where the processor computes, or where the GPU's memory is too small for them.
        """
        if requests is None:
            _check_count(first, count)
            requests = (FrameRequest(index=index) for index in range(first, first + count))
        return self._native.frames_on_device(list(requests))

    def stop(self) -> None:
        """Ends the frame under way, from another thread; whoever waits for it gets an Error of kind "stopped"."""
        self._native.stop()

    @property
    def progress(self) -> tuple[int, int]:
        """How far the frame under way is, as (done, of so many), in rays, roughly. For other threads to look at."""
        return self._native.progress()

    @property
    def ran_on(self) -> RanOn:
        """What computes the frames."""
        ran_on: RanOn = self._native.ran_on()
        return ran_on

    def __reduce__(self) -> tuple[Any, ...]:
        return _simulator_of, (self._scene, self._camera, self._options)

    def __repr__(self) -> str:
        ran_on = self.ran_on
        return f"<tofray.Simulator of {self._scene.name or 'a scene'} on {ran_on.backend}, {ran_on.isa}, {ran_on.threads} threads>"

    def __dir__(self) -> list[str]:
        return ["camera", "frame", "frames", "frames_on_device", "progress", "ran_on", "scene", "stop"]


def _check_count(first: object, count: object) -> None:
    """A range that a list of requests can be made of."""
    most = 1_000_000
    for name, value, least in (("first", first, 0), ("count", count, 1)):
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= (most if name == "count" else 2**64 - most - 1):
            expected = f"1 to {most}" if name == "count" else "0 or more"
            raise error_of("bad_input", f"frames_on_device: error: {name}: got {value!r}\n  expected {expected}")


def _simulator_of(scene: Scene, camera: Camera, options: dict[str, Any]) -> Simulator:
    return Simulator(scene, camera, **options)


def process(
    raw: Raw,
    camera: Camera,
    *,
    noise: Literal["off", "exact"] = "exact",
    threads: int = 0,
    backend: Literal["automatic", "cpu", "cuda"] = "automatic",
    device: int = -1,
    block_size: int = 0,
    isa: Literal["best", "scalar", "scalar_fma", "avx2", "avx512", "neon"] = "best",
) -> Depth:
    """Decodes raw data, simulated or measured, into depth.

    Parameters
    ----------
    raw : Raw
        ``raw``, or ``tap_a`` and ``tap_b``, and the arrays by phase: ``modulation_frequency_hz``, ``reference_phase_rad``,
        ``integration_time_s``, ``lit``.
    camera : Camera
        Says the rest: what lens, pixel, ADC and decoding are.
    noise, threads, backend, device, block_size, isa
        As of Simulator: ``noise="off"`` for expected values.

    Returns
    -------
    Depth

    Raises
    ------
    Error
        For arrays that lack, or do not fit together or to the camera, by their names.
    """
    options = {"noise": noise, "threads": threads, "backend": backend, "device": device, "block_size": block_size, "isa": isa}
    memory, _ = _native.process(raw, camera, options)
    depth: Depth = Depth._of(memory, memory.sizes())
    return depth


def pixel_rays(camera: Camera) -> NDArray[np.float32]:
    """Which way each pixel looks, the lens undistorted.

    Parameters
    ----------
    camera : Camera

    Returns
    -------
    float32 array [height, width, 2], 1
        x/z and y/z of the pixel's ray in the camera's frame.

    Raises
    ------
    Error
        For a camera that cannot be, by its member.
    """
    return _native.pixel_rays(camera)


def camera_report(camera: Camera, question: CameraQuestion | None = None) -> CameraReport:
    """What a camera can do in its mode, from expected values: field of view, range noise, wrong cycles, saturation.

    Parameters
    ----------
    camera : Camera
    question : CameraQuestion, optional
        Distances on the optical axis, reflectivities of a matt surface that faces the camera, and ambient light. None: 0.5, 1, 2 and 4 m,
        20 and 80 %, in the dark and in the sun.

    Returns
    -------
    CameraReport
        ``noise`` has one entry for each ambient light and reflectivity; its ``at`` has ``z_m``, ``sigma_m`` (equation 4.9), ``wrong_cycle``
        (equations 4.29 and 4.30) and ``saturated`` of each distance. ``warnings`` says what makes no sense about the design.

    Raises
    ------
    Error
        For a camera that no Simulator takes, and for a distance or a reflectivity out of range.
    """
    report: CameraReport = _native.camera_report(camera, CameraQuestion() if question is None else question)
    return report


def full_sun() -> AmbientCase:
    """All of the standard sun's light (100 % of ``sun_am15``), from everywhere, for a CameraQuestion.

    Returns
    -------
    AmbientCase
    """
    sun: AmbientCase = _native.full_sun()
    return sun


def scene_report(scene: Scene, camera: Camera, frame: Frame | None = None) -> SceneReport:
    """What the camera sees of the scene, and what of it is seldom meant.

    Parameters
    ----------
    scene : Scene
    camera : Camera
    frame : Frame, optional
        Of the scene, with ``truth.object_id`` and ``truth.range_m``. None: one ray for each pixel is traced, at frame 0.

    Returns
    -------
    SceneReport
        ``findings`` says in words what ``tofray check`` warns of; ``objects`` has one entry for each of the scene's.

    Raises
    ------
    Error
        For a scene and a camera that no Simulator takes, and for a frame of another scene.
    """
    report: SceneReport = _native.scene_report(scene, camera, frame)
    return report


def invalid_pixels(frame: Frame, camera: Camera, wrong_cycles: bool = True) -> InvalidPixels:
    """How many pixels have no depth, and why.

    Parameters
    ----------
    frame : Frame
        With ``depth.flags``. Where it has ``truth.object_id`` and ``truth.range_m``, too little light is told apart: no surface,
        beyond reach, dark.
    camera : Camera
        The one that the frame is of.
    wrong_cycles : bool
        Whether the raw frames are decoded once more to tell wrong cycles from flying pixels, where 1 % are flying.

    Returns
    -------
    InvalidPixels
        Each pixel counts once.

    Raises
    ------
    Error
        For raw frames that do not fit to the camera.
    """
    pixels: InvalidPixels = _native.invalid_pixels(frame, camera, wrong_cycles)
    return pixels


def camera_pose(scene: Scene, time_s: float = 0.0) -> NDArray[np.float64]:
    """Where the camera is at a time: camera to world.

    Parameters
    ----------
    scene : Scene
        Its ``camera`` says pose and keyframes.
    time_s : float
        In seconds; 0: the scene as written.

    Returns
    -------
    float64 array [4, 4], m
        A rotation, and in the last column the camera's place. Last row 0 0 0 1.

    Raises
    ------
    Error
        For a pose that cannot be.
    """
    return _native.camera_pose(scene, time_s)


def demo() -> Frame:
    """The first frame of the built-in demo: a snowman beside a fir tree.

    Returns
    -------
    Frame
    """
    return Simulator(load_scene("demo")).frame(0)
