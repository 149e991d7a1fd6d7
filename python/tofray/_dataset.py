# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Data sets: a file that says what varies, of which each sample is a scene."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native
from ._load import load_camera
from ._simulator import Simulator

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ._frame import Frame
    from ._model import Scene


class Drawn(NamedTuple):
    """A value that was drawn for a sample.

    Parameters
    ----------
    path : str
        Of the key, by the names of objects where they have names: ``objects/ball/radius``.
    form : str
        ``uniform``, ``choice``, ….
    text : str
        The value as it stands in the scene; empty where the key is left out.
    value : float, in the unit of ``text``
        Of a number; of a choice, grid, file or row which one it is, from 0; of a chance 0 or 1.
    """

    path: str
    form: str
    text: str
    value: float


class Dataset:
    """A set whose samples are scenes: ``set[i]`` computes the frame of sample i, the same bits on every machine.

    What is drawn for a value depends on the set's seed, the sample (or the view, the device, as its ``per`` says) and the path of its key alone: in any
    order, in any process, whatever else is changed in the set's file. A draw takes the 64 bits that Philox4x32-10 (Salmon et al. 2011) makes of the seed as
    key and the counter (sample's lower 32 bits; its upper 8, view, attempt; the first 8 bytes of the path's SHA-256).

    Parameters
    ----------
    file : path
        The set's file (``tofray dataset check`` says what is wrong with it).

    Raises
    ------
    Error
        With line and column.
    """

    def __init__(self, file: str | os.PathLike[str]) -> None:
        self._file = os.fspath(file)
        self._set = _native.Dataset(self._file)

    def __repr__(self) -> str:
        return f"<tofray.Dataset {self.name}: {len(self)} samples>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Dataset, (self._file,)

    @property
    def name(self) -> str:
        """The set's name."""
        return self._set.name

    @property
    def license(self) -> str:
        """The licence by its SPDX name; empty where the file says none."""
        return self._set.license

    @property
    def views(self) -> int:
        """Poses of the camera for each sample."""
        return self._set.views

    @property
    def combinations(self) -> int:
        """Combinations of the set's grids; 1 where it has none."""
        return self._set.combinations

    def __len__(self) -> int:
        return self._set.samples

    def __getitem__(self, sample: int) -> Frame:
        return self.frame(sample)

    def __iter__(self) -> Iterator[Frame]:
        return (self.frame(sample) for sample in range(len(self)))

    def _number(self, sample: int) -> int:
        at = range(len(self))[sample] if -len(self) <= sample < len(self) else None
        if at is None:
            raise IndexError(f"sample: got {sample}, expected 0 to {len(self) - 1}")
        return at

    def scene_yaml(self, sample: int, view: int = 0) -> str:
        """The scene of a sample as a scene's file has it.

        Parameters
        ----------
        sample : int
            From 0; negative: from the end.
        view : int
            Which of the sample's poses.

        Returns
        -------
        str
            YAML.

        Raises
        ------
        Error
            With line and column of the set's file.
        IndexError
            For a sample that is not there.
        """
        return self._set.scene_yaml(self._number(sample), view)

    def scene(self, sample: int, view: int = 0) -> Scene:
        """The scene of a sample.

        Parameters
        ----------
        sample : int
            From 0; negative: from the end.
        view : int
            Which of the sample's poses.

        Returns
        -------
        Scene

        Raises
        ------
        Error
            As ``load_scene``.
        IndexError
            For a sample that is not there.
        """
        scene: Scene = self._set.scene(self._number(sample), view)
        return scene

    def drawn(self, sample: int, view: int = 0) -> list[Drawn]:
        """What was drawn for a sample, in the order of the file.

        Parameters
        ----------
        sample : int
            From 0; negative: from the end.
        view : int
            Which of the sample's poses.

        Returns
        -------
        list of Drawn

        Raises
        ------
        Error
            With line and column of the set's file.
        IndexError
            For a sample that is not there.
        """
        return [Drawn(*one) for one in self._set.drawn(self._number(sample), view)]

    def noise_seed(self, sample: int, view: int = 0) -> int:
        """Seed of the noise of a sample's frames: another one for each sample and view, so that no two have the same noise.

        Parameters
        ----------
        sample : int
            From 0; negative: from the end.
        view : int
            Which of the sample's poses.

        Returns
        -------
        int
            0 to 2^53 - 1, for ``Simulator(seed=…)``.

        Raises
        ------
        IndexError
            For a sample that is not there.
        """
        return self._set.noise_seed(self._number(sample), view)

    def split(self, sample: int) -> str:
        """What a sample is for, by the set's ``split``: it follows from the sample's number, before anything else is drawn.

        Parameters
        ----------
        sample : int
            From 0; negative: from the end.

        Returns
        -------
        str
            ``train``, ``validation`` or ``test``; ``train`` where the set has no ``split``.

        Raises
        ------
        IndexError
            For a sample that is not there.
        """
        return self._set.split(self._number(sample))

    def frame(self, sample: int, view: int = 0, **options: Any) -> Frame:
        """The frame of a sample: what ``tofray render`` makes of its scene with its seed.

        Parameters
        ----------
        sample : int
            From 0; negative: from the end.
        view : int
            Which of the sample's poses.
        options
            Of the ``Simulator``: ``arrays``, ``threads``, ``noise`` and others.

        Returns
        -------
        Frame

        Raises
        ------
        Error
            As ``load_scene`` and ``Simulator``.
        IndexError
            For a sample that is not there.
        """
        scene = self.scene(sample, view)
        words: dict[str, Any] = {"seed": self.noise_seed(sample, view), **options}
        return Simulator(scene, load_camera(scene), **words).frame(0)
