// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light that the lens scatters: one bright pixel shows the kernel, an even image stays as it is, and depth mixes as phasors do.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "backend/cpu/cpu.h"
#include "support/cuda_cases.h"
#include "support/own_arrays.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int width = 61, height = 47;

/// One pixel of 1 pW and a path of 2 m among dark ones.
PixelLight bright_pixel(int x, int y) {
  PixelLight out;
  out.width = width, out.height = height;
  out.power_w.assign(width * height, 0.0f), out.path_length_m.assign(width * height, 0.0f);
  out.power_w[static_cast<std::size_t>(y * width + x)] = 1e-12f, out.path_length_m[static_cast<std::size_t>(y * width + x)] = 2;
  return out;
}

Camera scattering(const Scatter& scatter) {
  Camera camera = lit_camera(width, height, 60);
  camera.lens.scatter = scatter;
  return camera;
}

/// Signal of the first raw frame, against that of the bright pixel where nothing is scattered.
std::vector<double> spread(const Camera& camera, int x, int y) {
  Camera sharp = camera;
  sharp.lens.scatter = {};
  const SimulatorOptions options{.noise = Noise::off, .threads = 1};
  const Frame frame = Simulator({}, camera, options).frame(0, bright_pixel(x, y));
  const Frame whole = Simulator({}, sharp, options).frame(0, bright_pixel(x, y));
  const double all = static_cast<double>(whole.truth.signal_e[static_cast<std::size_t>(y * width + x)]);
  EXPECT_GT(all, 0);
  std::vector<double> out;
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) out.push_back(static_cast<double>(frame.truth.signal_e[i]) / all);
  return out;
}

double gaussian_share(double sigma, int d) {
  return 0.5 * (std::erf((d + 0.5) / (sigma * std::sqrt(2.0))) - std::erf((d - 0.5) / (sigma * std::sqrt(2.0))));
}

}  // namespace

TEST(scatter, one_bright_pixel_shows_the_gaussians) {
  for (const std::array at : {std::array{30, 20}, {0, 46}, {60, 3}}) {
    const int x0 = at[0], y0 = at[1];
    const std::vector<double> seen = spread(scattering({Scatter::Kind::gaussians, 0.3, {0.7, 9}, {3, 1}}), x0, y0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto share = [&](double sigma) { return gaussian_share(sigma, x - x0) * gaussian_share(sigma, y - y0); };
        const double expected = (x == x0 && y == y0 ? 0.7 : 0) + 0.3 * (0.75 * share(0.7) + 0.25 * share(9));
        ASSERT_NEAR(seen[static_cast<std::size_t>(y * width + x)], expected, 1e-6 * expected + 1e-9) << x << ", " << y;
      }
    }
  }
}

TEST(scatter, one_bright_pixel_shows_the_kernel) {
  Scatter scatter{Scatter::Kind::kernel, 0.25};
  scatter.rows = 3, scatter.columns = 5;
  scatter.kernel = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  for (const auto& [x0, y0] : {std::pair{30, 20}, std::pair{0, 0}, std::pair{60, 46}, std::pair{33, 46}}) {
    const std::vector<double> seen = spread(scattering(scatter), x0, y0);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int row = y - y0 + 1, column = x - x0 + 2;
        double expected = x == x0 && y == y0 ? 0.75 : 0;
        if (row >= 0 && row < 3 && column >= 0 && column < 5) expected += 0.25 * (1 + 5 * row + column) / 120.0;
        ASSERT_NEAR(seen[static_cast<std::size_t>(y * width + x)], expected, 1e-6 * expected) << x << ", " << y;
      }
    }
  }
}

// Through the light image and straight on: delays, drift, suppression, fixed patterns and exposures are applied once either way.
TEST(scatter, of_nothing_has_the_bytes_of_a_lens_that_scatters_nothing) {
  Scatter point{Scatter::Kind::kernel, 1};
  point.kernel = {4}, point.rows = point.columns = 1;
  for (const char* name : {"demo", "flying-ball", "sun-outdoors"}) {
    const Scene scene = load_scene(name);
    for (Camera camera : {small(load_camera(scene)), with_everything(load_camera(scene))}) {
      // The mean of an exposure is taken before a pixel's delay turns it, or after: bytes may differ there.
      const SimulatorOptions options{.exposure_samples = camera.pixel.delay_s == 0 ? 3 : 1};
      const Frame straight = Simulator(scene, camera, options).frame(1);
      camera.lens.scatter = point;
      EXPECT_EQ(first_difference(Simulator(scene, camera, options).frame(1), straight), "") << name;
    }
  }
}

// All of a Gaussian far wider than the sensor: nearly all is lost.
TEST(scatter, the_ends_of_what_a_lens_can_do) {
  const Scene scene = load_scene("demo");
  const Camera camera = small(load_camera(scene));
  Camera none = camera;
  none.lens.scatter = {Scatter::Kind::gaussians, 0, {5}};
  EXPECT_EQ(first_difference(Simulator(scene, none).frame(1), Simulator(scene, camera).frame(1)), "");
  const std::vector<double> wide = spread(scattering({Scatter::Kind::gaussians, 1, {1e4}}), 30, 20);
  const std::vector<double> narrow = spread(scattering({Scatter::Kind::gaussians, 1, {0.1}}), 30, 20);
  double sum = 0;
  for (const double one : wide) sum += one;
  EXPECT_NEAR(sum, width * height / (2 * pi * 1e8), 1e-4 * sum);
  EXPECT_NEAR(narrow[20 * width + 30], 1, 1e-5);
  for (const Scatter& odd :
       {Scatter{Scatter::Kind::gaussians, 0.1, {}}, Scatter{Scatter::Kind::gaussians, 0.1, {1, 2}, {1}},
        Scatter{Scatter::Kind::gaussians, 0.1, {1}, {0}}, Scatter{Scatter::Kind::gaussians, 1.1, {1}},
        Scatter{Scatter::Kind::kernel, 0.1, {}, {}, {1, 1}, 2, 1}, Scatter{Scatter::Kind::kernel, 0.1, {}, {}, {0}, 1, 1},
        Scatter{Scatter::Kind::kernel, 0.1, {}, {}, {1}, 3, 1}}) {
    Camera wrong = camera;
    wrong.lens.scatter = odd;
    EXPECT_THROW(Simulator(scene, wrong), Error);
  }
}

// Away from the edges an even image stays itself, in all that it is.
TEST(scatter, an_even_image_stays_itself) {
  Camera camera = scattering({Scatter::Kind::gaussians, 0.4, {0.5, 3}, {1, 1}});
  Camera sharp = camera;
  sharp.lens.scatter = {};
  PixelLight light;
  light.width = width, light.height = height;
  light.power_w.assign(width * height, 1e-12f), light.path_length_m.assign(width * height, 2.4f);
  light.ambient_e_per_s.assign(width * height, 1e6f);
  const SimulatorOptions options{.noise = Noise::off};
  const Frame a = Simulator({}, camera, options).frame(0, light), b = Simulator({}, sharp, options).frame(0, light);
  for (int y = 18; y < height - 18; ++y) {
    for (int x = 18; x < width - 18; ++x) {
      const auto at = static_cast<std::size_t>(y * width + x);
      ASSERT_NEAR(static_cast<double>(a.depth.range_m[at]), static_cast<double>(b.depth.range_m[at]), 1e-6);
      ASSERT_NEAR(static_cast<double>(a.depth.amplitude_e[at] / b.depth.amplitude_e[at]), 1, 1e-6);
      ASSERT_NEAR(static_cast<double>(a.raw.tap_a[at] / b.raw.tap_a[at]), 1, 1e-6);
    }
  }
  EXPECT_LT(static_cast<double>(a.raw.tap_a[0]), 0.9 * static_cast<double>(b.raw.tap_a[0])) << "nothing comes in over the edges";
}

// A dark pixel beside a bright one, 1.6 and 1.0 m away: depth is that of the sum of phasors.
TEST(scatter, mixes_depth_as_phasors) {
  Camera camera = scattering({Scatter::Kind::gaussians, 0.2, {2}});
  PixelLight light = bright_pixel(30, 20);
  const std::size_t dark = 20 * width + 32;
  light.power_w[dark] = 2e-14f, light.path_length_m[dark] = 3.2f;
  const Frame frame = Simulator({}, camera, {.noise = Noise::off}).frame(0, light);
  const double share = 0.2 * gaussian_share(2, 2) * gaussian_share(2, 0), own = 0.8 + 0.2 * gaussian_share(2, 0) * gaussian_share(2, 0);
  const double k = two_pi * 60e6 / 299792458.0;
  const double x = share * 1e-12 * std::cos(2 * k) + own * 2e-14 * std::cos(3.2 * k);
  const double y = share * 1e-12 * std::sin(2 * k) + own * 2e-14 * std::sin(3.2 * k);
  const double turns = std::atan2(y, x) / two_pi;
  EXPECT_NEAR(range_of_taps(frame.raw, dark), (turns - std::floor(turns)) * pi / k, 2e-6);
}

// Light from elsewhere goes through the same image as the scene's: neither is taken for the other.
TEST(scatter, of_light_from_elsewhere_is_not_kept) {
  Camera camera = scattering({Scatter::Kind::gaussians, 0.2, {2}});
  Simulator simulator(wall(1.5), camera, {.threads = 1});
  const Frame scene = simulator.frame(3), light = simulator.frame(3, bright_pixel(30, 20));
  EXPECT_EQ(first_difference(simulator.frame(3), scene), "");
  EXPECT_EQ(first_difference(simulator.frame(3, bright_pixel(30, 20)), light), "");
  EXPECT_NE(first_difference(simulator.frame(3, bright_pixel(3, 2)), light), "");
}

TEST(scatter, gives_the_same_bytes_on_every_machine) {
  const Scene scene = load_scene("flying-ball");
  Camera camera = small(load_camera(scene));
  Scatter kernel{Scatter::Kind::kernel, 0.5};
  kernel.rows = 7, kernel.columns = 3;
  for (int i = 0; i < 21; ++i) kernel.kernel.push_back(i % 5);
  for (const Scatter& scatter : {Scatter{Scatter::Kind::gaussians, 0.1, {1, 20}}, kernel}) {
    camera.lens.scatter = scatter;
    const Frame reference = Simulator(scene, camera, {.threads = 1, .isa = Isa::scalar}).frame(2);
    EXPECT_NE(first_difference(reference, Simulator(scene, small(load_camera(scene))).frame(2)), "");
    for (const Isa isa : backend::machine_isas) {
      if (!backend::can_run(isa)) continue;  // named by skipped_on_this_machine
      EXPECT_EQ(first_difference(Simulator(scene, camera, {.threads = 3, .isa = isa}).frame(2), reference), "") << backend::isa_name(isa);
    }
  }
}
