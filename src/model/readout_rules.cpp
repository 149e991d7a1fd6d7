// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What has to hold of the pixels that are read, and of exposures that follow the light.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"
#include "model/rules.h"

namespace tofray::model {

namespace {

/// A time to a nanosecond at most, which products of decimals are not.
std::string rounded(double value) { return base::number_text(std::round(value * 1e6) / 1e6); }

}  // namespace

void something_is_read(const Camera& camera, Complaints& complaints) {
  const Readout& r = camera.readout;
  const auto check = [&](const int& first, const int& size, int all, const char* side, const char* along) {
    const int left = all - first;
    if (left < 1 || size > left)
      return complaints.add(r, size > 0 ? &size : &first, std::string("the region that is read leaves the sensor"),
                            "got " + std::to_string(first) +
                                (size > 0 ? " and a " + std::string(along) + " of " + std::to_string(size) : "") + ", the sensor has a " +
                                side + " of " + std::to_string(all));
    const int read = size > 0 ? size : left;
    if (r.binning > read)
      complaints.add(r, &r.binning, "no binned pixel fits into what is read",
                     "got " + std::to_string(r.binning) + ", and a " + along + " of " + std::to_string(read) + " pixels");
  };
  check(r.left, r.width, camera.sensor.width, "width", "width");
  check(r.top, r.height, camera.sensor.height, "height", "height");
}

void exposures_fit(const Camera& camera, Complaints& complaints) {
  const AutoExposure& a = camera.auto_exposure;
  if (!(a.speed > 0)) return;
  double longest_in_mode = 0, lit = 0, others = 0;
  for (const RawFrame& raw : camera.mode.sequence) {
    (raw.lit ? lit : others) += raw.integration_time_s;
    if (raw.lit) longest_in_mode = std::max(longest_in_mode, raw.integration_time_s);
    others += camera.readout_time_s;
  }
  if (!(longest_in_mode > 0))
    return complaints.add(a, &a.speed, "no exposure can follow the light", "the mode has no lit raw frame; leave out auto_exposure");
  const double longest = a.longest_s > 0 ? a.longest_s : longest_in_mode;
  const double shortest = std::max(a.shortest_s, camera.min_integration_time_s);
  if (shortest > longest)
    return complaints.add(a, a.longest_s > 0 ? &a.longest_s : &a.shortest_s, "the shortest exposure is longer than the longest",
                          "got " + rounded(1e6 * shortest) + " us and " + rounded(1e6 * longest) +
                              " us (auto_exposure.shortest or timing.min_integration_time; auto_exposure.longest or the mode's)");
  const double total = others + lit * (longest / longest_in_mode), frame = 1 / camera.mode.frame_rate_hz;
  if (a.longest_s > 0 && !(total <= frame * (1 + 1e-9)))
    complaints.add(a, &a.longest_s, "the longest exposures do not fit into a frame",
                   "got " + rounded(1e3 * total) + " ms together, readout included; a frame has " + rounded(1e3 * frame) + " ms");
}

}  // namespace tofray::model
