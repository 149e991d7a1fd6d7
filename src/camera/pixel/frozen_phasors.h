// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/pixel/modulations.h"
#include "camera/pixel/view.h"
#include "camera/readout/image_camera.h"

namespace tofray::camera {

/// How the light of a path becomes phasors, at each modulation frequency and of each light; owns what the view points to. Not copied.
class FrozenPhasors {
 public:
  /// @throws Error (limit) for a waveform of too many harmonics
  FrozenPhasors(const ImageCamera& camera, const Modulations& modulations);
  FrozenPhasors(const FrozenPhasors&) = delete;
  FrozenPhasors& operator=(const FrozenPhasors&) = delete;

  [[nodiscard]] const PhasorView& view() const { return view_; }
  /// Says that no order is needed by itself: only the sums over all of them are.
  void take_sums_alone(bool alone) { view_.sums_alone = alone ? 1 : 0; }

 private:
  std::vector<float> sources_;
  std::vector<ModulationView> modulations_;
  PhasorView view_{};
};

}  // namespace tofray::camera
