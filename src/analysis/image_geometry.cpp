// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/image_geometry.h"

#include "camera/lens/lens.h"
#include "camera/readout/image_camera.h"

namespace tofray {

Camera analysis::image_camera(const Camera& profile) { return camera::ImageCamera(profile); }

std::optional<std::array<double, 2>> analysis::direction_through(const Camera& profile, double u, double v) {
  const Lens lens = camera::ImageCamera(profile).lens;
  camera::Point2 ray{};
  if (!camera::unproject(lens, camera::growing_radius_squared(lens), {u, v}, ray)) return {};
  return std::array{ray.x, ray.y};
}

}  // namespace tofray
