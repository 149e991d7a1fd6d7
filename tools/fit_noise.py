#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Fits the light of camera profiles to published noise, and says how well one number does.

What is fitted is the light's power. It stands for the whole product of power, transmission, fill factor, quantum efficiency and lens
that nobody publishes; for one camera the read noise is fitted with it. Noise is compared by the logarithm, so that a millimetre and a
centimetre weigh alike. Nothing is written: the numbers that are printed stand in profiles/.

    python3 tools/fit_noise.py                 all cameras
    python3 tools/fit_noise.py flexx2          one
"""

import dataclasses
import math
import sys

from one_pixel import Pixel


@dataclasses.dataclass
class Case:
    """Noise of cameras that share a light: (camera, mode, distance [m], reflectivity, published sigma [mm])."""

    what: str
    points: list
    first_w: float
    first_read_noise_e: float = 0  # above 0: fitted, too
    beyond: list = dataclasses.field(default_factory=list)  # compared, but not fitted


def published(camera, mode, reflectivity, noise):
    return [(camera, mode, distance, reflectivity, sigma) for distance, sigma in noise]


# [cai2024], a white wall: table of the axial noise. The reflectivity, 80 %, is assumed, and so is the mode.
FLEXX2 = [(2, 3.29), (3, 6.02)]
FLEXX2_NEAR = [(0.5, 2.03), (1, 2.07)]

CASES = {
    "flexx2": Case("noise in [cai2024]", published("flexx2", "MODE_9_5FPS", 0.8, FLEXX2), 1,
                   beyond=published("flexx2", "MODE_9_5FPS", 0.8, FLEXX2_NEAR)),
    "azure-kinect-nfov": Case("the maker's 17 mm at 15 % at the end of the range",
                              published("azure-kinect-nfov", "DEPTH_30FPS", 0.15, [(3.86, 17)])
                              + published("azure-kinect-nfov-binned", "DEPTH_30FPS", 0.15, [(5.46, 17)]), 16),
    "azure-kinect-wfov": Case("the maker's 17 mm at 15 % at the end of the range",
                              published("azure-kinect-wfov", "DEPTH_15FPS", 0.15, [(2.21, 17)])
                              + published("azure-kinect-wfov-binned", "DEPTH_30FPS", 0.15, [(2.88, 17)]), 16),
    "adtf3175": Case("the maker's bound, 15 mm at 15 % at 4 m", published("adtf3175", "LR_NATIVE", 0.15, [(4, 15)]), 16),
}


def sigma(point, power_w, read_noise_e=0.0, exposure=""):
    camera, mode, distance, reflectivity, _ = point
    changes = {"camera.illumination.0.power": f"{power_w:.9g} W"}
    if exposure:
        changes["camera.integration_time"] = exposure
    if read_noise_e > 0:
        changes["camera.pixel.read_noise"] = f"{read_noise_e:.9g} e"
    return Pixel(camera, mode, distance, reflectivity, changes).sigma_mm


def misfit(case, power_w, read_noise_e):
    return sum(math.log(sigma(point, power_w, read_noise_e) / point[4]) ** 2 for point in case.points)


def least(function, low, high, rounds=18):
    """Where a function of one hollow is least, by golden section."""
    ratio = (math.sqrt(5) - 1) / 2
    a, b = high - ratio * (high - low), low + ratio * (high - low)
    at_a, at_b = function(a), function(b)
    for _ in range(rounds):
        if at_a < at_b:
            high, b, at_b = b, a, at_a
            a = high - ratio * (high - low)
            at_a = function(a)
        else:
            low, a, at_a = a, b, at_b
            b = low + ratio * (high - low)
            at_b = function(b)
    return 0.5 * (low + high)


def fit(case):
    """The power, and the read noise where it is fitted: one after the other, each within a factor that shrinks."""
    power, read_noise, factor = case.first_w, case.first_read_noise_e, math.log(16)
    for _ in range(5 if read_noise > 0 else 1):
        middle = math.log(power)
        power = math.exp(least(lambda x: misfit(case, math.exp(x), read_noise), middle - factor, middle + factor, 12 if read_noise else 18))
        if read_noise > 0:
            middle = math.log(read_noise)
            read_noise = math.exp(least(lambda x: misfit(case, power, math.exp(x)), middle - factor, middle + factor, 12))
        factor *= 0.6
    return power, read_noise


def compare(case, power, read_noise):
    for point in case.points + case.beyond:
        camera, mode, distance, reflectivity, noise = point
        found = sigma(point, power, read_noise)
        print(f"  {camera:<26} {distance:>6.3f} m at {reflectivity:.0%}: published {noise:>5.2f} mm, "
              f"here {found:>5.2f} mm ({found / noise - 1:+.0%})" + ("" if point in case.points else ", not fitted"))


def exposures(case, power):
    """What exposure would give the published noise where the mode's longest gives less of it: automatic exposure shortens it so."""
    for point in case.beyond:
        time = math.exp(least(lambda x: math.log(sigma(point, power, 0, f"{math.exp(x):.6g} us") / point[4]) ** 2,
                              math.log(50), math.log(2000), 16))
        print(f"  {point[0]} {point[2]} m: {point[4]} mm would be an exposure of {time:.0f} us")


def main():
    for name in sys.argv[1:] or CASES:
        if name not in CASES:
            raise SystemExit(f"error: no published noise of {name}; there is some of {', '.join(CASES)}")
        case = CASES[name]
        power, read_noise = fit(case)
        print(f"{name}: {power:.3g} W" + (f", read noise {read_noise:.3g} e" if read_noise else "") + f" ({case.what})")
        compare(case, power, read_noise)
        exposures(case, power)


if __name__ == "__main__":
    main()
