// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/placed.h"

#include <algorithm>
#include <variant>

#include "base/limits.h"
#include "base/readout.h"
#include "base/rotation.h"
#include "base/text.h"
#include "model/check.h"
#include "scene/motion.h"
#include "simulator/check.h"
#include "simulator/checks.h"

namespace tofray {

namespace simulator {

namespace {

/// How a scene that was built in code, or read of a file, addresses an object.
std::string key_of(const Scene& scene, std::size_t i) {
  return scene.objects[i].key.empty() ? "objects." + std::to_string(i) : scene.objects[i].key;
}

std::string path_of(const std::string& request, const PlacedObject& object) {
  return request + ".objects[" + base::in_quotes(object.name, 60) + "]";
}

void check(const Placement& placement, const std::string& name) {
  model::check_in_code(Keyframe{0, placement.position, placement.rotation}, name);
}

void check(const PlacedObject& object, const std::string& name) {
  check(object.start, name + ".start");
  if (object.end) check(*object.end, name + ".end");
  if (object.keyframes.empty()) return;
  if (object.end || object.start.position != Vec3{} || base::turns(object.start.rotation))
    refuse(name + " has keyframes, and a start or an end", "its keyframes say where it is when; take the one out or the other");
  Object with_keys;
  with_keys.keyframes = object.keyframes;
  model::check_in_code(with_keys, name);
}

std::vector<Keyframe> keyframes_of(const PlacedObject& object, const FrameSpan& span) {
  if (!object.keyframes.empty()) return object.keyframes;
  const Keyframe start{span.start_s, object.start.position, object.start.rotation};
  if (!object.end) return {start};
  const Keyframe end{span.end_s, object.end->position, object.end->rotation};
  return {start, end, scene::going_on(start, end)};
}

}  // namespace

Handles::Handles(const Scene& scene) {
  const auto add = [&](const std::string& name, std::size_t i) {
    Known& one = known_[name];
    if (!one.objects.empty() && one.objects.back() == i) return;
    one.shared = one.shared || (!one.objects.empty() && key_of(scene, one.objects.front()) != key_of(scene, i));
    one.objects.push_back(i);
  };
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    add(key_of(scene, i), i);
    if (object.name.empty()) continue;
    add(object.name, i);
    // The pieces of a mesh are "name/material", and of one entry of the file.
    if (std::holds_alternative<Mesh>(object.shape) && !object.key.empty())
      if (const std::size_t slash = object.name.find('/'); slash != std::string::npos && slash > 0) add(object.name.substr(0, slash), i);
  }
}

std::vector<std::string> Handles::names() const {
  std::vector<std::string> out;
  for (const auto& [name, what] : known_) out.push_back(name);
  return out;
}

const std::vector<std::size_t>& Handles::find(const std::string& name) const {
  const auto found = known_.find(name);
  if (found == known_.end()) {
    constexpr std::size_t most = 12;
    std::vector<std::string> all = names();
    const std::string near = base::did_you_mean(name, all);
    // Names before numbers.
    std::stable_partition(all.begin(), all.end(), [](const std::string& one) { return !one.starts_with("objects."); });
    const std::size_t count = all.size();
    all.resize(std::min(count, most));
    for (std::string& one : all) one = base::printable(one);
    refuse("the scene has no object " + base::in_quotes(name, 60) + near,
           count == 0 ? "it has no objects"
                      : "expected " + base::listed(all) + (count > most ? " …" : "") +
                            "; `name: ball` in the object's line gives it a name, and objects.N counts from 0");
  }
  if (found->second.shared)
    refuse(std::to_string(found->second.objects.size()) + " objects are called " + base::in_quotes(name, 60),
           "give each a name of its own, or say objects.N with its number, which counts from 0");
  return found->second.objects;
}

FrameSpan span_of(const FrameRequest& request, double frame_rate_hz) {
  if (request.start_time_s) return {*request.start_time_s, *request.start_time_s + 1 / frame_rate_hz};
  return {static_cast<double>(request.index) / frame_rate_hz, static_cast<double>(request.index + 1) / frame_rate_hz};
}

void check(const FrameRequest& request, const std::string& name) {
  if (request.start_time_s) within(*request.start_time_s, {-1e6, 1e6}, name + ".start_time_s");
  if (request.pose) model::check_in_code(*request.pose, name + ".pose");
  if (request.pose_end) {
    model::check_in_code(*request.pose_end, name + ".pose_end");
    if (!request.pose) refuse(name + " has a pose_end, and no pose", "the pose is where the camera is at the frame's start");
    CameraChoice moves;
    moves.keyframes = {{0, *request.pose}, {1, *request.pose_end}};
    model::check_in_code(moves, name + ".pose, pose_end: camera");
  }
  if (!request.camera.empty()) {
    if (request.pose) refuse(name + " has a pose and keyframes of the camera", "its keyframes say where it stands; take the pose out");
    CameraChoice moves;
    moves.keyframes = request.camera;
    model::check_in_code(moves, name + ".camera");
  }
  for (const PlacedObject& object : request.objects) check(object, path_of(name, object));
}

Placed placed_by(const FrameRequest& request, const Handles& handles, const std::string& name) {
  Placed out;
  out.camera = !request.camera.empty() || request.pose_end.has_value();
  for (const PlacedObject& object : request.objects) {
    const std::vector<std::size_t>& found = handles.find(object.name);
    out.objects.insert(out.objects.end(), found.begin(), found.end());
  }
  std::sort(out.objects.begin(), out.objects.end());
  if (std::adjacent_find(out.objects.begin(), out.objects.end()) != out.objects.end()) {
    std::vector<bool> seen(out.objects.back() + 1, false);
    for (const PlacedObject& object : request.objects)
      for (const std::size_t i : handles.find(object.name)) {
        if (seen[i]) refuse(path_of(name, object) + " is placed twice", "one entry of each object, with its start and its end");
        seen[i] = true;
      }
  }
  return out;
}

void place_objects(const FrameRequest& request, const Handles& handles, const FrameSpan& span, Scene& scene) {
  for (const PlacedObject& from : request.objects) {
    const std::vector<Keyframe> keys = keyframes_of(from, span);
    for (const std::size_t i : handles.find(from.name)) {
      Object& object = scene.objects[i];
      object.position = object.velocity_m_per_s = object.angular_velocity_rad_per_s = {0, 0, 0};
      object.rotation = {};
      object.keyframes = keys;
    }
  }
}

void place_camera(const FrameRequest& request, const FrameSpan& span, CameraChoice& camera) {
  if (request.camera.empty() && !request.pose) return;
  camera.pose = {}, camera.keyframes = request.camera;
  if (request.pose_end) {
    const CameraKeyframe start{span.start_s, *request.pose}, end{span.end_s, *request.pose_end};
    camera.keyframes = {start, end, scene::going_on(start, end)};
  } else if (request.pose) {
    camera.pose = *request.pose;
  }
}

}  // namespace simulator

Scene placed_scene(const Scene& scene, const Camera& camera, const FrameRequest& request) {
  simulator::check(camera);
  simulator::check(request, "request");
  const simulator::Handles handles(scene);
  (void)simulator::placed_by(request, handles, "request");
  Scene out = scene;
  const simulator::FrameSpan span = simulator::span_of(request, camera.mode.frame_rate_hz);
  simulator::place_objects(request, handles, span, out);
  simulator::place_camera(request, span, out.camera);
  return out;
}

std::vector<double> exposure_times(const Camera& camera, double start_s) {
  simulator::check(camera);
  simulator::within(start_s, {-1e6, 1e6}, "start_s");
  std::vector<double> exposed;
  for (const RawFrame& one : camera.mode.sequence) exposed.push_back(one.integration_time_s);
  std::vector<double> out = base::raw_frame_starts_s(exposed, camera.readout_time_s);
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = start_s + out[k] + 0.5 * exposed[k];
  return out;
}

}  // namespace tofray
