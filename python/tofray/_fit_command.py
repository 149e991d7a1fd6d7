# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""``python3 -m tofray fit …``: numbers of a profile out of measurements."""

from __future__ import annotations

import argparse
import json
import math
import os
import sys
import warnings
from typing import TYPE_CHECKING, Any

from ._command_end import exit_code_of
from ._errors import BadInput, IoError

if TYPE_CHECKING:
    from ._fit import Fit

_HELP = """examples:
  python3 -m tofray fit o3d303 noise.csv --free illumination.0.power,pixel.read_noise -o fitted
  python3 -m tofray fit kinect-v2 noise.csv --free 'illumination.*.power' --where "distance_m>2.4"
  python3 -m tofray fit own.yaml white.csv black.csv --free pixel.read_noise --scale-free reflectivity
  python3 -m tofray fit o3d303 noise.dat --columns distance_mm,sigma_mm --free illumination.0.waveform.r3,illumination.0.waveform.psi3

columns: distance_m, sigma_mm, bias_mm (each in m, cm or mm), intensity, reflectivity, class, mode, ambient_lx, recording.
No profile is changed: fitted/patch.yaml says what was found, fitted/profile.diff what it would change.
exit codes: 0, fitted; 1, the rows do not say what was asked for; 2, bad input; 3, a file or a package is missing."""


def _words(text: str) -> list[str]:
    return [one.strip() for one in text.split(",") if one.strip()]


def _setting(text: str) -> tuple[str, str]:
    key, sign, value = text.partition("=")
    if not sign or not key:
        raise argparse.ArgumentTypeError(f"got {text!r:.60}, expected KEY=VALUE")
    return key.strip(), value.strip()


def _share(text: str) -> float:
    try:
        value = 0.01 * float(text[:-1]) if text.endswith("%") else float(text)
    except ValueError:
        value = 0.0
    if not 0 < value <= 1:
        raise argparse.ArgumentTypeError(f"got {text!r:.40}, expected above 0 and at most 1, such as 40%")
    return value


def parser() -> argparse.ArgumentParser:
    out = argparse.ArgumentParser(
        prog="python3 -m tofray fit", epilog=_HELP, formatter_class=argparse.RawDescriptionHelpFormatter,
        description="numbers of a camera profile with which `tofray budget` says what was measured of walls;\n"
                    "their errors, and what cannot be known")

    def add(*names: str, help: str, **words: Any) -> None:
        out.add_argument(*names, help=help, **words)

    add("profile", metavar="PROFILE", help="a profile's file or a built-in camera; it is not changed")
    add("rows", nargs="+", metavar="FILE", help="measurements: text with named columns")
    add("--free", required=True, type=_words, metavar="KEYS",
        help="keys whose numbers are looked for, with commas between; illumination.0.waveform.r3 and .psi3: its third harmonic")
    add("--scale-free", type=_words, default=[], metavar="WORDS",
        help="what else is not known: reflectivity (of each class), intensity (its unit), bias (its offset)")
    add("--where", default="", metavar="TEXT", help='which rows count: "distance_m>2.4, sigma_mm<250"')
    add("--columns", type=_words, default=[], metavar="NAMES", help="names of the columns of a file whose first line has none")
    add("--mode", default="", metavar="NAME", help="mode of rows that name none (the profile's first)")
    add("--reflectivity", type=_share, default=0.8, metavar="SHARE", help="of rows that name none (80%%)")
    add("--set", type=_setting, action="append", default=[], metavar="KEY=VALUE",
        help="change a key of the profile before; may be repeated")
    add("-o", "--output", default="", metavar="FOLDER", help="patch.yaml, profile.diff, rows.csv, table.md and fit.json go there")
    add("--plot", nargs="?", const="fit.png", default="", metavar="PICTURE",
        help="a picture of rows and fit: .png, .svg or .pdf (fit.png; in FOLDER)")
    add("--json", action="store_true", help="one JSON object on stdout")
    return out


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def json_of(found: Fit) -> dict[str, Any]:
    return {
        "profile": found._model.profile, "modes": [mode or found.camera().mode.name for mode in found._model.modes],
        "rows": len(found.rows), "rows_read": found.rows.total, "sources": found.rows.sources, "where": found.rows.where,
        "parameters": [{"key": one.key, "unit": one.unit, "value": one.value, "standard_error": _finite(one.error), "start": one.start,
                        "at_end": one.at_end} for one in found.parameters],
        "scatter": {kind: _finite(value) for kind, value in found.scatter.items()},
        "scatter_before": {kind: _finite(value) for kind, value in found.scatter_before.items()},
        "correlation": found.correlation.tolist(), "condition": found.condition, "hump_period_m": _finite(found.hump_period_m),
        "kappa_e_m2": None if found.kappa is None else found.kappa[0],
    }


def _rows_csv(found: Fit) -> str:
    columns = {"sigma": "sigma_m", "bias": "bias_m", "intensity": "intensity"}
    kinds = [columns[kind] for kind in found.residuals]
    lines = [",".join(["place", "distance_m", *(one for column in kinds for one in (column, "fitted_" + column)), "residual"])]
    first = next(iter(found.residuals.values()))
    for i, place in enumerate(found.rows.places):
        cells = [place, f"{found._model.distance[i]:.6g}"]
        for column in kinds:
            cells += [f"{found.rows.number(column)[i]:.6g}", f"{found.predicted[column][i]:.6g}"]
        lines.append(",".join([*cells, f"{first[i]:.6g}"]))
    return "\n".join(lines) + "\n"


def _write(found: Fit, folder: str) -> None:
    files = {"patch.yaml": found.patch(), "profile.diff": found.diff(), "rows.csv": _rows_csv(found), "table.md": found.table(),
             "fit.json": json.dumps(json_of(found), indent=2) + "\n"}
    try:
        os.makedirs(folder, exist_ok=True)
        for name, text in files.items():
            with open(os.path.join(folder, name), "w", encoding="utf-8") as out:
                out.write(text)
    except OSError as fault:
        raise IoError(f"{folder}: error: it cannot be written\n  {fault.strerror}") from None


def _run(options: argparse.Namespace) -> None:
    from ._fit import fit

    with warnings.catch_warnings(record=True) as notes:
        warnings.simplefilter("always", UserWarning)
        found = fit(options.profile, options.rows, options.free, scale_free=options.scale_free, mode=options.mode, set=dict(options.set),
                    reflectivity=options.reflectivity, columns=options.columns, where=options.where)
    for note in notes:
        print(note.message, file=sys.stderr)
    if options.output:
        _write(found, options.output)
    if options.plot:
        picture = os.path.join(options.output, options.plot) if options.output and not os.path.isabs(options.plot) else options.plot
        if not picture.endswith((".png", ".svg", ".pdf")):
            raise BadInput(f"--plot: error: got {options.plot!r:.60}\n  expected a name that ends in .png, .svg or .pdf")
        try:
            found.plot().savefig(picture, dpi=150)
        except OSError as fault:
            raise IoError(f"{picture}: error: it cannot be written\n  {fault.strerror}") from None
    if options.json:
        print(json.dumps(json_of(found)))
        return
    print(found, end="")
    if options.output:
        print(f"\n{os.path.join(options.output, '')}: patch.yaml, profile.diff, rows.csv, table.md, fit.json", file=sys.stderr)
    else:
        print("\n" + found.diff(), end="")


def main(arguments: list[str]) -> int:
    """Fits. Exit codes are those of ``tofray``."""
    return exit_code_of(_run, parser().parse_args(arguments))
