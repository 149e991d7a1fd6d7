# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Figures of a frame by matplotlib, which is asked for only here."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._errors import BadInput

if TYPE_CHECKING:
    from ._frame import Frame


def plot(frame: Frame, what: str = "z") -> Any:
    """One figure of a frame: "z", "amplitude", "error", "raw" or "cloud"."""
    makers = {"z": _z, "amplitude": _amplitude, "error": _error, "raw": _raw, "cloud": _cloud}
    if what not in makers:
        raise BadInput(f"what: error: got {what!r}\n  expected one of {', '.join(makers)}")
    import importlib

    try:
        Figure = importlib.import_module("matplotlib.figure").Figure
    except ImportError as fault:
        raise ImportError("plot() needs the package matplotlib; preview() needs none") from fault
    figure = Figure(figsize=(6.4, 4.8), layout="constrained")
    makers[what](frame, figure)
    return figure


def _span(values: Any) -> tuple[float, float]:
    """Without the hundredth at either end: a few pixels of a wrong cycle shall not set the scale."""
    import numpy as np

    finite = values[np.isfinite(values)]
    low, high = (float(one) for one in np.percentile(finite, (1, 99))) if finite.size else (0.0, 1.0)
    return low, high


def _image(figure: Any, values: Any, label: str, extend: str = "neither", **looks: Any) -> None:
    axes = figure.add_subplot()
    figure.colorbar(axes.imshow(values, interpolation="nearest", **looks), label=label, extend=extend)
    axes.set(xlabel="column", ylabel="row")


def _z(frame: Frame, figure: Any) -> None:
    low, high = _span(frame.depth.z_m)
    _image(figure, frame.depth.z_m, "z [m]", "both", cmap="viridis_r", vmin=low, vmax=high)


def _amplitude(frame: Frame, figure: Any) -> None:
    _image(figure, frame.depth.amplitude_e, "amplitude [e]", cmap="gray")


def _error(frame: Frame, figure: Any) -> None:
    import numpy as np

    error = 1e3 * (frame.depth.z_m - frame.truth.z_m)
    finite = np.abs(error[np.isfinite(error)])
    scale = float(np.percentile(finite, 98)) if finite.size else 1.0
    _image(figure, error, "z - true z [mm]", "both", cmap="RdBu_r", vmin=-scale, vmax=scale)


def _raw(frame: Frame, figure: Any) -> None:
    import numpy as np

    stack, label = frame.raw.get("raw"), "raw [DN]"
    if stack is None:
        stack, label = frame.raw.tap_a - frame.raw.tap_b, "A - B [e]"
    lit = frame.raw.get("lit")
    shown = stack if lit is None or not np.any(lit) else stack[np.asarray(lit, bool)]
    low, high = (float(one) for one in np.percentile(shown, (0.5, 99.5)))
    columns = 3
    image = None
    for k, values in enumerate(stack):
        axes = figure.add_subplot(-(-len(stack) // columns), columns, k + 1)
        image = axes.imshow(values, cmap="gray", interpolation="nearest", vmin=low, vmax=high)
        axes.set(xticks=[], yticks=[])
        axes.set_title(_title_of(frame, k), fontsize=8)
    figure.colorbar(image, ax=figure.axes, label=label, extend="both")


def _title_of(frame: Frame, k: int) -> str:
    """What a raw frame was taken with: "80.32 MHz, 90 deg"."""
    import math

    frequencies, phases, lit = (frame.raw.get(name) for name in ("modulation_frequency_hz", "reference_phase_rad", "lit"))
    if frequencies is None:
        return ""
    if not frequencies[k] > 0 or (lit is not None and not lit[k]):
        return "unlit"
    title = f"{frequencies[k] / 1e6:g} MHz"
    return title if phases is None else f"{title}, {math.degrees(phases[k]):.4g} deg"


def _cloud(frame: Frame, figure: Any) -> None:
    x, y, z = frame.points().T
    spans = [_span(axis) for axis in (x, z, -y)]
    inside = (z >= spans[1][0]) & (z <= spans[1][1])
    axes = figure.add_subplot(projection="3d")
    axes.scatter(x[inside], z[inside], -y[inside], c=z[inside], cmap="viridis_r", s=1)
    axes.set(xlabel="x [m]", ylabel="z [m]", zlabel="-y [m]")
    axes.set_box_aspect([max(high - low, 1e-3) for low, high in spans])
