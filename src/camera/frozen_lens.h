// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/lens.h"
#include "camera/views.h"

namespace tofray::camera {

/// Rays of all pixels through one place of each; owns the arrays that the view points to.
class FrozenLens {
 public:
  FrozenLens() = default;
  FrozenLens(const FrozenLens&) = delete;
  FrozenLens& operator=(const FrozenLens&) = delete;
  FrozenLens(FrozenLens&&) noexcept = default;
  FrozenLens& operator=(FrozenLens&&) noexcept = default;
  ~FrozenLens() = default;
  /// @param offset_px  of the place, from the pixel's middle
  /// @param area       that the ray stands for, of a pixel's
  FrozenLens(const Lens& lens, const Sensor& sensor, const Point2& offset_px, double area);

  [[nodiscard]] const LensView& view() const { return view_; }

 private:
  void freeze_tiles();

  LensView view_{};
  std::vector<float> ray_x_, ray_y_, inverse_length_, vignetting_;
  std::vector<flow::Bounds> tiles_;
};

}  // namespace tofray::camera
