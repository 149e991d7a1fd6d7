// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "camera/readout/image_camera.h"
#include "pipeline/setup.h"
#include "tofray/camera.h"

namespace tofray::simulator {

/// The frames before the one at work, as far as depth needs them, and the mean over them.              [theory: temporal-mean]
class Temporal {
 public:
  /// @param last  the last stage that is computed
  Temporal(const camera::ImageCamera& camera, Stage last);

  /// Whether depth is that of several frames.
  [[nodiscard]] bool on() const { return window_ > 0; }
  /// From which frame on those before `index` have to be kept yet; the ones that are not needed any more are forgotten.
  std::uint64_t missing_from(std::uint64_t index);
  /// Keeps a frame's range and noise: the first one that is missing.
  void keep(std::uint64_t index, const flow::FrameView& depth);
  /// Depth of a frame whose predecessors and itself are kept, in the place of its own: range, noise, z, points and confidence.
  void settle(std::uint64_t index, const pipeline::Setup& setup, const pipeline::Job& job);

 private:
  struct Kept {
    std::vector<float> range, noise;
  };
  [[nodiscard]] Kept& place_of(std::uint64_t index) { return kept_[index % kept_.size()]; }

  std::uint64_t window_ = 0;           // how many frames before one count
  std::uint64_t first_ = 0, end_ = 0;  // kept, without the last
  float factor_;
  std::vector<Kept> kept_;
};

}  // namespace tofray::simulator
