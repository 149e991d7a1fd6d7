// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "support/members.h"
#include "tofray/tofray.h"

/// Every number of a scene and a camera, so that tests can put anything into any of them.
namespace tofray::test {

struct Numbers {
  std::vector<double*> reals;
  std::vector<int*> integers;

  template <class... Records>
  void all(Records&... records) {
    (add(records), ...);
  }

 private:
  template <class T>
  void add(T& record) {
    each_member(record, [&](const model::Row& row, const model::Slot& slot, const std::string&) {
      each_real(slot, [&](double& number) { reals.push_back(&number); });
      const bool size = row.member == "Sensor::width" || row.member == "Sensor::height";  // they have tests of their own
      if (auto* const* whole = std::get_if<int*>(&slot); whole != nullptr && !size) integers.push_back(*whole);
    });
  }
};

}  // namespace tofray::test
