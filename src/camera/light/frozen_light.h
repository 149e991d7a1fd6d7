// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "camera/light/view.h"
#include "tofray/camera.h"

namespace tofray::camera {

/// One light: pattern table and numbers; owns the table.
struct FrozenLight {
  LightView view{};
  std::vector<float> table;
};
/// @param quantum_efficiency  QE at the light's wavelength
FrozenLight freeze_light(const Illumination& light, double quantum_efficiency);

/// All lights of a camera, each of them a point source; owns what the views point to. Not copied.
class FrozenLights {
 public:
  /// @throws Error (bad_input) for a light that power_model paper_literal does not know
  explicit FrozenLights(const Camera& camera);
  FrozenLights(const FrozenLights&) = delete;
  FrozenLights& operator=(const FrozenLights&) = delete;

  [[nodiscard]] const std::vector<LightView>& views() const { return views_; }

 private:
  std::vector<FrozenLight> lights_;
  std::vector<LightView> views_;
};

/// How much of what comes back meets a pixel; ambient light, which is the scene's, is not in it yet.
PowerView power_view(const Camera& camera);

}  // namespace tofray::camera
