// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "base/vec.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// Rows: the x, y and z axis of a light source. z is its axis, x the camera's as far as that goes (of an axis along x: its y).
base::Mat3 source_axes(const Vec3& axis);

/// Point sources in place of a camera's lights, one for each LED of a ring and each point of an area, LED by LED: what kernels, arrays of
/// one's own and the decoder count as a light each. Of a camera that has nothing else these are its lights.
std::vector<Illumination> emitters_of(const Camera& camera);
/// The camera with these for its lights.
/// @tparam AnyCamera  Camera, or a kind of it
template <class AnyCamera>
AnyCamera with_emitters(AnyCamera camera) {
  camera.illumination = emitters_of(camera);
  return camera;
}

}  // namespace tofray::camera
