// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Row noise: A−B of all pixels of a row is shifted alike in one raw frame.                                          [theory: column-noise]
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "backend/cpu/cpu.h"
#include "support/bench.h"
#include "support/pixels.h"
#include "support/statistics.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int row_width = 61, row_height = 40;  // no whole number of packs or tiles
constexpr double row_sigma = 30, row_step = 0.5;

/// A sensor in the dark: nothing but the noise that is asked for and rounding, one 16-bit code for half an electron.
Camera dark_rows(double row_noise_e, double column_noise_e = 0) {
  Camera camera = lit_camera(row_width, row_height);
  camera.illumination[0].power_w = 0;
  camera.pixel.row_noise_e = row_noise_e, camera.pixel.column_noise_e = column_noise_e;
  camera.adc = {16, row_step, 32768, 0, 65535};
  return camera;
}

Raw raw_rows(const Camera& camera, std::uint64_t frame, Noise noise = Noise::exact, Isa isa = Isa::best) {
  return Simulator(wall(1), camera, {.seed = 5, .noise = noise, .threads = 1, .isa = isa}).frame(frame).raw;
}

double row_electrons(const Raw& raw, std::size_t image, std::size_t row, std::size_t column) {
  return (raw.raw[(image * row_height + row) * row_width + column] - 32768.0) * row_step;
}

}  // namespace

TEST(row_noise, is_the_same_for_all_pixels_of_a_row) {
  const Raw raw = raw_rows(dark_rows(row_sigma), 0);
  int unlike = 0;
  for (std::size_t i = 0; i < raw.raw.size(); ++i) {
    ASSERT_EQ(raw.raw[i], raw.raw[i / row_width * row_width]) << i;
    unlike += raw.raw[i] != raw.raw[i / (row_width * row_height) * row_width * row_height] ? 1 : 0;
  }
  EXPECT_GT(unlike, 0);
}

// 40 frames of 4 · 40 rows. A variance of n normal numbers scatters by √(2/n) of itself, a correlation by 1/√n: 5 of them, a false alarm in
// 1.7 million.
TEST(row_noise, has_its_variance_and_is_drawn_anew_in_each_row_raw_frame_and_frame) {
  std::vector<double> drawn;
  for (std::uint64_t n = 0; n < 40; ++n) {
    const Raw raw = raw_rows(dark_rows(row_sigma), n);
    for (std::size_t i = 0; i < raw.raw.size(); i += row_width) drawn.push_back((raw.raw[i] - 32768.0) * row_step);
  }
  Moments one;
  for (const double value : drawn) one.add(value);
  const double expected = row_sigma * row_sigma + row_step * row_step / 12;
  EXPECT_NEAR(one.variance(), expected, 5 * std::sqrt(2.0 / static_cast<double>(drawn.size())) * expected);
  for (const std::size_t apart : {std::size_t{1}, std::size_t{row_height}, drawn.size() / 40}) {
    Correlation both(0, 0);
    for (std::size_t i = 0; i + apart < drawn.size(); ++i) both.add(drawn[i], drawn[i + apart]);
    EXPECT_LT(std::abs(both.z()), 5) << apart;
  }
}

// Both: each pixel is its column's plus its row's, which have nothing to do with each other. Rounding is off by up to a row_step.
TEST(row_noise, adds_to_column_noise) {
  const Raw raw = raw_rows(dark_rows(row_sigma, 2 * row_sigma), 3), columns = raw_rows(dark_rows(0, 2 * row_sigma), 3),
            rows = raw_rows(dark_rows(row_sigma), 3);
  Correlation both(0, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < row_height; ++i) {
      for (std::size_t j = 0; j < row_width; ++j)
        ASSERT_NEAR(row_electrons(raw, k, i, j), row_electrons(columns, k, i, j) + row_electrons(rows, k, i, j), row_step);
      both.add(row_electrons(rows, k, i, 0), row_electrons(columns, k, 0, i));
    }
  }
  EXPECT_LT(std::abs(both.z()), 5);
}

TEST(row_noise, is_off_unless_given_and_where_noise_is_off) {
  EXPECT_EQ(Pixel().row_noise_e, 0);
  for (const auto code : raw_rows(dark_rows(row_sigma), 0, Noise::off).raw) EXPECT_EQ(code, 32768);
  for (const auto code : raw_rows(dark_rows(0), 0).raw) EXPECT_EQ(code, 32768);
}

TEST(row_noise, is_the_same_with_every_instruction_set) {
  const Camera camera = dark_rows(row_sigma, row_sigma);
  const Raw scalar = raw_rows(camera, 3, Noise::exact, Isa::scalar);
  for (const Isa isa : backend::machine_isas) {
    if (!backend::can_run(isa)) continue;
    EXPECT_EQ(raw_rows(camera, 3, Noise::exact, isa).raw, scalar.raw);
  }
}

// Row noise by the plain float's text alone: the draw is the row's, and another one than that of the column of the same number.
TEST(row_noise, of_a_pixel_is_its_row_s_and_not_that_of_the_column_of_that_number) {
  const auto bench_of = [](double row_noise_e, double column_noise_e) {
    Camera camera = bench_camera();
    camera.sensor.width = 5, camera.sensor.height = 3;
    camera.pixel.row_noise_e = row_noise_e, camera.pixel.column_noise_e = column_noise_e;
    return Bench(camera, true);
  };
  const Bench rows = bench_of(1e3, 0), columns = bench_of(0, 1e3);
  const auto level = [](const Bench& bench, int pixel) { return bench.expose({0, 0, 0}, pixel)[0].level; };
  for (int pixel = 0; pixel < 15; ++pixel) {
    EXPECT_EQ(level(rows, pixel), level(rows, pixel / 5 * 5)) << pixel;
    EXPECT_EQ(level(columns, pixel), level(columns, pixel % 5)) << pixel;
  }
  for (int i = 0; i < 3; ++i) EXPECT_NE(level(rows, 5 * i), level(columns, i)) << i;
  EXPECT_NE(level(rows, 0), level(rows, 5));
}
