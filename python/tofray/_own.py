# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Arrays of one's own in the place of what the first stages find."""

from __future__ import annotations

from typing import TYPE_CHECKING, Sequence

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class Geometry:
    """What another renderer saw, pixel for pixel along the camera's rays (``pixel_rays``), in the camera's frame.

    All arrays may have one axis more before the others: a moment for each raw frame, where something moves. They are
    taken as they lie, or refused with the dtype, shape and order that is wanted.

    Parameters
    ----------
    z_m : float32 array [height, width], m
        Along the optical axis, in metres; NaN, or not above 0: nothing is seen.
    normal : float32 array [height, width, 3], 1
        Of unit length, on either side of the surface.
    diffuse : float32 array [height, width], 1
        Reflectivity, 0 to 1.
    specular, exponent : float32 arrays [height, width], 1, optional
        Of the Phong lobe.
    object_id : int32 array [height, width], 1, optional
        For ``truth.object_id``.
    shadow : uint8 array [light, height, width], 1, optional
        1 where the light does not reach.
    sun_shadow : uint8 array [height, width], 1, optional
        1 where ambient light with a direction does not reach.
    """

    __slots__ = ("diffuse", "exponent", "normal", "object_id", "shadow", "specular", "sun_shadow", "z_m")

    def __init__(self, z_m: NDArray[np.float32], normal: NDArray[np.float32], diffuse: NDArray[np.float32], *,
                 specular: NDArray[np.float32] | None = None, exponent: NDArray[np.float32] | None = None,
                 object_id: NDArray[np.int32] | None = None, shadow: NDArray[np.uint8] | None = None,
                 sun_shadow: NDArray[np.uint8] | None = None) -> None:
        self.z_m = z_m
        self.normal = normal
        self.diffuse = diffuse
        self.specular = specular
        self.exponent = exponent
        self.object_id = object_id
        self.shadow = shadow
        self.sun_shadow = sun_shadow


class PixelLight:
    """The light that each pixel receives: paths with power and length, or phasors.

    Parameters
    ----------
    power_w : float32 array [path, height, width], W
        On the pixel, mean of a modulation period. All arrays may have an axis of moments before the others.
    path_length_m : float32 array [path, height, width], m, optional
        From the light to the surface and on to the camera.
    light_of_path : sequence of int, optional
        Which light each path comes from; left out: one path of each.
    phasor_w : complex64 array [light, modulation frequency, harmonic, height, width], W, optional
        In place of path_length_m.
    ambient_e_per_s : float32 array [height, width], e/s, optional
        Electrons of both taps together.
    """

    __slots__ = ("ambient_e_per_s", "light_of_path", "path_length_m", "phasor_w", "power_w")

    def __init__(self, power_w: NDArray[np.float32], path_length_m: NDArray[np.float32] | None = None, *,
                 light_of_path: Sequence[int] | None = None, phasor_w: NDArray[np.complex64] | None = None,
                 ambient_e_per_s: NDArray[np.float32] | None = None) -> None:
        self.power_w = power_w
        self.path_length_m = path_length_m
        self.light_of_path = light_of_path
        self.phasor_w = phasor_w
        self.ambient_e_per_s = ambient_e_per_s


class Transient:
    """The light that each pixel receives by the length of its path, as histograms.

    Parameters
    ----------
    e_per_s : float32 array [bin, height, width], e/s
        Electrons per second of both taps together.
    first_m, bin_width_m : float, m
        Where the first bin begins, and how wide each is: whole path lengths, in metres.
    ambient_e_per_s : float32 array [height, width], e/s, optional
        Light without modulation.
    """

    __slots__ = ("ambient_e_per_s", "bin_width_m", "e_per_s", "first_m")

    def __init__(self, e_per_s: NDArray[np.float32], *, first_m: float, bin_width_m: float,
                 ambient_e_per_s: NDArray[np.float32] | None = None) -> None:
        self.e_per_s = e_per_s
        self.first_m = first_m
        self.bin_width_m = bin_width_m
        self.ambient_e_per_s = ambient_e_per_s
