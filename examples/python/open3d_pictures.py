# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""What Open3D's rays meet becomes raw frames and depth: z, normals and ids of a picture's pixels are what tofray takes of any renderer."""

from __future__ import annotations

import numpy as np
import open3d as o3d

import tofray


def cell() -> tuple[o3d.t.geometry.RaycastingScene, dict[int, float | str]]:
    """A wall, a ball and a box, in the camera's frame (x right, y down, z forward), and by their ids what they send back at 850 nm."""
    wall = o3d.geometry.TriangleMesh.create_box(6, 6, 0.1).translate((-3, -3, 1.6))
    wall.rotate(wall.get_rotation_matrix_from_xyz((0, 0.4, 0)), (0, 0, 1.6))
    ball = o3d.geometry.TriangleMesh.create_sphere(0.2, resolution=60).translate((-0.25, 0.1, 1.1))
    box = o3d.geometry.TriangleMesh.create_box(0.3, 0.3, 0.3).translate((0.15, 0.05, 1.0))
    scene = o3d.t.geometry.RaycastingScene()
    meshes = [o3d.t.geometry.TriangleMesh.from_legacy(mesh) for mesh in (wall, ball, box)]
    return scene, dict(zip([int(scene.add_triangles(mesh)) for mesh in meshes], [0.8, "skin", "cardboard-grey"]))


def main() -> None:
    camera = tofray.load_camera("pico-flexx")  # whose lens bends rays, which Open3D's camera does not
    pinhole = tofray.pinhole_for(camera)
    scene, materials = cell()
    rays = scene.create_rays_pinhole(o3d.core.Tensor(pinhole.matrix), o3d.core.Tensor(np.eye(4)), pinhole.width, pinhole.height)
    hit = {name: array.numpy() for name, array in scene.cast_rays(rays).items()}
    if not np.isfinite(hit["t_hit"]).any():
        raise SystemExit("no ray of this Open3D hits anything: Debian's 0.16.1 has that fault (the mask of its rays is 0)")
    # Directions have z = 1, so that t_hit is z; it is infinite where nothing is.
    seen = tofray.from_pictures(camera, hit["t_hit"], intrinsics=pinhole, normal=hit["primitive_normals"], labels=hit["geometry_ids"],
                                materials=materials, still=True)
    frame = tofray.Simulator(tofray.Scene(), camera, seed=7).frame(0, seen)
    error_mm = 1e3 * np.abs(frame.depth.z_m - frame.truth.z_m)
    print(f"{np.isfinite(error_mm).mean():.0%} of the pixels have a depth, half of them within {np.nanmedian(error_mm):.1f} mm of the truth")
    frame.save("open3d", scale=2)


if __name__ == "__main__":
    main()
