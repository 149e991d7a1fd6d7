// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light that comes by two ways: P11.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/pi.h"
#include "support/pixels.h"
#include "tofray/simulator.h"

using namespace tofray;
using namespace tofray::test;

// A second way of r times the power, D later in phase, turns the phase by atan2(r sin D, 1 + r cos D): asin(r) at most, at D = acos(−r).
TEST(two_paths, turn_the_phase_as_the_closed_form_says) {
  constexpr double light_speed = 299792458.0;
  struct Case {
    double r, later_rad;
  };
  std::vector<Case> cases;
  for (const double r : {0.0, 0.01, 0.3, 0.7, 0.9}) {
    for (const double later : {0.0, 0.3, 1.5, 2.5, 3.3, 4.7, 6.2}) cases.push_back({r, later});
    cases.push_back({r, std::acos(-r)});
  }
  const Camera camera = lit_camera(static_cast<int>(cases.size()), 1);
  const double per_metre = 2 * pi * camera.mode.sequence[0].modulation_frequency_hz / light_speed;
  constexpr float direct_m = 2, power_w = 1e-12f;
  PixelLight light;
  light.width = camera.sensor.width, light.height = 1;
  light.light_of_path = {0, 0};
  light.power_w.assign(cases.size(), power_w), light.path_length_m.assign(cases.size(), direct_m);
  for (const Case& one : cases) {
    light.power_w.push_back(static_cast<float>(one.r) * power_w);
    light.path_length_m.push_back(direct_m + static_cast<float>(one.later_rad / per_metre));
  }
  const Frame frame = Simulator({}, camera, {.noise = Noise::off}).frame(0, light);
  double most = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double r = static_cast<double>(light.power_w[cases.size() + i]) / static_cast<double>(power_w);
    const double later = (static_cast<double>(light.path_length_m[cases.size() + i]) - static_cast<double>(direct_m)) * per_metre;
    const double expected = std::atan2(r * std::sin(later), 1 + r * std::cos(later));
    const double turned = 2 * per_metre * (range_of_taps(frame.raw, i) - 0.5 * static_cast<double>(direct_m));
    EXPECT_NEAR(turned, expected, 1e-6) << "r " << r << ", " << later << " rad later";
    EXPECT_LE(std::abs(turned), std::asin(r) + 1e-6);
    if (r > 0.65 && r < 0.75) most = std::max(most, turned);
  }
  EXPECT_NEAR(most, std::asin(0.7), 1e-6);
}
