// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <vector>

#include "tofray/budget.h"

/// What budget, summary and solver have in common.
namespace tofray::analysis {

class PixelBudget;

/// The request with what it leaves open.
/// @throws Error (bad_input) for a number out of range
BudgetRequest complete_request(BudgetRequest request);

/// The pixel that a complete request asks for, in each of its lights.
class BudgetCamera {
 public:
  /// @throws Error as budget() does
  BudgetCamera(const Camera& camera, const BudgetRequest& request);
  ~BudgetCamera();
  BudgetCamera(const BudgetCamera&) = delete;
  BudgetCamera& operator=(const BudgetCamera&) = delete;

  /// @param light  which of the request's
  BudgetRow at(std::size_t light, double z, double reflectivity, bool wrong_cycles);
  /// The farthest distance at which it saturates; 0: nowhere from `nearest_m` on; farthest_m: at all distances.
  double saturated_up_to(std::size_t light, double reflectivity, double nearest_m, double farthest_m);
  /// The farthest distance at which σ is within the decoding's threshold; 0: nowhere.
  double reach(std::size_t light, double reflectivity, double nearest_m, double farthest_m);
  [[nodiscard]] const Camera& pixel() const { return pixel_; }

 private:
  Camera pixel_;
  AutoExposure law_;
  BudgetRequest request_;
  std::vector<std::unique_ptr<PixelBudget>> in_light_;  // where exposures are the mode's
};

}  // namespace tofray::analysis
