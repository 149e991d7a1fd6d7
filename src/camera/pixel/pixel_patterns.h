// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "camera/pixel/modulations.h"
#include "camera/pixel/view.h"
#include "camera/readout/image_camera.h"

namespace tofray::camera {

/// Gains, offsets, delays and phases that differ from pixel to pixel of a specimen; owns what a view points to. Not copied.
///                                                                               [theory: phase-offset, binned-patterns]
class PixelPatterns {
 public:
  /// @param profile  whose sensor has all pixels: which of them are read, or read together, is in what they draw
  PixelPatterns(const Camera& profile, const ImageCamera& camera, const Modulations& modulations);
  PixelPatterns(const PixelPatterns&) = delete;
  PixelPatterns& operator=(const PixelPatterns&) = delete;

  /// Points a view to them.
  void set(SensorView& sensor) const;

 private:
  using Map = std::shared_ptr<const std::vector<float>>;

  Map gain_, offset_, delay_;  // null: all pixels are alike
  std::vector<float> late_;    // delay_ with the pixels' phases in it, [modulation][height][width]
  std::size_t pixels_ = 0;
};

}  // namespace tofray::camera
