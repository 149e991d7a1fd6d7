// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "tofray/budget.h"

/// What `tofray budget --need … --solve KEY` is asked.
namespace tofray::app {

/// A number of a profile, by its key.
struct SolvedKey {
  std::string key;                      ///< without "camera."
  std::string example;                  ///< as people write it: its unit is that of texts
  double guess = 0, low = 0, high = 0;  ///< SI
  /// A value as --set takes it.
  [[nodiscard]] std::string text(double value) const;
};
/// Whether a profile may have it, and its value is one number.
bool is_number_key(const std::string& key);
/// @throws Error (bad_input) for a key of which that is not so
SolvedKey solved_key(const std::string& key);

/// "sigma 10mm at 3m, 10%, 50klx": the light may be left out.
/// @throws Error (bad_input)
BudgetNeed budget_need(const std::string& text);

}  // namespace tofray::app
