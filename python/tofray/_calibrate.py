# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What decoding has to know of one specimen of a camera, out of its raw frames of walls at known distances and temperatures."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

from ._calibration_file import write_specimen
from ._errors import BadInput
from ._walls import Wall, WallPhases, expected_phase, phases_of, walls_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from ._frame import Frame
    from ._model import Camera

LIGHT_SPEED = 299792458.0
_HIGHEST = 32
_BLURRED = 0.05  # rad: what is known worse than this is not known


class FrequencyResult:
    """What was found at one modulation frequency.

    Attributes
    ----------
    modulation_frequency_hz : float
    phase_offset_rad, phase_offset_error_rad : float
        Mean over the pixels of what phases are too large by, and its standard error.
    drift_m_per_kelvin, drift_error_m_per_kelvin : float
        Range for each kelvin, and its standard error; 0 and NaN until temperatures were looked at.
    orders : list of int
        Of the wiggling: so many times the measured phase.
    cos_rad, sin_rad, cos_error_rad, sin_error_rad : float64 arrays [number], rad
        Of each order.
    pixel_phase_rad, pixel_phase_error_rad : float64 arrays [height, width], rad
        Of each pixel, their mean being 0, and its standard error; 0 and NaN where there was no light.
    chi_square : float
        Of the residuals over their degrees of freedom: 1 where noise is all that is left.
    """

    def __init__(self, frequency: float, shape: tuple[int, int]) -> None:
        import numpy as np

        self.modulation_frequency_hz = frequency
        self.phase_offset_rad = 0.0
        self.phase_offset_error_rad = math.nan
        self.drift_m_per_kelvin = 0.0
        self.drift_error_m_per_kelvin = math.nan
        self.orders: list[int] = []
        self.cos_rad: Any = np.zeros(0)
        self.sin_rad: Any = np.zeros(0)
        self.cos_error_rad: Any = np.zeros(0)
        self.sin_error_rad: Any = np.zeros(0)
        self.pixel_phase_rad: Any = np.zeros(shape)
        self.pixel_phase_error_rad: Any = np.full(shape, np.nan)
        self.chi_square = math.nan

    def too_large_rad(self, measured_rad: Any) -> Any:
        """By how much measured phases are too large, of pixels in their last two axes."""
        out = self.phase_offset_rad + self.pixel_phase_rad
        for order, cosine, sine in zip(self.orders, self.cos_rad, self.sin_rad):
            out = out + cosine * _cos(order * measured_rad) + sine * _sin(order * measured_rad)
        return out


class HeldOut:
    """A wall that the calibration has not seen: range errors by it, in metres.

    Attributes
    ----------
    distance_m, modulation_frequency_hz : float
    before_m, after_m : float
        Mean over the pixels of what the half path is too long by, without a calibration and with it.
    spread_before_m, spread_after_m : float
        Standard deviation over the pixels; noise of the recording is in it.
    """

    def __init__(self, distance_m: float, frequency: float, before: Any, after: Any) -> None:
        import numpy as np

        half = LIGHT_SPEED / (4 * math.pi * frequency)
        self.distance_m = distance_m
        self.modulation_frequency_hz = frequency
        self.before_m, self.after_m = half * float(np.nanmean(before)), half * float(np.nanmean(after))
        self.spread_before_m, self.spread_after_m = half * float(np.nanstd(before)), half * float(np.nanstd(after))


class SpecimenCalibration:
    """What was found of a specimen; ``str()`` of it is a report.

    Attributes
    ----------
    frequencies : list of FrequencyResult
    reference_celsius : float, °C
        Temperature at which phases were measured.
    held_out : list of HeldOut
        Walls that the calibration had not seen when their errors were taken: afterwards it is made of all.
    notes : list of str
        What could not be known.
    """

    def __init__(self, frequencies: list[FrequencyResult], reference_celsius: float) -> None:
        self.frequencies = frequencies
        self.reference_celsius = reference_celsius
        self.held_out: list[HeldOut] = []
        self.notes: list[str] = []

    def save(self, file: str | os.PathLike[str]) -> None:
        """Writes the file that ``decoding.calibration`` names, and the pixels' phases beside it.

        Parameters
        ----------
        file : path
            "specimen.yaml"; "specimen_60MHz.npy" and the like are written, too.

        Raises
        ------
        Error
            Where it cannot be written.
        """
        write_specimen(self, os.fspath(file))

    def __str__(self) -> str:
        from ._calibration_file import report

        return report(self)


def _cos(angle: Any) -> Any:
    import numpy as np

    return np.cos(angle)


def _sin(angle: Any) -> Any:
    import numpy as np

    return np.sin(angle)


def wrapped(phase: Any) -> Any:
    """Into (−π, π]."""
    import numpy as np

    return np.angle(np.exp(1j * phase))


def _orders(phases: int, orders: Sequence[int] | None) -> list[int]:
    """Orders of harmonics that reference phases let through: multiples of their number, of an odd one of twice as much."""
    base = phases if phases % 2 == 0 else 2 * phases
    wanted = sorted({base, 2 * base, 3 * base} if orders is None else set(orders))
    if any(not 1 <= one <= _HIGHEST for one in wanted):
        raise BadInput(f"error: got orders of {wanted}\n  expected whole numbers of 1 to {_HIGHEST}: so many times the measured phase")
    return wanted


def _fit(frequency: float, data: WallPhases, walls: Sequence[int], orders: list[int]) -> FrequencyResult:
    """Offset, wiggling and pixels' phases together. Noise of a phase that is corrected has the correction's slope [theory: noise-estimate]."""
    measured = data.measured[list(walls)]
    first = _least_squares(frequency, data, walls, orders, 1.0)
    slope = 1.0
    for order, cosine, sine in zip(orders, first.cos_rad, first.sin_rad):
        slope = slope + order * (cosine * _sin(order * measured) - sine * _cos(order * measured))
    return _least_squares(frequency, data, walls, orders, slope)


def _least_squares(frequency: float, data: WallPhases, walls: Sequence[int], orders: list[int], slope: Any) -> FrequencyResult:
    import numpy as np

    measured, off = data.measured[list(walls)], data.off[list(walls)]
    weight = np.where(np.isfinite(off), 1 / (data.variance[list(walls)] * slope**2), 0.0)
    height, width = measured.shape[1:]
    off = np.where(weight > 0, off, 0.0)
    basis = np.stack([part for order in orders for part in (np.cos(order * measured), np.sin(order * measured))])
    basis = np.where(weight > 0, basis, 0.0)
    total = weight.sum(axis=0)
    seen = (weight > 0).sum(axis=0) >= 2
    per_total = np.where(seen, 1 / np.where(seen, total, 1.0), 0.0)
    weight = weight * seen
    # Each pixel's own phase is its mean: without means the rest knows nothing of it.
    mean_off, mean_basis = (weight * off).sum(axis=0) * per_total, (weight * basis).sum(axis=1) * per_total
    centred_off, centred = off - mean_off, basis - mean_basis[:, None]
    flat = centred.reshape(len(centred), -1)
    normal = (flat * weight.ravel()) @ flat.T
    right = (flat * weight.ravel()) @ centred_off.ravel()
    covariance = _inverse_of(normal, orders, frequency)
    found = covariance @ right
    pixel = mean_off - np.tensordot(found, mean_basis, 1)
    spread = np.einsum("ihw,ij,jhw->hw", mean_basis, covariance, mean_basis)
    out = FrequencyResult(frequency, (height, width))
    out.orders = orders
    error = np.sqrt(np.diag(covariance))
    out.cos_rad, out.sin_rad, out.cos_error_rad, out.sin_error_rad = found[0::2], found[1::2], error[0::2], error[1::2]
    if not seen.any():
        raise BadInput(f"error: no pixel sees light of two walls at {1e-6 * frequency:g} MHz\n  expected walls that are neither too dark nor too bright")
    out.phase_offset_rad = float(pixel[seen].mean())
    over_pixels = mean_basis[:, seen].mean(axis=1)
    out.phase_offset_error_rad = float(np.sqrt(per_total[seen].mean() / seen.sum() + over_pixels @ covariance @ over_pixels))
    out.pixel_phase_rad = np.where(seen, pixel - out.phase_offset_rad, 0.0)
    out.pixel_phase_error_rad = np.where(seen, np.sqrt(per_total + spread), np.nan)
    left = centred_off - np.tensordot(found, centred, 1)
    freedom = int((weight > 0).sum() - seen.sum() - len(found))
    out.chi_square = float((weight * left**2).sum() / freedom) if freedom > 0 else math.nan
    return out


def _inverse_of(normal: Any, orders: list[int], frequency: float) -> Any:
    import numpy as np

    try:
        covariance = np.linalg.inv(normal)
        worst = int(np.argmax(np.diag(covariance)))
        known = bool(np.isfinite(covariance).all() and 0 <= np.diag(covariance).min() and covariance[worst, worst] < _BLURRED**2)
    except np.linalg.LinAlgError:
        known, worst = False, 0
    if not known:
        raise BadInput(f"error: the walls do not say what the wiggling is at {1e-6 * frequency:g} MHz\n  its part of order {orders[worst // 2]} is not known to "
                       f"{_BLURRED:g} rad; expected more distances, at uneven steps over {0.5e3 * LIGHT_SPEED / frequency / min(orders):.0f} mm or more, or fewer orders")
    return covariance


def _held_out_of(count: int, held_out: Sequence[int] | None) -> list[int]:
    if held_out is None:
        return list(range(2, count - 1, 4)) if count >= 8 else []
    if any(not 0 <= one < count for one in held_out):
        raise BadInput(f"error: held_out has a wall that there is not\n  got {list(held_out)}, expected numbers of 0 to {count - 1}")
    return sorted(set(held_out))


def calibrate_phase(camera: Camera, walls: Iterable[tuple[float, Iterable[Frame | str | os.PathLike[str]] | str | os.PathLike[str]]], *,
                    orders: Sequence[int] | None = None, held_out: Sequence[int] | None = None) -> SpecimenCalibration:
    """Phase offset, wiggling and each pixel's phase, by modulation frequency.

    By how much a measured phase is too large is taken to be o + P(u, v) + Σ cₘ cos mφ̂ + sₘ sin mφ̂ [theory: specimen-calibration]; all of it is
    found together by least squares over all pixels. Noise is what the frames of each wall say it is.

    Parameters
    ----------
    camera : Camera
        Whose lens, lights' places and sequence are known; what it says of waveform and patterns is not looked at.
    walls : sequence of (distance, frames)
        z in metres of a matt wall that faces the camera, and two or more of its frames with raw data: frames, files or a folder of them.
    orders : sequence of int, optional
        Of the wiggling; left out: the first three that the number of reference phases lets through. 1 and 2, which taps that differ
        make, need distances over half a wave.
    held_out : sequence of int, optional
        Numbers of walls at which errors are taken of a calibration that has not seen them; left out: every fourth, of 8 or more.

    Returns
    -------
    SpecimenCalibration
        Of all walls.

    Raises
    ------
    Error
        Where frames lack, are of another camera, have no light, or do not say what is asked of them.
    """
    import numpy as np

    taken = walls_of(walls, camera, "distance")
    kept_out = _held_out_of(len(taken), held_out)
    seen_before = [i for i in range(len(taken)) if i not in kept_out]
    if len(seen_before) < 3:
        raise BadInput(f"error: too few walls\n  got {len(taken)}, {len(kept_out)} of them held out; expected three or more, such as 12 distances")
    out = SpecimenCalibration([], camera.temperature.celsius)
    for frequency, data in phases_of(taken, camera).items():
        data.off = wrapped(data.measured - expected_phase(camera, frequency, [wall.value for wall in taken]))
        data.off = data.center(data.off)
        wanted = _orders(data.phases, orders)
        if kept_out:
            partly = _fit(frequency, data, seen_before, wanted)
            for i in kept_out:
                off = data.off[i]
                out.held_out.append(HeldOut(taken[i].value, frequency, wrapped(off), off - partly.too_large_rad(data.measured[i])))
        found = _fit(frequency, data, range(len(taken)), wanted)
        found.phase_offset_rad = float(wrapped(found.phase_offset_rad))
        out.frequencies.append(found)
        dark = int(np.isnan(found.pixel_phase_error_rad).sum())
        if dark:
            out.notes.append(f"{dark} of {found.pixel_phase_rad.size} pixels have no light of two walls at {1e-6 * frequency:g} MHz: they are taken to be as the mean")
    return out


def calibrate_temperature(camera: Camera, walls: Iterable[tuple[float, Iterable[Frame | str | os.PathLike[str]] | str | os.PathLike[str]]],
                          specimen: SpecimenCalibration) -> SpecimenCalibration:
    """How far the range drifts with each kelvin, by modulation frequency.

    A wall that stands still is seen at several temperatures; how far away it is need not be known.

    Parameters
    ----------
    camera : Camera
    walls : sequence of (temperature, frames)
        In degrees Celsius, and two or more frames of the same wall.
    specimen : SpecimenCalibration
        Of ``calibrate_phase``; its wiggling is taken off, and its own temperature stays the one that phases are of.

    Returns
    -------
    SpecimenCalibration
        The specimen, with its drift.

    Raises
    ------
    Error
        As of ``calibrate_phase``, and for temperatures that are all alike.
    """
    import copy

    import numpy as np

    taken = walls_of(walls, camera, "temperature")
    celsius = np.array([wall.value for wall in taken])
    if len(taken) < 3 or np.ptp(celsius) < 1:
        raise BadInput(f"error: too few temperatures\n  got {len(taken)} over {np.ptp(celsius) if len(taken) else 0:g} K; expected three or more over 1 K at least")
    out = copy.deepcopy(specimen)
    out.held_out = []
    found = phases_of(taken, camera)
    for one in out.frequencies:
        data = next((data for hz, data in found.items() if abs(hz - one.modulation_frequency_hz) <= 1e-6 * hz), None)
        if data is None:
            raise BadInput(f"error: the frames have no {1e-6 * one.modulation_frequency_hz:g} MHz\n  expected the modulation frequencies of the specimen's calibration")
        corrected = data.measured - one.too_large_rad(data.measured)
        apart = wrapped(corrected - corrected[0])  # the wall's own phase goes
        weight = np.where(np.isfinite(apart), 1 / data.variance, 0.0)
        mean = (weight * np.where(weight > 0, apart, 0.0)).sum(axis=(1, 2)) / weight.sum(axis=(1, 2))
        half = LIGHT_SPEED / (4 * math.pi * one.modulation_frequency_hz) / camera.refractive_index
        slope, error, left = _line(celsius, half * mean)
        one.drift_m_per_kelvin, one.drift_error_m_per_kelvin = slope, error
        for i, kelvin in enumerate(celsius - celsius.mean()):
            out.held_out.append(_Warmer(celsius[i], one.modulation_frequency_hz, half * mean[i] - half * mean.mean(), left[i]))
    return out


class _Warmer(HeldOut):
    """Of a temperature: the range's drift from their mean, and what a line through the others leaves of it."""

    def __init__(self, celsius: float, frequency: float, before: float, after: float) -> None:
        self.celsius = celsius
        self.distance_m = math.nan
        self.modulation_frequency_hz = frequency
        self.before_m, self.after_m = before, after
        self.spread_before_m = self.spread_after_m = math.nan


def _line(x: Any, y: Any) -> tuple[float, float, Any]:
    """Slope, its standard error, and what is left of each point by a line through the others."""
    import numpy as np

    def through(keep: Any) -> tuple[float, float]:
        slope = float(np.polyfit(x[keep], y[keep], 1)[0])
        return slope, float(y[keep].mean() - slope * x[keep].mean())

    everything = np.ones(len(x), bool)
    slope, level = through(everything)
    left = y - slope * x - level
    error = float(np.sqrt((left**2).sum() / (len(x) - 2) / ((x - x.mean()) ** 2).sum()))
    others = []
    for i in range(len(x)):
        keep = everything.copy()
        keep[i] = False
        if np.ptp(x[keep]) > 0:
            a, b = through(keep)
            others.append(y[i] - a * x[i] - b)
        else:
            others.append(math.nan)
    return slope, error, np.array(others)


__all__ = ["FrequencyResult", "HeldOut", "SpecimenCalibration", "Wall", "calibrate_phase", "calibrate_temperature"]
