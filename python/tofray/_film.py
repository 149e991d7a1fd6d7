# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Films as MCAP files with the messages of ROS 2."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Sequence

from . import _native
from ._errors import BadInput

if TYPE_CHECKING:
    from types import TracebackType
    from typing import Literal

    from ._frame import Frame
    from ._model import Camera, FileRecord, Scene

WORDS = ("driver", "stamp", "name", "topics", "depth_encoding", "unorganized", "amplitude_step_e", "epoch_s", "compression")


class McapWriter:
    """Writes frames into an MCAP file, one after the other, as ``tofray render --emit mcap`` does: topics of a camera for ROS 2.

    A chunk of 1 MiB goes to the disk whole. Until ``close()`` the file is called run.part.mcap for run.mcap; a program that ends early leaves it,
    and all of its whole chunks can be read. The same frames give the same bytes. As a context manager it closes itself, unless an
    exception ends the block.

    >>> with tofray.McapWriter("run.mcap", scene, camera, driver="pico_flexx") as film:
    ...     for frame in simulator.frames(100):
    ...         film.write(frame)

    Parameters
    ----------
    file : path
        A file of this name is replaced once the new one is complete.
    scene, camera : Scene, Camera
        What is simulated.
    driver : {"plain", "pmd", "pico_flexx", "ifm", "k4a", "realsense"}
        Whose topics and frames.
    stamp : {"start", "middle", "end"}
        Which moment of a frame's exposures its messages are stamped with.
    name : str
        Of the camera, the first part of topics and frames; empty: the driver's.
    topics : sequence of str
        Out of "depth", "amplitude", "noise", "confidence", "points", "raw", "rectified", "truth", "clock"; empty: what the driver has, and raw.
    depth_encoding : {"", "32FC1", "16UC1"}
        Metres with NaN where invalid, or millimetres with 0; empty: the driver's.
    unorganized : bool
        Clouds of the valid points alone.
    amplitude_step_e : float, e
        Electrons of 1 in amplitude as mono16; 0: the least power of two at which nothing clips.
    epoch_s : float, s
        Seconds since 1970 at the simulation's time 0.
    compression : {"zstd", "none"}, optional
        Of the chunks; None: zstd where the build has it.
    seed, noise
        What the frames are simulated with, for the file's record ``tofray``; None: 0 and "exact".

    Raises
    ------
    Error
        Of kind "io" where the file cannot be made; of kind "bad_input" for a word that cannot be.
    """

    __slots__ = ("_file",)

    def __init__(self, file: str | os.PathLike[str], scene: Scene, camera: Camera, *,
                 driver: Literal["plain", "pmd", "pico_flexx", "ifm", "k4a", "realsense"] = "plain",
                 stamp: Literal["start", "middle", "end"] = "middle", name: str = "", topics: Sequence[str] = (),
                 depth_encoding: Literal["", "32FC1", "16UC1"] = "", unorganized: bool = False, amplitude_step_e: float = 0,
                 epoch_s: float = 0, compression: Literal["zstd", "none"] | None = None, seed: int | None = None,
                 noise: Literal["off", "exact"] | None = None) -> None:
        words = {"driver": driver, "stamp": stamp, "name": name, "topics": list(topics), "depth_encoding": depth_encoding,
                 "unorganized": unorganized, "amplitude_step_e": amplitude_step_e, "epoch_s": epoch_s, "compression": compression}
        simulated = {key: value for key, value in (("seed", seed), ("noise", noise)) if value is not None}
        self._file = _native.McapFile(os.fspath(file), scene, camera, words, simulated)

    def write(self, frame: Frame) -> None:
        """Writes the messages of a frame.

        Parameters
        ----------
        frame : Frame
            Of this scene and camera. Where its camera was placed from outside, /tf says so.

        Raises
        ------
        Error
            Of kind "io" where the disk is full; of kind "bad_input" where the frame lacks an array that a topic is made of.
        """
        self._file.write(frame, frame.scene if frame._request is not None else None)

    def close(self) -> FileRecord:
        """Writes the summary and gives the file its name.

        Returns
        -------
        FileRecord
            Name, bytes and SHA-256.

        Raises
        ------
        Error
            Of kind "io"; of kind "bad_input" where it is closed already.
        """
        record: FileRecord = self._file.close()
        return record

    def __enter__(self) -> McapWriter:
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, where: TracebackType | None) -> None:
        if kind is None:
            self.close()


def mcap_contents(file: str | os.PathLike[str]) -> dict[str, Any]:
    """What is in an MCAP file, of any writer; every sum in it is checked.

    Parameters
    ----------
    file : path

    Returns
    -------
    dict
        ``topics`` (by name: ``type``, ``messages``, ``bytes``, ``rate_hz``, ``first_ns``, ``last_ns``), ``attachments`` (bytes by name), ``metadata``
        (of tofray's files the record ``tofray``), ``messages``, ``first_ns``, ``last_ns``, ``chunks``, ``compression``, ``bytes``; ``complete`` is False where the
        file ends early, and ``lost_bytes`` are behind its last whole chunk then.

    Raises
    ------
    Error
        Of kind "io" where it cannot be read; of kind "bad_input" where it is none, or is damaged.
    """
    return _native.mcap_contents(os.fspath(file))


def film_words(words: Any) -> dict[str, Any]:
    """Words of ``render``'s ``mcap``."""
    unknown = [key for key in words if key not in WORDS]
    if unknown:
        raise BadInput(f"mcap: error: unknown word {unknown[0]!r}\n  expected some of {', '.join(WORDS)}")
    return {key: list(value) if key == "topics" else value for key, value in words.items()}
