// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "files/json.h"

/// What tests of measurements read from their reports.
namespace tofray::test {

inline double number(const files::Json& row, const char* key) {
  double value = std::nan("");
  row.find(key)->number(value);
  return value;
}

}  // namespace tofray::test
