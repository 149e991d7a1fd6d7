// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tofray/budget.h"

namespace tofray::analysis {

/// A number of a budget's rows, as CSV, JSON and Python call it.
struct BudgetColumn {
  const char* name;
  double (*of)(const BudgetRow& row);  ///< NaN: there is none
};
const std::vector<BudgetColumn>& budget_columns();

/// Likewise what is yes or no.
struct BudgetFlag {
  const char* name;
  bool BudgetRow::*member;
};
const std::vector<BudgetFlag>& budget_flags();

/// A number of each modulation frequency.
struct BudgetFrequencyColumn {
  const char* name;
  double BudgetFrequency::*member;
};
const std::vector<BudgetFrequencyColumn>& budget_frequency_columns();

}  // namespace tofray::analysis
