# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""A MuJoCo model as tofray's scene, as mirror.h has it: each geom that is drawn is an object, made once; then it is told where things are.

MuJoCo's cameras look along -z with y up; tofray's along z with y down. Its quaternions have w first, tofray's last. Both have metres.
"""

from __future__ import annotations

import math
from typing import Any, Mapping

import mujoco
import numpy as np

import tofray

KINDS = {int(getattr(mujoco.mjtGeom, f"mjGEOM_{name.upper()}")): name
         for name in ("plane", "sphere", "capsule", "cylinder", "box", "ellipsoid", "mesh")}


def name_of(model: Any, kind: Any, index: int, else_called: str) -> str:
    return (mujoco.mj_id2name(model, kind, index) if index >= 0 else None) or else_called


def triple(values: Any) -> tuple[float, float, float]:
    x, y, z = map(float, values)
    return x, y, z


def rotation_of(matrix: Any) -> tofray.Rotation:
    """Of nine numbers, row by row, from the thing's frame to the world's."""
    q = np.zeros(4)
    mujoco.mju_mat2Quat(q, matrix)
    w, x, y, z = map(float, q)
    return tofray.Rotation(quaternion=(x, y, z, w))


def pose_of(data: Any, camera: int) -> tofray.Pose:
    right, up, backward = data.cam_xmat[camera].reshape(3, 3).T
    matrix = np.eye(4)
    matrix[:3] = np.stack([right, -up, -backward, data.cam_xpos[camera]], axis=1)
    return tofray.Pose.from_matrix(matrix)


def ellipsoid(radii: Any) -> tofray.Mesh:
    """Flat pieces of 3 degrees of an ellipsoid, its normals those of the round one."""
    around, down = 120, 60
    polar, azimuth = ([turn * i / count for i in range(steps)] for turn, count, steps in ((math.pi, down, down + 1), (2 * math.pi, around, around)))
    on_ball = np.array([(math.sin(p) * math.cos(a), math.sin(p) * math.sin(a), math.cos(p)) for p in polar for a in azimuth])
    normals = on_ball / radii
    normals /= np.sqrt(normals[:, :1] ** 2 + normals[:, 1:2] ** 2 + normals[:, 2:] ** 2)
    triangles = []
    for i in range(down):
        for j in range(around):
            here, right = i * around + j, i * around + (j + 1) % around
            if i > 0:
                triangles.append((here, right, here + around))
            if i + 1 < down:
                triangles.append((right, right + around, here + around))
    return tofray.Mesh(triangles=tofray.TriangleMesh((radii * on_ball).astype(np.float32), np.array(triangles, np.int32), normals.astype(np.float32)))


def mesh(model: Any, index: int) -> tofray.Mesh:
    vertex, face = int(model.mesh_vertadr[index]), int(model.mesh_faceadr[index])
    vertices = model.mesh_vert[vertex:vertex + int(model.mesh_vertnum[index])]
    faces = model.mesh_face[face:face + int(model.mesh_facenum[index])]
    return tofray.Mesh(triangles=tofray.TriangleMesh(np.array(vertices, np.float32), np.array(faces, np.int32)))


def shape_of(model: Any, geom: int) -> Any:
    """A geom's shape about its own zero, where tofray's shapes turn. MuJoCo's sizes are halves."""
    kind = KINDS.get(int(model.geom_type[geom]))
    x, y, z = size = triple(model.geom_size[geom])
    if kind == "plane":
        return tofray.Rectangle(center=(0, 0, 0), size=(2 * x, 2 * y)) if x > 0 and y > 0 else tofray.Plane(point=(0, 0, 0), normal=(0, 0, 1))
    if kind == "sphere":
        return tofray.Sphere(center=(0, 0, 0), radius=x)
    if kind == "capsule":
        return tofray.Capsule(start=(0, 0, -y), end=(0, 0, y), radius=x)
    if kind == "cylinder":
        return tofray.Cylinder(center=(0, 0, 0), axis=(0, 0, 1), radius=x, height=2 * y)
    if kind == "box":
        return tofray.Box(min=(-x, -y, -z), max=size)
    if kind == "ellipsoid":
        return ellipsoid(np.array(size))
    if kind == "mesh":
        return mesh(model, int(model.geom_dataid[geom]))
    raise ValueError(f"{name_of(model, mujoco.mjtObj.mjOBJ_GEOM, geom, f'geom.{geom}')} is a height field or of an unknown type: expected "
                     "planes, spheres, capsules, cylinders, boxes, ellipsoids, meshes")


def linear(screen: float) -> float:
    return screen / 12.92 if screen <= 0.04045 else math.pow((screen + 0.055) / 1.055, 2.4)


class Mirror:
    """What mirror.h's class of that name is.

    camera is the name of one of the model's cameras; only where it is counts, the lens is tofray's. materials are by names of geoms or of
    MuJoCo's materials; of others the mean of their colour stands for reflectivity, which in the near infrared it is not.
    ValueError where there is no such camera, and for height fields.
    """

    def __init__(self, model: Any, camera: str, materials: Mapping[str, tofray.Material] | None = None) -> None:
        self._model, self._materials = model, materials or {}
        self._camera = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, camera)
        if self._camera < 0:
            raise ValueError(f'the model has no camera "{camera}"')
        self._camera_moves = self._moves(int(model.cam_bodyid[self._camera])) or int(model.cam_mode[self._camera]) != 0   # 0: fixed to its body
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        #: What stands still is where it is, what moves at zero. Objects are called as geoms are, or "geom.7".
        self.scene = tofray.Scene(name="mujoco")
        self.scene.camera.pose = pose_of(data, self._camera)
        #: The geom that each object is (``frame.truth.object_id``).
        self.geoms: list[int] = []
        self._moving: dict[str, int] = {}
        for geom in range(model.ngeom):
            if self._colour(geom)[3] != 0:
                self._add(geom, data)
        self._forget()

    def _moves(self, body: int) -> bool:
        return bool(self._model.body_weldid[body] != 0 or self._model.body_mocapid[body] >= 0)

    def _colour(self, geom: int) -> list[float]:
        paint = int(self._model.geom_matid[geom])
        return [float(part) for part in (self._model.mat_rgba[paint] if paint >= 0 else self._model.geom_rgba[geom])]

    def _add(self, geom: int, data: Any) -> None:
        added = tofray.Object(name=name_of(self._model, mujoco.mjtObj.mjOBJ_GEOM, geom, f"geom.{geom}"), shape=shape_of(self._model, geom),
                              material=len(self.geoms))
        if self._moves(int(self._model.geom_bodyid[geom])):
            self._moving[added.name] = geom
        else:
            added.position, added.rotation = triple(data.geom_xpos[geom]), rotation_of(data.geom_xmat[geom])
        self.geoms.append(geom)
        self.scene.objects.append(added)
        self.scene.materials.append(self._material_of(geom))

    def _material_of(self, geom: int) -> tofray.Material:
        paint = int(self._model.geom_matid[geom])
        for name in (name_of(self._model, mujoco.mjtObj.mjOBJ_GEOM, geom, ""), name_of(self._model, mujoco.mjtObj.mjOBJ_MATERIAL, paint, "")):
            if name in self._materials:
                return self._materials[name]
        return tofray.Material(diffuse=sum(linear(part) / 3 for part in self._colour(geom)[:3]))

    def _forget(self) -> None:
        self._seen: dict[str, list[tofray.Keyframe]] = {}
        self._camera_seen: list[tofray.CameraKeyframe] = []

    def look(self, data: Any) -> None:
        """Remembers where all that moves is at ``data.time``: call it at the times of tofray.exposure_times, or oftener."""
        when = float(data.time)
        for name, geom in self._moving.items():
            key = tofray.Keyframe(time_s=when, position=triple(data.geom_xpos[geom]), rotation=rotation_of(data.geom_xmat[geom]))
            self._seen.setdefault(name, []).append(key)
        if self._camera_moves:
            self._camera_seen.append(tofray.CameraKeyframe(time_s=when, pose=pose_of(data, self._camera)))

    def seen(self) -> dict[str, Any]:
        """What was remembered since the last call, as ``camera`` and ``objects`` of ``simulator.frame``."""
        out: dict[str, Any] = {"camera": self._camera_seen or None, "objects": self._seen}
        self._forget()
        return out
