// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/readout.h"

namespace tofray::base {

ImageExtent image_extent(const Camera& camera) {
  const Readout& r = camera.readout;
  const auto side = [&](int sensor, int first, int size) { return (size > 0 ? size : sensor - first) / r.binning; };
  return {side(camera.sensor.width, r.left, r.width), side(camera.sensor.height, r.top, r.height)};
}

std::vector<double> raw_frame_starts_s(const std::vector<double>& integration_time_s, double readout_time_s) {
  std::vector<double> out;
  double start = 0;
  for (const double time : integration_time_s) {
    out.push_back(start);
    start += time + readout_time_s;
  }
  return out;
}

}  // namespace tofray::base
