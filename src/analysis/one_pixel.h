// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/readout/image_camera.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

/// One pixel before a wall: what reports of a camera simulate.
namespace tofray::analysis {

/// Expected values up to a stage, on this thread.
SimulatorOptions expected_values(Stage last);

/// A matt wall that all pixels see at the same z.
/// @param angle_rad  it is turned by this about the camera's y; 0: it faces the camera
Geometry wall_at(int width, int height, double z, double reflectivity, double angle_rad = 0);

/// The camera with one pixel alone, which is like the mean of all and looks where pixel (u, v) does; neighbours, other cameras, frames
/// before and exposures of others do nothing to it.
/// @param camera  as it is read out
camera::ImageCamera pixel_alone(camera::ImageCamera camera, double u, double v);

}  // namespace tofray::analysis
