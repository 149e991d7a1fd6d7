# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Recordings of walls: phases by modulation frequency as they are measured, their noise, and what they should be."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

from ._errors import BadInput, IoError
from ._frame import Frame, load
from ._simulator import pixel_rays

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ._model import Camera

_LIGHT_SPEED = 299792458.0


class Wall:
    """Frames of one wall. `value` is its distance in metres, or the temperature in degrees Celsius."""

    def __init__(self, value: float, name: str, frames: list[Frame]) -> None:
        self.value = value
        self.name = name
        self.frames = frames


class WallPhases:
    """At one modulation frequency: means over the frames of each wall, [wall, height, width].

    `off` is what the phase is too large by, NaN where there is no light; `variance` that of the mean phase.
    """

    def __init__(self, phases: int, measured: Any, variance: Any) -> None:
        self.phases = phases
        self.measured = measured
        self.variance = variance
        self.off: Any = None

    @staticmethod
    def center(off: Any) -> Any:
        """Whole turns added so that all phases lie about their common direction."""
        import numpy as np

        good = off[np.isfinite(off)]
        middle = float(np.angle(np.exp(1j * good).mean())) if good.size else 0.0
        return middle + np.angle(np.exp(1j * (off - middle)))


def _files(path: str, name: str) -> list[str]:
    if not os.path.isdir(path):
        return [path]
    try:
        files = [os.path.join(path, one) for one in sorted(os.listdir(path)) if one.endswith(".npz")]
    except OSError as fault:
        raise IoError(f"{path}: error: it cannot be read\n  {fault.strerror}") from None
    if not files:
        raise BadInput(f"{path}: error: there is no npz file in this folder\n  expected frames of the wall at {name}, as `tofray render -o` writes them")
    return files


def walls_of(walls: Iterable[Any], camera: Camera, what: str) -> list[Wall]:
    """Reads what is named, and refuses what has no raw data of the camera."""
    out: list[Wall] = []
    unit = " m" if what == "distance" else " degC"
    shape = pixel_rays(camera).shape[:2]
    for value, given in walls:
        number = float(value)
        name = f"{number:g}{unit}"
        if not math.isfinite(number) or (what == "distance" and not 0 < number < 1e5):
            raise BadInput(f"error: got a {what} of {name}\n  expected a number" + (" above 0" if what == "distance" else ""))
        items = _files(os.fspath(given), name) if isinstance(given, (str, os.PathLike)) else list(given)
        frames = [one if isinstance(one, Frame) else load(one) for one in items]
        places = [name if isinstance(one, Frame) else os.fspath(one) for one in items]
        if len(frames) < 2:
            raise BadInput(f"{places[0] if places else name}: error: there is one frame of the wall at {name}, or none\n"
                           "  expected two or more, in a folder: their scatter says what the noise is")
        for frame, place in zip(frames, places):
            _check(frame, place, shape)
        out.append(Wall(number, name, frames))
    if not out:
        raise BadInput("error: there is no wall")
    return out


def _check(frame: Frame, place: str, shape: tuple[int, ...]) -> None:
    raw = frame.raw
    taps = raw.get("raw") if raw.get("raw") is not None else raw.get("tap_a") if raw.get("tap_b") is not None else None
    needed = (taps, *(raw.get(name) for name in ("modulation_frequency_hz", "reference_phase_rad", "lit")))
    if any(one is None for one in needed):
        raise BadInput(f"{place}: error: there are no raw frames in it\n  expected raw, or tap_a and tap_b, as `tofray render --arrays +raw` keeps them, "
                       "with modulation_frequency_hz, reference_phase_rad and lit")
    if taps is not None and tuple(taps.shape[1:]) != tuple(shape):
        raise BadInput(f"{place}: error: the image is not the camera's\n  got {taps.shape[2]} x {taps.shape[1]} pixels, the camera reads {shape[1]} x {shape[0]}")


def _differences(frame: Frame, camera: Camera) -> tuple[Any, Any]:
    """A − B of each raw frame in electrons, and which pixels saturate in one."""
    import numpy as np

    raw = frame.raw
    if raw.get("raw") is None:
        difference = np.asarray(raw.tap_a, float) - np.asarray(raw.tap_b, float)
        return difference, ~np.isfinite(difference).all(axis=0)
    codes = np.asarray(raw.raw, float)
    adc, decoding = camera.adc, camera.decoding
    lower = adc.valid_min if decoding.lower_saturation_dn is None else decoding.lower_saturation_dn
    upper = adc.valid_max if decoding.upper_saturation_dn is None else decoding.upper_saturation_dn
    outside = ((codes < lower) | (codes > upper)).any(axis=0)
    return (codes - adc.mid_code) * adc.step_e_per_dn / camera.mode.gain, outside


def _phasors(frame: Frame, camera: Camera) -> tuple[dict[float, tuple[int, Any]], Any]:
    """Ẑ = (2/N) Σ D e^{−iτ} of each modulation frequency, with the number of its reference phases."""
    import numpy as np

    difference, outside = _differences(frame, camera)
    hz, lit = np.asarray(frame.raw.modulation_frequency_hz), np.asarray(frame.raw.lit, bool)
    tau = np.asarray(frame.raw.reference_phase_rad, float) + _known_offset(camera, hz)
    out = {}
    for frequency in dict.fromkeys(hz[lit].tolist()):
        these = np.flatnonzero(lit & (hz == frequency))
        out[frequency] = len(these), 2 / len(these) * np.tensordot(np.exp(-1j * tau[these]), difference[these], 1)
    return out, outside


def _known_offset(camera: Camera, hz: Any) -> Any:
    """What the profile's `calibration` says that raw data are off by, which decoding knows anyway."""
    import numpy as np

    known = camera.calibration
    out = 4 * np.pi * hz * camera.refractive_index * known.range_offset_m / _LIGHT_SPEED
    if len(known.phase_offset.y) == 0:
        return out
    if len(known.phase_offset.y) == 1:
        return out + known.phase_offset.y[0]
    order = {round(x): y for x, y in zip(known.phase_offset.x, known.phase_offset.y)}
    try:
        return out + np.array([order[round(one)] if one > 0 else 0.0 for one in hz])
    except KeyError:
        raise BadInput("error: calibration.phase_offset of the profile has no sample at a modulation frequency of the frames\n"
                       "  expected one at each, or take the key out: the specimen's calibration finds the offset") from None


def phases_of(walls: list[Wall], camera: Camera) -> dict[float, WallPhases]:
    """By modulation frequency the walls' phases. Noise is V = (aÂ + b)/Â² with a and b by what all frames scatter."""
    import numpy as np

    means: dict[float, list[Any]] = {}
    scatter: dict[float, list[Any]] = {}
    phases: dict[float, int] = {}
    for wall in walls:
        every = [_phasors(frame, camera) for frame in wall.frames]
        outside = np.any([one[1] for one in every], axis=0)
        if any(set(one[0]) != set(every[0][0]) for one in every) or (phases and set(every[0][0]) != set(phases)):
            raise BadInput(f"error: the frames have not all the same modulation frequencies\n  got others of the wall at {wall.name}; expected one mode of one camera")
        for frequency, (count, _) in every[0][0].items():
            stack = np.stack([one[0][frequency][1] for one in every])
            mean = np.where(outside, np.nan, stack.mean(axis=0))
            turned = stack * np.exp(-1j * np.angle(mean))
            means.setdefault(frequency, []).append(mean)
            scatter.setdefault(frequency, []).append((turned.imag.var(axis=0, ddof=1), len(every)))
            phases[frequency] = count
    return {frequency: _with_noise(phases[frequency], np.stack(means[frequency]), scatter[frequency]) for frequency in means}


def _with_noise(phases: int, mean: Any, scatter: list[Any]) -> WallPhases:
    """Of 38,528 pixels and a few frames the two numbers of the noise are known to a part in a hundred."""
    import numpy as np

    amplitude = np.abs(mean)
    across = np.stack([one[0] for one in scatter])
    frames = np.array([one[1] for one in scatter])[:, None, None]
    dim = amplitude < 1
    mean = np.where(dim, np.nan, mean)
    good = np.isfinite(mean) & np.isfinite(across)
    if not good.any():
        return WallPhases(phases, np.angle(mean), np.full(mean.shape, np.inf))
    x, y = amplitude[good], across[good]
    weight = 1 / np.maximum(x, 1) ** 2
    rows = np.stack([x, np.ones_like(x)])
    try:
        a, b = np.linalg.solve((rows * weight) @ rows.T, (rows * weight) @ y)
    except np.linalg.LinAlgError:
        a, b = 0.0, float(y.mean())
    if a < 0 or b < 0:
        a, b = (0.0, float(y.mean())) if a < 0 else (float((y / x).mean()), 0.0)
    variance = np.maximum(a * amplitude + b, 1e-12) / np.where(dim, 1, amplitude) ** 2 / frames
    return WallPhases(phases, np.angle(mean), np.maximum(variance, 1e-14))


def expected_phase(camera: Camera, frequency: float, distances: list[float]) -> Any:
    """Of walls that face the camera: 2π f n/c times the way from the lights, and on to each pixel [wall, height, width]."""
    import numpy as np

    rays = pixel_rays(camera).astype(float)
    ray = np.concatenate([rays, np.ones((*rays.shape[:2], 1))], axis=2)
    length = np.linalg.norm(ray, axis=2)
    light, square = _mean_light(camera)
    along = ray @ light / length
    out = []
    for distance in distances:
        r = distance * length
        path = r + np.sqrt(r * r - 2 * r * along + square)  # light where decoding takes it to be [theory: several-lights]
        out.append(2 * np.pi * frequency * camera.refractive_index / _LIGHT_SPEED * path)
    return np.stack(out)


def _mean_light(camera: Camera) -> tuple[Any, float]:
    import numpy as np

    if not camera.illumination:
        raise BadInput("error: the camera has no light source\n  expected one whose place is known")
    power = np.array([one.power_w for one in camera.illumination])
    share = power / power.sum() if power.sum() > 0 else np.full(len(power), 1 / len(power))
    places = np.array([one.position for one in camera.illumination], float)
    spread = np.array([one.ring_radius_m**2 * (one.ring_leds > 1) + _spread(one.area) for one in camera.illumination])
    return share @ places, float(share @ ((places**2).sum(axis=1) + spread))


def _spread(area: Any) -> float:
    """Mean square distance from the middle."""
    if area.kind == "disk":
        return 0.5 * float(area.radius_m) ** 2
    return (float(area.width_m) ** 2 + float(area.height_m) ** 2) / 12 if area.kind == "rectangle" else 0.0
