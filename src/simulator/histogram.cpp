// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/histogram.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "num/setup_math.h"

namespace tofray::simulator {

namespace {

/// Bins and pixels that are summed at once: their phasors and sums stay near the processor. A block of bins is summed in double precision
/// before it is added to the others.
constexpr std::size_t bins_together = 256, pixels_together = 64;

/// e^{i m 2π f n ℓ/c}, [frequency][order][2], m = 1, 3, 5 …
void append_turns(const std::vector<double>& frequency_hz, double optical_length_m, std::size_t orders, std::vector<double>& out) {
  for (const double frequency : frequency_hz) {
    const double turns = frequency * optical_length_m / base::speed_of_light, angle = 2 * base::pi * (turns - std::rint(turns));
    const double x = num::setup::cos(angle), y = num::setup::sin(angle), step_x = x * x - y * y, step_y = 2 * x * y;
    double real = x, imaginary = y;
    for (std::size_t h = 0; h < orders; ++h) {
      out.insert(out.end(), {real, imaginary});
      const double next = real * step_x - imaginary * step_y;
      imaginary = real * step_y + imaginary * step_x, real = next;
    }
  }
}

/// Light of some bins in a row.
struct Block {
  const float* values;  ///< [bin][pixel]
  std::size_t bins, pixels;
  std::vector<double> turns;  ///< [bin][parts]
  std::size_t parts;
};

/// Adds it to the sums of pixels `first` to `first` + `count`.
void add(const Block& block, std::size_t first, std::size_t count, std::vector<double>& part, HistogramSums& out) {
  double rate[pixels_together] = {};
  part.assign(block.parts * pixels_together, 0.0);
  for (std::size_t k = 0; k < block.bins; ++k) {
    const float* const row = block.values + k * block.pixels + first;
    if (std::all_of(row, row + count, [](float light) { return light == 0; })) continue;
    for (std::size_t i = 0; i < count; ++i) rate[i] += static_cast<double>(row[i]);
    for (std::size_t q = 0; q < block.parts; ++q) {
      const double turn = block.turns[k * block.parts + q];
      double* const sum = part.data() + q * pixels_together;
      for (std::size_t i = 0; i < count; ++i) sum[i] += static_cast<double>(row[i]) * turn;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    out.rate[first + i] += static_cast<float>(rate[i]);
    for (std::size_t q = 0; q < block.parts; ++q)
      out.phasor[q / 2 * 2 * block.pixels + 2 * (first + i) + q % 2] += static_cast<float>(part[q * pixels_together + i]);
  }
}

}  // namespace

HistogramSums sums_of(const Transient& transient, const std::vector<double>& frequency_hz, double refractive_index, int orders) {
  const std::size_t pixels = static_cast<std::size_t>(transient.width) * static_cast<std::size_t>(transient.height);
  const std::size_t bins = static_cast<std::size_t>(transient.bins), each = static_cast<std::size_t>(orders);
  HistogramSums out{std::vector<float>(pixels), std::vector<float>(frequency_hz.size() * each * 2 * pixels)};
  std::vector<double> part;
  for (std::size_t from = 0; from < bins; from += bins_together) {
    Block block{transient.e_per_s.data() + from * pixels, std::min(bins_together, bins - from), pixels, {}, frequency_hz.size() * each * 2};
    for (std::size_t k = from; k < from + block.bins; ++k) {
      const double length = transient.first_m + (static_cast<double>(k) + 0.5) * transient.bin_width_m;
      append_turns(frequency_hz, refractive_index * length, each, block.turns);
    }
    for (std::size_t first = 0; first < pixels; first += pixels_together)
      add(block, first, std::min(pixels_together, pixels - first), part, out);
  }
  return out;
}

}  // namespace tofray::simulator
