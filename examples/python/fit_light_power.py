# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Fitting the light's power to a recording: which power makes the simulated raw frames those of a scene that was measured?

Power stands for the whole product of power, transmission, fill factor and quantum efficiency, which nobody can measure apart.
"""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

import tofray


def fit(raw: tofray.Raw, scene: tofray.Scene, camera: tofray.Camera) -> tuple[float, float]:
    """The power of the camera's first light, and its standard error, in watts.

    What is compared are the codes of the lit raw frames: they go with the power in a straight line, which amplitudes do not where there is
    little light. The difference of the taps scatters by the root of all electrons in both (theory 3), and by their read noise.
    """
    lit = raw.lit > 0
    codes = raw.raw[lit].astype(np.float64)

    def taps(power_w: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Electrons to expect. (Codes would be rounded, and steps are no curve to fit.)"""
        brighter = copy.deepcopy(camera)
        brighter.illumination[0].power_w = power_w
        expected = tofray.Simulator(scene, brighter, noise="off", truth=False, last_stage="raw").frame(0).raw
        return expected.tap_a[lit].astype(np.float64), expected.tap_b[lit].astype(np.float64)

    step, middle = camera.adc.step_e_per_dn, camera.adc.mid_code
    sigma = np.sqrt(sum(taps(camera.illumination[0].power_w)) + 2 * camera.pixel.read_noise_e**2) / step
    whole = (codes > camera.adc.valid_min + 5 * sigma) & (codes < camera.adc.valid_max - 5 * sigma)  # others may be clipped

    def residuals(logarithm: NDArray[np.float64]) -> Any:
        tap_a, tap_b = taps(float(np.exp(logarithm[0])))
        return (((tap_a - tap_b) / step + middle - codes) / sigma)[whole]

    found = least_squares(residuals, [np.log(camera.illumination[0].power_w)], diff_step=1e-2)
    steep = found.jac[:, 0]
    power_w = float(np.exp(found.x[0]))
    return power_w, power_w * float(np.sqrt(np.mean(found.fun**2) / (steep @ steep)))


def main() -> None:
    scene = tofray.scene({"objects": [{"plane": {"point": [0, 0, 1.5], "normal": [0, 0, -1], "reflectivity": 0.8}}]}, name="wall")
    camera = tofray.load_camera("pico-flexx", "MODE_9_5FPS_2000")
    real = copy.deepcopy(camera)  # no camera at hand: one whose light is weaker than its profile says
    real.illumination[0].power_w *= 0.83
    recording = tofray.Simulator(scene, real, seed=11).frame(0).raw
    power_w, error_w = fit(recording, scene, camera)
    print(f"the profile says {camera.illumination[0].power_w:.5f} W, the recording {power_w:.5f} +- {error_w:.5f} W"
          f" (simulated with {real.illumination[0].power_w:.5f} W)")


if __name__ == "__main__":
    main()
