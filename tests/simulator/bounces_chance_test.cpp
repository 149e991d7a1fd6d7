// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Chance in light that goes from surface to surface: how fast its error falls, that it is right on the mean, and where ways must not go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/bounces.h"
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/random_scene.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// P(|t| > |value|) of Student's distribution, by Simpson's rule over its density.
double two_sided(double value, double freedom) {
  const double scale = std::exp(std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2)) / std::sqrt(freedom * pi);
  const auto density = [&](double t) { return scale * std::pow(1 + t * t / freedom, -(freedom + 1) / 2); };
  constexpr int steps = 400;
  const double width = std::abs(value) / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += width / 6 * (density(i * width) + 4 * density((i + 0.5) * width) + density((i + 1) * width));
  return std::fmax(1 - 2 * sum, 0);
}

/// Sum and sum of squares of the same block over many seeds.
struct Block {
  double sum = 0, square = 0;
  void add(double value) { sum += value, square += value * value; }
  [[nodiscard]] double mean(int n) const { return sum / n; }
  /// Of the mean.
  [[nodiscard]] double variance(int n) const { return std::fmax(square / n - mean(n) * mean(n), 0) / (n - 1); }
};

constexpr int block_side = 8;

/// Indirect light of each block of 8 × 8 pixels, over seeds of their own.
std::vector<Block> blocks_of(const Scene& scene, const Camera& camera, int samples, unsigned long long first_seed, int seeds) {
  const int across = camera.sensor.width / block_side, down = camera.sensor.height / block_side;
  std::vector<Block> out(static_cast<std::size_t>(across * down));
  for (int n = 0; n < seeds; ++n) {
    const Frame frame = frame_with_bounces(scene, camera, 3, samples, first_seed + static_cast<unsigned long long>(n));
    std::vector<double> sums(out.size());
    for (int y = 0; y < down * block_side; ++y)
      for (int x = 0; x < across * block_side; ++x)
        sums[static_cast<std::size_t>(y / block_side * across + x / block_side)] +=
            static_cast<double>(frame.truth.indirect_e[static_cast<std::size_t>(y * camera.sensor.width + x)]);
    for (std::size_t i = 0; i < out.size(); ++i) out[i].add(sums[i]);
  }
  return out;
}

}  // namespace

// P17: in the corner the error falls at least as N^−0.7 from 64 ways on (32 in either half), and is never above that of ways drawn one by one.
TEST(bounces, come_closer_the_more_ways_are_followed) {
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  Camera camera = lit_camera(24, 20, 20);
  constexpr int most = with_sanitizers ? 1024 : 16384;
  const Frame known = frame_with_bounces(scene, camera, 1, most, 99);
  const auto error = [&](int samples) {
    double sum = 0;
    for (unsigned long long seed = 0; seed < 8; ++seed) {
      const Frame frame = frame_with_bounces(scene, camera, 1, samples, seed);
      for (std::size_t i = 0; i < frame.truth.range_m.size(); ++i) {
        const double off = static_cast<double>(frame.truth.indirect_e[i]) / static_cast<double>(known.truth.indirect_e[i]) - 1;
        sum += off * off;
      }
    }
    return std::sqrt(sum);
  };
  const double two = error(2);
  double before = two;
  for (int n = 4; n <= (with_sanitizers ? 64 : 1024); n *= 4) {
    const double now = error(n);
    EXPECT_LT(now, two / std::sqrt(n / 2.0)) << n;
    EXPECT_LT(std::log(now / before) / std::log(4), n == 4                       ? -0.25
                                                    : n == 16                    ? -0.55
                                                    : n == 64 || with_sanitizers ? -0.6
                                                                                 : -0.7)
        << n << ": " << now / two;
    before = now;
  }
}

// Samples within a pixel each have ways of their own, and all of their light arrives.
TEST(bounces, of_samples_within_pixels_add_up) {
  const Camera camera = lit_camera(24, 20, 20);
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  scene.transport.bounces = 2, scene.transport.samples = 256;
  const auto sum = [&](int subpixel) {
    const Frame frame = Simulator(scene, camera, {.noise = Noise::off, .subpixel = subpixel}).frame(0);
    return sum_over(frame.truth.indirect_e, 0, 480) / sum_over(frame.truth.direct_e, 0, 480);
  };
  const double one = sum(1);
  for (const int n : {2, 3}) EXPECT_NEAR(sum(n) / one, 1, 0.01) << n;
}

// Errors of neighbours have nothing to do with each other, nor with those of another pixel in the same row or column.
TEST(bounces, are_chosen_anew_for_each_pixel) {
  constexpr int width = 32, height = 32, seeds = with_sanitizers ? 10 : 40;
  Camera camera = lit_camera(width, height, 2e4);  // all of them see the same
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.2, 0, 0}, {-1, 0, 0}}));
  double square = 0, of_next = 0, of_below = 0, of_seed = 0;
  std::vector<double> before;
  for (unsigned long long seed = 1; seed <= seeds; ++seed) {
    const Frame frame = frame_with_bounces(scene, camera, 2, 4, seed);
    std::vector<double> error;
    const double mean = sum_over(frame.truth.indirect_e, 0, width * height) / (width * height);
    for (std::size_t i = 0; i < width * height; ++i) error.push_back(static_cast<double>(frame.truth.indirect_e[i]) - mean);
    for (std::size_t i = 0; i < error.size(); ++i) {
      square += error[i] * error[i];
      of_next += error[i] * error[(i + 1) % error.size()], of_below += error[i] * error[(i + width) % error.size()];
      if (!before.empty()) of_seed += error[i] * before[i];
    }
    before = error;
  }
  for (const double product : {of_next, of_below, of_seed}) EXPECT_LT(std::abs(product), square * 5 / std::sqrt(width * height * seeds));
}

// P18: few ways and many mean the same light. Welch's t for each block of 8 × 8 pixels; its p values are even between 0 and 1 (Kolmogorov and
// Smirnov, false alarm 1e-6), and the t of all blocks together have no side (5 sigma).
TEST(bounces, of_few_ways_are_right_on_the_mean) {
  constexpr int seeds = with_sanitizers ? 8 : 40;
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  scene.objects.push_back(object(Sphere{{-0.1, 0.1, 0.8}, 0.1}));
  const Camera camera = lit_camera(80, 64, 70);
  const std::vector<Block> many = blocks_of(scene, camera, with_sanitizers ? 16 : 64, 1000, seeds);
  for (const int samples : {2, 4, 8}) {
    const std::vector<Block> few = blocks_of(scene, camera, samples, static_cast<unsigned long long>(samples) * 100, seeds);
    std::vector<double> p;
    double sum = 0;
    for (std::size_t i = 0; i < few.size(); ++i) {
      const double a = few[i].variance(seeds), b = many[i].variance(seeds);
      const double t = (few[i].mean(seeds) - many[i].mean(seeds)) / std::sqrt(a + b);
      p.push_back(two_sided(t, (a + b) * (a + b) * (seeds - 1) / (a * a + b * b)));
      sum += t;
    }
    const auto n = static_cast<double>(p.size());
    std::sort(p.begin(), p.end());
    double farthest = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
      farthest = std::max({farthest, static_cast<double>(i + 1) / n - p[i], p[i] - static_cast<double>(i) / n});
    // 2·exp(−2 n D²) = 1e-6
    EXPECT_LT(farthest, std::sqrt(std::log(2e6) / (2 * n))) << samples;
    // Student's t is wider than a normal: by √(ν/(ν − 2)), ν at least seeds − 1
    EXPECT_LT(std::abs(sum), 5 * std::sqrt(n * (seeds - 1.0) / (seeds - 3.0))) << samples;
  }
}

// Smooth normals that lean over: a way below the surface itself leads nowhere. Of a matt surface whose normal leans by β, a share of
// (1 + cos β)/2 of its ways stays above it, and so much of an even sky reaches it.
TEST(bounces, of_leaning_normals_do_not_go_through_their_own_surface) {
  constexpr int n = with_sanitizers ? 8 : 32, ways = with_sanitizers ? 64 : 512;
  const Camera camera = lit_camera(n, n, 2000);
  const auto sky_on = [&](double lean) {
    TriangleMesh flat;
    flat.vertices = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    flat.triangles = {{0, 1, 2}, {0, 2, 3}};
    flat.normals.assign(4, {static_cast<float>(std::sin(lean)), 0, static_cast<float>(-std::cos(lean))});
    Scene scene;
    scene.materials.push_back({"white", Material::Brdf::lambert, 0.8, 0, 1});
    scene.objects.push_back(object(shared(flat)));
    scene.ambient.spectrum = Ambient::Spectrum::equal_energy, scene.ambient.quantity = Ambient::Quantity::band_irradiance_w_per_m2;
    scene.ambient.amount = 1;
    const Frame frame = frame_with_bounces(scene, camera, 2, ways);
    return sum_over(frame.truth.ambient_e_per_s, 0, frame.truth.ambient_e_per_s.size());
  };
  const double upright = sky_on(0);
  // Each way is a yes or no: √(p(1 − p)/N) of them all together, and less for points that are even; five of these.
  const double error = 5 * 0.5 / std::sqrt(static_cast<double>(n) * n * ways);
  for (const double lean : {0.2, 0.6, 1.2}) EXPECT_NEAR(sky_on(lean) / upright, (1 + std::cos(lean)) / 2, error) << lean;
}
