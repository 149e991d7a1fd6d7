# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0
"""The first frame: a ball before a wall, as a pico flexx sees it."""
import numpy as np

import tofray

scene = tofray.scene({"objects": [{"plane": {"point": [0, 0, 2], "normal": [0, 0, -1], "reflectivity": 0.8}},
                                  {"sphere": {"center": [0.1, 0, 1.3], "radius": "25 cm", "reflectivity": "40 %"}}]})
frame = tofray.Simulator(scene, seed=7).frame(0)
error = frame.depth.z_m - frame.truth.z_m
print(f"{frame}: half of the pixels are within {1e3 * np.nanmedian(np.abs(error)):.1f} mm of the truth")
frame.save("first_frame")
