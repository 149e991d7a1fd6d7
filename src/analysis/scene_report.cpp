// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "analysis/bodies.h"
#include "analysis/findings.h"
#include "analysis/reach.h"
#include "base/faults.h"
#include "tofray/analysis.h"
#include "tofray/simulator.h"
#include "tofray/stages.h"

namespace tofray {

namespace analysis {

namespace {

bool holds(const Body& body, const Vec& p) {
  return body.low.x <= p.x && p.x <= body.high.x && body.low.y <= p.y && p.y <= body.high.y && body.low.z <= p.z && p.z <= body.high.z;
}

bool is_behind(const Body& body, const Seen& seen) {
  const Vec middle = 0.5 * (body.low + body.high), half = 0.5 * (body.high - body.low);
  double most = shape::dot(middle - seen.eye, seen.forward);
  for (int k = 0; k < 3; ++k) most += half[k] * std::abs(seen.forward[k]);
  return !body.endless && most < 0;
}

/// What each object takes, before pixels are looked at.
void place_objects(const Seen& seen, SceneReport& report) {
  for (std::size_t i = 0; i < seen.bodies.size(); ++i) {
    const Body& body = seen.bodies[i];
    ObjectInView& one = report.objects.emplace_back();
    one.object = static_cast<int>(i), one.name = name_of(seen.scene, static_cast<int>(i));
    one.endless = body.endless;
    one.low = {body.low.x, body.low.y, body.low.z}, one.high = {body.high.x, body.high.y, body.high.z};
    one.behind_camera = is_behind(body, seen);
    if (!body.endless && holds(body, seen.eye))
      one.around_camera = is_inside(seen.scene.objects[i], report.time_s, seen.eye).value_or(false);
  }
}

/// Meshes that surround the camera: parts of one file together.
void find_meshes_around(const Seen& seen, SceneReport& report) {
  constexpr double most_of_it = 0.75;  // of all directions: a room may lack a wall
  std::map<std::string, std::vector<std::size_t>> parts;
  for (std::size_t i = 0; i < seen.bodies.size(); ++i) {
    const Object& object = seen.scene.objects[i];
    if (std::holds_alternative<Mesh>(object.shape)) parts[object.key.empty() ? std::to_string(i) : object.key].push_back(i);
  }
  for (const auto& [key, objects] : parts) {
    Body all = seen.bodies[objects[0]];
    for (const std::size_t i : objects)
      for (int k = 0; k < 3; ++k)
        all.low[k] = std::min(all.low[k], seen.bodies[i].low[k]), all.high[k] = std::max(all.high[k], seen.bodies[i].high[k]);
    if (!holds(all, seen.eye)) continue;
    double sum = 0;
    for (const std::size_t i : objects) sum += surrounding(seen.scene.objects[i], report.time_s, seen.eye);
    for (const std::size_t i : objects) report.objects[i].around_camera = std::abs(sum) > most_of_it;
  }
}

void count_pixels(const Truth& truth, SceneReport& report) {
  const auto least = [](std::optional<double>& known, double m) { known = std::min(known.value_or(m), m); };
  const auto most = [](std::optional<double>& known, double m) { known = std::max(known.value_or(m), m); };
  for (std::size_t i = 0; i < truth.object_id.size(); ++i) {
    if (truth.object_id[i] < 0) {
      ++report.no_surface;
      continue;
    }
    const auto range = static_cast<double>(truth.range_m[i]);
    ObjectInView& one = report.objects[static_cast<std::size_t>(truth.object_id[i])];
    ++one.pixels;
    least(one.nearest_m, range), most(one.farthest_m, range), least(report.nearest_m, range), most(report.farthest_m, range);
    if (report.ambiguity_range_m > 0 && range > report.ambiguity_range_m) ++report.beyond_reach;
  }
}

/// Pixels that see nothing because the lens model has no ray for them.
void count_outside(const Camera& camera, const Truth& truth, SceneReport& report) {
  if (report.no_surface == 0) return;
  const std::vector<float> rays = pixel_rays(camera);
  if (rays.size() != 2 * truth.object_id.size()) return;
  for (std::size_t i = 0; i < truth.object_id.size(); ++i)
    if (truth.object_id[i] < 0 && std::isnan(rays[2 * i])) ++report.outside_lens;
  report.no_surface -= report.outside_lens;
}

void check_truth(const Scene& scene, const Truth& truth) {
  const std::size_t pixels = static_cast<std::size_t>(truth.width) * static_cast<std::size_t>(truth.height);
  if (pixels == 0 || truth.object_id.size() != pixels || truth.range_m.size() != pixels)
    base::refuse(fmt::format("the truth lacks object_id or range_m\n  got {} and {} values, expected {} of each", truth.object_id.size(),
                             truth.range_m.size(), pixels));
  const auto most = *std::max_element(truth.object_id.begin(), truth.object_id.end());
  if (most >= static_cast<std::int64_t>(scene.objects.size()))
    base::refuse(fmt::format("the truth is of another scene\n  it sees object {}, and the scene has {}", most, scene.objects.size()));
}

}  // namespace

}  // namespace analysis

SceneReport scene_report(const Scene& scene, const Camera& camera, const Truth& truth) {
  using namespace analysis;
  check_truth(scene, truth);
  SceneReport out;
  out.time_s = truth.time_s;
  out.pixels = static_cast<std::int64_t>(truth.object_id.size());
  out.ambiguity_range_m = reach_of(camera).ambiguity_range_m;
  const std::vector<Body> bodies = bodies_at(scene, truth.time_s);
  Seen seen{scene, bodies, scene::pose_at(scene.camera, truth.time_s)};
  seen.eye = scene::vec(seen.pose.position);
  const std::array<double, 16> to_world = pose_matrix(seen.pose);
  seen.forward = {to_world[2], to_world[6], to_world[10]};
  place_objects(seen, out);
  find_meshes_around(seen, out);
  count_pixels(truth, out);
  count_outside(camera, truth, out);
  add_findings(seen, out);
  return out;
}

SceneReport scene_report(const Scene& scene, const Camera& camera) {
  SimulatorOptions options;
  options.noise = Noise::off;
  options.backend = Backend::cpu;
  options.arrays = {"gt_range_m", "gt_object_id"};
  options.last_stage = Stage::trace;
  Scene traced = scene;
  traced.transport = {};
  Camera simple = camera;
  simple.auto_exposure = {};
  simple.decoding.temporal_frames = 1;
  return scene_report(scene, camera, Simulator(traced, simple, options).frame(0).truth);
}

}  // namespace tofray
