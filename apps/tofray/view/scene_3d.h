// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/tessellation.h"
#include "files/json.h"
#include "view/drag.h"

namespace tofray::view {

/// What of a scene in 3D does not change from frame to frame.
struct Geometry {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rays;  ///< [height][width][2]: x/z, y/z of each pixel's ray
  analysis::SceneTriangles triangles;
};
Geometry geometry_of(const SceneAt& at);
/// Whether both are drawn alike.
bool same(const Geometry& a, const Geometry& b);

/// Adds what a `view3d` message has: time_s, camera, frustum, lights, objects.
void put_scene(files::Json& json, const SceneAt& at, const Geometry& geometry);

}  // namespace tofray::view
