// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Charge that a pixel's neighbours collect.                                                       [theory: crosstalk, crosstalk-mtf]
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/own_arrays.h"
#include "support/pixels.h"
#include "support/same_frame.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int shared_width = 61, shared_height = 47;  // no whole number of packs or tiles
constexpr std::size_t shared_pixels = std::size_t{shared_width} * shared_height;

Camera sharing(double left_right, double up_down) {
  Camera camera = lit_camera(shared_width, shared_height, 60);
  camera.pixel.crosstalk_left_right = left_right, camera.pixel.crosstalk_up_down = up_down;
  camera.adc = {16, 10, 32768, 0, 65535};
  return camera;
}

/// Any power and path length in each pixel, and any ambient light.
PixelLight uneven_light() {
  PixelLight out;
  out.width = shared_width, out.height = shared_height;
  for (std::size_t i = 0; i < shared_pixels; ++i) {
    const double x = static_cast<double>(i);
    out.power_w.push_back(static_cast<float>(1e-12 * (2.1 + std::sin(1.7 * x) + std::cos(0.31 * x))));
    out.path_length_m.push_back(static_cast<float>(2.2 + std::sin(0.77 * x)));
    out.ambient_e_per_s.push_back(static_cast<float>(1e5 * (1.1 + std::cos(2.3 * x))));
  }
  return out;
}

std::size_t place(int x, int y) { return static_cast<std::size_t>(y * shared_width + x); }

/// [theory: crosstalk] of a pixel, of an image of which nothing is known beyond its edges.
double shared_at(const float* image, int x, int y, double left_right, double up_down) {
  double sum = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      if (x + i < 0 || x + i >= shared_width || y + j < 0 || y + j >= shared_height) continue;
      const double along = i == 0 ? 1 - 2 * left_right : left_right, across = j == 0 ? 1 - 2 * up_down : up_down;
      sum += along * across * static_cast<double>(image[place(x + i, y + j)]);
    }
  }
  return sum;
}

/// Both taps of all raw frames against [theory: crosstalk] of those of another frame, `rim` pixels off the edges.
void expect_shared(const Frame& seen, const Frame& whole, double left_right, double up_down, int rim) {
  for (std::size_t k = 0; k < 4; ++k) {
    for (int y = rim; y < shared_height - rim; ++y) {
      for (int x = rim; x < shared_width - rim; ++x) {
        const std::size_t first = k * shared_pixels, at = first + place(x, y);
        const double a = shared_at(whole.raw.tap_a.data() + first, x, y, left_right, up_down),
                     b = shared_at(whole.raw.tap_b.data() + first, x, y, left_right, up_down);
        ASSERT_NEAR(static_cast<double>(seen.raw.tap_a[at]), a, 2e-6 * (a + b)) << x << ", " << y;
        ASSERT_NEAR(static_cast<double>(seen.raw.tap_b[at]), b, 2e-6 * (a + b)) << x << ", " << y;
      }
    }
  }
}

}  // namespace

TEST(crosstalk, mixes_each_tap_with_those_of_the_neighbours) {
  const Frame whole = frame_of_light(sharing(0, 0), uneven_light());
  for (const auto& [left_right, up_down] : {std::pair{0.03, 0.1}, std::pair{0.02, 0.0}, std::pair{0.0, 0.05}, std::pair{0.25, 0.25}})
    expect_shared(frame_of_light(sharing(left_right, up_down), uneven_light()), whole, left_right, up_down, 0);
}

// What the lens scatters comes first, and what of it falls beside the sensor is gone: no pixel there shares it.
TEST(crosstalk, acts_on_what_the_lens_scatters) {
  Scatter kernel{Scatter::Kind::kernel, 0.25};
  kernel.rows = 3, kernel.columns = 5, kernel.kernel = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  for (const Scatter& scatter : {Scatter{Scatter::Kind::gaussians, 0.3, {0.7, 9}, {3, 1}}, kernel}) {
    Camera scattering = sharing(0, 0), both = sharing(0.04, 0.02);
    scattering.lens.scatter = both.lens.scatter = scatter;
    expect_shared(frame_of_light(both, uneven_light()), frame_of_light(scattering, uneven_light()), 0.04, 0.02, 0);
  }
}

// Half of 20 % of even light goes up, half down: the top row has 0.9 of it, the next one all; then 0.78·0.9 + 0.11·1.
TEST(crosstalk, of_an_edge_is_of_what_the_lens_has_left_there) {
  Scatter kernel{Scatter::Kind::kernel, 0.2};
  kernel.rows = 3, kernel.columns = 1, kernel.kernel = {1, 0, 1};
  PixelLight light = uneven_light();
  light.power_w.assign(shared_pixels, 1e-12f), light.path_length_m.assign(shared_pixels, 2.0f), light.ambient_e_per_s.clear();
  Camera both = sharing(0, 0.11);
  both.lens.scatter = kernel;
  const Frame frame = frame_of_light(both, light), plain = frame_of_light(sharing(0, 0), light);
  EXPECT_NEAR(static_cast<double>(frame.truth.signal_e[place(20, 0)]) / static_cast<double>(plain.truth.signal_e[place(20, 0)]), 0.812,
              1e-6);
}

// Stripes of p pixels: the sine's mean stays, its swing is that of [theory: crosstalk-mtf]. Rows of the middle, columns off the edges.
TEST(crosstalk, leaves_of_stripes_what_the_closed_form_says) {
  for (const int period : {2, 3, 8}) {
    for (const double share : {0.01, 0.1, 0.25}) {
      PixelLight light = uneven_light();
      for (std::size_t i = 0; i < shared_pixels; ++i) {
        const int x = static_cast<int>(i) % shared_width;
        light.power_w[i] = static_cast<float>(1e-12 * (1 + 0.8 * std::cos(two_pi * x / period)));
        light.path_length_m[i] = 2, light.ambient_e_per_s[i] = 0;
      }
      const Frame flat = frame_of_light(sharing(0, 0), light), frame = frame_of_light(sharing(share, 0), light);
      const double mtf = 1 - 4 * share * std::pow(std::sin(pi / period), 2);
      const auto row = static_cast<std::size_t>(shared_height / 2 * shared_width);
      const double peak = static_cast<double>(flat.truth.signal_e[row]) / 1.8;
      for (std::size_t x = 1; x < shared_width - 1; ++x) {
        const double expected = peak * (1 + 0.8 * mtf * std::cos(two_pi * static_cast<double>(x) / period));
        EXPECT_NEAR(static_cast<double>(frame.truth.signal_e[row + x]), expected, 2e-6 * peak) << period << " " << share << " " << x;
      }
    }
  }
}

// Electrons go one by one: the mean is blurred, counts stay Poisson's and those of neighbours know nothing of each other. Charge mixed after it
// was collected would correlate by 2e(1 − 2e)/((1 − 2e)² + 2e²) = 0.87 along rows at e = 0.2. 4 · 2867 draws: 5/√n, and 5·√(2/n) of a variance.
TEST(crosstalk, leaves_the_noise_of_each_pixel_its_own) {
  PixelLight light = uneven_light();
  light.power_w.assign(shared_pixels, 1e-12f), light.path_length_m.assign(shared_pixels, 2.0f), light.ambient_e_per_s.clear();
  const Camera camera = sharing(0.2, 0.2);
  const Frame noisy = frame_of_light(camera, light, Noise::exact), mean = frame_of_light(camera, light);
  Moments spread;
  Correlation along(0, 0), across(0, 0), corner(0, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto off = [&](int x, int y) {
      const std::size_t at = k * shared_pixels + place(x, y);
      const double expected = static_cast<double>(mean.raw.tap_a[at]);
      return (static_cast<double>(noisy.raw.tap_a[at]) - expected) / std::sqrt(expected);
    };
    for (int y = 0; y + 1 < shared_height; ++y) {
      for (int x = 0; x + 1 < shared_width; ++x) {
        spread.add(off(x, y));
        along.add(off(x, y), off(x + 1, y)), across.add(off(x, y), off(x, y + 1)), corner.add(off(x, y), off(x + 1, y + 1));
      }
    }
  }
  EXPECT_NEAR(spread.variance(), 1, 5 * std::sqrt(2 / spread.count()));
  EXPECT_LT(std::abs(along.z()), 5);
  EXPECT_LT(std::abs(across.z()), 5);
  EXPECT_LT(std::abs(corner.z()), 5);
}

// Each neighbour's light is sorted by the gates that collect it: the pixel's own delay counts, which the decoder takes out.
TEST(crosstalk, of_an_even_wall_is_no_error_whatever_the_delays) {
  Camera camera = sharing(0.1, 0.1);
  camera.pixel.delay_s = 50e-12;
  PixelLight light = uneven_light();
  light.power_w.assign(shared_pixels, 1e-12f), light.path_length_m.assign(shared_pixels, 2.4f);
  const Frame frame = frame_of_light(camera, light);
  for (int y = 1; y < shared_height - 1; ++y)
    for (int x = 1; x < shared_width - 1; ++x) ASSERT_NEAR(static_cast<double>(frame.depth.range_m[place(x, y)]), 1.2, 3e-6);
}

TEST(crosstalk, is_off_unless_given_and_the_same_with_every_instruction_set) {
  EXPECT_EQ(Pixel().crosstalk_left_right, 0);
  EXPECT_EQ(Pixel().crosstalk_up_down, 0);
  Camera camera = sharing(0.02, 0.01);
  camera.interference = {0.1, 30, 1, {}};
  const Frame scalar = frame_of_light(camera, uneven_light(), Noise::exact, Isa::scalar);
  for (const Isa isa : {Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(first_difference(frame_of_light(camera, uneven_light(), Noise::exact, isa), scalar), "");
  }
  for (const double beyond : {-0.01, 0.26}) EXPECT_THROW(Simulator({}, sharing(beyond, 0)), Error);
}
