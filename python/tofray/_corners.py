# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Corners of a chessboard in an image: OpenCV finds them, and two crossing edges fitted to each say where they are to hundredths of a pixel."""

from __future__ import annotations

import importlib
from typing import Any

_STEPS = 25
_SETTLED_PX = 5e-4
_STEP = 1e-4  # of slopes: pixels and radians


def opencv() -> Any:
    try:
        return importlib.import_module("cv2")
    except ImportError as fault:
        raise ImportError("calibrate lens needs the package cv2 (Debian: python3-opencv)") from fault


def corners_of(image: Any, columns: int, rows: int) -> Any:
    """Of an image [height, width] the inner corners [rows·columns, 2] (u, v) in pixels, row by row of the board; None where there is no such board."""
    found = _found(image, columns, rows)
    return None if found is None else refined(image, found.reshape(rows, columns, 2)).reshape(-1, 2)


def _found(image: Any, columns: int, rows: int) -> Any:
    """To a fraction of a pixel. Small images are enlarged first: squares of a few pixels are not found otherwise."""
    import numpy as np

    cv2 = opencv()
    seen = np.nan_to_num(np.asarray(image, np.float32), nan=0.0, posinf=0.0, neginf=0.0)
    even = seen / (cv2.GaussianBlur(seen, (0, 0), seen.shape[1] / 16) + 0.02 * float(seen.max()) + 1e-20)  # without the light's fall-off
    for picture in (even, np.sqrt(np.maximum(seen, 0) / (float(np.percentile(seen, 99)) + 1e-20))):
        for times in dict.fromkeys(max(1, round(wide / seen.shape[1])) for wide in (500, 700, 1000, 1)):
            grey = np.clip(picture * (150 if picture is even else 220), 0, 255).astype(np.uint8)
            large = cv2.resize(grey, None, fx=times, fy=times, interpolation=cv2.INTER_CUBIC) if times > 1 else grey
            good, at = cv2.findChessboardCornersSB(large, (columns, rows))
            if good:
                return (at[:, 0].astype(float) + 0.5) / times - 0.5
    return None


def _along(grid: Any, axis: int) -> Any:
    """From each corner to its neighbours on both sides, halved; at the board's rim, to the only one."""
    import numpy as np

    return np.gradient(grid, axis=axis)


def refined(image: Any, grid: Any) -> Any:
    """Corners [rows, columns, 2] where two edges cross.

    About each corner the image is taken to be L(u, v) + C(u, v)·E(a)·E(b): a and b are distances from the two edges E, L and C are planes
    (the light's fall-off). Turned by half a turn a corner looks the same, so that neither pixels nor blur move it.
    """
    import numpy as np

    right, down = _along(grid, 1), _along(grid, 0)
    size = min(float(np.linalg.norm(right, axis=2).min()), float(np.linalg.norm(down, axis=2).min()))
    reach = float(np.clip(0.75 * size, 2.0, 6.0))
    # Normals of the edges along the board's rows and columns.
    first, second = np.arctan2(right[..., 0], -right[..., 1]), np.arctan2(down[..., 0], -down[..., 1])
    start = np.stack([grid[..., 0], grid[..., 1], first, second, np.full(first.shape, 0.2)], axis=-1).reshape(-1, 5)
    at = _solve(np.asarray(image, float), start, reach)
    far = np.hypot(*(at[:, :2] - start[:, :2]).T) > 0.5 * size
    at[far] = start[far]
    return at[:, :2].reshape(grid.shape)


def _edge(distance: Any, normal: Any, blur: Any) -> Any:
    """−1 to 1: x/√(x² + s²) averaged over the square pixel. Without the average, edges along the rows would be off by a tenth of a pixel."""
    import numpy as np

    def twice_integrated(x: Any) -> Any:
        return 0.5 * (x * np.sqrt(x * x + blur * blur) + blur * blur * np.arcsinh(x / blur))

    wide, high = (np.maximum(np.abs(one), 0.02) for one in (np.cos(normal), np.sin(normal)))
    outer, inner = 0.5 * (wide + high), 0.5 * (wide - high)
    four = twice_integrated(distance + outer) - twice_integrated(distance + inner) - twice_integrated(distance - inner) + twice_integrated(distance - outer)
    return four / (wide * high)


class _Windows:
    """Pixels about each corner: their places and values [corner, pixel]."""

    def __init__(self, image: Any, middle: Any, reach: float) -> None:
        import numpy as np

        half = int(np.ceil(reach)) + 1
        v, u = (one.ravel() for one in np.mgrid[-half:half + 1, -half:half + 1])
        self.u = np.rint(middle[:, :1]) + u
        self.v = np.rint(middle[:, 1:]) + v
        height, width = image.shape
        inside = (self.u >= 0) & (self.u < width) & (self.v >= 0) & (self.v < height)
        value = image[np.clip(self.v, 0, height - 1).astype(int), np.clip(self.u, 0, width - 1).astype(int)]
        good = inside & np.isfinite(value)
        self.good = good & good[:, ::-1]  # at the image's rim both halves of a turn, or neither
        self.value = np.where(self.good, value, 0.0)
        self.reach = reach

    def left(self, at: Any) -> Any:
        """Weighted residuals, the planes being those that fit best."""
        import numpy as np

        x, y = self.u - at[:, :1], self.v - at[:, 1:2]
        weight = self.good * np.exp(-((x * x + y * y) / self.reach**2) ** 2)  # round the corner itself, so that it has no side
        a, b = (x * np.cos(at[:, i:i + 1]) + y * np.sin(at[:, i:i + 1]) for i in (2, 3))
        cross = _edge(a, at[:, 2:3], at[:, 4:5]) * _edge(b, at[:, 3:4], at[:, 4:5])
        one = np.ones_like(x)
        basis = np.stack([one, x, y, cross, cross * x, cross * y], axis=-1) * weight[..., None]
        value = self.value * weight
        normal = basis.swapaxes(1, 2) @ basis + 1e-9 * np.eye(6)
        best = np.linalg.solve(normal, basis.swapaxes(1, 2) @ value[..., None])
        return value - (basis @ best)[..., 0]


def _solve(image: Any, start: Any, reach: float) -> Any:
    """Levenberg and Marquardt's steps for all corners at once; who has settled stays."""
    import numpy as np

    out = start.copy()
    moving = np.arange(len(start))
    damping = np.full(len(start), 1e-3)
    for _ in range(_STEPS):
        at = out[moving]
        windows = _Windows(image, at[:, :2], reach)
        left = windows.left(at)
        slope = np.stack([(windows.left(at + _STEP * (np.arange(5) == i)) - left) / _STEP for i in range(5)], axis=-1)
        tried = at + np.clip(_move(slope, left, damping[moving]), -0.5, 0.5)
        tried[:, 4] = np.clip(tried[:, 4], 0.03, 3.0)
        better = (windows.left(tried)**2).sum(axis=1) < (left**2).sum(axis=1)
        out[moving[better]] = tried[better]
        damping[moving] *= np.where(better, 0.2, 5.0)
        moving = moving[np.hypot(*(tried - at)[:, :2].T) > _SETTLED_PX]
        if len(moving) == 0:
            break
    return out


def _move(slope: Any, left: Any, damping: Any) -> Any:
    import numpy as np

    normal = slope.swapaxes(1, 2) @ slope
    diagonal = np.einsum("nii->ni", normal)
    damped = normal + (damping[:, None] * diagonal + 1e-12 * diagonal.max(axis=1, keepdims=True) + 1e-30)[..., None] * np.eye(normal.shape[1])
    return -np.linalg.solve(damped, slope.swapaxes(1, 2) @ left[..., None])[..., 0]
