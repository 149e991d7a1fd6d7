// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/bodies.h"
#include "analysis/tessellation.h"
#include "base/rotation.h"
#include "tofray/analysis.h"

namespace tofray {

namespace {

Vec3 vec3_of(const analysis::Vec& v) { return {v.x, v.y, v.z}; }

}  // namespace

std::vector<ObjectPlace> object_places(const Scene& scene, double time_s) {
  const std::vector<analysis::Body> bodies = analysis::bodies_at(scene, time_s);
  std::vector<ObjectPlace> out;
  out.reserve(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Object& object = scene.objects[i];
    const analysis::ObjectPose pose = analysis::pose_of(object, time_s);
    base::Mat3 rows{};
    for (std::size_t k = 0; k < 3; ++k) rows[k] = vec3_of(pose.turn.row[k]);
    out.push_back({object.name, object.class_name, vec3_of(pose.origin), base::quaternion_of(rows), bodies[i].endless,
                   vec3_of(bodies[i].low), vec3_of(bodies[i].high)});
  }
  return out;
}

}  // namespace tofray
