# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What class Pinhole has beside its members."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._record import Record

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class PinholeMethods(Record):
    __slots__ = ()

    if TYPE_CHECKING:
        height: int
        fx_px: float
        fy_px: float
        cx_px: float
        cy_px: float

    @property
    def matrix(self) -> NDArray[np.float64]:
        """The intrinsic matrix K: float64 array [3, 3], px; with its first pixel's middle at ``pixel_centre``."""
        import numpy as np

        return np.array([[self.fx_px, 0, self.cx_px], [0, self.fy_px, self.cy_px], [0, 0, 1]], np.float64)

    @property
    def angle_up_down_rad(self) -> float:
        """The angle of view from the picture's upper to its lower edge (``fovy``), where the axis is its middle: 2 atan(height / (2 fy))."""
        import math

        return 2 * math.atan(self.height / (2 * self.fy_px))


__all__ = ["PinholeMethods"]
