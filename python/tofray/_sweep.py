# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A scene with keys that vary, and how good its depth is with each."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Dict

from . import _native
from ._errors import BadInput
from ._load import _chosen, _in_words_of_python
from ._run import _settings, _typed

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from typing import Literal


class Sweep(Dict[str, Any]):
    """Arrays of float64 by metric, each [axis 0, axis 1, …, region]; NaN where there is nothing that it could be of.

    Parameters
    ----------
    arrays : dict
        The arrays, by names whose end is the unit: ``sigma_m``, ``fill_percent``, ``amplitude_e``.
    axes : dict
        By key, in the arrays' order: a list of numbers in SI units, or of texts.
    texts : dict
        By key: the values as ``set`` takes them.
    units : dict
        By key: the unit of its numbers, or nothing.
    regions : list of str
        "all" (or the region's column, row, width and height), then objects.
    counts : dict
        ``traced``, ``from_light`` and ``from_raw``: how many frames began with rays, with light and with raw frames that were there; ``seconds``.
    """

    def __init__(self, arrays: dict[str, Any], axes: dict[str, list[Any]], texts: dict[str, list[str]], units: dict[str, str], regions: list[str],
                 counts: dict[str, Any]) -> None:
        super().__init__(arrays)
        self.axes = axes
        self.texts = texts
        self.units = units
        self.regions = regions
        self.counts = counts

    def best(self, wish: str) -> list[tuple[int, ...]]:
        """The cells that nothing beats: those that hold all conditions, and of them each that no other is better than in every aim.

        Parameters
        ----------
        wish : str
            Aims and conditions with "," between: ``"sigma, fill>95%"``, ``"rmse, illumination.0.power"``. An aim is a metric of the first region or
            an axis of numbers, which shall be small (fill and amplitude: large).

        Returns
        -------
        list of tuple of int
            Places along the axes, by the first aim: ``sweep["sigma_m"][place]``.

        Raises
        ------
        Error
            For a name that the sweep does not have, a number of another unit, no aim.
        """
        import numpy as np

        axes = [(key, values if self._is_number(key) else [], self.units[key], len(values)) for key, values in self.axes.items()]
        found: list[tuple[int, ...]] = _native.best_cells(axes, list(self), np.stack([array[..., 0] for array in self.values()], axis=-1), wish)
        return found

    def _is_number(self, key: str) -> bool:
        return all(isinstance(one, float) for one in self.axes[key])

    def plot(self, metric: str = "sigma_m", region: int = 0) -> Any:
        """A metric: a curve over one axis, a heat map over two, small multiples over three.

        Parameters
        ----------
        metric : str
            One of those that the sweep has.
        region : int
            Which of ``regions``; of a sweep over one axis all are drawn.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        Error
            For a metric or a region that the sweep does not have, and for more than three axes.
        ImportError
            Without matplotlib.
        """
        from . import plot

        return plot.sweep_figure(self, metric, region)


def sweep(
    scene: str | os.PathLike[str],
    vary: Mapping[str, Any],
    *,
    set: Mapping[str, Any] | None = None,
    mode: str = "",
    root: str | os.PathLike[str] = "",
    metrics: Sequence[str] = (),
    region: tuple[int, int, int, int] | None = None,
    by_object: bool = False,
    repeat: int = 1,
    seed: int = 0,
    noise: Literal["off", "exact"] = "exact",
    exposure_samples: int = 1,
    subpixel: int = 1,
    threads: int = 0,
    folder: str | os.PathLike[str] = "",
    each: Callable[[int, int], object] | None = None,
) -> Sweep:
    """Simulates a scene with all combinations of values of some keys, and measures z against its ground truth in each.

    Where only what follows the light varies (pixel, ADC, integration times) rays are traced once; where only ``decoding`` varies, raw frames are made
    once. A cell's frames have the bytes of ``render`` with its values as ``set``.

    Parameters
    ----------
    scene : path or name
        As of ``load_inputs``.
    vary : mapping
        Keys of the scene, or of its camera with or without "camera." before them, with ``*`` for all elements of a list; ``mode``, ``profile``. Values
        are numbers in SI units, texts as of ``set``, or one text as of the command line: ``{"illumination.0.power": np.geomspace(0.1, 1, 10),
        "integration_time": ["100 us", "200 us"], "lens.f_number": "1.0:2.0:5", "mode": "@all"}``.
    set, mode, root
        As of ``load_inputs``.
    metrics : sequence of str
        Out of bias, median, sigma, rmse, p95, fill, wrong_cycle, amplitude, noise, tap_filling, adc_filling and the flags; left empty: all.
        sigma = √(mean variance of z over the frames), divisor repeat - 1; of one frame √(mean of (noise_m · z/range)²).
    region : (int, int, int, int), optional
        Column, row, width and height in pixels; None: the whole image.
    by_object : bool
        Besides, each object's own pixels of it.
    repeat : int
        Frames of each cell.
    seed, noise, exposure_samples, subpixel, threads
        As of ``Simulator``.
    folder : path
        Where sweep.csv, sweep.npz and manifest.json go; left empty: nowhere.
    each : callable, optional
        Called with the number of cells that are done, and with that of all.

    Returns
    -------
    Sweep

    Raises
    ------
    Error
        As ``load_inputs`` and ``Simulator``, with the cell; of kind "limit" for more than 100,000 cells.
    """
    if not hasattr(vary, "items"):
        raise BadInput(f"vary: error: got {type(vary).__name__}\n  expected a mapping of keys to values, as in {{'adc.bits': [10, 12]}}")
    axes: list[tuple[Any, ...]] = []
    for key, values in vary.items():
        if isinstance(values, str):
            axes.append((key, values))
            continue
        values = values.tolist() if hasattr(values, "tolist") else list(values)
        if values and all(isinstance(one, (int, float)) and not isinstance(one, bool) for one in values):
            axes.append((key, None, [float(one) for one in values]))
        else:
            axes.append((key, [text for _, text in (_settings({key: one})[0] for one in values)]))
    words = {"scene": _chosen(_native.choose_scene(_typed(scene))), "set": _settings(set), "mode": mode, "root": os.fspath(root),
             "metrics": list(metrics), "region": region, "by_object": by_object, "repeat": repeat}
    options = {"seed": seed, "noise": noise, "exposure_samples": exposure_samples, "subpixel": subpixel, "threads": threads}
    found, regions, names, values, counts = _in_words_of_python(lambda: _native.sweep(words, axes, options, os.fspath(folder), each))
    return Sweep({name: values[..., i] for i, name in enumerate(names)},
                 {key: list(numbers) if numbers else list(texts) for key, texts, numbers, _, _ in found},
                 {key: list(texts) for key, texts, _, _, _ in found}, {key: unit for key, _, _, unit, _ in found}, list(regions), dict(counts))
