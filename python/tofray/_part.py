# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What Raw, Depth and Truth have in common: arrays by name, fetched when first asked for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Iterator

from ._errors import BadInput

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from ._native import FrameMemory

_SIZES = ("width", "height", "phases", "bins", "modulations", "time_s")
_EXTENTS = {"phase": "phases", "height": "height", "width": "width", "bin": "bins", "frequency": "modulations"}


# Arrays that only some frames have, and what of the scene or simulator makes them; sub-pixel samples and bounces are off unless asked for.
_COMES_WITH = {
    **dict.fromkeys(("direct_e", "indirect_e", "multipath_m", "path_noise_m", "path_count"), "it comes with scene.transport.bounces above 0"),
    **dict.fromkeys(("transient_e_per_s", "transient_lost_e_per_s"), "it comes with scene.transport.transient.bins above 0"),
    **dict.fromkeys(("raw_dn", "phase_flow_px", "class_id"), "ask for it by name: Simulator(…, arrays=[…])"),
    "raw_direct_dn": "ask for it by name, Simulator(…, arrays=[…]), with scene.transport.bounces above 0",
    **dict.fromkeys(("amplitude_by_frequency_e", "range_by_frequency_m", "cycle_by_frequency"), "ask for it by name: Simulator(…, arrays=[…])"),
    **dict.fromkeys(("mixed", "object_share"), "it comes with Simulator(…, subpixel=2) or more"),
}


class Part:
    """A part of a frame: numpy arrays that are views of the frame's memory, and keep it alive.

    Attributes
    ----------
    width, height : int
        Of the sensor, in pixels.
    phases : int
        Raw frames of a frame.
    bins : int
        Of histograms of light by path length.
    modulations : int
        Modulation frequencies of arrays that have one image for each.
    time_s : float
        When the ground truth holds, in seconds from the scene as written.
    units : dict of str
        Unit of each array.
    names : tuple of str
        The arrays that this frame has.
    """

    __slots__ = ("_held", "_memory", "_own", "bins", "height", "modulations", "phases", "time_s", "width")
    _rows: dict[str, tuple[str, str, str, str, str]] = {}

    width: int
    height: int
    phases: int
    bins: int
    modulations: int
    time_s: float

    def __init__(self, *, width: int | None = None, height: int | None = None, phases: int | None = None,
                 bins: int | None = None, modulations: int | None = None, time_s: float = 0.0, **arrays: NDArray[Any]) -> None:
        self._memory: FrameMemory | None = None
        self._own = True
        self._held: dict[str, Any] = {}
        sizes = {"width": width, "height": height, "phases": phases, "bins": bins, "modulations": modulations}
        for name, size in sizes.items():
            object.__setattr__(self, name, 0 if size is None else size)
        self.time_s = time_s
        given = {name for name, size in sizes.items() if size}
        for name, array in arrays.items():
            if name not in self._rows:
                raise BadInput(f"{type(self).__name__}: error: has no array {name!r}\n  expected some of {', '.join(self._rows)}")
            self._held[name] = array
            self._learn_sizes(name, array, given)

    def _learn_sizes(self, name: str, array: NDArray[Any], known: set[str]) -> None:
        """The first array with an axis says how long it is; native code compares the others when they are used."""
        letters = self._rows[name][2].strip("[]").split(", ")
        shape = getattr(array, "shape", None)
        if shape is None or len(shape) != len(letters):
            return
        for letter, size in zip(letters, shape):
            extent = _EXTENTS.get(letter)
            if extent is not None and extent not in known:
                object.__setattr__(self, extent, int(size))
                known.add(extent)

    @classmethod
    def _of(cls, memory: FrameMemory, sizes: dict[str, Any]) -> Any:
        self = cls.__new__(cls)
        object.__setattr__(self, "_memory", memory)
        object.__setattr__(self, "_own", False)
        object.__setattr__(self, "_held", {})
        for name in _SIZES:
            object.__setattr__(self, name, sizes[name])
        return self

    @property
    def _part(self) -> str:
        return type(self).__name__.lower()

    def get(self, name: str) -> NDArray[Any] | None:
        """The array of that name, or None where this frame does not have it.

        Parameters
        ----------
        name : str
            One of ``names``: "z_m".

        Returns
        -------
        array or None
            A view of the frame's memory; dtype, shape and unit are those of the class's list.
        """
        held = self._held.get(name)
        if held is None and self._memory is not None and name in self._rows:
            held = self._memory.array(self._part, name)
            if held is not None:
                self._held[name] = held
        return held

    def __getattr__(self, name: str) -> NDArray[Any]:
        if name.startswith("_") or name not in self._rows:
            raise AttributeError(f"{type(self).__name__} has no array {name!r}; it may have {', '.join(self._rows)}")
        array = self.get(name)
        if array is None:
            why = _COMES_WITH.get(name, "it was not asked for, or a stage before it was the last")
            raise AttributeError(f"this frame has no {self._part}.{name} ({self._rows[name][0]}): {why}\n"
                                 f"  it has {', '.join(self.names) or 'none'}")
        return array

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._rows:
            if not self._own:
                raise AttributeError(
                    f"{self._part}.{name} is the frame's own memory\n"
                    f"  expected {self._part}.{name}[...] = values, or a tofray.{type(self).__name__} of one's own")
            self._held[name] = value
            return
        if name in _SIZES and not self._own:
            raise AttributeError(f"{self._part}.{name} is what the frame has\n  expected a tofray.{type(self).__name__} of one's own")
        object.__setattr__(self, name, value)

    def __getitem__(self, name: str) -> NDArray[Any]:
        array = self.get(name)
        if array is None:
            raise KeyError(name)
        return array

    def __contains__(self, name: object) -> bool:
        return isinstance(name, str) and self.get(name) is not None

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    @property
    def names(self) -> tuple[str, ...]:
        """The arrays that this frame has."""
        return tuple(name for name in self._rows if self.get(name) is not None)

    @property
    def units(self) -> dict[str, str]:
        """The unit of each array, such as "m", "e" or "1"."""
        return {name: row[4] for name, row in self._rows.items()}

    def __dir__(self) -> list[str]:
        return [*self._rows, "width", "height", "phases", "bins", "modulations", "time_s", "get", "names", "units"]

    def __repr__(self) -> str:
        return f"<tofray.{type(self).__name__} {self.width} x {self.height}: {', '.join(self.names) or 'no arrays'}>"

    def __reduce__(self) -> tuple[Any, ...]:
        sizes = {name: getattr(self, name) for name in _SIZES}
        return _part_of, (type(self), sizes, {name: self[name] for name in self.names})


def _part_of(part: type[Part], sizes: dict[str, Any], arrays: dict[str, NDArray[Any]]) -> Part:
    words: dict[str, Any] = {**sizes, **arrays}
    return part(**words)
