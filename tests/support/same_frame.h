// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstring>
#include <string>
#include <vector>

#include "tofray/frame.h"

namespace tofray::test {

/// "power_w of pixel 17", the first array in the order of the stages in which two frames differ by a bit; empty: none.
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
  const Truth &t = a.truth, &u = b.truth;
  compare("object_id", t.object_id, u.object_id), compare("range_m", t.range_m, u.range_m), compare("z_m", t.z_m, u.z_m);
  compare("reflectivity", t.reflectivity, u.reflectivity), compare("position_m", t.position_m, u.position_m);
  compare("normal", t.normal, u.normal), compare("irradiance_w_m2", t.irradiance_w_m2, u.irradiance_w_m2);
  compare("radiance_w_m2_sr", t.radiance_w_m2_sr, u.radiance_w_m2_sr), compare("power_w", t.power_w, u.power_w);
  compare("signal_e", t.signal_e, u.signal_e);
  compare("tap_a", a.raw.tap_a, b.raw.tap_a), compare("tap_b", a.raw.tap_b, b.raw.tap_b), compare("raw", a.raw.raw, b.raw.raw);
  compare("start_time_s", a.raw.start_time_s, b.raw.start_time_s);
  const Depth &d = a.depth, &e = b.depth;
  compare("flags", d.flags, e.flags), compare("amplitude_e", d.amplitude_e, e.amplitude_e), compare("ambient_e", d.ambient_e, e.ambient_e);
  compare("noise_m", d.noise_m, e.noise_m), compare("depth range_m", d.range_m, e.range_m), compare("depth z_m", d.z_m, e.z_m);
  compare("points_m", d.points_m, e.points_m), compare("confidence", d.confidence, e.confidence);
  return found;
}

}  // namespace tofray::test
