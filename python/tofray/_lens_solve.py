# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A lens and the poses of a board before it, by least squares over all corners together."""

from __future__ import annotations

import copy
import math
from typing import TYPE_CHECKING, Any

from ._corners import opencv
from ._errors import BadInput
from ._simulator import pixel_rays

if TYPE_CHECKING:
    from ._calibrate_lens import Model
    from ._model import Camera, Lens

# In OpenCV's order.
NAMES: dict[Model, list[str]] = {
    "plumb_bob": ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"],
    "rational_polynomial": ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"],
    "equidistant": ["fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"],
}
_STEPS = 200


def with_lens(camera: Camera, model: Model, values: dict[str, float]) -> Camera:
    """The camera with another lens: coefficients that the model has not are 0."""
    out = copy.deepcopy(camera)
    lens = out.lens
    lens.distortion = "fisheye" if model == "equidistant" else "brown_conrady"
    for name in ("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"):
        setattr(lens, name, values.get(name, 0.0))
    lens.fx_px, lens.fy_px, lens.cx_px, lens.cy_px = (values[name] for name in ("fx", "fy", "cx", "cy"))
    return out


def _numbers(lens: Lens, model: Model) -> Any:
    import numpy as np

    same = (lens.distortion == "fisheye") == (model == "equidistant")
    first = [lens.fx_px, lens.fy_px, lens.cx_px, lens.cy_px]
    return np.array(first + [float(getattr(lens, name)) if same else 0.0 for name in NAMES[model][4:]])


def project(model: Model, lens: Any, points: Any, pose: Any) -> tuple[Any, Any, Any]:
    """Pixels [n, 2] of points, and their slopes [n, 2, …] by the lens and by the pose (three of rotation, three of place)."""
    import numpy as np

    cv2 = opencv()
    matrix = np.array([[lens[0], 0, lens[2]], [0, lens[1], lens[3]], [0, 0, 1.0]])
    count = len(lens)
    given = np.ascontiguousarray(points, float).reshape(-1, 1, 3)
    if model == "equidistant":
        at, slope = cv2.fisheye.projectPoints(given, pose[:3].copy(), pose[3:].copy(), matrix, np.ascontiguousarray(lens[4:]))
        slope = np.asarray(slope).reshape(-1, 2, 15)
        return at.reshape(-1, 2), slope[..., :count], slope[..., 8:14]
    at, slope = cv2.projectPoints(given, pose[:3], pose[3:], matrix, np.ascontiguousarray(lens[4:]))
    slope = np.asarray(slope).reshape(-1, 2, slope.shape[1])
    return at.reshape(-1, 2), slope[..., 6:6 + count], slope[..., :6]


class Bundle:
    """Corners of one board in several images, and what is taken to have made them: a lens, and a pose for each image."""

    def __init__(self, model: Model, camera: Camera, points: Any, corners: list[Any]) -> None:
        self.model: Model = model
        self.points = points
        self.corners = corners
        self._size = (int(camera.sensor.width), int(camera.sensor.height))
        self._start = _numbers(camera.lens, model)
        self.lens = self._start
        self.poses: list[Any] = []

    def solve(self) -> None:
        """From the profile's lens, and from one that the images say: what fits better is taken."""
        best = None
        for lens in (self._start, self._by_homographies()):
            self.lens, self.poses = lens, [self._pose(lens, one) for one in self.corners]
            self._descend()
            if best is None or self.rms_px() < best[0]:
                best = self.rms_px(), self.lens, self.poses
        assert best is not None
        _, self.lens, self.poses = best

    def _by_homographies(self) -> Any:
        import numpy as np

        found = opencv().initCameraMatrix2D([self.points.astype(np.float32)] * len(self.corners), [one.astype(np.float32) for one in self.corners], self._size)
        lens = np.zeros(len(self._start))
        lens[:4] = found[0, 0], found[1, 1], found[0, 2], found[1, 2]
        usual = np.isfinite(lens).all() and (lens[:2] > 0).all() and (lens[:2] < 1e5).all()
        return lens if usual else self._start

    def _pose(self, lens: Any, corners: Any) -> Any:
        import numpy as np

        cv2 = opencv()
        matrix = np.array([[lens[0], 0, lens[2]], [0, lens[1], lens[3]], [0, 0, 1.0]])
        given = np.ascontiguousarray(corners, float).reshape(-1, 1, 2)
        flat = cv2.fisheye.undistortPoints(given, matrix, lens[4:]) if self.model == "equidistant" else cv2.undistortPoints(given, matrix, lens[4:])
        flat = flat if np.isfinite(flat).all() and np.abs(flat).max() < 50 else (given - lens[2:4]) / lens[:2]
        good, turn, place = cv2.solvePnP(self.points, flat, np.eye(3), None, flags=cv2.SOLVEPNP_IPPE)
        if not good:
            raise BadInput("error: the corners of an image are not those of a flat board\n  expected images of one flat chessboard")
        return np.concatenate([turn.ravel(), place.ravel()])

    def _rows(self, lens: Any, poses: list[Any]) -> list[tuple[Any, Any, Any]]:
        """Of each image what is left [2n], and its slopes by lens and pose."""
        out = []
        for corners, pose in zip(self.corners, poses):
            at, by_lens, by_pose = project(self.model, lens, self.points, pose)
            out.append(((at - corners).ravel(), by_lens.reshape(-1, len(lens)), by_pose.reshape(-1, 6)))
        return out

    def _descend(self) -> None:
        """Levenberg and Marquardt's steps. Poses are of one image each, and are eliminated one by one."""
        damping = 1e-4
        rows = self._rows(self.lens, self.poses)
        cost = sum(float(one[0] @ one[0]) for one in rows)
        for _ in range(_STEPS):
            lens, poses = self._step(rows, damping)
            then = self._rows(lens, poses)
            after = sum(float(one[0] @ one[0]) for one in then)
            if not after < cost:
                damping *= 10
                if damping > 1e8:
                    break
                continue
            done = cost - after < 1e-12 * cost
            self.lens, self.poses, rows, cost, damping = lens, poses, then, after, max(damping / 10, 1e-12)
            if done:
                break

    def _step(self, rows: list[tuple[Any, Any, Any]], damping: float) -> tuple[Any, list[Any]]:
        import numpy as np

        normal = sum(a.T @ a for _, a, _ in rows)
        scale = np.diag(np.diag(normal)) * damping + 1e-15 * np.eye(len(self.lens))
        normal = normal + scale
        right = -sum(a.T @ left for left, a, _ in rows)
        solved = []
        for left, a, b in rows:
            own = b.T @ b
            own = own + damping * np.diag(np.diag(own))
            mixed = np.linalg.solve(own, np.column_stack([b.T @ a, -b.T @ left]))
            normal = normal - a.T @ b @ mixed[:, :-1]
            right = right - a.T @ b @ mixed[:, -1]
            solved.append(mixed)
        move = np.linalg.lstsq(normal, right, rcond=1e-14)[0]
        return self.lens + move, [pose + mixed[:, -1] - mixed[:, :-1] @ move for pose, mixed in zip(self.poses, solved)]

    def covariance(self) -> Any:
        """Of the lens; what the corners scatter says how well they are known. Infinite where it is not determined."""
        import numpy as np

        rows = self._rows(self.lens, self.poses)
        normal = np.zeros((len(self.lens),) * 2)
        for _, a, b in rows:
            normal += a.T @ (a - b @ np.linalg.lstsq(b, a, rcond=None)[0])
        freedom = sum(len(left) for left, _, _ in rows) - len(self.lens) - 6 * len(rows)
        variance = sum(float(left @ left) for left, _, _ in rows) / max(freedom, 1)
        size = np.sqrt(np.maximum(np.diag(sum(a.T @ a for _, a, _ in rows)), 1e-300))
        even = normal / np.outer(size, size)
        if np.linalg.eigvalsh(even).min() < 1e-13:
            return np.full(normal.shape, math.inf)
        return variance * np.linalg.inv(even) / np.outer(size, size)

    def rms_px(self) -> float:
        import numpy as np

        return float(np.sqrt(np.mean(np.square(self.each_rms_px()))))

    def each_rms_px(self) -> list[float]:
        import numpy as np

        return [float(np.sqrt(2 * np.mean(left**2))) for left, _, _ in self._rows(self.lens, self.poses)]

    def rms_elsewhere_px(self, corners: list[Any]) -> float:
        """Of other images by this lens, whose poses alone are fitted."""
        import numpy as np

        squares = []
        for one in corners:
            pose = self._pose(self.lens, one)
            for _ in range(20):
                at, _, slope = project(self.model, self.lens, self.points, pose)
                pose = pose - np.linalg.lstsq(slope.reshape(-1, 6), (at - one).ravel(), rcond=None)[0]
            squares.append(2 * np.mean((project(self.model, self.lens, self.points, pose)[0] - one) ** 2))
        return float(np.sqrt(np.mean(squares)))

    def most_tilted_rad(self) -> float:
        """The largest angle between two boards, or between one and the image."""
        import numpy as np

        normals = np.stack([opencv().Rodrigues(pose[:3])[0][:, 2] for pose in self.poses] + [np.array([0.0, 0.0, 1.0])])
        return float(np.arccos(np.clip(normals @ normals.T, -1, 1)).max())

    def ray_errors_px(self, lens: Lens, camera: Camera, covariance: Any) -> Any:
        """Of each pixel, by how much it may look elsewhere: √(trace(J Σ Jᵀ)), NaN where it looks nowhere."""
        import numpy as np

        other = copy.deepcopy(camera)
        other.lens = lens
        _, slope, _ = self._of_rays(other)
        return np.sqrt(np.einsum("nij,jk,nik->n", slope, covariance, slope))

    def apart_px(self, camera: Camera) -> Any:
        """Of each pixel, how far from itself this lens shows what the camera's own lens sees there."""
        import numpy as np

        at, _, own = self._of_rays(camera)
        return np.hypot(*(at - own).T)

    def _of_rays(self, camera: Camera) -> tuple[Any, Any, Any]:
        import numpy as np

        rays = pixel_rays(camera).astype(float)
        v, u = np.mgrid[:rays.shape[0], :rays.shape[1]]
        good = np.isfinite(rays).all(axis=2)
        points = np.concatenate([rays[good], np.ones((int(good.sum()), 1))], axis=1)
        at, slope, _ = project(self.model, self.lens, points, np.array([0.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
        return at, slope, np.stack([u[good], v[good]], axis=1)
