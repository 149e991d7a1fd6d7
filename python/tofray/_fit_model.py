# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What `fit` varies, and what the library's budget says of each row with it."""

from __future__ import annotations

import cmath
import math
import re
from typing import TYPE_CHECKING, Any

from . import _native
from ._budget import _case
from ._errors import BadInput

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from ._fit_rows import Rows

_HARMONIC = re.compile(r"(illumination\.(?:\d+|\*)\.waveform)\.(a1|r[3579]|psi[3579])")
_KAPPA = re.compile(r"illumination\.[\d*]+\.(power|waveform\.a1)|lens\.(transmission|f_number)|sensor\.(fill_factor|pixel_pitch)"
                    r"|pixel\.quantum_efficiency|integration_time|.*\.integration_time")


class Unknown:
    """One number that is looked for. Inside it is `inner`: the logarithm of a positive number, or the number over its usual size.

    Parameters
    ----------
    name : str
        The key, or words for what is none: "reflectivity of black".
    unit : str
    start, low, high : float
        In that unit.
    keys : list of str
        The profile's keys that it is; empty: it is none of the profile.
    """

    def __init__(self, name: str, unit: str, start: float, low: float, high: float, keys: Sequence[str] = (), linear: bool = False) -> None:
        self.name = name
        self.unit = unit
        self.start = start
        self.low = low
        self.high = high
        self.keys = list(keys)
        self.log = not linear and start > 0 and low >= 0
        self.size = abs(start) if start else 1.0

    def inner(self, value: float) -> float:
        return math.log(value) if self.log else value / self.size

    def outer(self, inner: float) -> float:
        value = math.exp(min(inner, 700.0)) if self.log else inner * self.size
        return min(max(value, self.low), self.high)

    @property
    def bounds(self) -> tuple[float, float]:
        low = self.inner(self.low) if not self.log else math.log(max(self.low, 1e-9 * self.start))
        return low, self.inner(self.high)

    @property
    def step(self) -> float:
        """Of a difference: float32 light has seven digits, so that it is no smaller."""
        return 0.01


def _unknown_of_key(key: str, numbers: Mapping[str, tuple[str, float, float, float, bool, bool]]) -> Unknown:
    pattern = re.escape(key).replace(r"\*", r"\d+")
    keys = [one for one in numbers if re.fullmatch(pattern, one)]
    if not keys:
        import difflib

        near = difflib.get_close_matches(key, [*numbers, "illumination.0.waveform.r3", "illumination.0.waveform.psi3"], 1, 0.6)
        meant = f"; did you mean {near[0]!r}?" if near else ""
        raise BadInput(f"free: error: {key!r:.80} is no number of this profile and mode{meant}\n"
                       "  expected a key whose value is one number (`tofray list keys`), or illumination.0.waveform.r3 and .psi3")
    units = {numbers[one][0] for one in keys}
    values = [numbers[one][1] for one in keys]
    unit, _, low, high, whole, _ = numbers[keys[0]]
    if whole:
        raise BadInput(f"free: error: {key} is a whole number\n  expected a number that can have any value in its range")
    if len(units) > 1 or max(values) - min(values) > 1e-9 * abs(max(values)):
        raise BadInput(f"free: error: {key} stands for {len(keys)} different values\n"
                       "  expected the same value in all of them, which then change together")
    return Unknown(key, unit, values[0], low, high, keys)


class Harmonics:
    """Amplitudes and phases of a light's correlation: a_1, and r_m = a_m/a_1 and psi_m of odd m [theory: measured-correlation]."""

    def __init__(self, waveform: Any, contrast: float, place: str) -> None:
        self.place = place
        self.terms: dict[int, complex] = {}
        if waveform.kind == "measured":
            import numpy as np

            if len(waveform.sample_phases_rad):
                raise BadInput(f"free: error: the samples of {place} stand at phases of their own\n  expected equally spaced ones")
            curve = np.asarray(waveform.correlation)
            count = len(curve)
            for m in range(1, min(2 * waveform.harmonics, (count + 1) // 2), 2):
                self.terms[m] = complex(2 / count * (curve * np.exp(-2j * np.pi * m * np.arange(count) / count)).sum())
        elif waveform.kind == "sine":
            self.terms[1] = complex(contrast)
        else:
            raise BadInput(f"free: error: the harmonics of {place} follow of what else its kind, {waveform.kind}, says\n"
                           "  expected a measured correlation or a sine, whose harmonics are numbers of their own")

    def get(self, name: str) -> float:
        first = self.terms[1]
        if name == "a1":
            return abs(first)
        term = self.terms.get(int(name[-1]), 0j)
        return abs(term / first) if name[0] == "r" else math.degrees(cmath.phase(term)) % 360 if term else 0.0

    def with_values(self, values: Mapping[str, float]) -> Harmonics:
        out = Harmonics.__new__(Harmonics)
        out.place, out.terms = self.place, dict(self.terms)
        if "a1" in values:
            factor = values["a1"] / abs(self.terms[1])
            out.terms = {m: term * factor for m, term in self.terms.items()}
        for m in {int(name[-1]) for name in values if name != "a1"}:
            ratio = values.get(f"r{m}", self.get(f"r{m}"))
            phase = values.get(f"psi{m}", self.get(f"psi{m}"))
            out.terms[m] = cmath.rect(ratio * abs(out.terms[1]), math.radians(phase))
        return out

    @property
    def count(self) -> int:
        return (max(self.terms) + 1) // 2

    def samples(self, digits: int | None = None) -> list[float]:
        count = max(16, 4 * self.count)
        out = [sum((term * cmath.exp(2j * math.pi * m * j / count)).real for m, term in self.terms.items()) for j in range(count)]
        return out if digits is None else [round(one, digits) + 0.0 for one in out]


def _mode_names(rows: Rows, mode: str) -> list[str]:
    return rows.word("mode", mode)


def _reflectivity_of(name: str) -> str:
    return f"reflectivity of {name}" if name else "reflectivity"


class Model:
    """All rows, as the budget of a camera with some numbers says them."""

    def __init__(self, profile: str, mode: str, words: dict[str, str], rows: Rows, free: Sequence[str], scale_free: Sequence[str],
                 reflectivity: float) -> None:
        self.profile, self.mode, self.words, self.rows = profile, mode, words, rows
        self.modes = sorted(set(_mode_names(rows, mode)))
        _, self.text, numbers, self.places = _native.profile_file(profile, self.modes[0] if len(self.modes) == 1 else mode, words)
        self.source = profile
        self.numbers = numbers
        self.harmonics: dict[int, Harmonics] = {}
        self.unknowns: list[Unknown] = []
        self.pairs: list[tuple[int, int]] = []  # places of r_m and psi_m that are looked for together, as a number of two parts
        for key in dict.fromkeys(one.removeprefix("camera.") for one in free):
            found = _HARMONIC.fullmatch(key)
            self.unknowns.append(self._unknown_harmonic(key, found) if found else _unknown_of_key(key, numbers))
        self._pair_harmonics()
        self._scales(scale_free, reflectivity)
        self._group()

    def _unknown_harmonic(self, key: str, found: re.Match[str]) -> Unknown:
        place, name = found[1], found[2]
        camera = self._camera_of(self.modes[0], self.words)
        lights = range(len(camera.illumination)) if "*" in place else [int(place.split(".")[1])]
        if lights[-1] >= len(camera.illumination):
            raise BadInput(f"free: error: {key} is of light {lights[-1]}\n  expected 0 to {len(camera.illumination) - 1}")
        for light in lights:
            if light in self.harmonics:
                continue
            waveform = camera.illumination[light].waveform
            sequences = [self._camera_of(mode, self.words).mode.sequence for mode in self.modes]
            frequencies = {one.modulation_frequency_hz for sequence in sequences for one in sequence if one.lit}
            if waveform.kind != "measured" and len(frequencies) > 1:
                raise BadInput(f"free: error: {key} would be the same for {len(frequencies)} modulation frequencies\n"
                               "  expected one, or a measured correlation")
            contrast = float(self._budget(camera, [10.0], 0.5, 0.0)["contrast"][0])
            self.harmonics[light] = Harmonics(waveform, contrast, f"illumination.{light}.waveform")
        start = self.harmonics[lights[0]].get(name)
        keys = [f"illumination.{light}.waveform.{name}" for light in lights]
        if name == "a1":
            return Unknown(key, "", start, 1e-3, 2, keys)
        out = Unknown(key, "" if name[0] == "r" else "deg", start, *((0.0, 0.95) if name[0] == "r" else (-1e4, 1e4)), keys, linear=True)
        out.size = 1.0 if name[0] == "r" else 57.3
        return out

    def _pair_harmonics(self) -> None:
        names = [one.name for one in self.unknowns]
        for i, name in enumerate(names):
            found = re.fullmatch(r"(.*\.waveform)\.r([3579])", name)
            if found and f"{found[1]}.psi{found[2]}" in names:
                self.pairs.append((i, names.index(f"{found[1]}.psi{found[2]}")))

    def _scales(self, scale_free: Sequence[str], reflectivity: float) -> None:
        import numpy as np

        rows = self.rows
        self.reflectivity = rows.number("reflectivity", reflectivity)
        self.class_of_row = rows.word("class")
        self.scale: dict[str, int] = {}
        for word in scale_free:
            if word == "reflectivity":
                for name in dict.fromkeys(self.class_of_row):
                    mine = self.reflectivity[np.array([one == name for one in self.class_of_row])]
                    self.scale[_reflectivity_of(name)] = len(self.unknowns)
                    self.unknowns.append(Unknown(_reflectivity_of(name), "", float(np.median(mine)), 1e-3, 1.0))
            elif word == "intensity":
                if "intensity" not in rows.numbers:
                    raise BadInput("scale_free: error: intensity is no column of the rows\n  expected one whose scale is not known")
                self.scale["intensity per electron"] = len(self.unknowns)
                self.unknowns.append(Unknown("intensity per electron", "", 1.0, 1e-12, 1e12))
            elif word == "bias":
                if "bias_m" not in rows.numbers:
                    raise BadInput("scale_free: error: bias is no column of the rows\n  expected bias_mm, whose offset is not known")
                self.scale["offset of bias"] = len(self.unknowns)
                self.unknowns.append(Unknown("offset of bias", "mm", 0.0, -1e6, 1e6, linear=True))
            else:
                raise BadInput(f"scale_free: error: got {word!r:.40}\n  expected reflectivity (one for each class), intensity or bias")

    def _group(self) -> None:
        """Rows that one call of the budget computes: of one mode, light and reflectivity."""
        groups: dict[tuple[str, float, str], list[int]] = {}
        modes, ambient = _mode_names(self.rows, self.mode), self.rows.number("ambient_lx", 0.0)
        free = any(one.startswith("reflectivity") for one in self.scale)
        for i, name in enumerate(self.class_of_row):
            reflectivity = _reflectivity_of(name) if free else repr(float(self.reflectivity[i]))
            groups.setdefault((modes[i], float(ambient[i]), reflectivity), []).append(i)
        self.groups = groups
        self.distance = self.rows.number("distance_m")
        self.intensity = self.rows.number("intensity")

    @staticmethod
    def _budget(camera: Any, distances: Sequence[float], reflectivity: float, ambient: float) -> dict[str, Any]:
        words = {"distance_m": list(distances), "reflectivity": [reflectivity], "ambient": [_case(ambient)], "angle_rad": 0.0,
                 "temperature_celsius": None, "pixel": None, "auto_exposure": False}
        arrays, _ = _native.budget(camera, words, False)
        return {name: array[0, 0] for name, array in arrays.items()}

    def _camera_of(self, mode: str, words: dict[str, str]) -> Any:
        return _native.load_camera(self.profile, mode, words, "")

    def text_of(self, unknown: Unknown, value: float, digits: int = 12) -> str:
        return f"{value:.{digits}g}" + (f" {unknown.unit}" if unknown.unit else "")

    def harmonics_at(self, values: Sequence[float]) -> dict[int, Harmonics]:
        changed: dict[int, dict[str, float]] = {}
        for unknown, value in zip(self.unknowns, values):
            for key in unknown.keys:
                found = _HARMONIC.fullmatch(key)
                if found:
                    changed.setdefault(int(key.split(".")[1]), {})[found[2]] = value
        return {light: self.harmonics[light].with_values(changed[light]) for light in changed}

    def camera(self, values: Sequence[float], mode: str) -> Any:
        words = dict(self.words)
        for unknown, value in zip(self.unknowns, values):
            for key in unknown.keys:
                if not _HARMONIC.fullmatch(key):
                    words[key] = self.text_of(unknown, value)
        camera = self._camera_of(mode, words)
        for light, harmonics in self.harmonics_at(values).items():
            waveform = camera.illumination[light].waveform
            waveform.kind, waveform.correlation, waveform.sample_phases_rad = "measured", harmonics.samples(), []
            waveform.harmonics = harmonics.count
        return camera

    def nothing(self) -> dict[str, Any]:
        """Of rows of which nothing is known."""
        import numpy as np

        count = len(self.rows)
        numbers = {name: np.full(count, np.nan) for name in ("sigma_m", "bias_m", "intensity", "kappa")}
        return {"saturated": np.zeros(count, bool), **numbers}

    def predict(self, values: Sequence[float]) -> dict[str, Any]:
        """sigma_m, bias_m, intensity and signal of each row; NaN where there is none."""
        import numpy as np

        out = self.nothing()
        gain = values[self.scale["intensity per electron"]] if "intensity per electron" in self.scale else 1.0
        offset = 1e-3 * values[self.scale["offset of bias"]] if "offset of bias" in self.scale else 0.0
        cameras = {mode: self.camera(values, mode) for mode in self.modes}
        for (mode, ambient, reflectivity), members in self.groups.items():
            share = values[self.scale[reflectivity]] if reflectivity in self.scale else float(reflectivity)
            places = np.array(members)
            known = places[~np.isnan(self.distance[places])]
            if known.size:
                got = self._budget(cameras[mode], self.distance[known].tolist(), share, ambient)
                out["sigma_m"][known], out["bias_m"][known] = got["sigma_m"], got["bias_m"] + offset
                out["intensity"][known] = gain * got["amplitude_e"]
                out["kappa"][known] = got["signal_e"] * got["z_m"] ** 2 / share
                out["saturated"][known] = got["saturated"]
            unknown = places[np.isnan(self.distance[places])]
            if unknown.size:
                out["sigma_m"][unknown] = self._by_intensity(cameras[mode], share, ambient, self.intensity[unknown] / gain)
        return out

    def _by_intensity(self, camera: Any, reflectivity: float, ambient: float, amplitude_e: Any) -> Any:
        """Range noise of a wall where it has that amplitude A, by (sigma A)^2 = c0 + c1 A + c2 A^2: read noise, shot noise, what grows with
        the light. The coefficients are those of 160 distances, over whose humps they go."""
        import numpy as np

        got = self._budget(camera, [float(distance) for distance in np.geomspace(0.1, 40, 160)], reflectivity, ambient)
        good = np.isfinite(got["sigma_m"]) & ~got["saturated"] & (got["amplitude_e"] > 0)
        brightest = int(np.argmax(np.where(good, got["amplitude_e"], 0)))
        good[:brightest] = False  # nearer, light leaves the pixel's view
        if good.sum() < 10:
            return np.full(len(amplitude_e), np.nan)
        amplitude, noise = got["amplitude_e"][good], got["sigma_m"][good]
        law = (noise * amplitude) ** 2
        powers = np.stack([np.ones_like(amplitude), amplitude, amplitude ** 2], axis=1) / law[:, None]
        sizes = np.abs(powers).max(axis=0)
        coefficients = np.linalg.lstsq(powers / sizes, np.ones_like(amplitude), rcond=None)[0] / sizes
        squared = coefficients[0] + coefficients[1] * amplitude_e + coefficients[2] * amplitude_e ** 2
        within = (amplitude_e <= amplitude[0]) & (amplitude_e >= amplitude[-1]) & (squared > 0)
        return np.where(within, np.sqrt(np.where(within, squared, 1.0)) / amplitude_e, np.nan)

    @property
    def has_kappa(self) -> bool:
        return any(_KAPPA.fullmatch(one.name) for one in self.unknowns)
