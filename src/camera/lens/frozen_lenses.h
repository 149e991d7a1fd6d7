// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "camera/lens/frozen_lens.h"
#include "camera/lens/view.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// The rays of a camera: one through the middle of each pixel, and those of its samples within the pixel. Owns what its views point to.
class FrozenLenses {
 public:
  /// @param image     lens and sensor of the image's pixels
  /// @param subpixel  samples of each pixel along a row and along a column
  /// @param threads   that find the rays; 0: one per core
  FrozenLenses(const Camera& image, int subpixel, int threads);
  FrozenLenses(const FrozenLenses&) = delete;
  FrozenLenses& operator=(const FrozenLenses&) = delete;

  [[nodiscard]] const LensView& middle() const { return middle_->view(); }
  [[nodiscard]] const SubpixelView& subpixel() const { return subpixel_; }

 private:
  std::shared_ptr<const FrozenLens> middle_;
  std::vector<std::shared_ptr<const FrozenLens>> samples_;
  std::vector<LensView> views_;  // of the samples
  std::vector<float> shares_;
  SubpixelView subpixel_{};
};

}  // namespace tofray::camera
