// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Charge beyond a full well, which spills into the neighbours, as far as flags know of it.                       [theory: blooming]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/own_arrays.h"
#include "support/pixels.h"
#include "support/same_frame.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int bloom_width = 45, bloom_height = 23;  // no whole number of packs or tiles
constexpr std::size_t bloom_pixels = std::size_t{bloom_width} * bloom_height;
constexpr double bloom_well = 20000;

Camera blooming(double share, double limit) {
  Camera camera = lit_camera(bloom_width, bloom_height, 60);
  camera.adc = {16, 10, 32768, 0, 65535};
  camera.pixel.full_well_e = bloom_well;
  camera.pixel.blooming_share = share, camera.pixel.blooming_limit_e = limit;
  return camera;
}

/// Dim light, and in some pixels, at edges and corners, too, up to ten times what the wells hold.
PixelLight with_bright_spots() {
  PixelLight out;
  out.width = bloom_width, out.height = bloom_height;
  for (std::size_t i = 0; i < bloom_pixels; ++i) {
    const bool bright = i == 0 || i == bloom_pixels - 1 || i % 37 == 5;
    out.power_w.push_back(static_cast<float>(bright ? 1e-11 * static_cast<double>(1 + i % 50) : 2e-12));
    out.path_length_m.push_back(static_cast<float>(2.2 + std::sin(0.77 * static_cast<double>(i))));
  }
  return out;
}

/// What each pixel's wells have no room for in the raw frame in which that is most.
std::vector<double> overflow_of(const Frame& whole) {
  std::vector<double> out(bloom_pixels, 0.0);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < bloom_pixels; ++i) {
      const std::size_t at = k * bloom_pixels + i;
      out[i] = std::max(out[i], std::max(static_cast<double>(whole.raw.tap_a[at]) - bloom_well, 0.0) +
                                    std::max(static_cast<double>(whole.raw.tap_b[at]) - bloom_well, 0.0));
    }
  return out;
}
double neighbours_of(const std::vector<double>& image, int x, int y) {
  double sum = 0;
  for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
    if (x + dx < 0 || x + dx >= bloom_width || y + dy < 0 || y + dy >= bloom_height) continue;
    sum += image[static_cast<std::size_t>((y + dy) * bloom_width + x + dx)];
  }
  return sum;
}

}  // namespace

// With expected charges: flagged where share·Σ of the four neighbours is above the limit, or the pixel itself is full; all else is as without.
TEST(blooming, flags_who_gets_more_than_the_limit_of_what_neighbours_cannot_hold) {
  const PixelLight light = with_bright_spots();
  Camera bottomless = blooming(0, 0);
  bottomless.pixel.full_well_e = 1e30;
  const std::vector<double> over = overflow_of(frame_of_light(bottomless, light));
  const Frame plain = frame_of_light(blooming(0, 0), light);
  for (const auto& [share, limit] : {std::pair{0.05, 400.0}, {0.25, 0.0}, {0.01, 2000.0}}) {
    const Frame seen = frame_of_light(blooming(share, limit), light);
    EXPECT_EQ(seen.raw.tap_a, plain.raw.tap_a);
    EXPECT_EQ(seen.raw.raw, plain.raw.raw);
    int more = 0;
    for (int y = 0; y < bloom_height; ++y) {
      for (int x = 0; x < bloom_width; ++x) {
        const auto at = static_cast<std::size_t>(y * bloom_width + x);
        const bool spilled = share * neighbours_of(over, x, y) > limit, full = (plain.depth.flags[at] & flag_saturated) != 0;
        ASSERT_EQ((seen.depth.flags[at] & flag_saturated) != 0, spilled || full) << x << ", " << y;
        if (!spilled) continue;
        more += full ? 0 : 1;
        ASSERT_TRUE(std::isnan(seen.depth.z_m[at]) && std::isnan(seen.depth.range_m[at]) && std::isnan(seen.depth.points_m[3 * at]));
        ASSERT_EQ(seen.depth.confidence[at], 0);
        ASSERT_EQ(seen.depth.flags[at] & ~flag_saturated & ~flag_flying_pixel,
                  plain.depth.flags[at] & ~flag_saturated & ~flag_flying_pixel);
      }
    }
    EXPECT_GT(more, 5) << share;
  }
}

// ±1 e⁻ about the limit: one bright pixel, no other. Its path is a whole period, so that tap A of the first raw frame has most by far.
TEST(blooming, begins_where_the_limit_is_passed) {
  PixelLight light = with_bright_spots();
  std::fill(light.power_w.begin(), light.power_w.end(), 2e-12f);
  constexpr std::size_t middle = bloom_pixels / 2;
  light.power_w[middle] = 2.4e-11f, light.path_length_m[middle] = static_cast<float>(299792458.0 / 60e6);
  Camera bottomless = blooming(0, 0);
  bottomless.pixel.full_well_e = 1e30;
  const double over = overflow_of(frame_of_light(bottomless, light))[middle];
  ASSERT_GT(over, 1000);
  for (const double off : {-1.0, 1.0}) {
    const Frame seen = frame_of_light(blooming(0.1, 0.1 * over + off), light);
    int flagged = 0;
    for (const std::size_t at : {middle - 1, middle + 1, middle - bloom_width, middle + bloom_width})
      flagged += (seen.depth.flags[at] & flag_saturated) != 0 ? 1 : 0;
    EXPECT_EQ(flagged, off < 0 ? 4 : 0);
  }
}

// A raw frame without the camera's light measures ambient light alone: what overflows there is no matter of depth, as with full wells themselves.
TEST(blooming, looks_at_lit_raw_frames) {
  Camera camera = blooming(0.25, 0);
  camera.mode.sequence.push_back({false, 0, 0, 1});
  PixelLight light = with_bright_spots();
  std::fill(light.power_w.begin(), light.power_w.end(), 2e-12f);
  light.ambient_e_per_s.assign(bloom_pixels, 1e5f);  // 100 e⁻ in a lit raw frame, 1e5 in the unlit one
  const Frame seen = frame_of_light(camera, light);
  EXPECT_TRUE(std::all_of(seen.depth.flags.begin(), seen.depth.flags.end(), [](auto flags) { return (flags & flag_saturated) == 0; }));
}

// Filters that keep edges come before the check for flying pixels, and after this: nothing is made of a pixel that is flagged.
TEST(blooming, comes_before_filters) {
  for (const auto kind :
       {ImageFilter::Kind::median, ImageFilter::Kind::adaptive, ImageFilter::Kind::bilateral, ImageFilter::Kind::gaussian}) {
    Camera camera = blooming(0.05, 400);
    const Frame plain = frame_of_light(camera, with_bright_spots());
    camera.decoding.filter.kind = kind;
    const Frame seen = frame_of_light(camera, with_bright_spots());
    for (std::size_t i = 0; i < bloom_pixels; ++i) {
      if ((plain.depth.flags[i] & flag_saturated) == 0) continue;
      ASSERT_NE(seen.depth.flags[i] & flag_saturated, 0);
      ASSERT_TRUE(std::isnan(seen.depth.range_m[i]));
    }
  }
}

// Filters take nothing of a flagged pixel: it has another range, and what is around has one that no filter changes.
TEST(blooming, lets_no_flagged_pixel_bleed_into_what_filters_make) {
  for (const auto kind : {ImageFilter::Kind::gaussian, ImageFilter::Kind::median, ImageFilter::Kind::adaptive}) {
    Camera camera = blooming(0.1, 10);
    camera.decoding.filter.kind = kind, camera.decoding.filter.sigmas = 1000, camera.decoding.flying_check = false;
    PixelLight light = with_bright_spots();
    std::fill(light.power_w.begin(), light.power_w.end(), 2e-12f), std::fill(light.path_length_m.begin(), light.path_length_m.end(), 2.2f);
    constexpr std::size_t middle = bloom_pixels / 2;
    light.power_w[middle] = 4e-10f;
    for (const std::size_t at : {middle - 1, middle + 1, middle - bloom_width, middle + bloom_width}) light.path_length_m[at] = 3.4f;
    const Frame seen = frame_of_light(camera, light);
    int valid = 0;
    for (const float range : seen.depth.range_m) {
      if (std::isnan(range)) continue;
      ++valid;
      ASSERT_NEAR(static_cast<double>(range), 1.1, 1e-5);
    }
    EXPECT_EQ(valid, static_cast<int>(bloom_pixels) - 5);
  }
}

TEST(blooming, is_the_same_with_every_instruction_set_and_off_unless_given) {
  EXPECT_EQ(Pixel().blooming_share, 0);
  const Frame scalar = frame_of_light(blooming(0.05, 400), with_bright_spots(), Noise::exact, Isa::scalar);
  for (const Isa isa : {Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(first_difference(frame_of_light(blooming(0.05, 400), with_bright_spots(), Noise::exact, isa), scalar), "");
  }
  // A limit without a share is nothing.
  EXPECT_EQ(first_difference(frame_of_light(blooming(0, 400), with_bright_spots(), Noise::exact),
                             frame_of_light(blooming(0, 0), with_bright_spots(), Noise::exact)),
            "");
}

// What is recorded says nothing of charge beyond the wells.
TEST(blooming, is_not_known_of_a_recording) {
  const Frame plain = frame_of_light(blooming(0, 0), with_bright_spots());
  const Depth again = process(plain.raw, blooming(0.25, 0)), before = process(plain.raw, blooming(0, 0));
  EXPECT_EQ(again.flags, before.flags);
}
