# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What a fit found, for people: report, table, patch, diff, picture."""

from __future__ import annotations

import difflib
import importlib
import math
import os
import re
from typing import TYPE_CHECKING, Any

from . import _native
from ._errors import Error
from ._fit_model import _HARMONIC
from ._profile_text import with_values

if TYPE_CHECKING:
    from ._fit import Fit

_KINDS = {"sigma": "range noise", "bias": "bias", "intensity": "intensity"}


def _scatter(kind: str, value: float) -> str:
    return f"{1e3 * value:.3g} mm" if kind == "bias" else f"{100 * value:.1f} %"


def _error(one: Any) -> str:
    from ._fit import _rounded

    return _rounded(one.error, one.error) + (f" {one.unit}" if one.unit else "")


def _columns(lines: list[list[str]]) -> str:
    widths = [max(len(line[i]) for line in lines) for i in range(len(lines[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths)).rstrip() for line in lines)


def _profile_name(fit: Fit) -> str:
    return os.path.basename(fit._model.profile)


def report(fit: Fit) -> str:
    """All that is known of it, as text."""
    lines = [["", "start", "fitted", "standard error"]]
    for one in fit.parameters:
        start = f"{one.start:.6g}" + (f" {one.unit}" if one.unit else "")
        lines.append([one.key, start, one.text, _error(one) + (", at an end of its range" if one.at_end else "")])
    modes = ", ".join(mode or fit.camera().mode.name for mode in fit._model.modes)
    out = [f"{_profile_name(fit)}, {modes}: fitted to {fit.rows.said()}", "", _columns(lines), ""]
    for kind, value in fit.scatter.items():
        before = fit.scatter_before[kind]
        out.append(f"scatter of {_KINDS[kind]}: {_scatter(kind, value)} rms, {_scatter(kind, fit.robust_scatter[kind])} by its median"
                   + ("" if math.isnan(before) else f"; {_scatter(kind, before)} with the values in force"))
    lost = int(fit.predicted["saturated"].sum())
    if lost:
        out.append(f"{lost} rows are saturated with what was found")
    if any(_HARMONIC.fullmatch(one.key) for one in fit.parameters) and math.isfinite(fit.hump_period_m):
        out.append(f"humps by harmonics: period {fit.hump_period_m:.3f} m")
    if fit.kappa is not None:
        out.append(f"kappa: {fit.kappa[0]:.4g} e m2 +- {100 * fit.kappa[1]:.2g} %, electrons of a raw frame times distance squared over\n"
                   "  reflectivity. All factors of the signal (light, exposure, lens, pixel, the walls' reflectivity) are in it;\n"
                   "  the rows cannot tell them apart")
    out += ["", f"correlations (condition number {fit.condition:.3g})"]
    count = len(fit.parameters)
    out.append(_columns([[f"{i + 1}", one.key, *(f"{fit.correlation[i, j]:+.2f}" if j <= i else "" for j in range(count))]
                         for i, one in enumerate(fit.parameters)]))
    return "\n".join(out) + "\n"


def table(fit: Fit, step: int) -> str:
    """Medians of `step` rows each, by distance; where there is none by intensity."""
    import numpy as np

    x, name, _ = _abscissa(fit)
    out = []
    for kind, column, scale, unit in (("sigma", "sigma_m", 1e3, "mm"), ("bias", "bias_m", 1e3, "mm"), ("intensity", "intensity", 1.0, "")):
        if kind not in fit.residuals:
            continue
        measured, fitted = fit.rows.number(column), fit.predicted[column]
        order = [i for i in np.argsort(x, kind="stable") if np.isfinite(measured[i])]
        unit = f", {unit}" if unit else ""
        out.append(f"| {name} | {_KINDS[kind]} measured{unit} | fitted{unit} | | |\n|---|---|---|---|---|")
        for first in range(0, len(order), step):
            part = order[first : first + step]
            at, real, here = (float(np.nanmedian(array[part])) for array in (x, measured, fitted))
            off = f"{1e3 * (here - real):+.1f} mm" if kind == "bias" else f"{here / real - 1:+.0%}"
            out.append(f"| {at:.3g} | {scale * real:.3g} | {scale * here:.3g} | {off} | fitted |")
        out.append("")
    return "\n".join(out)


def _source(fit: Fit, one: Any) -> str:
    return f"fitted to {fit.rows.said()}; standard error {_error(one)}"


def _list(numbers: list[float]) -> str:
    return "[" + ", ".join(f"{one:.5f}" for one in numbers) + "]"


def changes(fit: Fit) -> list[tuple[str, str, str]]:
    """Keys of the profile, their values as it writes them, and where these come from; "" where `set` said so."""
    model = fit._model
    found = {key: one for one, unknown in zip(fit.parameters, model.unknowns) for key in unknown.keys}
    lights = model.harmonics_at(fit._values)
    out = []
    for key, text in model.words.items():
        covered = any(key == f"illumination.{light}.waveform" or key.startswith(f"illumination.{light}.waveform.") for light in lights)
        if key not in found and not covered:
            out.append((key, text, ""))
    for key, one in found.items():
        if not _HARMONIC.fullmatch(key):
            out += [(where, one.text, _source(fit, one)) for where in _written(fit, key)]
    for light, harmonics in lights.items():
        place = f"illumination.{light}.waveform"
        said = "; ".join(f"{key.rsplit('.', 1)[1]} {one.text}, standard error {_error(one)}"
                         for key, one in found.items() if key.startswith(place))
        source = f"fitted to {fit.rows.said()}: {said}"
        samples = _list(harmonics.samples())
        written = _native.load_camera(model.profile, model.modes[0], {}, "").illumination[light].waveform
        same = written.kind == "measured" and written.harmonics == harmonics.count and place not in model.words
        if same and place + ".correlation" in model.places:
            out.append((place + ".correlation", samples, source))
        else:
            out.append((place, f"{{kind: measured, correlation: {samples}, harmonics: {harmonics.count}", source))
    return out


def _written(fit: Fit, key: str) -> list[str]:
    """Where a profile writes it: an exposure stands in each raw frame of the mode."""
    if key != "integration_time" or key in fit._model.places:
        return [key]
    modes = [fit.camera(mode).mode.name for mode in fit._model.modes]
    patterns = [rf"modes\.{re.escape(mode)}\.sequence\.\d+\.integration_time" for mode in modes]
    return [one for one in fit._model.places if any(re.fullmatch(pattern, one) for pattern in patterns)]


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _value(text: str, source: str) -> str:
    if not source:
        return text
    if text.startswith("{"):  # left open for it
        return f"{text}, source: {_quoted(source)}}}"
    return f"{{value: {text}, source: {_quoted(source)}}}"


def patch(fit: Fit) -> str:
    """By key what was found."""
    lines = [f"# {_profile_name(fit)}: by key what a person may write into the profile; `tofray fit` changes none. Scatter of "
             + ", ".join(f"{_KINDS[kind]} {_scatter(kind, value)}" for kind, value in fit.scatter.items())]
    for one in fit.parameters:
        value, error = one.text, _error(one)
        key, source = _quoted(one.key) if " " in one.key or "*" in one.key else one.key, _quoted("fitted to " + fit.rows.said())
        lines.append(f"{key}: {{value: {value}, standard_error: {error}, source: {source}}}")
    if fit.kappa is not None:
        lines.append(f"kappa: {{value: {fit.kappa[0]:.4g}, standard_error: {fit.kappa[0] * fit.kappa[1]:.2g}, unit: e m2}}")
    for light, harmonics in fit._model.harmonics_at(fit._values).items():
        samples = _list(harmonics.samples())
        lines.append(f"illumination.{light}.waveform: {{kind: measured, correlation: {samples}, harmonics: {harmonics.count}}}")
    return "\n".join(lines) + "\n"


def changed_text(fit: Fit) -> str:
    """The profile's text with what was found, its comments as they were. Read back and compared with the fit.

    Raises
    ------
    Error
        Where the text cannot be changed in one place alone.
    """
    import numpy as np

    model = fit._model
    text = with_values(model.text, model.places, [(key, _value(value, source)) for key, value, source in changes(fit)])
    name = model.profile if os.path.exists(model.profile) else "<" + model.profile + ">"
    for mode in model.modes:
        camera = _native.load_camera_text(text, name, mode, {})
        here, there = (model._budget(one, [0.7, 1.3, 2.9], 0.3, 0.0)["amplitude_e"] for one in (camera, fit.camera(mode)))
        if not np.allclose(here, there, rtol=0.02, equal_nan=True):
            raise Error(f"{model.source}: error: the profile with what was found is another camera than the fit's\n"
                        "  the places to change are those of the patch")
    return text


def diff(fit: Fit) -> str:
    """What would change in the profile's file."""
    name = fit._model.profile
    file = name if os.path.exists(name) else f"profiles/{name}.yaml"
    lines = difflib.unified_diff(fit._model.text.splitlines(True), changed_text(fit).splitlines(True), file, file)
    return "".join(lines)


def _abscissa(fit: Fit) -> tuple[Any, str, bool]:
    import numpy as np

    distance = fit._model.distance
    return (distance, "m", True) if np.isfinite(distance).any() else (fit._model.intensity, "intensity", False)


def figure(fit: Fit) -> Any:
    """Rows and fit, and their ratio below."""
    import numpy as np

    try:
        Figure = importlib.import_module("matplotlib.figure").Figure
    except ImportError as fault:
        raise ImportError("plot() needs the package matplotlib (Debian: python3-matplotlib)") from fault
    x, name, by_distance = _abscissa(fit)
    kind = next(iter(fit.residuals))
    column, scale = {"sigma": ("sigma_m", 1e3), "bias": ("bias_m", 1e3), "intensity": ("intensity", 1.0)}[kind]
    drawing = Figure(figsize=(6.8, 6.0), layout="constrained")
    above, below = drawing.subplots(2, 1, sharex=True, height_ratios=(2.2, 1))
    classes = np.array([f"{one}, {mode}" if mode else one for one, mode in zip(fit.rows.word("class", "measured"), fit.rows.word("mode"))])
    for i, one in enumerate(dict.fromkeys(classes.tolist())):
        rows = np.flatnonzero((classes == one) & np.isfinite(fit.rows.number(column)))
        rows = rows[np.argsort(x[rows], kind="stable")]
        above.plot(x[rows], scale * fit.rows.number(column)[rows], ".", color=f"C{i}", alpha=0.6, label=one)
        label = f"{one}, fitted" if len(set(classes)) > 1 else "fitted"
        above.plot(x[rows], scale * fit.predicted[column][rows], "-", color=f"C{i}", label=label)
        off = fit.residuals[kind][rows]
        below.plot(x[rows], 1e3 * off if kind == "bias" else 100 * np.expm1(off), ".", color=f"C{i}", alpha=0.6)
    ticker = importlib.import_module("matplotlib.ticker")
    if kind != "bias":
        above.set_yscale("log")
        above.yaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        above.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        above.yaxis.set_minor_formatter(ticker.NullFormatter())
    if not by_distance:
        above.set_xscale("log")
        below.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
        below.xaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        below.xaxis.set_minor_formatter(ticker.NullFormatter())
    above.set(ylabel=_KINDS[kind] + (" [mm]" if scale > 1 else " [device units]"), title=f"{_profile_name(fit)}: {fit.rows.said()}")
    above.title.set_fontsize(10)
    below.axhline(0, color="0.5", linewidth=1)
    below.set(xlabel="distance [m]" if by_distance else "intensity [device units]",
              ylabel="fitted - measured [mm]" if kind == "bias" else "fitted / measured - 1 [%]")
    for axes in (above, below):
        axes.grid(alpha=0.3)
    above.legend()
    return drawing
