// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "files/json.h"
#include "tofray/budget.h"

/// A budget for people, and for other programs.
namespace tofray::app {

/// Tables, one for each light and reflectivity, below what holds of all distances.
std::string budget_text(const Camera& camera, const std::vector<BudgetRow>& rows, const BudgetSummary& summary);
/// The whole budget.
files::Json budget_json(const Camera& camera, const std::vector<BudgetRow>& rows, const BudgetSummary& summary);
/// A line for each row, units in the names; of modulation frequencies f1_…, f2_….
std::string budget_csv(const std::vector<BudgetRow>& rows);

}  // namespace tofray::app
