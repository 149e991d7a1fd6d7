// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Regions of a sensor, and pixels that are read together.                                                   [theory: eq. 3.35]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "load/builtin.h"
#include "load/load.h"
#include "support/pixels.h"
#include "support/text.h"

namespace {

using namespace tofray;
using test::has;

using Settings = std::vector<std::pair<std::string, std::string>>;

Camera pico_with(const Settings& set, const std::string& mode = {}) {
  CameraOptions options;
  options.set = set, options.mode = mode;
  return load_camera("pico-flexx", options);
}

std::string refusal_of(const Settings& set) {
  try {
    pico_with(set);
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

const std::string small_region = "{left: 40, top: 30, width: 64, height: 48}";

}  // namespace

// A region is the same pixels: each value of expected frames, to the bit.
TEST(region, shows_what_its_pixels_show_in_the_whole_image) {
  const Camera whole = pico_with({}), part = pico_with({{"region", small_region}});
  ASSERT_EQ(part.sensor.width, 64);
  ASSERT_EQ(part.sensor.height, 48);
  const Scene scene = load_scene("demo");
  const Frame seen = test::expected_frame(scene, part), all = test::expected_frame(scene, whole);
  const std::size_t phases = whole.mode.sequence.size();
  for (std::size_t k = 0; k < phases; ++k)
    for (std::size_t y = 0; y < 48; ++y)
      for (std::size_t x = 0; x < 64; ++x) {
        const std::size_t at = (k * 48 + y) * 64 + x, from = (k * 172 + y + 30) * 224 + x + 40;
        ASSERT_EQ(seen.raw.tap_a[at], all.raw.tap_a[from]) << k << " " << x << " " << y;
        ASSERT_EQ(seen.raw.raw[at], all.raw.raw[from]);
      }
  for (std::size_t y = 0; y < 48; ++y)
    for (std::size_t x = 0; x < 64; ++x) ASSERT_EQ(seen.truth.object_id[y * 64 + x], all.truth.object_id[(y + 30) * 224 + x + 40]);
}

// Charge of n × n pixels together (3.35): what a smooth scene gives them is within the curvature of cos⁴ over two pixels of their sum, 1e-4,
// and the middle of the binned pixel looks between theirs.
TEST(binning, adds_the_charge_of_its_pixels) {
  Settings even = {{"illumination.0.pattern", "{kind: lambertian}"}, {"pixel.dark_current", "5000 e/s"}};
  const Camera whole = pico_with(even);
  even.emplace_back("binning", "2");
  const Camera binned = pico_with(even);
  ASSERT_EQ(binned.sensor.width, 112);
  ASSERT_EQ(binned.sensor.height, 86);
  const Scene scene = test::wall(1, 0.5);
  const Frame seen = test::expected_frame(scene, binned), all = test::expected_frame(scene, whole);
  for (std::size_t k = 0; k < whole.mode.sequence.size(); ++k)
    for (const auto& [x, y] : {std::pair<std::size_t, std::size_t>{55, 43}, {20, 43}, {80, 12}}) {
      double sum = 0;
      for (const std::size_t dy : {0, 1})
        for (const std::size_t dx : {0, 1}) sum += static_cast<double>(all.raw.tap_a[(k * 172 + 2 * y + dy) * 224 + 2 * x + dx]);
      EXPECT_NEAR(static_cast<double>(seen.raw.tap_a[(k * 86 + y) * 112 + x]) / sum, 1, 3e-4) << k << " " << x << " " << y;
    }
}

TEST(binning, makes_larger_pixels_that_are_read_once) {
  const Settings set = {{"pixel.patterns", "{prnu: 2 %, delay: 20 ps, phase_offset: 0.02 rad, dsnu: 3 DN}"},
                        {"pixel.crosstalk", "{left_right: 4 %, up_down: 2 %}"},
                        {"pixel.suppression", "{threshold: 1000 e, budget: 5000 e}"},
                        {"pixel.blooming", "{share: 8 %, limit: 100 e}"},
                        {"lens.scatter", "{kind: gaussians, share: 1 %, sigma: [8 px]}"}};
  Settings binned_set = set;
  binned_set.emplace_back("region", small_region), binned_set.emplace_back("binning", "4");
  const Camera whole = pico_with(set), binned = pico_with(binned_set);
  EXPECT_EQ(binned.sensor.width, 16);
  EXPECT_EQ(binned.sensor.height, 12);
  EXPECT_DOUBLE_EQ(binned.sensor.pixel_pitch_m, 48e-6);
  EXPECT_DOUBLE_EQ(binned.lens.fx_px, whole.lens.fx_px / 4);
  EXPECT_DOUBLE_EQ(binned.lens.cx_px, (111.5 - 40 - 1.5) / 4);  // the region's column 1.5 is the middle of the first binned pixel
  EXPECT_DOUBLE_EQ(binned.lens.cy_px, (85.5 - 30 - 1.5) / 4);
  EXPECT_DOUBLE_EQ(binned.lens.scatter.sigma_px[0], 2);
  EXPECT_DOUBLE_EQ(binned.pixel.full_well_e, 16 * whole.pixel.full_well_e);
  EXPECT_DOUBLE_EQ(binned.pixel.suppression_threshold_e, 16000);
  EXPECT_DOUBLE_EQ(binned.pixel.suppression_budget_e, 80000);
  EXPECT_DOUBLE_EQ(binned.pixel.prnu, 0.005);
  EXPECT_DOUBLE_EQ(binned.pixel.delay_s, 5e-12);
  EXPECT_DOUBLE_EQ(binned.pixel.phase_offset_rad, 0.005);
  EXPECT_DOUBLE_EQ(binned.pixel.dsnu_dn, 3);
  EXPECT_DOUBLE_EQ(binned.pixel.crosstalk_left_right, 0.01);
  EXPECT_DOUBLE_EQ(binned.pixel.crosstalk_up_down, 0.005);
  EXPECT_DOUBLE_EQ(binned.pixel.blooming_share, 0.02);
  EXPECT_DOUBLE_EQ(binned.pixel.read_noise_e, whole.pixel.read_noise_e);
}

// Each mode its own; what is said of the whole profile, or for a run, counts more.
TEST(region_and_binning, are_those_of_the_mode) {
  const std::string first = "modes.MODE_9_5FPS_2000.", other = "MODE_9_10FPS_1000";
  const Settings set = {{first + "region", small_region}, {first + "binning", "2"}};
  EXPECT_EQ(pico_with(set, "MODE_9_5FPS_2000").sensor.width, 32);
  EXPECT_EQ(pico_with(set, other).sensor.width, 224);
  Settings more = set;
  more.emplace_back("binning", "4");
  EXPECT_EQ(pico_with(more, "MODE_9_5FPS_2000").sensor.width, 16);
  EXPECT_EQ(pico_with(more, other).sensor.width, 56);
  std::vector<int> widths;
  const std::string text(load::find_builtin(load::builtin_profiles(), "pico-flexx")->text);
  CameraOptions options;
  options.set = set;
  load::camera_from_text(text, "pico", "", options, [&](const Camera& camera) { widths.push_back(camera.sensor.width); });
  EXPECT_EQ(std::count(widths.begin(), widths.end(), 32), 1);
  EXPECT_EQ(std::count(widths.begin(), widths.end(), 224), static_cast<long>(widths.size()) - 1);
}

TEST(region_and_binning, are_refused_where_they_do_not_fit) {
  EXPECT_EQ(refusal_of({{"region", "{left: 160, top: 0, width: 64, height: 172}"}}), "");
  EXPECT_TRUE(has(refusal_of({{"region", "{left: 161, top: 0, width: 64, height: 172}"}}), "the region reaches over the sensor's edge"));
  EXPECT_TRUE(has(refusal_of({{"region", "{left: 0, top: 1, width: 64, height: 172}"}}), "rows 1 to 172 of 224 x 172"));
  EXPECT_TRUE(has(refusal_of({{"binning", "3"}}), "the binning leaves pixels over"));
  EXPECT_TRUE(
      has(refusal_of({{"binning", "2"}, {"sensor.mask", "{kind: table, samples: [[1, 0], [0, 1]]}"}}), "are those of single pixels"));
}
