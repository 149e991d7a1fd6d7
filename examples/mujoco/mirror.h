// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <mujoco/mujoco.h>
#include <tofray/tofray.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// A MuJoCo model as tofray's scene: each geom that is drawn (alpha above 0) is an object, made once; then it is told where things are.
///
/// MuJoCo's cameras look along −z with y up; tofray's along z with y down. Its quaternions have w first, tofray's last. Both have metres.
class Mirror {
 public:
  using Materials = std::map<std::string, tofray::Material>;

  /// @param camera     the name of one of the model's cameras; only where it is counts, the lens is tofray's
  /// @param materials  by names of geoms or of MuJoCo's materials; of others the mean of their colour stands for reflectivity, which in the
  /// near infrared it is not
  /// @throws std::runtime_error where there is no such camera, and for height fields
  Mirror(const mjModel* model, const std::string& camera, const Materials& materials = {});

  /// What stands still is where it is, what moves at zero. Objects are called as geoms are, or "geom.7".
  [[nodiscard]] const tofray::Scene& scene() const { return scene_; }
  /// The geom that an object is (Truth::object_id).
  [[nodiscard]] int geom_of(int object) const { return geoms_[static_cast<std::size_t>(object)]; }

  /// Remembers where all that moves is at `data->time`: call it at the times of tofray::exposure_times, or oftener.
  void look(const mjData* data);
  /// The frame of what was remembered since the last call.
  [[nodiscard]] tofray::FrameRequest request(std::uint64_t index, double start_time_s);

 private:
  [[nodiscard]] int material_of(int geom, const Materials& materials);

  const mjModel* model_;
  int camera_;
  bool camera_moves_;
  tofray::Scene scene_;
  std::vector<int> geoms_;                  // of each object
  std::vector<std::size_t> moving_;         // objects whose body moves
  std::vector<tofray::PlacedObject> seen_;  // of these
  std::vector<tofray::CameraKeyframe> camera_seen_;
};
