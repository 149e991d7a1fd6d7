// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// Range error of a point in the direction (x, 0, 1), lit by every light as strongly as its share of the power says.
double range_error(const Camera& camera, double x, double range) {
  const Bench bench(camera);
  const double length = std::hypot(x, 1.0), px = range * x / length, pz = range / length;
  std::vector<flow::Path<float>> paths;
  double sum = 0;
  for (const Illumination& l : camera.illumination) sum += l.power_w;
  for (const Illumination& source : camera.illumination) {
    const double from_light = std::hypot(px - source.position[0], source.position[1], pz - source.position[2]);
    paths.push_back({static_cast<float>(2e7 * source.power_w / sum), static_cast<float>(from_light + range)});
  }
  const flow::Light<float> light = bench.light_of(paths);
  auto exposure = raw::start<float>(bench.sensor(), {0, 1}, nullptr);
  std::vector<float> difference;
  for (int k = 0; k < bench.sensor().raw_frames; ++k) {
    difference.push_back(raw::expose(bench.sensor(), k, light, bench.phasors().orders, {0, 0}, exposure).difference);
  }
  const auto ray = flow::make_ray(static_cast<float>(x), 0.0f, 1.0f);
  return static_cast<double>(depth::decode<float>(bench.decoder(), difference.data(), false, false, ray, {0, 1}).range) - range;
}

Camera lights_at(const std::vector<std::pair<double, double>>& x_and_power) {
  Camera camera = bench_camera({20e6});
  const Illumination one = camera.illumination[0];
  camera.illumination.clear();
  for (const auto& [x, power] : x_and_power) {
    camera.illumination.push_back(one);
    camera.illumination.back().position = {x, 0, 0}, camera.illumination.back().power_w = power;
  }
  return camera;
}

}  // namespace

// Two lights 50 mm to either side. On the axis both paths are alike, and what is left is the roundings. Aside, the mean of ℓ² is more than
// the square of the mean by the paths' variance, at most (L·sin α)², which makes the range too short by no more than (L·sin α)²/2ℓ. (Decoded
// as if all light came from the first, it would be off by L·sin α/2, 11 mm at α = 27°.)
TEST(several_lights, to_both_sides_of_the_camera_leave_the_range_where_it_is) {
  const Camera camera = lights_at({{0.05, 1}, {-0.05, 1}});
  for (const double range : {0.3, 0.5, 2.0}) {
    EXPECT_NEAR(range_error(camera, 0, range), 0, 5e-6) << range;
    for (const double x : {-0.5, 0.5}) {
      const double aside = 0.05 * std::sin(std::atan(0.5)), error = range_error(camera, x, range);
      EXPECT_NEAR(error, 0, aside * aside / (4 * range) * 1.1 + 5e-6) << range << " " << x;
      EXPECT_NEAR(error, range_error(camera, -x, range), 5e-6) << "the two sides are alike";
    }
  }
}

// Three to one: light from the mean position. A light without power does not count.
TEST(several_lights, count_by_their_power) {
  const Camera camera = lights_at({{0.05, 3}, {-0.05, 1}, {0.09, 0}});
  EXPECT_NEAR(static_cast<double>(Bench(camera).decoder().light[0]), 0.05 * (3 - 1) / 4, 1e-8);
  EXPECT_NEAR(static_cast<double>(Bench(camera).decoder().light_square), 0.05 * 0.05, 1e-9);
  for (const double x : {-0.5, 0.0, 0.5}) EXPECT_NEAR(range_error(camera, x, 0.5), 0, 0.00028) << x;  // (L·sin α)²/2ℓ again
}

// At one place with different waveforms the pixel cannot tell which light is which: it sees the sum of their phasors, by their power.
TEST(several_lights, of_different_waveforms_are_decoded_as_their_sum) {
  Camera camera = lights_at({{0, 3}, {0, 1}});
  Waveform& first = camera.illumination[0].waveform;
  Waveform& second = camera.illumination[1].waveform;
  first.harmonics = 4, first.duty = 0.25, first.rise_time_s = 2e-9, first.bandwidth_hz = 30e6;
  second.kind = Waveform::Kind::sine, second.modulation_depth = 0.8;
  // linear interpolation of the wiggling table, and single precision
  for (double range = 0.2; range < 7; range += 0.37) EXPECT_NEAR(range_error(camera, 0, range), 0, 3e-5) << range;
}
