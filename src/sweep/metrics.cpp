// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/metrics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/samples.h"
#include "base/constants.h"
#include "base/text.h"
#include "tofray/error.h"

namespace tofray {

const std::vector<SweepMetric>& sweep_metrics() {
  static const std::vector<SweepMetric> all = {
      {"bias_m", "mean of z - true z", false},
      {"median_m", "median of z - true z", false},
      {"sigma_m", "noise of z, 1 sigma: over the frames, divisor n - 1; of one frame what noise_m says of it", false},
      {"rmse_m", "root of the mean square of z - true z", false},
      {"p95_m", "95 % of the pixels are off by less, either way", false},
      {"fill_percent", "pixels that have a depth", true},
      {"wrong_cycle_percent", "pixels that have a depth and are off by more than half a cycle of the highest modulation frequency", false},
      {"amplitude_e", "mean amplitude of pixels that have a depth", true},
      {"noise_m", "root of the mean square of the camera's own estimate of the range's noise", false},
      {"tap_filling_percent", "fuller tap of a pixel's fullest lit raw frame over the full well, mean", false},
      {"adc_filling_percent", "how far a pixel's farthest code of a lit raw frame is on its way to the end of the valid ones, mean", false},
#define TOFRAY_FLAGGED(name, bit, invalid, letter, dark, light, words, ...) {#name "_percent", "pixels with the flag: " words, false},
      TOFRAY_FLAGS(TOFRAY_FLAGGED)
#undef TOFRAY_FLAGGED
  };
  return all;
}

namespace sweeps {

namespace {

/// Places in sweep_metrics().
enum Place : std::size_t { bias, median, sigma_of, rmse, p95, fill, wrong_cycle, amplitude, noise, tap_filling, adc_filling, first_flag };

constexpr std::uint16_t flag_bits[] = {
#define TOFRAY_BIT(name, bit, ...) bit,
    TOFRAY_FLAGS(TOFRAY_BIT)
#undef TOFRAY_BIT
};
constexpr std::size_t flag_count = std::size(flag_bits);

std::string without_unit(const std::string& name) {
  for (const char* end : {"_m", "_percent", "_e"})
    if (name.ends_with(end)) return name.substr(0, name.size() - std::string_view(end).size());
  return name;
}

}  // namespace

std::size_t metric_named(const std::string& name) {
  std::vector<std::string> known;
  for (const SweepMetric& one : sweep_metrics()) {
    known.push_back(without_unit(one.name));
    if (one.name == name || known.back() == name) return known.size() - 1;
  }
  throw Error(ErrorKind::bad_input, fmt::format("error: no metric is called {}{}\n  expected {}", base::in_quotes(name),
                                                base::did_you_mean(name, known), base::listed(known)));
}

bool Wanted::has(std::size_t first, std::size_t last) const {
  return std::any_of(metrics.begin(), metrics.end(), [&](std::size_t one) { return one >= first && one <= last; });
}

Wanted wanted_metrics(const std::vector<std::string>& names) {
  Wanted out;
  for (const std::string& name : names) {
    const std::size_t place = metric_named(name);
    if (std::find(out.metrics.begin(), out.metrics.end(), place) == out.metrics.end()) out.metrics.push_back(place);
  }
  for (std::size_t i = 0; names.empty() && i < sweep_metrics().size(); ++i) out.metrics.push_back(i);
  return out;
}

std::vector<std::string> arrays_for(const Wanted& wanted, bool by_object) {
  std::vector<std::string> out = {"z_m", "flags", "gt_z_m"};
  if (wanted.has(sigma_of, sigma_of) || wanted.has(noise, noise)) out.insert(out.end(), {"range_m", "noise_m"});
  if (wanted.has(wrong_cycle, wrong_cycle)) out.insert(out.end(), {"range_m", "gt_range_m"});
  if (wanted.has(amplitude, amplitude)) out.emplace_back("amplitude_e");
  if (wanted.has(tap_filling, tap_filling)) out.insert(out.end(), {"tap_a", "tap_b"});
  if (wanted.has(adc_filling, adc_filling)) out.emplace_back("raw");
  if (by_object) out.emplace_back("gt_object_id");
  return out;
}

Measuring::Measuring(const Wanted& wanted, const Camera& camera, const ImageRegion& region, const std::vector<int>& part_of,
                     std::uint64_t frames)
    : wanted_(wanted),
      part_of_(part_of),
      region_(region),
      frames_(frames),
      filling_(wanted.has(tap_filling, adc_filling)),
      errors_(wanted.has(bias, p95)),
      full_well_e_(camera.pixel.full_well_e),
      mid_code_(camera.adc.mid_code),
      parts_(part_of.empty() ? 1 : 1 + static_cast<std::size_t>(*std::max_element(part_of.begin(), part_of.end()))) {
  double highest = 0;
  for (const RawFrame& one : camera.mode.sequence)
    if (one.lit) highest = std::max(highest, one.modulation_frequency_hz);
  half_cycle_m_ = base::speed_of_light / (4 * highest * camera.refractive_index);
  const double low = camera.decoding.lower_saturation_dn.value_or(camera.adc.valid_min),
               high = camera.decoding.upper_saturation_dn.value_or(camera.adc.valid_max);
  code_reach_ = std::min(mid_code_ - low, high - mid_code_);
  for (Part& part : parts_) part.flagged.resize(flag_count);
  if (frames > 1 && wanted.has(sigma_of, sigma_of))
    spread_.resize(static_cast<std::size_t>(region.width) * static_cast<std::size_t>(region.height));
}

/// Of lit raw frames the fuller tap [e⁻], and how far the code is from its middle.
void Measuring::find_filling(const Frame& frame) {
  const Raw& raw = frame.raw;
  const std::size_t pixels = static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
  fullest_.assign(pixels, 0), farthest_.assign(pixels, 0);
  const auto middle = static_cast<float>(mid_code_);
  for (std::size_t k = 0; k < static_cast<std::size_t>(raw.phases); ++k) {
    if (raw.lit[k] == 0) continue;
    const std::size_t at = k * pixels;
    for (std::size_t i = 0; i < pixels && !raw.tap_a.empty(); ++i)
      fullest_[i] = std::max(fullest_[i], std::max(raw.tap_a[at + i], raw.tap_b[at + i]));
    for (std::size_t i = 0; i < pixels && !raw.raw.empty(); ++i)
      farthest_[i] = std::max(farthest_[i], std::fabs(static_cast<float>(raw.raw[at + i]) - middle));
  }
}

void Measuring::add(const Frame& frame, std::size_t pixel, Part& part) const {
  const Depth& depth = frame.depth;
  ++part.pixels;
  const unsigned flags = depth.flags[pixel];
  for (std::size_t i = 0; flags != 0 && i < flag_count; ++i) part.flagged[i] += (flags & flag_bits[i]) != 0;
  if (filling_) part.taps += static_cast<double>(fullest_[pixel]), part.codes += static_cast<double>(farthest_[pixel]);
  if (!analysis::has_depth(depth, pixel)) return;
  ++part.valid;
  const auto z = static_cast<double>(depth.z_m[pixel]), truth = static_cast<double>(frame.truth.z_m[pixel]);
  if (!depth.amplitude_e.empty()) part.amplitude += static_cast<double>(depth.amplitude_e[pixel]);
  if (!depth.noise_m.empty()) {
    const double sigma = static_cast<double>(depth.noise_m[pixel]), along = z / static_cast<double>(depth.range_m[pixel]);
    part.noise += sigma * sigma, part.claimed += sigma * sigma * along * along;
  }
  if (!(truth > 0)) return;
  ++part.known;
  if (errors_) part.errors.push_back(z - truth);
  if (frame.truth.range_m.empty()) return;
  part.wrong += std::fabs(static_cast<double>(depth.range_m[pixel]) - static_cast<double>(frame.truth.range_m[pixel])) > half_cycle_m_;
}

void Measuring::take(const Frame& frame) {
  const auto width = static_cast<std::size_t>(frame.depth.width);
  if (filling_) find_filling(frame);
  std::size_t i = 0;
  for (int v = region_.v; v < region_.v + region_.height; ++v) {
    for (int u = region_.u; u < region_.u + region_.width; ++u, ++i) {
      const std::size_t pixel = static_cast<std::size_t>(v) * width + static_cast<std::size_t>(u);
      add(frame, pixel, parts_[0]);
      const int object = parts_.size() > 1 ? frame.truth.object_id[pixel] : -1;
      const int part = object >= 0 && static_cast<std::size_t>(object) < part_of_.size() ? part_of_[static_cast<std::size_t>(object)] : 0;
      if (part > 0) add(frame, pixel, parts_[static_cast<std::size_t>(part)]);
      if (spread_.empty() || !analysis::has_depth(frame.depth, pixel)) continue;
      // What moves is measured against its truth.
      const double truth = static_cast<double>(frame.truth.z_m[pixel]), z = static_cast<double>(frame.depth.z_m[pixel]);
      Spread& one = spread_[i];
      if (one.count > 0 && one.part != part) continue;
      one.part = part, ++one.count;
      const double error = truth > 0 ? z - truth : z, away = error - one.mean;
      one.mean += away / one.count, one.squares += away * (error - one.mean);
    }
  }
}

/// Root of the mean variance over the frames, of pixels with a depth in all of them. @param part  0: of the whole region
double Measuring::sigma(int part) const {
  double sum = 0;
  std::size_t count = 0;
  const auto all = static_cast<int>(frames_);
  for (const Spread& one : spread_) {
    if (one.count != all || (part > 0 && one.part != part)) continue;
    sum += one.squares / (all - 1), ++count;
  }
  return count == 0 ? analysis::unknown : std::sqrt(sum / static_cast<double>(count));
}

double Measuring::number(const Part& part, std::size_t metric, double sigma) const {
  const auto share = [&](std::size_t count, std::size_t of) {
    return of == 0 ? analysis::unknown : 100 * static_cast<double>(count) / static_cast<double>(of);
  };
  const auto mean = [&](double sum, std::size_t of) { return of == 0 ? analysis::unknown : sum / static_cast<double>(of); };
  switch (metric) {
    case bias: return analysis::mean_of(part.errors);
    case median: return analysis::median_of(part.errors);
    case sigma_of: return spread_.empty() ? std::sqrt(mean(part.claimed, part.valid)) : sigma;
    case rmse: return std::sqrt(mean(analysis::squares_about(part.errors, 0), part.errors.size()));
    case p95: {
      std::vector<double> sizes;
      sizes.reserve(part.errors.size());
      for (const double one : part.errors) sizes.push_back(std::fabs(one));
      return analysis::quantile(std::move(sizes), 0.95);
    }
    case fill: return share(part.valid, part.pixels);
    case wrong_cycle: return share(part.wrong, part.known);
    case amplitude: return mean(part.amplitude, part.valid);
    case noise: return std::sqrt(mean(part.noise, part.valid));
    case tap_filling: return 100 * mean(part.taps, part.pixels) / full_well_e_;
    case adc_filling: return 100 * mean(part.codes, part.pixels) / code_reach_;
    default: return share(part.flagged[metric - first_flag], part.pixels);
  }
}

std::vector<double> Measuring::values() const {
  std::vector<double> out;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double spread = spread_.empty() ? 0 : sigma(static_cast<int>(i));
    for (const std::size_t metric : wanted_.metrics) out.push_back(number(parts_[i], metric, spread));
  }
  return out;
}

}  // namespace sweeps

}  // namespace tofray
