// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "camera/pixel/view.h"
#include "flow/frame_view.h"
#include "pipeline/setup.h"
#include "tofray/camera.h"
#include "tofray/simulator.h"

namespace tofray::simulator {

/// Pixels that count: a region of the arrays', which are of this size.
struct Metered {
  std::int32_t width, height;
  pipeline::Region region;  ///< as Setup::region
};

/// Integration times that follow the light: those of frame i come of the raw frames of frame i − 1, from frame 0 on.
/// [theory: brightness, auto-exposure]
class ExposureControl {
 public:
  /// @param camera  as it is read out
  /// @throws Error (bad_input) where times follow the light, and raw frames are not computed
  ExposureControl(const Camera& camera, Stage last);

  /// Whether times follow the light.
  [[nodiscard]] bool on() const { return law_.speed > 0; }
  /// How many frames' times are known: those of frames 0, 1 …
  [[nodiscard]] std::uint64_t known() const { return longest_.size(); }
  /// @throws Error (limit) for a frame that too many others come before
  void check(std::uint64_t index) const;
  /// Of each raw frame of a frame whose times are known [s].
  [[nodiscard]] std::vector<double> times_of(std::uint64_t index) const;
  /// Takes the raw frames of the last frame whose times are known, and so knows those of the next.
  void follow(const camera::SensorView& sensor, const flow::FrameView& frame, const Metered& pixels);

 private:
  AutoExposure law_;
  std::vector<RawFrame> mode_;
  double of_mode_ = 0;           // longest lit exposure of the mode
  std::vector<double> longest_;  // [frame] longest lit exposure of each frame
};

/// Bright pixels of raw frames: how much of the valid codes they use, 1 and more where they saturate.             [theory: brightness]
/// @param bright  quantile
double brightness(const camera::SensorView& sensor, const flow::FrameView& frame, const Metered& pixels, double bright);

}  // namespace tofray::simulator
