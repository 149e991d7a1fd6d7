# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A lens that was found, as a file and as a report."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

from ._errors import BadInput, IoError

if TYPE_CHECKING:
    from ._calibrate_lens import LensCalibration


def write_lens(found: LensCalibration, file: str) -> None:
    if not file.endswith((".yaml", ".yml")):
        raise BadInput(f"{file}: error: a calibration's file ends in .yaml\n  expected for instance lens.yaml")
    one = found.values
    matrix = [one["fx"], 0.0, one["cx"], 0.0, one["fy"], one["cy"], 0.0, 0.0, 1.0]
    bent = [value for name, value in one.items() if name[0] in "kp"]
    lines = ["# A lens, as ROS's camera_calibration writes it: tofray calibration FILE --camera PROFILE makes a profile of it.",
             f"image_width: {found.size[0]}", f"image_height: {found.size[1]}", "camera_name: tof",
             f"camera_matrix: {{rows: 3, cols: 3, data: {_list(matrix)}}}", f"distortion_model: {found.model}",
             f"distortion_coefficients: {{rows: 1, cols: {len(bent)}, data: {_list(bent)}}}"]
    try:
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
        with open(file, "w", encoding="utf-8") as out:
            out.write("\n".join(lines) + "\n")
    except OSError as fault:
        raise IoError(f"{fault.filename or file}: error: it cannot be written\n  {fault.strerror}") from None


def _list(values: list[float]) -> str:
    return "[" + ", ".join(f"{value:.9g}" for value in values) + "]"


def report(found: LensCalibration) -> str:
    lines = [f"{found.model} of {found.views} images with {found.corners} corners each"]
    for name, value in found.values.items():
        pixels = name in ("fx", "fy", "cx", "cy")
        lines.append(f"  {name}  {value:12.{4 if pixels else 6}f} +- {found.errors[name]:.{4 if pixels else 6}f}{' px' if pixels else ''}")
    held = "" if math.isnan(found.held_out_px) else f"; {found.held_out_px:.4f} px of images held out"
    lines += [f"residual  {found.residual_px:.4f} px rms{held}",
              f"rays      known to {found.ray_error_px:.4f} px rms over the image, {found.worst_ray_error_px:.4f} px at worst",
              f"change    {found.change_px:.4f} px rms from the profile's lens, {found.worst_change_px:.4f} px at most", *found.notes]
    return "\n".join(lines) + "\n"


def json_of(found: LensCalibration) -> dict[str, Any]:
    return {"model": found.model, "width": found.size[0], "height": found.size[1], "values": found.values, "errors": found.errors,
            "images": found.views, "corners": found.corners, "residual_px": found.residual_px, "residuals_px": found.residuals_px,
            "held_out_px": None if math.isnan(found.held_out_px) else found.held_out_px,
            "ray_error_px": found.ray_error_px, "worst_ray_error_px": found.worst_ray_error_px,
            "change_px": found.change_px, "worst_change_px": found.worst_change_px, "notes": found.notes}
