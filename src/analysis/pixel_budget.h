// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "analysis/variance_terms.h"
#include "camera/frozen_camera.h"
#include "tofray/budget.h"
#include "tofray/simulator.h"

namespace tofray::analysis {

/// Rows of a budget of one pixel in one light. Light and charge come of simulated frames without noise, one as the camera is, and one whose
/// taps hold nothing but the camera's illumination.
class PixelBudget {
 public:
  /// @param pixel  of pixel_alone(), with the exposures that it has
  PixelBudget(const Camera& pixel, const AmbientCase& light);
  /// Without wrong_cycle, exposure and ambient's name.
  BudgetRow at(double z, double reflectivity, double angle_rad = 0);
  /// P(wrong cycle) of the row that was asked for last.
  [[nodiscard]] double wrong_cycle() const;

 private:
  [[nodiscard]] std::vector<ReadFrame> read_frames() const;
  void add_light(BudgetRow& row) const;
  void add_charge(const std::vector<ReadFrame>& frames, BudgetRow& row) const;
  void add_noise(const std::vector<ReadFrame>& frames, BudgetRow& row);

  Camera pixel_;
  camera::Modulations modulations_;
  camera::FrozenCamera frozen_;
  camera::SensorView sensor_;
  Simulator seen_, own_;
  Frame frame_, own_frame_;  // of the row that was asked for last
  std::vector<PhaseCorrection> corrections_;
  std::vector<PhaseNoise> phases_;  // of the row that was asked for last; empty: it has no range
  double band_irradiance_ = 0;      // [W/m²]
  double ambient_j_per_e_ = 0;      // energy of ambient light that makes an electron
};

}  // namespace tofray::analysis
