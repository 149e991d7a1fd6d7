# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""``python -m tofray.plot SWEEP``: a sweep's picture, by matplotlib.

SWEEP is a folder of ``tofray sweep -o``, or its sweep.npz.
"""

from __future__ import annotations

import argparse
import importlib
import json
import os
import sys
from typing import TYPE_CHECKING, Any

from ._errors import BadInput, Error

if TYPE_CHECKING:
    from ._sweep import Sweep


def load_sweep(path: str | os.PathLike[str]) -> Sweep:
    """Reads what ``tofray sweep -o`` wrote.

    Parameters
    ----------
    path : path
        The folder, or sweep.npz in it.

    Returns
    -------
    Sweep

    Raises
    ------
    Error
        Where it cannot be read, or is none of a sweep.
    """
    import numpy as np

    from ._sweep import Sweep

    file = os.fspath(path)
    if os.path.isdir(file):
        file = os.path.join(file, "sweep.npz")
    try:
        with np.load(file, allow_pickle=False) as read:
            arrays = {name: read[name] for name in read.files}
    except (OSError, ValueError) as fault:
        raise BadInput(f"{file}: error: it cannot be read\n  {fault}; expected the folder of `tofray sweep -o`, or sweep.npz in it") from None
    if not {"axes", "regions", "metrics", "meta"} <= arrays.keys():
        raise BadInput(f"{file}: error: this is no sweep\n  expected what `tofray sweep -o` writes")
    meta = {one["key"]: one for one in json.loads(str(arrays["meta"]))["axes"]}
    keys = [str(key) for key in arrays["axes"]]
    return Sweep({str(name): arrays[str(name)] for name in arrays["metrics"]},
                 {key: [one if isinstance(one, float) else str(one) for one in arrays[key].tolist()] for key in keys},
                 {key: list(meta[key]["values"]) for key in keys}, {key: meta[key]["unit"] for key in keys},
                 [str(one) for one in arrays["regions"]], {})


_UNITS = (("_percent", "%", 1.0), ("_m", "mm", 1e3), ("_e", "e", 1.0))


def _label(metric: str) -> tuple[str, float]:
    for end, unit, scale in _UNITS:
        if metric.endswith(end):
            return f"{metric[:-len(end)].replace('_', ' ')} [{unit}]", scale
    return metric, 1.0


def _name(sweep: Sweep, key: str) -> str:
    short = key[len("camera."):] if key.startswith("camera.") else key
    return f"{short} [{sweep.units[key]}]" if sweep.units[key] else short


def _even_ratios(values: list[Any]) -> bool:
    """Whether the values are those of a logarithmic axis."""
    if len(values) < 3 or min(values) <= 0:
        return False
    steps = [after / before for before, after in zip(values, values[1:])]
    return bool(min(steps) > 1 and max(steps) / min(steps) < 1.001 and values[-1] / values[0] > 3)


def _wide(values: Any) -> bool:
    """Whether numbers above 0 span so much that a scale of ratios shows more."""
    import numpy as np

    finite = values[np.isfinite(values)]
    return bool(finite.size and finite.min() > 0 and finite.max() > 10 * finite.min())


def _ticks_of_ratios() -> dict[str, Any]:
    """Places and words of a scale of ratios: 1, 2, 5, 10 …"""
    ticker = importlib.import_module("matplotlib.ticker")
    return {"locator": ticker.LogLocator(subs=(1.0, 2.0, 5.0)), "formatter": ticker.FuncFormatter(lambda value, _: f"{value:g}")}


def _curves(sweep: Sweep, axes: Any, metric: str) -> None:
    (key, values), = sweep.axes.items()
    label, scale = _label(metric)
    numbers = sweep._is_number(key)
    for i, region in enumerate(sweep.regions):
        x = values if numbers else range(len(values))
        style: dict[str, Any] = {"color": "black", "linestyle": "--"} if i == 0 and len(sweep.regions) > 1 else {"color": f"C{(i - 1) % 10}"}
        if i > 10:
            style["linestyle"] = ":"
        axes.plot(x, scale * sweep[metric][:, i], marker="o" if len(values) < 30 else None, markersize=4, label=region, **style)
    if numbers and _even_ratios(values):
        axes.set_xscale("log")
        if len(values) <= 8:
            axes.set_xticks(values, [f"{one:.3g}" for one in values])
            axes.set_xticks([], minor=True)
    if _wide(scale * sweep[metric]):
        ticks = _ticks_of_ratios()
        axes.set_yscale("log")
        axes.yaxis.set_major_locator(ticks["locator"])
        axes.yaxis.set_major_formatter(ticks["formatter"])
        axes.yaxis.set_minor_formatter(importlib.import_module("matplotlib.ticker").NullFormatter())
    if not numbers:
        axes.set_xticks(range(len(values)), values, rotation=30, ha="right")
    axes.set(xlabel=_name(sweep, key), ylabel=label)
    axes.grid(alpha=0.3)
    if len(sweep.regions) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1, 1), fontsize=8)


def _ticks(values: list[str]) -> tuple[list[int], list[str]]:
    step = -(-len(values) // 8)
    places = list(range(0, len(values), step))
    return places, [values[i] for i in places]


def _map(sweep: Sweep, axes: Any, array: Any, keys: list[str], norm: Any) -> Any:
    down, across = keys
    shown = axes.imshow(array, origin="lower", aspect="auto", interpolation="nearest", cmap="viridis", norm=norm)
    axes.set_xticks(*_ticks([f"{one:.3g}" if isinstance(one, float) else one for one in sweep.axes[across]]), rotation=30, ha="right")
    axes.set_yticks(*_ticks([f"{one:.3g}" if isinstance(one, float) else one for one in sweep.axes[down]]))
    axes.set(xlabel=_name(sweep, across), ylabel=_name(sweep, down))
    return shown


def sweep_figure(sweep: Sweep, metric: str = "sigma_m", region: int = 0) -> Any:
    """A metric of a sweep: a curve over one axis, a heat map over two, small multiples over three.

    Parameters
    ----------
    sweep : Sweep
    metric : str
        One of those that it has.
    region : int
        Which of ``sweep.regions``; of a sweep over one axis all are drawn.

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
    import numpy as np

    names = {_label(name)[0].split(" [")[0].replace(" ", "_"): name for name in sweep}
    metric = names.get(metric, metric)
    if metric not in sweep:
        raise BadInput(f"metric: error: got {metric!r}\n  expected one of {', '.join(names)}")
    if not -len(sweep.regions) <= region < len(sweep.regions):
        raise BadInput(f"region: error: got {region}\n  expected 0 to {len(sweep.regions) - 1}: {', '.join(sweep.regions)}")
    keys = list(sweep.axes)
    if len(keys) > 3:
        raise BadInput(f"plot: error: the sweep has {len(keys)} axes\n  expected one to three; of more take sweep.npz or sweep.csv")
    try:
        Figure = importlib.import_module("matplotlib.figure").Figure
    except ImportError as fault:
        raise ImportError("plot() needs the package matplotlib") from fault
    label, scale = _label(metric)
    if len(keys) == 1:
        figure = Figure(figsize=(6.4 + (2.2 if len(sweep.regions) > 1 else 0), 4.2), layout="constrained")
        _curves(sweep, figure.subplots(), metric)
        return figure
    array = scale * sweep[metric][..., region]
    finite = array[np.isfinite(array)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 1.0)
    colors = importlib.import_module("matplotlib.colors")
    norm = (colors.LogNorm if _wide(array) else colors.Normalize)(low, high)
    layers = [array] if len(keys) == 2 else list(array)
    columns = 2 if len(layers) == 4 else min(len(layers), 3)
    rows = -(-len(layers) // columns)
    figure = Figure(figsize=(1.4 + 4.0 * columns, 0.6 + 3.4 * rows), layout="constrained")
    grid = figure.subplots(rows, columns, squeeze=False)
    for i, layer in enumerate(layers):
        axes = grid[i // columns, i % columns]
        shown = _map(sweep, axes, layer, keys[-2:], norm)
        if len(keys) == 3:
            axes.set_title(f"{_name(sweep, keys[0]).split(' [')[0]} = {sweep.texts[keys[0]][i]}", fontsize=9)
    for i in range(len(layers), rows * columns):
        grid[i // columns, i % columns].set_visible(False)
    ticks = _ticks_of_ratios() if _wide(array) else {}
    bar = figure.colorbar(shown, ax=grid, label=label, ticks=ticks.get("locator"), format=ticks.get("formatter"))
    bar.ax.yaxis.set_minor_formatter(importlib.import_module("matplotlib.ticker").NullFormatter())
    if len(sweep.regions) > 1:
        figure.suptitle(sweep.regions[region])
    return figure


def main(arguments: list[str] | None = None) -> int:
    """Draws one. Exit codes are those of ``tofray``.

    Parameters
    ----------
    arguments : list of str, optional
        None: those of the command line.

    Returns
    -------
    int
        0: it is drawn; 2: what was asked for cannot be; 3: matplotlib is missing, or the picture cannot be written.
    """
    parser = argparse.ArgumentParser(prog="python3 -m tofray.plot", description="a sweep's picture: a curve, a heat map or small multiples")
    parser.add_argument("sweep", help="folder of `tofray sweep -o`, or its sweep.npz")
    parser.add_argument("-o", "--output", help="picture to write: .png, .svg or .pdf (sweep.png in the folder)")
    parser.add_argument("--metric", default="sigma", help="what is drawn (sigma)")
    parser.add_argument("--region", type=int, default=0, metavar="N", help="which region of the sweep, from 0 on (0)")
    options = parser.parse_args(arguments)
    folder = options.sweep if os.path.isdir(options.sweep) else os.path.dirname(options.sweep)
    output = options.output or os.path.join(folder, "sweep.png")
    try:
        sweep_figure(load_sweep(options.sweep), options.metric, options.region).savefig(output, dpi=150)
    except Error as fault:
        print(fault, file=sys.stderr)
        return 2
    except (ImportError, OSError, ValueError) as fault:
        print(f"error: no picture: {fault}\n  expected matplotlib (Debian: python3-matplotlib), and a name that ends in .png, .svg or .pdf", file=sys.stderr)
        return 3
    print(output, file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
