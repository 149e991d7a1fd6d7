// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "camera/lens/lens.h"
#include "camera/lens/view.h"

namespace tofray::camera {

/// What the rays of all pixels depend on.
struct LensKey {
  Lens lens;          ///< but for f-number, transmission and scatter, which bend no ray
  int width, height;  ///< of the image
  Point2 offset_px;   ///< of each ray's place in its pixel, from the pixel's middle
  double area;        ///< that the ray stands for, of a pixel's
  bool operator==(const LensKey&) const = default;
};

/// Rays of all pixels through one place of each; owns the arrays that the view points to.
class FrozenLens {
 public:
  FrozenLens(const FrozenLens&) = delete;
  FrozenLens& operator=(const FrozenLens&) = delete;
  FrozenLens(FrozenLens&&) noexcept = default;
  FrozenLens& operator=(FrozenLens&&) noexcept = default;
  ~FrozenLens() = default;
  /// @param threads  that find them; 0: one per core
  explicit FrozenLens(const LensKey& of, int threads = 0);
  /// The one for all cameras of such rays.
  static std::shared_ptr<const FrozenLens> shared(const LensKey& of, int threads);

  [[nodiscard]] const LensView& view() const { return view_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  void freeze_tiles();

  LensView view_{};
  std::vector<float> ray_x_, ray_y_, inverse_length_, vignetting_;
  std::vector<flow::Bounds> tiles_;
};

}  // namespace tofray::camera
