# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Simulator, process and demo."""

from __future__ import annotations

import copy
import functools
from typing import TYPE_CHECKING, Any, Callable, Iterable, Iterator, Mapping, Sequence

from . import _native
from ._arrays import Depth, Raw
from ._errors import error_of
from ._frame import Frame
from ._load import load_camera, load_scene
from ._model import (
    AmbientCase, Camera, CameraKeyframe, CameraQuestion, CameraReport, FrameRequest, InvalidPixels, Keyframe, ObjectPlace, PlacedObject, Placement, Pose,
    PlanStep, RanOn, Scene, SceneReport,
)
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

    def frame(
        self,
        index: int = 0,
        own: Geometry | PixelLight | Transient | None = None,
        *,
        camera: Pose | tuple[Pose, Pose] | Sequence[CameraKeyframe] | None = None,
        objects: Mapping[str, Placement | tuple[Placement, Placement] | Sequence[Keyframe]] | None = None,
        time_s: float | None = None,
        seed: int | None = None,
    ) -> Frame:
        """Computes one frame, which starts at index / frame_rate.

        Parameters
        ----------
        index : int
            0 or more.
        own : Geometry, PixelLight or Transient, optional
            Arrays of one's own in the place of what the scene's objects give.
        camera : Pose, pair of Pose, or sequence of CameraKeyframe, optional
            Where the camera stands in this frame; or where it is at the frame's start and where the next frame starts: it goes there
            evenly; or keyframes, by the scene's time.
        objects : mapping of str to Placement, pair of Placement, or sequence of Keyframe, optional
            Where objects stand, by their names (or as "objects.2"), in place of their own motion. Others move as the scene says.
            The bytes are those of a scene with the same keyframes. The first frame that places other objects than those before takes as
            long as a new simulator; then no hierarchy is built anew.
        time_s : float, optional, s
            When the frame starts, in place of index / frame_rate. ``exposure_times`` says when its raw frames are exposed.
        seed : int, optional
            In place of the simulator's.

        Returns
        -------
        Frame
            Its memory is its own, and stays while the frame or one of its arrays is held.

        Raises
        ------
        Error
            Of kind "stopped" where ``stop`` ended it; of kind "bad_input" for an index below 0, for arrays that do not fit the camera, and
            for names that the scene has not, poses that cannot be, and keyframes that do not rise in time.
        KeyboardInterrupt
            By Ctrl-C.
        """
        if camera is None and objects is None and time_s is None and seed is None:
            return Frame._of(self._native.frame(index, own), self._scene, self._camera, self._options)
        if own is not None:
            raise error_of("bad_input", "frame: error: arrays of one's own and a camera, objects, a time or a seed\n"
                                        "  expected the arrays alone: they say what is seen; seed is an option of Simulator")
        request = _request(index, camera, objects, time_s, seed)
        memory, as_it_was = self._native.frame_of_request(request)
        return self._frame_of(request, memory, as_it_was)

    def _frame_of(self, request: FrameRequest, memory: Any, as_it_was: Any) -> Frame:
        options = self._options if request.seed is None else {**self._options, "seed": request.seed}
        places = request.pose is not None or request.camera or request.objects
        return Frame._of(memory, self._scene, self._camera, options, as_it_was if places else None)

    def frames(self, first: int = 0, count: int | None = None, *, requests: Iterable[FrameRequest] | None = None) -> Iterator[Frame]:
        """Frames one after the other; without a count they do not end.

        Parameters
        ----------
        first, count : int
            From which frame on, and how many.
        requests : iterable of FrameRequest, optional
            In place of them: each frame's index and, where they differ from the simulator's, its seed, its time, the camera's pose and
            where objects are. Requests are copied when they are taken.
            A request with a seed, a time or a pose is remembered by its number alone in what ``save`` writes.

        Yields
        ------
        Frame
            Each as of ``frame``.

        Raises
        ------
        Error
            As ``frame``.
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
            yield self._frame_of(request, memory, request)

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
            Of kind "device" where the processor computes, or where the GPU's memory is too small for them; of kind "bad_input" for
            requests that do not all place the same objects.
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

    def plan(self) -> list[PlanStep]:
        """How the first frame is computed: passes over all of its pixels, one before the next begins.

        Of what stands still later frames keep the light, and take fewer.

        Returns
        -------
        list[PlanStep]
            Pass, what it does, which part of its work, and how many pieces it has.

        Raises
        ------
        Error
            ``bad_input``: the scene cannot be looked at at the first frame's time.
        """
        steps: list[PlanStep] = self._native.plan()
        return steps

    def __reduce__(self) -> tuple[Any, ...]:
        return _simulator_of, (self._scene, self._camera, self._options)

    def __repr__(self) -> str:
        ran_on = self.ran_on
        return f"<tofray.Simulator of {self._scene.name or 'a scene'} on {ran_on.backend}, {ran_on.isa}, {ran_on.threads} threads>"

    def __dir__(self) -> list[str]:
        return ["camera", "frame", "frames", "frames_on_device", "plan", "progress", "ran_on", "scene", "stop"]


def _request(index: int, camera: Any, objects: Any, time_s: float | None, seed: int | None) -> FrameRequest:
    """What frame() is asked for."""
    def is_pair(value: Any, of: type) -> bool:
        return isinstance(value, (tuple, list)) and len(value) == 2 and all(isinstance(one, of) for one in value)

    def refuse(name: str, value: Any, one: str, key: str) -> Any:
        kind = type(value).__name__
        return error_of("bad_input", f"frame: error: {name}: got {kind}\n  expected a tofray.{one}, (start, end) of two, or a list of {key}s")

    out = FrameRequest(index=index, seed=seed, start_time_s=time_s)
    if isinstance(camera, Pose):
        out.pose = camera
    elif is_pair(camera, Pose):
        out.pose, out.pose_end = camera
    elif isinstance(camera, (tuple, list)) and camera and all(isinstance(one, CameraKeyframe) for one in camera):
        out.camera = list(camera)
    elif camera is not None:
        raise refuse("camera", camera, "Pose", "CameraKeyframe")
    if objects is not None and not isinstance(objects, Mapping):
        raise error_of("bad_input", f"frame: error: objects: got {type(objects).__name__}\n"
                                    '  expected names and placements, such as {"ball": (start, end)}')
    for name, where in ({} if objects is None else objects).items():
        one = PlacedObject(name=name)
        if isinstance(where, Placement):
            one.start = where
        elif is_pair(where, Placement):
            one.start, one.end = where
        elif isinstance(where, (tuple, list)) and where and all(isinstance(key, Keyframe) for key in where):
            one.keyframes = list(where)
        else:
            raise refuse(f"objects[{name!r:.80}]", where, "Placement", "Keyframe")
        out.objects.append(one)
    return out


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


def placed_scene(scene: Scene, camera: Camera, request: FrameRequest) -> Scene:
    """The scene whose file would say what a request says of it.

    Parameters
    ----------
    scene : Scene
        What the request is of.
    camera : Camera
        Its frame rate says when frames start.
    request : FrameRequest
        What is placed from outside.

    Returns
    -------
    Scene
        With keyframes in place of what the request places.

    Raises
    ------
    Error
        As ``Simulator.frame`` for such a request.
    """
    placed: Scene = _native.placed_scene(scene, camera, request)
    return placed


def exposure_times(camera: Camera, start_s: float = 0.0) -> NDArray[np.float64]:
    """When a frame looks at what moves: the middle of each raw frame's exposure.

    Parameters
    ----------
    camera : Camera
        Its mode says how long each raw frame takes; with ``auto_exposure`` the times are those of the mode.
    start_s : float, s
        When the frame starts.

    Returns
    -------
    float64 array [phase], s
        By which a renderer or a physics engine can be asked. With ``exposure_samples`` more than 1 a frame looks at other times, too.

    Raises
    ------
    Error
        For a camera that cannot be, and a time that is not within -1e6 to 1e6 s.
    """
    return _native.exposure_times(camera, start_s)


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
        ``noise`` has one entry for each ambient light and reflectivity; its ``at`` has ``z_m``, ``sigma_m`` [theory: noise-estimate],
        ``wrong_cycle`` [theory: noisy-phasor, wrong-cycle-share] and ``saturated`` of each distance. ``warnings`` says what makes no sense about the design.

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


def object_places(scene: Scene, time_s: float = 0.0) -> list[ObjectPlace]:
    """Where each of the scene's objects is at one time: its pose and its box, in the world.

    Parameters
    ----------
    scene : Scene
    time_s : float, s, optional
        Of the scene, as ``frame.truth.time_s`` says it.

    Returns
    -------
    list of ObjectPlace
        In the order of ``truth.object_id``.

    Raises
    ------
    TypeError, Error
        Where a member of the scene is not what it has to be.
    """
    places: list[ObjectPlace] = _native.object_places(scene, time_s)
    return places


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
