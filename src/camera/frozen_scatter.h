// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/views.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// The kernels by which a lens scatters light; owns the weights that the view points to. Not copied.
class FrozenScatter {
 public:
  FrozenScatter(const Scatter& scatter, const Sensor& sensor);
  FrozenScatter(const FrozenScatter&) = delete;
  FrozenScatter& operator=(const FrozenScatter&) = delete;

  [[nodiscard]] const ScatterView& view() const { return view_; }

 private:
  void add_gaussian(double sigma_px, double share, int most);
  void add_kernel(const Scatter& scatter);

  ScatterView view_{1, 0, 0, nullptr};
  std::vector<ScatterTerm> terms_;
  std::vector<std::vector<float>> weights_;
};

}  // namespace tofray::camera
