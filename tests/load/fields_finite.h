// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>

#include "support/members.h"

/// Whether every number that the readers hand on is finite, and no zero is negative.
namespace tofray::test {

template <class T>
bool finite(T record) {
  bool good = true;
  each_member(record, [&](const model::Row&, const model::Slot& slot, const std::string&) {
    each_real(slot, [&](double number) { good = good && std::isfinite(number) && !(number == 0 && std::signbit(number)); });
  });
  return good;
}

}  // namespace tofray::test
