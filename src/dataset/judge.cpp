// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/judge.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "num/setup_math.h"

namespace tofray::dataset {

namespace {

/// Whether there are numbers enough between two ends.
bool are_apart(double a, double b) { return b - a > 1e-9 * std::max(std::abs(a), std::abs(b)); }

double lower_tail_of(double x) { return 0.5 * num::setup::erfc(-x / std::sqrt(2.0)); }

}  // namespace

std::optional<Portion> uniform_place(double value, double a, double b) {
  if (!are_apart(a, b) || !std::isfinite(b - a)) return {};
  return Portion{(value - a) / (b - a), 0};
}

std::optional<Portion> log_uniform_place(double value, double a, double b) {
  if (!are_apart(a, b)) return {};
  const double from = num::setup::log(a), to = num::setup::log(b);
  return Portion{(num::setup::log(value) - from) / (to - from), 0};
}

std::optional<Portion> normal_place(double value, double mean, double sigma, double low, double high) {
  if (!are_apart(mean - sigma, mean + sigma) || (std::isfinite(high - low) && !are_apart(low, high))) return {};
  // Above the mean by the mirror image, whose tail is exact.
  const bool mirrored = low > mean;
  const double sign = mirrored ? -1 : 1;
  const double first = sign * ((mirrored ? high : low) - mean) / sigma, last = sign * ((mirrored ? low : high) - mean) / sigma;
  const double from = lower_tail_of(first), to = lower_tail_of(last);
  if (!(to - from > 1e-300)) return {};
  const double place = (lower_tail_of(sign * (value - mean) / sigma) - from) / (to - from);
  return Portion{mirrored ? 1 - place : place, 0};
}

Portion place_among(double which, double count) { return {which / count, 1 / count}; }

Portion place_by_weight(std::size_t which, const std::vector<double>& weights) {
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  const double below = std::accumulate(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(which), 0.0);
  return {below / all, weights[which] / all};
}

void DrawCounts::add(const Portion& place, double spread) {
  const double at = std::clamp(std::floor((place.from + place.share * spread) * bins), 0.0, bins - 1.0);
  ++counts[static_cast<std::size_t>(at)];
}

void DrawCounts::add(const DrawCounts& other) {
  form = other.form;
  std::transform(counts.begin(), counts.end(), other.counts.begin(), counts.begin(), std::plus<>());
}

std::uint64_t DrawCounts::draws() const { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

double DrawCounts::chi_square() const {
  const double expected = static_cast<double>(draws()) / bins;
  double out = 0;
  for (const std::uint64_t count : counts) {
    const double off = static_cast<double>(count) - expected;
    if (expected > 0) out += off * off / expected;
  }
  return out;
}

std::string missed_laws(const Judgement& of) {
  std::string out;
  for (const auto& [path, counts] : of)
    if (counts.misses())
      out += fmt::format("{}{} ({}): χ² {:.1f} of {} draws", out.empty() ? "" : "; ", base::printable(path), counts.form,
                         counts.chi_square(), counts.draws());
  return out;
}

}  // namespace tofray::dataset
