# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A specimen's calibration as a file, and as a report."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING

from ._errors import BadInput, IoError

if TYPE_CHECKING:
    from ._calibrate import FrequencyResult, SpecimenCalibration
    from ._model import Camera


def _list(values: list[float]) -> str:
    return "[" + ", ".join(f"{value:.8g} rad" for value in values) + "]"


def _wiggling(one: FrequencyResult) -> list[str]:
    most = max(one.orders, default=0)
    if most == 0:
        return []
    at = {order: i for i, order in enumerate(one.orders)}
    cosines = [float(one.cos_rad[at[m]]) if m in at else 0.0 for m in range(1, most + 1)]
    sines = [float(one.sin_rad[at[m]]) if m in at else 0.0 for m in range(1, most + 1)]
    return ["    wiggling:", f"      cos: {_list(cosines)}", f"      sin: {_list(sines)}"]


def write_specimen(found: SpecimenCalibration, file: str) -> None:
    import numpy as np

    if not file.endswith((".yaml", ".yml")):
        raise BadInput(f"{file}: error: a calibration's file ends in .yaml\n  expected for instance specimen.yaml")
    stem = os.path.splitext(file)[0]
    lines = ["# What decoding has to know of one specimen: decoding.calibration of a profile names this file.", "kind: specimen",
             f"reference: {found.reference_celsius:.6g} degC", "frequencies:"]
    try:
        os.makedirs(os.path.dirname(file) or ".", exist_ok=True)
        for one in found.frequencies:
            pixels = f"{stem}_{1e-6 * one.modulation_frequency_hz:.6g}MHz.npy"
            np.save(pixels, one.pixel_phase_rad.astype(np.float32))
            lines += [f"  - modulation_frequency: {1e-6 * one.modulation_frequency_hz:.12g} MHz", f"    phase_offset: {one.phase_offset_rad:.8g} rad",
                      f"    drift: {1e3 * one.drift_m_per_kelvin:.8g} mm/K", *_wiggling(one), f"    pixel_phase: {os.path.basename(pixels)}"]
        with open(file, "w", encoding="utf-8") as out:
            out.write("\n".join(lines) + "\n")
    except OSError as fault:
        raise IoError(f"{fault.filename or file}: error: it cannot be written\n  {fault.strerror}") from None


def _millimetres(value: float) -> str:
    return "" if math.isnan(value) else f" {1e3 * value:6.2f}"


def _error(value: float, digits: int) -> str:
    """Thousandths; nothing of what is not known."""
    return f" +- {1e3 * value:.{digits}f}" if math.isfinite(value) else ""


def report(found: SpecimenCalibration) -> str:
    import numpy as np

    lines = [f"at {found.reference_celsius:g} degC"]
    for one in found.frequencies:
        half = 299792458.0 / (4 * math.pi * one.modulation_frequency_hz) * 1e3
        lines.append(f"{1e-6 * one.modulation_frequency_hz:g} MHz (1 mm is {1e3 / half:.2f} mrad)")
        lines.append(f"  offset    {1e3 * one.phase_offset_rad:9.2f}{_error(one.phase_offset_error_rad, 2)} mrad")
        for order, c, s, ce, se in zip(one.orders, one.cos_rad, one.sin_rad, one.cos_error_rad, one.sin_error_rad):
            lines.append(f"  order {order:2d}  {1e3 * c:9.3f}{_error(ce, 3)} mrad cos, {1e3 * s:9.3f}{_error(se, 3)} mrad sin")
        error = float(np.nanmedian(one.pixel_phase_error_rad)) if np.isfinite(one.pixel_phase_error_rad).any() else math.nan
        lines.append(f"  pixels    {1e3 * float(one.pixel_phase_rad.std()):9.2f} mrad from pixel to pixel" + (f", each known to {1e3 * error:.2f} mrad" if math.isfinite(error) else ""))
        if math.isfinite(one.drift_error_m_per_kelvin):
            lines.append(f"  drift     {1e3 * one.drift_m_per_kelvin:9.4f} +- {1e3 * one.drift_error_m_per_kelvin:.4f} mm/K")
        if math.isfinite(one.chi_square):
            lines.append(f"  chi^2     {one.chi_square:9.2f} for each degree of freedom")
    if found.held_out:
        lines += ["", "held out           without           with calibration (mean, and pixel to pixel)"]
    for row in found.held_out:
        celsius = getattr(row, "celsius", None)
        where = f"{row.distance_m:.3f} m" if celsius is None else f"{celsius:.1f} degC"
        lines.append(f"{where:>10} {1e-6 * row.modulation_frequency_hz:7.2f} MHz {1e3 * row.before_m:8.2f}{_millimetres(row.spread_before_m)} mm "
                     f"{1e3 * row.after_m:8.2f}{_millimetres(row.spread_after_m)} mm")
    lines += found.notes
    return "\n".join(lines) + "\n"


def read_specimen(camera: Camera, profile: str, file: str) -> SpecimenCalibration:
    """What a specimen's file says, without errors.

    Raises
    ------
    Error
        For a file that is none, or of another camera, by its place.
    """
    import numpy as np

    from ._calibrate import FrequencyResult, SpecimenCalibration
    from ._load import load_camera
    from ._simulator import pixel_rays

    known = load_camera(profile, camera.mode.name, set={"decoding.calibration": file}).decoding.calibration
    if known.kind != "specimen":
        raise BadInput(f"{file}: error: this is no specimen's calibration\n  expected what `calibrate phase` wrote")
    shape = pixel_rays(camera).shape[:2]
    frequencies = []
    for row in known.frequencies:
        one = FrequencyResult(row.modulation_frequency_hz, (shape[0], shape[1]))
        one.phase_offset_rad, one.drift_m_per_kelvin = row.phase_offset_rad, row.drift_m_per_kelvin
        one.orders = [i + 1 for i, both in enumerate(zip(row.wiggling_cos_rad, row.wiggling_sin_rad)) if any(both)]
        one.cos_rad, one.sin_rad = (np.array([part[m - 1] for m in one.orders]) for part in (row.wiggling_cos_rad, row.wiggling_sin_rad))
        one.cos_error_rad = one.sin_error_rad = np.full(len(one.orders), np.nan)
        if len(row.pixel_phase_rad):
            one.pixel_phase_rad = np.array(row.pixel_phase_rad).reshape(shape)
        frequencies.append(one)
    return SpecimenCalibration(frequencies, known.reference_celsius)
