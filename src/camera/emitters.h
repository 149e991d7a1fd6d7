// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "base/vec.h"
#include "camera/image_camera.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// Rows: the x, y and z axis of a light source. z is its axis, x the camera's as far as that goes (of an axis along x: its y).
base::Mat3 source_axes(const Vec3& axis);

/// The same camera with point sources in place of its lights, one for each LED of a ring and each point of an area, LED by LED: what
/// kernels, arrays of one's own and the decoder count as a light each. Of a camera that has nothing else it is the camera itself.
Camera with_emitters(const Camera& camera);
ImageCamera with_emitters(ImageCamera camera);

}  // namespace tofray::camera
