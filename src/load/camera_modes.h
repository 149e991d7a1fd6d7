// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <vector>

#include "load/fill.h"

namespace tofray::load {

/// The modes of a profile, read once, and the checks that go beyond single numbers.
class Modes {
 public:
  Modes(const yaml::Value& root, base::Faults& faults);

  [[nodiscard]] std::size_t count() const { return modes_.size(); }
  /// Which one the profile asks for; the first where it does not say.
  [[nodiscard]] std::size_t wanted() const { return wanted_; }
  /// Puts one of them into the camera, which stays the same otherwise.
  void choose(std::size_t which, Camera& camera, Filler& filler) const;

 private:
  struct Entry {
    Mode mode;
    bool good = false;
  };
  [[nodiscard]] std::size_t find_wanted() const;
  void check_time(const yaml::Value& chosen, Camera& camera) const;
  void check_edges(const Camera& camera) const;

  const yaml::Value& root_;
  base::Faults& faults_;
  std::size_t wanted_ = 0;
  std::vector<Entry> modes_;
};

}  // namespace tofray::load
