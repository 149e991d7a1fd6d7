// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <variant>

#include "base/faults.h"
#include "dataset/amount.h"

/// "= wall - 0.6 m": what a value is made of.
namespace tofray::dataset {

/// What a name of `let` stands for: a number, or a text (a column of a table, a choice of words).
using Named = std::variant<Amount, std::string>;
/// Gives a name's value. @throws Error where there is none
using Names = std::function<Named(std::string_view name)>;

/// The value of what stands behind "=": numbers with units, names, + - * /, ( ), min(…), max(…), sqrt(…). A single name that stands for a text is that
/// text. Sums and min and max take numbers of one kind, sqrt halves its argument's; the result has its SI unit.
/// @param place  of the whole, for faults
/// @throws Error naming the place
Named evaluate(std::string_view expression, const base::Place& place, const Names& names);

/// Whether a name may stand in an expression.
bool is_name(std::string_view word);

}  // namespace tofray::dataset
