// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/filter.h"

#include <cmath>

#include "num/setup_math.h"

namespace tofray::simulator {

void set_filter(const ImageFilter& filter, pipeline::Job& job) {
  switch (filter.kind) {
    case ImageFilter::Kind::none: job.filter = pipeline::FilterKind::none; break;
    case ImageFilter::Kind::gaussian: job.filter = pipeline::FilterKind::gaussian; break;
    case ImageFilter::Kind::median: job.filter = pipeline::FilterKind::median; break;
    case ImageFilter::Kind::bilateral: job.filter = pipeline::FilterKind::bilateral; break;
    case ImageFilter::Kind::adaptive: job.filter = pipeline::FilterKind::adaptive; break;
  }
  job.filter_radius = filter.radius_px;
  const auto square = [](double value) { return static_cast<float>(value * value); };
  job.filter_factor = square(filter.sigmas), job.filter_range = square(filter.range_m), job.filter_goal = square(filter.goal_m);
  if (filter.kind != ImageFilter::Kind::gaussian && filter.kind != ImageFilter::Kind::bilateral) return;
  // Beyond 3 sigma the weights are below 1.2 %.
  job.filter_radius = static_cast<int>(std::ceil(3 * filter.sigma_px));
  for (int i = 0; i <= job.filter_radius; ++i) {
    job.filter_weights[i] = static_cast<float>(num::setup::exp(-0.5 * i * i / (filter.sigma_px * filter.sigma_px)));
  }
}

}  // namespace tofray::simulator
