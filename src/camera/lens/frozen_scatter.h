// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/lens/view.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// How far a lens scatters light [px].
int scattered_radius(const Scatter& scatter);

/// The kernels by which a lens scatters light and pixels share their charge; owns the weights that the view points to. Not copied.
class FrozenScatter {
 public:
  FrozenScatter(const Scatter& scatter, const Sensor& sensor, const Pixel& pixel);
  FrozenScatter(const FrozenScatter&) = delete;
  FrozenScatter& operator=(const FrozenScatter&) = delete;

  [[nodiscard]] const ScatterView& view() const { return view_; }

  /// Whether there are any of a camera's.
  static bool spreads(const Camera& camera);

 private:
  using Weights = std::vector<double>;
  void add_gaussians(const Scatter& scatter, int most);
  void add_kernel(const Scatter& scatter);
  void add_sharing(const Pixel& pixel);
  void add_separable(const Weights& row, const Weights& column);

  ScatterView view_{1, 0, 1, 0, nullptr};
  std::vector<ScatterTerm> terms_;
  std::vector<std::vector<float>> weights_;
};

}  // namespace tofray::camera
