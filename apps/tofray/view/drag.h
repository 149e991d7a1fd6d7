// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/scene.h"
#include "view/control.h"

/// What hands do to objects and the camera, as keys of --set.
namespace tofray::view {

/// A scene at the time of a frame's truth.
struct SceneAt {
  const Scene& scene;
  const Camera& camera;
  const Overrides& set;  ///< in force
  double time_s = 0;
};

/// What makes it so: first `unsets` go out of the list of --set, then each of `sets` is set.
struct Moved {
  Overrides sets;
  std::vector<std::string> unsets;
  std::string what;  ///< in a few words
};

/// Why an object cannot be moved; empty where it can.
std::string why_fixed(const Object& object);
std::string why_fixed(const CameraChoice& camera);

/// Positions come out to the micrometre, rotations and sizes to nine digits.
/// @param truth  of the frame: gt_object_id and gt_z_m
/// @throws Error (bad_input) where the object cannot, where the first pixel does not show it, and where the lens has no ray of the last one
Moved dragged(const SceneAt& at, const Truth& truth, const Drag& drag);

/// Of an object or the camera, to the last bit.
/// @throws Error (bad_input) where it cannot
Moved placed(const SceneAt& at, const Place& place);

}  // namespace tofray::view
