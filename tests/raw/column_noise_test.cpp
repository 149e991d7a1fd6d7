// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Column noise: A−B of all pixels of a column is shifted alike in one raw frame.                                    [theory: column-noise]
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int width = 61, height = 40;  // no whole number of packs or tiles
constexpr double sigma = 30, step = 0.5;

/// A sensor in the dark: nothing but the noise that is asked for and rounding, one 16-bit code for half an electron.
Camera dark_camera(double column_noise_e, double read_noise_e = 0) {
  Camera camera = lit_camera(width, height);
  camera.illumination[0].power_w = 0;
  camera.pixel.column_noise_e = column_noise_e, camera.pixel.read_noise_e = read_noise_e;
  camera.adc.bits = 16, camera.adc.step_e_per_dn = step, camera.adc.mid_code = 32768, camera.adc.valid_max = 65535;
  return camera;
}

Raw raw_of(const Camera& camera, std::uint64_t frame, Noise noise = Noise::exact, Isa isa = Isa::best) {
  return Simulator(wall(1), camera, {.seed = 5, .noise = noise, .threads = 1, .isa = isa}).frame(frame).raw;
}

/// [phase][column] mean of A−B over a column [e].
std::vector<double> column_means(const Raw& raw) {
  std::vector<double> means(static_cast<std::size_t>(raw.phases * width));
  for (std::size_t i = 0; i < raw.raw.size(); ++i) {
    const std::size_t image = i / (width * height), column = i % width;
    means[image * width + column] += (raw.raw[i] - 32768.0) * step / height;
  }
  return means;
}

double variance(const std::vector<double>& values) {  // of a mean that is known to be 0
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum / static_cast<double>(values.size());
}

/// Means of many frames, one after the other.
std::vector<double> many_means(const Camera& camera, int frames, Noise noise) {
  std::vector<double> all;
  for (int i = 0; i < frames; ++i) {
    const std::vector<double> one = column_means(raw_of(camera, static_cast<std::uint64_t>(i), noise));
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

}  // namespace

TEST(column_noise, is_the_same_for_all_pixels_of_a_column) {
  const Raw raw = raw_of(dark_camera(sigma), 0);
  int unlike = 0;
  for (std::size_t i = 0; i < raw.raw.size(); ++i) {
    const std::size_t image = i / (width * height), column = i % width;
    ASSERT_EQ(raw.raw[i], raw.raw[image * width * height + column]) << "phase " << image << " column " << column;
    unlike += raw.raw[i] != raw.raw[image * width * height] ? 1 : 0;
  }
  EXPECT_GT(unlike, 0);
}

// Var = σ_c² + (2σ_r² + s²/12)/H. A variance of n normal numbers scatters by √(2/n) of itself: 5 of them, a false alarm in 1.7 million.
TEST(column_noise, has_the_variance_of_its_closed_form) {
  for (const double read : {3.0, 20.0}) {
    const std::vector<double> means = many_means(dark_camera(sigma, read), 40, Noise::exact);
    const double expected = sigma * sigma + (2 * read * read + step * step / 12) / height;
    EXPECT_NEAR(variance(means), expected, 5 * std::sqrt(2.0 / static_cast<double>(means.size())) * expected);
  }
}

// A correlation of n independent pairs scatters by 1/√n.
TEST(column_noise, is_drawn_anew_in_each_column_raw_frame_and_frame) {
  const std::vector<double> means = many_means(dark_camera(sigma), 40, Noise::exact);
  const std::size_t raw_frames = means.size() / 40 / width;
  for (const std::size_t apart : {std::size_t{1}, std::size_t{width}, raw_frames * width}) {
    double sum = 0;
    const std::size_t pairs = means.size() - apart;
    for (std::size_t i = 0; i < pairs; ++i) sum += means[i] * means[i + apart];
    EXPECT_LT(std::abs(sum / static_cast<double>(pairs)) / variance(means), 5 / std::sqrt(static_cast<double>(pairs))) << apart;
  }
}

TEST(column_noise, is_off_unless_given_and_where_noise_is_off) {
  EXPECT_EQ(Pixel().column_noise_e, 0);
  for (const double code : column_means(raw_of(dark_camera(sigma), 0, Noise::off))) EXPECT_EQ(code, 0);
  for (const double code : column_means(raw_of(dark_camera(0), 0))) EXPECT_EQ(code, 0);
}

TEST(column_noise, is_the_same_with_every_instruction_set) {
  const Camera camera = dark_camera(sigma, 20);
  const Raw scalar = raw_of(camera, 3, Noise::exact, Isa::scalar);
  for (const Isa isa : backend::machine_isas) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(raw_of(camera, 3, Noise::exact, isa).raw, scalar.raw);
  }
}

// V of [theory: phase-noise] grows by σ_c², and σ_d² with it: with 2σ_c the growth is four times that with σ_c. Single precision leaves
// 1e-5 of it.
TEST(column_noise, is_in_the_noise_that_depth_says_of_itself) {
  const auto noise_square = [](double column_noise_e) {
    Camera camera = lit_camera(1, 1);
    camera.pixel.column_noise_e = column_noise_e, camera.adc.step_e_per_dn = 20;
    const double noise = static_cast<double>(expected_frame(wall(1), camera).depth.noise_m[0]);
    return noise * noise;
  };
  const double without = noise_square(0), once = noise_square(200) - without, twice = noise_square(400) - without;
  EXPECT_GT(once, 1e-3 * without);
  EXPECT_NEAR(twice / once, 4, 0.02);
}
