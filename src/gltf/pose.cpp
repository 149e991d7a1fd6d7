// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/pose.h"

#include <fmt/core.h>

#include <cmath>

#include "base/faults.h"
#include "gltf/channels.h"

namespace tofray::gltf {
namespace {

/// What a node says of itself, or an animation of it.
struct Placed {
  Vec3 translation, scale;
  Quaternion rotation;
};

void check(const Model& model, int animation, double time_s, int scene) {
  if (animation != none && (animation < 0 || static_cast<std::size_t>(animation) >= model.animations.size()))
    base::refuse(
        fmt::format("animation {} is none of the file's\n  it has {}, of which the first is 0", animation, model.animations.size()));
  if (scene != none && (scene < 0 || static_cast<std::size_t>(scene) >= model.scenes.size()))
    base::refuse(fmt::format("scene {} is none of the file's\n  it has {}, of which the first is 0", scene, model.scenes.size()));
  if (!std::isfinite(time_s)) base::refuse("the time of a pose is not a finite number");
}

void apply(const Channel& channel, double time_s, Placed& placed, std::vector<double>& weights) {
  switch (channel.path) {
    case Channel::Path::translation: return evaluate(channel, time_s, placed.translation);
    case Channel::Path::scale: return evaluate(channel, time_s, placed.scale);
    case Channel::Path::rotation: return evaluate(channel, time_s, placed.rotation);
    case Channel::Path::weights: return evaluate(channel, time_s, weights);
  }
}

void show(const Model& model, const Scene& scene, Pose& pose) {
  for (const int root : scene.nodes) pose.in_scene[static_cast<std::size_t>(root)] = 1;
  for (const int node : model.parents_first)
    if (const int parent = model.nodes[static_cast<std::size_t>(node)].parent;
        parent != none && pose.in_scene[static_cast<std::size_t>(parent)] != 0)
      pose.in_scene[static_cast<std::size_t>(node)] = 1;
}

}  // namespace

Pose at(const Model& model, int animation, double time_s, int scene) {
  check(model, animation, time_s, scene);
  const std::size_t nodes = model.nodes.size();
  std::vector<Placed> placed;
  Pose pose{std::vector<Matrix>(nodes, identity), std::vector<std::uint8_t>(nodes, 0), {}};
  for (const Node& node : model.nodes) {
    placed.push_back({node.translation, node.scale, node.rotation});
    const bool own = !node.weights.empty() || node.mesh == none;
    pose.weights.push_back(own ? node.weights : model.meshes[static_cast<std::size_t>(node.mesh)].weights);
  }
  if (animation != none)
    for (const Channel& channel : model.animations[static_cast<std::size_t>(animation)].channels) {
      const auto node = static_cast<std::size_t>(channel.node);
      apply(channel, time_s, placed[node], pose.weights[node]);
    }
  for (const int one : model.parents_first) {
    const auto i = static_cast<std::size_t>(one);
    const Node& node = model.nodes[i];
    const Matrix local = node.matrix ? *node.matrix : transform(placed[i].translation, placed[i].rotation, placed[i].scale);
    pose.world[i] = node.parent == none ? local : product(pose.world[static_cast<std::size_t>(node.parent)], local);
  }
  show(model, model.scenes[static_cast<std::size_t>(scene == none ? model.scene : scene)], pose);
  return pose;
}

}  // namespace tofray::gltf
