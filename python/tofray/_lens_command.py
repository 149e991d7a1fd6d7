# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""``python3 -m tofray calibrate lens …``: the lens of one specimen, out of its images of a chessboard."""

from __future__ import annotations

import argparse
import json
import sys
from typing import Any

from ._calibrate_command import _numbers
from ._command_end import exit_code_of
from ._fit_command import _setting

_HELP = """examples:
  python3 -m tofray calibrate lens pico-flexx boards/*.npz --board 11x8 --square 24mm -o lens.yaml
  tofray calibration lens.yaml --camera pico-flexx > calibrated.yaml

images: amplitudes of one flat chessboard, each of another view: frames (.npz), grey pictures (.png, 8 or 16 bits), or folders with several
frames of one view, whose mean is taken. 20 views or so, the board turned by 20 to 40 degrees to several sides, some with corners near to
each corner of the image, no edge along the pixels' rows. --board counts inner corners, as OpenCV and ROS do: 11x8 of 12 x 9 squares.
exit codes: 0, calibrated; 2, bad input; 3, a file or a package (OpenCV) is missing."""


def _board(text: str) -> tuple[int, int]:
    columns, sign, rows = text.partition("x")
    if not (sign and columns.isdecimal() and rows.isdecimal()):
        raise argparse.ArgumentTypeError(f"got {text!r:.40}, expected inner corners along a row and a column, such as 11x8")
    return int(columns), int(rows)


def _length(text: str) -> float:
    for unit, factor in {"mm": 1e-3, "cm": 1e-2, "m": 1.0}.items():
        number = text.strip().removesuffix(unit)
        if number != text.strip():
            try:
                return float(number) * factor
            except ValueError:
                break
    raise argparse.ArgumentTypeError(f"got {text!r:.40}, expected a length with its unit, such as 24mm")


def parser() -> argparse.ArgumentParser:
    out = argparse.ArgumentParser(
        prog="python3 -m tofray calibrate lens", epilog=_HELP, formatter_class=argparse.RawDescriptionHelpFormatter,
        description="focal lengths, principal point and distortion of one specimen of a camera, out of its images of a chessboard")

    def add(*names: str, help: str, **words: Any) -> None:
        out.add_argument(*names, help=help, **words)

    add("profile", metavar="PROFILE", help="a profile's file or a built-in camera: its sensor's size, and its lens to start from")
    add("images", nargs="+", metavar="IMAGE", help="a frame, a picture, or a folder with frames of one view")
    add("--board", required=True, type=_board, metavar="COLUMNSxROWS", help="inner corners along a row and along a column of the board")
    add("--square", required=True, type=_length, metavar="LENGTH", help="side of a square, such as 24mm")
    add("-o", "--output", required=True, metavar="FILE", help="the lens (.yaml), as ROS writes it, for `tofray calibration`")
    add("--model", default=None, choices=["plumb_bob", "rational_polynomial", "equidistant"], help="distortion (as the profile's lens has it)")
    add("--mode", default="", metavar="NAME", help="the camera's mode (the profile's first)")
    add("--held-out", default=None, metavar="NUMBERS",
        help="images, counted from 0, at which the residual is taken of a lens found without them, with commas between (every fourth of 8 or more)")
    add("--set", type=_setting, action="append", default=[], metavar="KEY=VALUE", help="change a key of the profile before; may be repeated")
    add("--json", action="store_true", help="one JSON object on stdout")
    return out


def _run(options: argparse.Namespace) -> None:
    from ._calibrate_lens import calibrate_lens
    from ._lens_file import json_of
    from ._load import load_camera

    camera = load_camera(options.profile, options.mode, set=dict(options.set))
    found = calibrate_lens(camera, options.images, board=options.board, square_m=options.square, model=options.model,
                           held_out=_numbers(options.held_out, "--held-out"))
    found.save(options.output)
    print(json.dumps(json_of(found)) if options.json else str(found), end="\n" if options.json else "")
    print(f"{options.output}: tofray calibration {options.output} --camera {options.profile} makes a profile of it", file=sys.stderr)


def main(arguments: list[str]) -> int:
    """Calibrates. Exit codes are those of ``tofray``."""
    return exit_code_of(_run, parser().parse_args(arguments))
