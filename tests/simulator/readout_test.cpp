// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Regions of the sensor, and pixels that are read together.              [theory: image-pixels, binned-charge, binned-patterns]
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "camera/readout/image_camera.h"
#include "support/pixels.h"
#include "support/same_frame.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int whole_width = 67, whole_height = 45;  // no whole number of packs, tiles or binned pixels

Camera whole_sensor() {
  Camera camera = lit_camera(whole_width, whole_height, 60);
  camera.lens.cx_px = 30.25, camera.lens.cy_px = 24;
  camera.pixel.dark_current_e_per_s = 2e5, camera.pixel.tap_offset_mismatch_e = 40;
  camera.adc = {16, 10, 32768, 0, 65535};
  return camera;
}

Camera read_by(Camera camera, const Readout& readout) {
  camera.readout = readout;
  return camera;
}

/// Three surfaces at different distances, so that pixels differ.
Scene steps() {
  Scene scene = wall(1.3, 0.6);
  scene.objects.push_back(object(Box{{-0.4, -0.3, 0.9}, {0.1, 0.25, 1.0}}));
  scene.objects.push_back(object(Sphere{{0.3, 0.2, 1.0}, 0.2}));
  return scene;
}

Frame without_noise_of(const Scene& scene, const Camera& camera, int subpixel = 1) {
  return Simulator(scene, camera, {.noise = Noise::off, .threads = 1, .subpixel = subpixel}).frame(0);
}

std::string complaint_of(const Readout& readout) {
  try {
    Simulator(wall(1), read_by(whole_sensor(), readout));
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

}  // namespace

// Every array of the region is that part of the whole sensor's, fixed patterns included: they are of the specimen, not of the image.
TEST(readout, a_region_is_a_part_of_the_whole) {
  Camera camera = whole_sensor();
  camera.pixel.prnu = 0.05, camera.pixel.dsnu_dn = 3, camera.pixel.delay_s = 1e-10, camera.pixel.phase_offset_rad = 0.05;
  camera.decoding.flying_check = false;  // its edge has no neighbours
  const Readout region{1, 9, 5, 33, 21};
  const Frame all = without_noise_of(steps(), camera), part = without_noise_of(steps(), read_by(camera, region));
  ASSERT_EQ(part.depth.width, 33);
  ASSERT_EQ(part.depth.height, 21);
  for (std::size_t y = 0; y < 21; ++y) {
    for (std::size_t x = 0; x < 33; ++x) {
      const std::size_t here = y * 33 + x, there = (y + 5) * whole_width + x + 9;
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_EQ(part.raw.tap_a[k * 33 * 21 + here], all.raw.tap_a[k * whole_width * whole_height + there]) << x << ", " << y;
        EXPECT_EQ(part.raw.raw[k * 33 * 21 + here], all.raw.raw[k * whole_width * whole_height + there]) << x << ", " << y;
      }
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_FLOAT_EQ(part.depth.points_m[3 * here + axis], all.depth.points_m[3 * there + axis]) << x << ", " << y;
      EXPECT_EQ(part.depth.flags[here], all.depth.flags[there]);
      EXPECT_EQ(part.truth.object_id[here], all.truth.object_id[there]);
    }
  }
}

namespace {

/// Every array of a region against that part of another frame's, `left` and `top` pixels further on.
void expect_part(const Frame& part, const Frame& all, int left, int top, const std::string& what) {
  const auto width = static_cast<std::size_t>(part.depth.width), height = static_cast<std::size_t>(part.depth.height),
             wide = static_cast<std::size_t>(all.depth.width), high = static_cast<std::size_t>(all.depth.height);
  std::size_t other = 0;
  for (std::size_t y = 0; y < height; ++y) {
    for (std::size_t x = 0; x < width; ++x) {
      const std::size_t here = y * width + x, there = (y + static_cast<std::size_t>(top)) * wide + x + static_cast<std::size_t>(left);
      for (std::size_t k = 0; k < 4; ++k) other += part.raw.tap_a[k * width * height + here] != all.raw.tap_a[k * wide * high + there];
      other += part.depth.flags[here] != all.depth.flags[there];
      other += part.truth.object_id[here] != all.truth.object_id[there];
      for (std::size_t axis = 0; axis < 3; ++axis) {  // rays differ by the rounding of where the image begins
        const auto a = static_cast<double>(part.depth.points_m[3 * here + axis]),
                   b = static_cast<double>(all.depth.points_m[3 * there + axis]);
        other += std::isnan(a) != std::isnan(b) || std::abs(a - b) > 1e-6;
      }
    }
  }
  EXPECT_EQ(other, 0U) << what;
}

}  // namespace

// Light that the lens scatters, charge that neighbours share and what wells spill come over a region's border as if all were read.
TEST(readout, a_region_gets_what_comes_from_pixels_that_are_not_read) {
  Camera plain = whole_sensor();
  plain.decoding.flying_check = false;  // its edge has no neighbours
  std::vector<std::pair<std::string, Camera>> cameras(5, {"", plain});
  cameras[0].first = "gaussians", cameras[0].second.lens.scatter = {Scatter::Kind::gaussians, 0.2, {3, 0.5}, {1, 2}};
  cameras[1].first = "kernel",
  cameras[1].second.lens.scatter = {Scatter::Kind::kernel, 0.3, {}, {}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15}, 5, 3};
  cameras[2].first = "crosstalk", cameras[2].second.pixel.crosstalk_left_right = 0.04, cameras[2].second.pixel.crosstalk_up_down = 0.02;
  cameras[3].first = "blooming", cameras[3].second.pixel.full_well_e = 4e4, cameras[3].second.pixel.blooming_share = 0.2,
  cameras[3].second.pixel.blooming_limit_e = 100;
  cameras[4].first = "all of it", cameras[4].second = cameras[3].second, cameras[4].second.lens.scatter = cameras[0].second.lens.scatter,
  cameras[4].second.pixel.crosstalk_left_right = 0.04;
  for (const auto& [name, camera] : cameras) {
    for (const int n : {1, 2}) {
      const Frame all = without_noise_of(steps(), read_by(camera, {n, 0, 0, 0, 0}));
      for (const auto& [left, top, width, height] :
           {std::array{20, 16, 24, 10}, {0, 0, 14, 12}, {52, 30, 14, 14}, {0, 20, 66, 8}, {30, 0, 6, 44}}) {
        const Camera region = read_by(camera, {n, left, top, width, height});
        const std::string what = name + ", " + std::to_string(n) + ": " + std::to_string(left) + ", " + std::to_string(top);
        const Frame part = without_noise_of(steps(), region);
        ASSERT_EQ(part.depth.width, width / n);
        expect_part(part, all, left / n, top / n, what);
        if (n == 1) continue;
        // A frame of a batch is a part, too.
        Simulator many(steps(), region, {.noise = Noise::off, .threads = 1});
        many.frames(0, 2, [&](const FrameArrays& one) {
          ASSERT_EQ(one.width, part.depth.width);
          EXPECT_TRUE(std::equal(part.raw.tap_a.begin(), part.raw.tap_a.end(), one.tap_a)) << what;
        });
      }
    }
  }
}

// Even light stays even to the region's rim; a mean over frames and an exposure that follows the light see the region alone.
TEST(readout, a_region_of_even_light_is_even) {
  Camera camera = whole_sensor();
  camera.pixel.dark_current_e_per_s = 0, camera.pixel.tap_offset_mismatch_e = 0;
  camera.lens.scatter = {Scatter::Kind::gaussians, 0.2, {3}, {}};
  PixelLight light;
  light.width = whole_width, light.height = whole_height;
  light.power_w.assign(std::size_t{whole_width} * whole_height, 1e-12f), light.path_length_m.assign(light.power_w.size(), 2.0f);
  const SimulatorOptions options{.noise = Noise::off, .threads = 1};
  Camera sharp = camera;
  sharp.lens.scatter = {};
  const double one = static_cast<double>(Simulator({}, sharp, options).frame(0, light).truth.signal_e[0]);
  // Light of one's own is of the region alone, and dark beside it.
  Camera part = read_by(camera, {1, 25, 20, 20, 16});
  light.width = 20, light.height = 16, light.power_w.resize(320), light.path_length_m.resize(320);
  EXPECT_NEAR(static_cast<double>(Simulator({}, part, options).frame(0, light).truth.signal_e[0]) / one, 0.85, 0.03);
  // What is seen goes on beside it.
  Scene scene = wall(1, 0.5);
  scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.01, {}, {}, {}};
  part.illumination.clear(), part.mode.sequence = {{false, 0, 0, 1e-3}};
  part.lens.vignetting = Lens::Vignetting::off;
  const Frame even = Simulator(scene, part, options).frame(0);
  // (Nine rows further down the sensor ends, and with it what its light is worth: 0.2·1.5e-3/2.)
  for (const float charge : even.raw.tap_a) ASSERT_NEAR(charge, even.raw.tap_a[160], 2e-4F * even.raw.tap_a[160]);
  for (const bool follows : {false, true}) {
    Camera over = read_by(camera, {1, 25, 20, 20, 16});
    if (follows)
      over.auto_exposure = {1, 0.02, 0.9, 0, 0};
    else
      over.decoding.temporal_frames = 3;
    Simulator simulator(steps(), over, options);
    const Frame third = simulator.frame(2);
    EXPECT_EQ(third.depth.width, 20);
    int found = 0;
    for (const float z : third.depth.z_m) found += z > 0.5F && z < 1.5F ? 1 : 0;
    EXPECT_GT(found, 280) << follows;  // of 320; the rest is at edges
    EXPECT_EQ(third.raw.integration_time_s[0] != camera.mode.sequence[0].integration_time_s, follows);
  }
}

// What lies beside a region is computed for the lens that scatters, and brighter: the next time follows from the region's codes alone
// [theory: auto-exposure].
TEST(readout, an_exposure_meters_its_region_alone) {
  Camera camera = whole_sensor();
  camera.lens.scatter = {Scatter::Kind::gaussians, 0.2, {3}, {}};
  camera.auto_exposure = {1, 0.5, 1, 0, 1e-2};
  for (const auto& [left, top] : {std::array{25, 20}, {4, 4}, {45, 24}}) {
    const Camera part = read_by(camera, {1, left, top, 8, 8});
    Simulator simulator(steps(), part, {.noise = Noise::off, .threads = 1});
    const Frame first = simulator.frame(0);
    const double reach = std::min(part.adc.mid_code - part.adc.valid_min, part.adc.valid_max - part.adc.mid_code);
    double most = 0;
    for (std::size_t i = 0; i < first.raw.raw.size(); ++i)
      if (part.mode.sequence[i / 64].lit) most = std::max(most, std::abs(first.raw.raw[i] - part.adc.mid_code) / reach);
    const double before = first.raw.integration_time_s[0], after = simulator.frame(1).raw.integration_time_s[0];
    EXPECT_NEAR(after / before, std::clamp(0.5 / most, 0.25, 4.0), 1e-6) << left << " " << top;  // a share in float
  }
}

// A region with no width reaches to the sensor's edge.
TEST(readout, a_region_reaches_to_the_edge_unless_it_says_how_far) {
  const ImageSize size = image_size(read_by(whole_sensor(), {2, 9, 5, 0, 0}));
  EXPECT_EQ(size.width, (whole_width - 9) / 2);
  EXPECT_EQ(size.height, (whole_height - 5) / 2);
  EXPECT_EQ(pixel_rays(read_by(whole_sensor(), {2, 9, 5, 0, 0})).size(), 2U * 29 * 20);
}

// Without noise a tap of a binned pixel holds what n × n taps hold, dark charge and offsets of the taps with it. Samples within the
// pixel, n × n of them, see what those pixels see: what is left is single precision.
TEST(readout, binned_pixels_hold_the_charge_of_all_of_theirs) {
  for (const int n : {2, 3}) {
    const Frame all = without_noise_of(steps(), whole_sensor()),
                binned = without_noise_of(steps(), read_by(whole_sensor(), {n, 4, 3, 48, 36}), n);
    const int width = 48 / n, height = 36 / n;
    ASSERT_EQ(binned.raw.width, width);
    ASSERT_EQ(binned.raw.height, height);
    for (int k = 0; k < 4; ++k) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          double a = 0, b = 0;
          for (int i = 0; i < n * n; ++i) {
            const auto at = static_cast<std::size_t>((k * whole_height + 3 + y * n + i / n) * whole_width + 4 + x * n + i % n);
            a += static_cast<double>(all.raw.tap_a[at]), b += static_cast<double>(all.raw.tap_b[at]);
          }
          const auto at = static_cast<std::size_t>((k * height + y) * width + x);
          EXPECT_NEAR(static_cast<double>(binned.raw.tap_a[at]), a, 1e-5 * a) << n << ": " << x << ", " << y;
          EXPECT_NEAR(static_cast<double>(binned.raw.tap_b[at]), b, 1e-5 * b) << n << ": " << x << ", " << y;
        }
      }
    }
  }
}

// The middle of n × n points of a plane that faces the camera is the point of the binned pixel.
TEST(readout, points_of_binned_pixels_are_in_the_middle_of_theirs) {
  const Frame all = without_noise_of(wall(1), whole_sensor()), binned = without_noise_of(wall(1), read_by(whole_sensor(), {2, 0, 0, 0, 0}));
  for (int y = 0; y < whole_height / 2; ++y) {
    for (int x = 0; x < whole_width / 2; ++x) {
      for (int axis = 0; axis < 2; ++axis) {
        double sum = 0;
        for (int i = 0; i < 4; ++i)
          sum += static_cast<double>(
              all.truth.position_m[static_cast<std::size_t>(3 * ((2 * y + i / 2) * whole_width + 2 * x + i % 2) + axis)]);
        const auto at = static_cast<std::size_t>(3 * (y * (whole_width / 2) + x) + axis);
        EXPECT_NEAR(static_cast<double>(binned.truth.position_m[at]), sum / 4, 1e-6) << x << ", " << y;
      }
    }
  }
}

// In the dark: n² times the charge with its shot noise, and reset and read noise once. The variance of N values has a relative error of
// √(2/N) = 0.9 %; five of them are exceeded by one of 1.7 million tests.
TEST(readout, read_noise_comes_once_and_shot_noise_of_all_charge) {
  Camera camera = whole_sensor();
  camera.sensor.width = camera.sensor.height = 318;
  camera.pixel.read_noise_e = 25, camera.pixel.tap_offset_mismatch_e = 0;
  const double charge = 9 * camera.pixel.dark_current_e_per_s * 1e-3;
  const Frame frame = Simulator(Scene(), read_by(camera, {3, 0, 0, 0, 0}), {.seed = 7, .threads = 1}).frame(0);
  const std::size_t pixels = 106 * 106;
  ASSERT_EQ(frame.raw.tap_a.size(), 4 * pixels);
  double sum = 0, square = 0;
  for (std::size_t i = 0; i < 2 * pixels; ++i) {
    const double off = static_cast<double>(frame.raw.tap_a[i]) - charge;
    sum += off, square += off * off;
  }
  const double count = 2.0 * static_cast<double>(pixels), variance = charge + 25 * 25;
  EXPECT_NEAR(sum / count, 0, 5 * std::sqrt(variance / count));
  EXPECT_NEAR(square / count, variance, 5 * std::sqrt(2 / count) * variance);
}

TEST(readout, wells_of_all_pixels_are_filled) {
  Camera camera = whole_sensor();
  camera.pixel.full_well_e = 300, camera.pixel.tap_offset_mismatch_e = 0;
  camera.pixel.dark_current_e_per_s = 1e9;
  const Frame frame = without_noise_of(Scene(), read_by(camera, {4, 0, 0, 0, 0}));
  for (const float tap : frame.raw.tap_a) EXPECT_EQ(tap, 16 * 300.0F);
  EXPECT_NE(frame.depth.flags[0] & flag_saturated, 0);
}

// A card of which one edge lies between two binned pixels: who lies beside it gets what its wells have no room for, along n pixels. So it is
// flagged where one pixel would be that stood beside the mean of the card's.
TEST(readout, binned_pixels_spill_from_where_single_ones_would) {
  constexpr int n = 4, rows = 12, left = 7, right = 8;
  constexpr double share = 0.1;
  Scene scene = wall(0.5, 0.6);
  scene.objects = {object(Box{{-2, -2, 0.5}, {0, 2, 0.6}})};
  Camera camera = lit_camera(16 * n, rows * n, 60);
  camera.adc = {16, 10, 32768, 0, 65535};
  const Frame bottomless = without_noise_of(scene, camera);
  const auto mean = [&](const Array<float>& tap, std::size_t k, std::size_t row) {
    double sum = 0;
    for (std::size_t y = 0; y < n; ++y)
      for (std::size_t x = 0; x < n; ++x) sum += tap[(k * rows * n + row * n + y) * 16 * n + left * n + x];
    return sum / (n * n);
  };
  camera.pixel.full_well_e = 0.5 * mean(bottomless.raw.tap_a, 0, rows / 2);
  std::vector<double> spilled(rows, 0.0);
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t k = 0; k < 4; ++k) {
      double over = 0;
      for (const auto* tap : {&bottomless.raw.tap_a, &bottomless.raw.tap_b})
        over += std::max(mean(*tap, k, row) - camera.pixel.full_well_e, 0.0);
      spilled[row] = std::max(spilled[row], share * over);
    }
  camera.pixel.blooming_share = share, camera.pixel.blooming_limit_e = 0.5 * (spilled[1] + spilled[2]);
  const Frame binned = without_noise_of(scene, read_by(camera, {n, 0, 0, 0, 0}));
  int flagged = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    const bool is = (binned.depth.flags[row * 16 + right] & flag_saturated) != 0;
    EXPECT_EQ(is, spilled[row] > camera.pixel.blooming_limit_e) << row << ": " << spilled[row] << " of " << camera.pixel.blooming_limit_e;
    flagged += is ? 1 : 0;
  }
  EXPECT_EQ(flagged, rows - 4);
}

// Gains of binned pixels are the means of the specimen's: by the ratio of frames with and without them, whose pixels have the same light.
TEST(readout, patterns_of_binned_pixels_are_means_of_the_specimens) {
  Camera camera = whole_sensor(), uneven = camera;
  uneven.pixel.prnu = 0.1;
  const auto gains = [&](const Readout& readout) {
    const Scene lit = wall(1);
    const Frame with = without_noise_of(lit, read_by(uneven, readout)), flat = without_noise_of(lit, read_by(camera, readout));
    std::vector<double> out;
    const std::size_t pixels = static_cast<std::size_t>(with.raw.width) * static_cast<std::size_t>(with.raw.height);
    for (std::size_t i = 0; i < pixels; ++i) out.push_back(static_cast<double>(with.raw.tap_b[i]) / static_cast<double>(flat.raw.tap_b[i]));
    return out;
  };
  camera.pixel.tap_offset_mismatch_e = uneven.pixel.tap_offset_mismatch_e = 0;
  camera.pixel.dark_current_e_per_s = uneven.pixel.dark_current_e_per_s = 0;  // dark charge has no PRNU
  const std::vector<double> one = gains({}), binned = gains({2, 3, 1, 0, 0});
  Moments spread(1);
  for (const double gain : one) spread.add(gain);
  EXPECT_NEAR(spread.deviation(), 0.1, 0.01);
  const int width = (whole_width - 3) / 2;
  for (int y = 0; y < (whole_height - 1) / 2; ++y) {
    for (int x = 0; x < width; ++x) {
      double sum = 0;
      for (int i = 0; i < 4; ++i) sum += one[static_cast<std::size_t>((1 + 2 * y + i / 2) * whole_width + 3 + 2 * x + i % 2)];
      EXPECT_NEAR(binned[static_cast<std::size_t>(y * width + x)], sum / 4, 1e-5) << x << ", " << y;
    }
  }
}

namespace {

/// Light that is the same for all pixels that are read together, a pixel's part of it.
PixelLight blocks(int width, int height, int n, double part) {
  PixelLight out;
  out.width = width, out.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double block = 37.0 * (y / n) + 11.0 * (x / n);
      out.power_w.push_back(static_cast<float>(part * 1e-11 * (2 + std::sin(block))));
      out.path_length_m.push_back(static_cast<float>(2.2 + std::sin(0.77 * block)));
    }
  }
  return out;
}

}  // namespace

// Where light is even over each block of pixels, the charge that neighbours share, or the light that a kernel scatters, is exactly that of all
// pixels: four taps make one.
TEST(readout, crosstalk_and_kernels_go_as_far_as_before) {
  Camera plain = whole_sensor();
  plain.sensor.width = 32, plain.sensor.height = 24;
  plain.pixel.dark_current_e_per_s = 0, plain.pixel.tap_offset_mismatch_e = 0;
  Camera sharing = plain, scattering = plain;
  sharing.pixel.crosstalk_left_right = 0.03, sharing.pixel.crosstalk_up_down = 0.05;
  scattering.lens.scatter.kind = Scatter::Kind::kernel, scattering.lens.scatter.share = 0.4;
  scattering.lens.scatter.columns = 5, scattering.lens.scatter.rows = 3;
  scattering.lens.scatter.kernel = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const SimulatorOptions options{.noise = Noise::off, .threads = 1};
  for (const Camera& camera : {sharing, scattering}) {
    const Frame all = Simulator({}, camera, options).frame(0, blocks(32, 24, 2, 0.25));
    const Frame binned = Simulator({}, read_by(camera, {2, 0, 0, 0, 0}), options).frame(0, blocks(16, 12, 1, 1));
    for (int k = 0; k < 4; ++k) {
      for (int y = 0; y < 12; ++y) {
        for (int x = 0; x < 16; ++x) {
          double a = 0;
          for (int i = 0; i < 4; ++i)
            a += static_cast<double>(all.raw.tap_a[static_cast<std::size_t>((k * 24 + 2 * y + i / 2) * 32 + 2 * x + i % 2)]);
          const double one = static_cast<double>(binned.raw.tap_a[static_cast<std::size_t>((k * 12 + y) * 16 + x)]);
          EXPECT_NEAR(one, a, 2e-6 * a + 1e-3) << x << ", " << y;
        }
      }
    }
  }
}

// What is recorded is decoded as it was.
TEST(readout, process_makes_the_same_depth_of_recorded_raw_frames) {
  Camera camera = read_by(whole_sensor(), {2, 3, 1, 40, 40});
  camera.pixel.read_noise_e = 30, camera.pixel.delay_s = 1e-10;
  const Frame frame = Simulator(steps(), camera, {.seed = 2, .threads = 1}).frame(0);
  const Depth again = process(frame.raw, camera, {.threads = 1});
  EXPECT_EQ(again.flags, frame.depth.flags);
  ASSERT_EQ(again.range_m.size(), frame.depth.range_m.size());
  for (std::size_t i = 0; i < again.range_m.size(); ++i) {
    if (std::isnan(again.range_m[i])) continue;
    EXPECT_EQ(again.range_m[i], frame.depth.range_m[i]) << i;
  }
}

// A profile cannot take the place of an image's camera; the other way round it can.
static_assert(!std::is_convertible_v<const Camera&, camera::ImageCamera>);
static_assert(std::is_convertible_v<const camera::ImageCamera&, const Camera&>);

// The camera as it is read out is a camera, of which nothing is left to be read out.
TEST(readout, is_in_the_numbers_of_the_camera_that_comes_of_it) {
  Camera camera = whole_sensor();
  camera.lens.scatter.kind = Scatter::Kind::gaussians, camera.lens.scatter.share = 0.1, camera.lens.scatter.sigma_px = {8, 0.12};
  camera.sensor.fill_factor = 0.5;
  camera.pixel.nonlinearity = {{0, 1000}, {0, 900}};
  camera.pixel.suppression_threshold_e = 500, camera.pixel.suppression_budget_e = 2000;
  const camera::ImageCamera image(read_by(camera, {2, 10, 6, 40, 20}));
  EXPECT_EQ(image.sensor.width, 20);
  EXPECT_EQ(image.sensor.height, 10);
  EXPECT_DOUBLE_EQ(image.sensor.pixel_pitch_m, 35e-6);
  EXPECT_DOUBLE_EQ(image.lens.fx_px, 30);
  // the sensor's place x is (x − 10 + ½)/2 − ½ in the image
  EXPECT_DOUBLE_EQ(image.lens.cx_px, (30.25 - 10 + 0.5) / 2 - 0.5);
  EXPECT_DOUBLE_EQ(image.lens.cy_px, (24 - 6 + 0.5) / 2 - 0.5);
  EXPECT_EQ(image.lens.scatter.sigma_px, (std::vector<double>{4, 0.1}));
  EXPECT_EQ(image.pixel.nonlinearity.x, (std::vector<double>{0, 4000}));
  EXPECT_EQ(image.pixel.suppression_threshold_e, 2000);
  EXPECT_EQ(image.pixel.suppression_budget_e, 8000);
  EXPECT_EQ(image.readout.binning, 1);
  const camera::ImageCamera again(static_cast<const Camera&>(image));
  EXPECT_EQ(again.sensor.width, 20);
  EXPECT_EQ(again.lens.cx_px, image.lens.cx_px);
}

TEST(readout, what_is_not_on_the_sensor_is_refused) {
  EXPECT_NE(complaint_of({1, 60, 0, 10, 0}).find("the region that is read leaves the sensor"), std::string::npos);
  EXPECT_NE(complaint_of({1, 0, whole_height, 0, 0}).find("the region that is read leaves the sensor"), std::string::npos);
  EXPECT_NE(complaint_of({8, 0, 40, 0, 0}).find("no binned pixel fits into what is read"), std::string::npos);
  EXPECT_EQ(complaint_of({8, 0, 37, 8, 8}), "none");
}

namespace {

constexpr const char* modes_of_a_sensor = R"(
name: two
sensor: {width: 24, height: 16, pixel_pitch: 10 um}
lens: {fx: 20 px, fy: 20 px, cx: 11.5 px, cy: 7.5 px, f_number: 1.4}
illumination: [{illumination_wavelength: 850 nm, power: 1 W, pattern: {kind: lambertian}, waveform: {kind: sine}}]
pixel: {quantum_efficiency: 0.4}
adc: {bits: 12, step: 20 e/DN}
readout: {region: {left: 4, width: 16}}
modes:
  whole:
    frame_rate: 10 Hz
    sequence: [{modulation_frequency: 60 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], integration_time: 1 ms}]
  binned:
    frame_rate: 10 Hz
    readout: {binning: 4}
    sequence: [{modulation_frequency: 60 MHz, reference_phase: [0 deg, 90 deg, 180 deg, 270 deg], integration_time: 1 ms}]
)";

}  // namespace

TEST(readout, a_mode_may_have_one_of_its_own_and_a_run_has_the_last_word) {
  const auto size = [](const CameraOptions& options) {
    const ImageSize image = image_size(load_camera_text(modes_of_a_sensor, "two.yaml", options));
    return std::vector<int>{image.width, image.height};
  };
  EXPECT_EQ(size({}), (std::vector<int>{16, 16}));
  EXPECT_EQ(size({.mode = "binned"}), (std::vector<int>{4, 4}));
  EXPECT_EQ(size({.mode = "binned", .set = {{"readout.binning", "2"}}}), (std::vector<int>{8, 8}));
  EXPECT_EQ(size({.set = {{"readout.binning", "2"}}}), (std::vector<int>{8, 8}));
}

TEST(readout, all_instruction_sets_and_threads_agree) {
  Camera camera = read_by(whole_sensor(), {2, 3, 1, 0, 0});
  camera.pixel.read_noise_e = 30, camera.pixel.prnu = 0.02;
  const Frame one = Simulator(steps(), camera, {.seed = 2, .threads = 1, .isa = Isa::scalar}).frame(3);
  EXPECT_EQ(first_difference(one, Simulator(steps(), camera, {.seed = 2, .threads = 3}).frame(3)), "");
}
