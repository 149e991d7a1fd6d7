# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""Passes of Blender's Cycles (a multi-layer EXR) become raw frames and depth. Run by Python, it has Blender draw, and then looks at the file."""

from __future__ import annotations

import json
import pathlib
import subprocess
import sys
from typing import Any

MATERIALS: dict[int, float | str] = {1: 0.8, 2: "skin", 3: "cardboard-grey"}  # by pass index: what they send back at 850 nm, which colours do not say


def draw(pinhole: dict[str, Any], file: str) -> None:
    """In Blender: a wall, a ball and a box, seen by a camera 1 m above the floor that looks along y, and a bit down."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_plane_add(size=20, location=(0, 1.8, 0), rotation=(1.5708, 0, 0.4))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=128, ring_count=64, radius=0.2, location=(-0.25, 1.1, 0.9))
    bpy.ops.mesh.primitive_cube_add(size=0.3, location=(0.3, 1.2, 0.85))
    for index, one in enumerate(bpy.data.objects, start=1):
        one.pass_index = {"Plane": 1, "Sphere": 2, "Cube": 3}[one.name]
    bpy.ops.object.camera_add(location=(0, 0, 1), rotation=(1.5, 0, 0))
    scene, camera = bpy.context.scene, bpy.context.object
    scene.camera = camera
    camera.data.sensor_fit, camera.data.sensor_width = "HORIZONTAL", 36
    camera.data.lens = 36 * pinhole["fx_px"] / pinhole["width"]
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 0.01  # z of the pixel's middle, not of somewhere in it
    scene.render.resolution_x, scene.render.resolution_y = pinhole["width"], pinhole["height"]
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_object_index = True
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR_MULTILAYER", "32"
    scene.render.filepath = file
    bpy.ops.render.render(write_still=True)
    pathlib.Path(file).with_suffix(".json").write_text(json.dumps([list(row) for row in camera.matrix_world]), encoding="utf-8")


def main() -> None:
    import numpy as np
    import OpenImageIO as oiio

    import tofray

    camera = tofray.load_camera("pico-flexx")
    pinhole = tofray.pinhole_for(camera)
    words = json.dumps({"fx_px": pinhole.fx_px, "width": pinhole.width, "height": pinhole.height})
    subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--", words, "blender.exr"],
                   check=True, stdout=subprocess.DEVNULL)
    picture = oiio.ImageBuf("blender.exr")
    channels, pixels = list(picture.spec().channelnames), picture.get_pixels(oiio.FLOAT)

    def layer(*names: str) -> Any:
        return pixels[..., [next(i for i, one in enumerate(channels) if one.endswith(name)) for name in names]]

    pose = tofray.Pose.from_matrix(json.loads(pathlib.Path("blender.json").read_text(encoding="utf-8")), axes="opengl")
    seen = tofray.from_pictures(camera, layer("Depth.Z")[..., 0], intrinsics=pinhole, normal=layer("Normal.X", "Normal.Y", "Normal.Z"),
                                normal_axes=pose, labels=layer("IndexOB.X")[..., 0].astype(np.int32), materials=MATERIALS, still=True)
    frame = tofray.Simulator(tofray.Scene(), camera, seed=7).frame(0, seen)
    error_mm = 1e3 * np.abs(frame.depth.z_m - frame.truth.z_m)
    print(f"{np.isfinite(error_mm).mean():.0%} of the pixels have a depth, half of them within {np.nanmedian(error_mm):.1f} mm of the truth")
    frame.save("blender", scale=2)


if __name__ == "__main__":
    if "--" in sys.argv:
        draw(json.loads(sys.argv[-2]), sys.argv[-1])
    else:
        main()
