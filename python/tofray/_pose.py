# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Poses and placements from matrices and quaternions, and back: what these classes have beside their members."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ._record import Record

if TYPE_CHECKING:
    from typing import Literal, Sequence

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ._model import Placement, Pose

# Columns: the optical axes (right, down, forward) in others.
_OPTICAL_IN = {
    "optical": ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "body": ((0, 0, 1), (-1, 0, 0), (0, -1, 0)),
    "opengl": ((1, 0, 0), (0, -1, 0), (0, 0, -1)),
}


class PlacementMethods(Record):
    __slots__ = ()

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Placement:
        """The placement that a matrix says: in the world, where the object stands at zero in the scene's file.

        Parameters
        ----------
        matrix : array [4, 4], m
            From the object's own frame to the world's: a rotation R, and a shift p in the last column; what is at x from the object's centre
            is at R x + p then.

        Returns
        -------
        Placement
            With ``position`` and the rotation's ``quaternion``.

        Raises
        ------
        Error
            Where the upper left 3 x 3 is no rotation to 1e-3 (it scales, shears or mirrors), or the last row is not 0 0 0 1.
        """
        from . import _model

        pose = _model.Pose.from_matrix(matrix)
        return _model.Placement(position=pose.position, rotation=_model.Rotation(quaternion=pose.quaternion))


class PoseMethods(Record):
    __slots__ = ()

    @classmethod
    def from_matrix(cls, matrix: ArrayLike, *, axes: Literal["optical", "body", "opengl"] = "optical") -> Pose:
        """The pose that a matrix says.

        Parameters
        ----------
        matrix : array [4, 4], m
            From the camera's frame to the world's: a rotation R, and the camera's place p in the last column; what is at x in the
            camera's frame is at R x + p in the world. ``tofray.camera_pose`` and the array ``camera_pose`` of files are such matrices.
        axes : "optical", "body" or "opengl"
            The camera's frame: x right, y down, z forward (OpenCV, ROS's optical frames); x forward, y left, z up (a body in ROS);
            x right, y up, z backward (OpenGL, Blender, NeRF data sets).

        Returns
        -------
        Pose
            With ``position`` and ``quaternion``.

        Raises
        ------
        Error
            Where the upper left 3 x 3 is no rotation to 1e-3 (it scales, shears or mirrors), or the last row is not 0 0 0 1.
        """
        import numpy as np

        from . import _native
        from ._errors import BadInput

        given = np.asarray(matrix, np.float64)
        if given.shape != (4, 4):
            raise BadInput(f"error: the matrix of a pose has the shape {given.shape}\n  expected (4, 4)")
        if axes not in _OPTICAL_IN:
            raise BadInput(f"error: axes is {axes!r}\n  expected optical, body or opengl")
        turned = given.copy()
        turned[:3, :3] = given[:3, :3] @ np.array(_OPTICAL_IN[axes], np.float64)
        pose: Pose = _native.pose_from_matrix(turned.ravel().tolist())
        return pose

    @classmethod
    def from_quaternion(cls, position: Sequence[float], quaternion: Sequence[float], *,
                        axes: Literal["optical", "body", "opengl"] = "optical") -> Pose:
        """The pose that a place and a quaternion say.

        Parameters
        ----------
        position : three floats, m
            Of the camera, in the world.
        quaternion : four floats, 1
            x, y, z, w (the scalar last, as in ROS, TUM's files and scipy), from the camera's frame to the world's; of length 1 to 1e-3.
        axes : "optical", "body" or "opengl"
            The camera's frame, as in ``from_matrix``.

        Returns
        -------
        Pose
            With ``position`` and ``quaternion``, which is of unit length then.

        Raises
        ------
        Error
            Where the quaternion is not of unit length.
        """
        import numpy as np

        from . import _model

        pose = _model.Pose(position=tuple(map(float, position)), quaternion=tuple(map(float, quaternion)))  # type: ignore[arg-type]
        turned = pose.matrix  # which checks it
        if axes != "optical":
            return cls.from_matrix(turned, axes=axes)
        length = float(np.sqrt(np.dot(pose.quaternion, pose.quaternion)))  # type: ignore[arg-type]
        pose.quaternion = tuple(part / length for part in pose.quaternion)  # type: ignore[assignment, union-attr]
        return pose

    @property
    def matrix(self) -> NDArray[np.float64]:
        """From the camera's frame (x right, y down, z forward) to the world's: float64 array [4, 4], m; last row 0 0 0 1.

        Raises
        ------
        Error
            For a pose that cannot be.
        """
        from . import _native

        return _native.pose_matrix(self)


__all__ = ["PoseMethods"]
