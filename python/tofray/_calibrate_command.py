# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""``python3 -m tofray calibrate phase|temperature|lens …``: what has to be known of a specimen."""

from __future__ import annotations

import argparse
import json
import sys
from typing import TYPE_CHECKING, Any

from ._command_end import exit_code_of
from ._errors import BadInput
from ._fit_command import _finite, _setting

if TYPE_CHECKING:
    from ._calibrate import SpecimenCalibration

_HELP = """examples:
  python3 -m tofray calibrate phase pico-flexx 0.6m=walls/a 0.8m=walls/b 1.1m=walls/c 1.5m=walls/d -o specimen.yaml
  python3 -m tofray calibrate temperature pico-flexx --specimen specimen.yaml 20degC=cold 35degC=warm 50degC=hot -o warm.yaml
  tofray process out/frame.npz --set camera.decoding.calibration=specimen.yaml

walls: a matt one that faces the camera and fills its image; of each a folder of two or more npz files with raw frames
(tofray render --arrays +raw). Distances are z, where the optical axis meets the wall, at uneven steps over c/2Nf or more
(N reference phases; of an odd N half as much).
calibrate lens --help: the lens, out of images of a chessboard.
The file goes into decoding.calibration; `tofray calibration` is another command: it makes a profile's lens of an OpenCV or ROS file.
exit codes: 0, calibrated; 2, bad input; 3, a file or a package is missing."""


def _wall(text: str) -> tuple[float, str]:
    value, sign, path = text.partition("=")
    units = {"mm": 1e-3, "cm": 1e-2, "m": 1.0, "degC": 1.0, "C": 1.0}
    for unit, factor in units.items():
        number = value.strip().removesuffix(unit)
        if sign and path and number != value.strip():
            try:
                return float(number) * factor, path
            except ValueError:
                break
    raise argparse.ArgumentTypeError(f"got {text!r:.80}, expected a distance or a temperature and a folder, such as 0.8m=walls/b or 35degC=warm")


def parser() -> argparse.ArgumentParser:
    out = argparse.ArgumentParser(
        prog="python3 -m tofray calibrate", epilog=_HELP, formatter_class=argparse.RawDescriptionHelpFormatter,
        description="what decoding has to know of one specimen of a camera, out of its recordings of walls:\n"
                    "phase: offset, wiggling and each pixel's phase, from known distances; temperature: the drift of the range; lens has options of its own")

    def add(*names: str, help: str, **words: Any) -> None:
        out.add_argument(*names, help=help, **words)

    add("what", choices=["phase", "temperature"], help="what is looked for")
    add("profile", metavar="PROFILE", help="a profile's file or a built-in camera: its lens, the lights' places and its sequence are taken as known")
    add("walls", nargs="+", type=_wall, metavar="VALUE=FOLDER", help="distance or temperature, and frames with raw data")
    add("-o", "--output", required=True, metavar="FILE", help="the specimen's calibration (.yaml); pixels' phases (.npy) go beside it")
    add("--specimen", default="", metavar="FILE", help="temperature: the calibration that gets the drift")
    add("--mode", default="", metavar="NAME", help="the camera's mode (the profile's first)")
    add("--held-out", default=None, metavar="NUMBERS",
        help="walls, counted from 0, at which errors are taken of a calibration that has not seen them, with commas between (every fourth of 8 or more)")
    add("--orders", default=None, metavar="NUMBERS",
        help="phase: of the wiggling, so many times the measured phase (the first three that the reference phases let through: 4,8,12 of four)")
    add("--set", type=_setting, action="append", default=[], metavar="KEY=VALUE", help="change a key of the profile before; may be repeated")
    add("--json", action="store_true", help="one JSON object on stdout")
    return out


def json_of(found: SpecimenCalibration) -> dict[str, Any]:
    return {
        "reference_celsius": found.reference_celsius, "notes": found.notes,
        "frequencies": [{"modulation_frequency_hz": one.modulation_frequency_hz, "phase_offset_rad": one.phase_offset_rad,
                         "phase_offset_error_rad": _finite(one.phase_offset_error_rad), "drift_m_per_kelvin": one.drift_m_per_kelvin,
                         "drift_error_m_per_kelvin": _finite(one.drift_error_m_per_kelvin), "orders": one.orders,
                         "cos_rad": list(map(float, one.cos_rad)), "sin_rad": list(map(float, one.sin_rad)),
                         "cos_error_rad": list(map(float, one.cos_error_rad)), "sin_error_rad": list(map(float, one.sin_error_rad)),
                         "chi_square": _finite(one.chi_square)} for one in found.frequencies],
        "held_out": [{"distance_m": _finite(one.distance_m), "celsius": getattr(one, "celsius", None),
                      "modulation_frequency_hz": one.modulation_frequency_hz, "before_m": _finite(one.before_m), "after_m": _finite(one.after_m),
                      "spread_before_m": _finite(one.spread_before_m), "spread_after_m": _finite(one.spread_after_m)} for one in found.held_out],
    }


def _numbers(text: str | None, option: str) -> list[int] | None:
    if text is None:
        return None
    try:
        return [int(one) for one in text.split(",") if one.strip()]
    except ValueError:
        raise BadInput(f"{option}: error: got {text!r:.60}\n  expected whole numbers with commas between, such as 2,6") from None


def _run(options: argparse.Namespace) -> None:
    from ._calibrate import calibrate_phase, calibrate_temperature
    from ._calibration_file import read_specimen
    from ._load import load_camera

    camera = load_camera(options.profile, options.mode, set=dict(options.set))
    if options.what == "phase":
        found = calibrate_phase(camera, options.walls, orders=_numbers(options.orders, "--orders"),
                                held_out=_numbers(options.held_out, "--held-out"))
    else:
        if not options.specimen:
            raise BadInput("error: calibrate temperature lacks --specimen FILE\n  expected what `calibrate phase` wrote: the drift is added to it")
        found = calibrate_temperature(camera, options.walls, read_specimen(camera, options.profile, options.specimen))
    found.save(options.output)
    print(json.dumps(json_of(found)) if options.json else str(found), end="\n" if options.json else "")
    print(f"{options.output}: tofray process FRAME --set camera.decoding.calibration={options.output} decodes by it", file=sys.stderr)


def main(arguments: list[str]) -> int:
    """Calibrates. Exit codes are those of ``tofray``."""
    if arguments[:1] == ["lens"]:
        from ._lens_command import main as lens

        return lens(arguments[1:])
    return exit_code_of(_run, parser().parse_args(arguments))
