// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/picture_scale.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace tofray::pictures {

std::vector<double> PictureScale::ticks() const {
  std::vector<double> values;
  // counted, so that no sum of steps drifts
  const double first = std::ceil(low / step - 1e-9);
  for (int i = 0; i < 100 && (first + i) * step <= high + 1e-9 * step; ++i) values.push_back((first + i) * step);
  return values;
}

std::string grouped(std::string digits) {
  const std::size_t point = std::min(digits.find('.'), digits.size());
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(point) - 3; at > (digits[0] == '-' ? 1 : 0); at -= 3)
    digits.insert(static_cast<std::size_t>(at), 1, ' ');
  return digits;
}

std::string PictureScale::label(double tick) const {
  const std::string digits = grouped(fmt::format("{:.{}f}", std::abs(tick), decimals));
  const bool zero = digits.find_first_not_of("0. ") == std::string::npos;
  return (tick < 0 && !zero ? "\xE2\x88\x92" : "") + digits;
}

PictureScale round_scale(double low, double high, double least_span) {
  if (high - low < least_span) {
    const double middle = 0.5 * (low + high);
    low = middle - 0.5 * least_span;
    high = middle + 0.5 * least_span;
  }
  PictureScale scale;
  const double wanted = (high - low) / 5;
  // the power of ten below the wanted step, then 1, 2 or 5 of it
  double power = 1;
  int exponent = 0;
  for (; power > wanted && exponent > -12; --exponent) power /= 10;
  for (; power * 10 <= wanted && exponent < 30; ++exponent) power *= 10;
  scale.step = wanted <= 1.5 * power ? power : wanted <= 3.2 * power ? 2 * power : wanted <= 7 * power ? 5 * power : 10 * power;
  scale.decimals = std::max(0, wanted > 7 * power ? -exponent - 1 : -exponent);
  // half steps are round enough for the ends
  const double half = 0.5 * scale.step;
  scale.low = std::floor(low / half + 1e-9) * half;
  scale.high = std::ceil(high / half - 1e-9) * half;
  return scale;
}

double percentile(std::vector<double> values, double q, double otherwise) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.empty()) return otherwise;
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace tofray::pictures
