# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Where a camera's light goes, and what its range noise is made of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict

from . import _native
from ._errors import BadInput
from ._model import Ambient, AmbientCase

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ._model import Camera


class Budget(Dict[str, Any]):
    """Arrays by name, each [ambient, reflectivity, distance]; those of modulation frequencies have one more axis.

    Parameters
    ----------
    arrays : dict
        The arrays.
    summary : dict
        What does not depend on the distance: ``ambiguity_range_m``, ``reach_m`` [ambient, reflectivity], ``mean_power_w`` and others.
    ambients : list of str
        Names of the ambient lights.
    """

    def __init__(self, arrays: dict[str, Any], summary: dict[str, Any], ambients: list[str]) -> None:
        super().__init__(arrays)
        self.summary = summary
        self.ambients = ambients

    def plot(self) -> Any:
        """Range noise over distance, and below it the shares of its variance of the first light and reflectivity.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        ImportError
            Without matplotlib.
        """
        import importlib

        try:
            Figure = importlib.import_module("matplotlib.figure").Figure
        except ImportError as fault:
            raise ImportError("plot() needs the package matplotlib") from fault
        figure = Figure(figsize=(6.4, 6.4), layout="constrained")
        noise, shares = figure.subplots(2, 1, sharex=True)
        z = self["z_m"]
        for i, ambient in enumerate(self.ambients):
            for j in range(z.shape[1]):
                noise.plot(z[i, j], 1e3 * self["sigma_m"][i, j], label=f"{100 * self['reflectivity'][i, j, 0]:g} %, {ambient}")
        noise.axhline(1e3 * self.summary["low_signal_m"], color="0.5", linestyle=":", label="low signal")
        noise.set(yscale="log", ylabel="range noise [mm]")
        noise.legend()
        causes = [name for name in self if name.startswith("share_") and (self[name][0, 0] > 0).any()]
        shares.stackplot(z[0, 0], [100 * self[name][0, 0] for name in causes],
                         labels=[name[len("share_"):].replace("_", " ") for name in causes])
        shares.set(xlabel="z [m]", ylabel="share of the variance [%]", ylim=(0, 100))
        shares.legend(loc="lower right")
        return figure


def _case(ambient: Any) -> AmbientCase:
    if isinstance(ambient, AmbientCase):
        return ambient
    if isinstance(ambient, bool) or not isinstance(ambient, (int, float)):
        raise BadInput(f"ambient: error: got {ambient!r:.60}\n  expected an illuminance in lx, or an AmbientCase")
    if ambient == 0:
        return AmbientCase()
    return AmbientCase(name=f"{ambient:g} lx", ambient=Ambient(spectrum="sun_am15", quantity="illuminance_lx", amount=float(ambient)))


def budget(camera: Camera, distance_m: Iterable[float] = (0.5, 1.0, 2.0, 4.0), reflectivity: Iterable[float] = (0.2, 0.8),
           ambient: Iterable[float | AmbientCase] = (0.0,), *, angle_rad: float = 0.0, temperature_celsius: float | None = None,
           pixel: tuple[float, float] | None = None, auto_exposure: bool = False) -> Budget:
    """Expected light, charge and range noise of one pixel before a matt wall, and the noise's variance by cause.

    σ² = |dr/dd|² Σ_i w_i² σ_i² / (Σ_i w_i)², of each modulation frequency i by the variances of its raw frames [theory: noise-by-cause].
    A single frame, before filters; without multipath, scattered light, crosstalk, patterns of the specimen and other cameras.

    Parameters
    ----------
    camera : Camera
    distance_m : sequence of float
        z of the wall where the pixel sees it, 0.001 to 100000.
    reflectivity : sequence of float
        Of the wall, 0 to 1.
    ambient : sequence of float or AmbientCase
        Illuminance in lx, of the sun's spectrum, from everywhere; or light of any kind.
    angle_rad : float
        The wall is turned by this about the camera's y; 0: it faces the camera.
    temperature_celsius : float, optional
        In the place of the camera's.
    pixel : (float, float), optional
        Column and row in the image; None: where the optical axis is.
    auto_exposure : bool
        Integration times as ``camera.auto_exposure`` leaves them of each wall.

    Returns
    -------
    Budget
        float64 arrays [ambient, reflectivity, distance] such as ``sigma_m``, ``signal_e``, ``tap_filling``, ``wrong_cycle``, ``share_read``; bool
        ones such as ``saturated``; with one more axis, of the modulation frequency, ``frequency_sigma_m`` and others. NaN: there is no range.

    Raises
    ------
    Error
        For a camera that no Simulator takes, and for a number out of range.
    """
    cases = [_case(one) for one in ambient]
    words = {"distance_m": [float(one) for one in distance_m], "reflectivity": [float(one) for one in reflectivity], "ambient": cases,
             "angle_rad": angle_rad, "temperature_celsius": temperature_celsius, "pixel": pixel, "auto_exposure": auto_exposure}
    arrays, summary = _native.budget(camera, words)
    return Budget(arrays, summary, [one.name for one in cases])
