// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstring>
#include <string>
#include <vector>

#include "tofray/frame.h"

namespace tofray::test {

/// "gt_power_w at 17: …", the first array in the order of the stages in which two frames differ by a bit; empty: none.
inline std::string first_difference(const Frame& a, const Frame& b) {
  std::string found;
  const auto compare = [&](const char* name, const auto& one, const auto& other) {
    if (!found.empty()) return;
    if (one.size() != other.size()) {
      found = std::string("the size of ") + name;
      return;
    }
    for (std::size_t i = 0; i < one.size(); ++i) {
      if (std::memcmp(&one[i], &other[i], sizeof one[i]) == 0) continue;
      found = std::string(name) + " at " + std::to_string(i) + ": " + std::to_string(one[i]) + " and " + std::to_string(other[i]);
      return;
    }
  };
#define TOFRAY_COMPARE(name, part, member, ...) compare(#name, a.part.member, b.part.member);
  // truth first: what is wrong early shows in all that follows
  TOFRAY_TRUTH_ARRAYS(TOFRAY_COMPARE)
  TOFRAY_RAW_ARRAYS(TOFRAY_COMPARE)
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_COMPARE)
  TOFRAY_DEPTH_ARRAYS(TOFRAY_COMPARE)
#undef TOFRAY_COMPARE
  return found;
}

}  // namespace tofray::test
