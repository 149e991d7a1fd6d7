// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/scene.h"
#include "tofray/simulator.h"

/// What is placed from outside.
namespace tofray::simulator {

/// Finds the objects of a scene by what a request calls them.
class Handles {
 public:
  explicit Handles(const Scene& scene);
  /// @return several where a mesh has several materials
  /// @throws Error (bad_input) where there is none, or where objects of different entries share the name
  [[nodiscard]] const std::vector<std::size_t>& find(const std::string& name) const;

 private:
  [[nodiscard]] std::vector<std::string> names() const;
  struct Known {
    std::vector<std::size_t> objects;
    bool shared = false;  ///< by objects that are not one mesh's
  };
  std::map<std::string, Known, std::less<>> known_;
};

/// Which objects are placed, ascending, and whether the camera moves from outside.
struct Placed {
  std::vector<std::size_t> objects;
  bool camera = false;
  [[nodiscard]] bool any() const { return camera || !objects.empty(); }
  bool operator==(const Placed&) const = default;
};

/// When a frame starts, and when the next one does [s].
struct FrameSpan {
  double start_s, end_s;
};
FrameSpan span_of(const FrameRequest& request, double frame_rate_hz);

/// @param name  of the request, in messages
/// @throws Error (bad_input; limit for counts) naming the member
void check(const FrameRequest& request, const std::string& name);
/// Which objects a request places, and whether it moves the camera. @throws Error (bad_input) for a name that is no object of the scene, that several have, or that is placed twice
Placed placed_by(const FrameRequest& request, const Handles& handles, const std::string& name);

/// Puts keyframes into the scene in place of what a good request says of objects, and of the camera.
void place_objects(const FrameRequest& request, const Handles& handles, const FrameSpan& span, Scene& scene);
void place_camera(const FrameRequest& request, const FrameSpan& span, CameraChoice& camera);

}  // namespace tofray::simulator
