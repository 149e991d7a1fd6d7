// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/random_scene.h"
#include "support/turning.h"
#include "tofray/simulator.h"

/// A wall, a crate and a stone (a mesh), and a path for the two and the camera.
namespace tofray::test {

inline Camera placed_camera() {
  Camera out = lit_camera(64, 48, 60);
  out.illumination[0].position = {-0.05, 0.02, 0};
  out.readout_time_s = 1e-3;
  return out;
}

inline Scene placed_scene_at_rest() {
  Random random(11);
  Scene scene = wall(2, 0.5);
  scene.objects[0].name = "wall";
  scene.objects.push_back(object(Box{{-0.25, -0.15, 1.1}, {0.05, 0.15, 1.3}}));
  scene.objects.back().name = "crate";
  scene.objects.push_back(object(shared(single(stone(random, 2, 0.25, {0.3, 0, 1.4})))));
  scene.objects.back().name = "stone";
  return scene;
}

/// Keyframes at the starts of frames: what moves, moves evenly.
inline Scene scene_on_a_path(Scene scene, const Camera& camera, std::uint64_t frames, bool camera_moves) {
  scene.objects[1].keyframes.clear(), scene.objects[2].keyframes.clear(), scene.camera.keyframes.clear();
  for (std::uint64_t i = 0; i < frames; ++i) {
    const double time = static_cast<double>(i) / camera.mode.frame_rate_hz, n = static_cast<double>(i);
    scene.objects[1].keyframes.push_back({time, {0.01 * n, 0, -0.02 * n}, {{0, 1, 0}, 0.3 * n}});
    scene.objects[2].keyframes.push_back({time, {-0.01 * n, 0.005 * n, 0}, {{1, 0, 0}, 0.1 * n}});
    Pose pose{{0.01 * n, 0, 0}, {0.01 * n, 0.1, 1.5}};
    if (camera_moves) scene.camera.keyframes.push_back({time, pose});
  }
  return scene;
}

/// What a frame's start and the next one's are on that path.
inline FrameRequest request_on_the_path(const Scene& moving, std::uint64_t index) {
  const auto at = [](const std::vector<Keyframe>& keys, std::size_t i) { return Placement{keys[i].position, keys[i].rotation}; };
  const auto i = static_cast<std::size_t>(index);
  FrameRequest out{.index = index};
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
    out.objects.push_back({moving.objects[k].name, at(moving.objects[k].keyframes, i), at(moving.objects[k].keyframes, i + 1), {}});
  if (!moving.camera.keyframes.empty()) out.pose = moving.camera.keyframes[i].pose, out.pose_end = moving.camera.keyframes[i + 1].pose;
  return out;
}

}  // namespace tofray::test
