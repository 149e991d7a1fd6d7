// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/compare.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "analysis/samples.h"
#include "tofray/error.h"

namespace tofray {

namespace analysis {

namespace {

/// One pixel that both have.
struct ComparedPixel {
  std::size_t place = 0;  ///< in the region
  double difference = 0, distance = 0;
  std::uint16_t flags = 0;
  bool edge = false;
};

template <class Wanted>
Differences differences_of(const std::vector<ComparedPixel>& pixels, const Wanted& wanted) {
  std::vector<double> values, sizes;
  for (const ComparedPixel& one : pixels)
    if (wanted(one)) values.push_back(one.difference), sizes.push_back(std::fabs(one.difference));
  Differences out;
  out.pixels = static_cast<std::int64_t>(values.size());
  const auto n = static_cast<double>(values.size());
  out.bias_m = mean_of(values), out.median_m = median_of(values), out.spread_m = values.empty() ? unknown : spread_about_median(values);
  out.sigma_m = values.size() < 2 ? unknown : std::sqrt(squares_about(values, out.bias_m) / (n - 1));
  out.rmse_m = values.empty() ? unknown : std::sqrt(squares_about(values, 0) / n);
  out.p50_m = quantile(sizes, 0.5), out.p95_m = quantile(sizes, 0.95), out.p99_m = quantile(std::move(sizes), 0.99);
  return out;
}

std::uint16_t flags_at(const Depth& depth, std::size_t pixel) { return depth.flags.empty() ? std::uint16_t{0} : depth.flags[pixel]; }

/// noise_m where it is known, else 0.
double noise_at(const Depth& depth, std::size_t pixel) {
  if (depth.noise_m.empty()) return 0;
  const double noise = depth.noise_m[pixel];
  return std::isfinite(noise) && noise > 0 ? noise : 0;
}

/// Pixels of the image that are no farther than `reach` from a jump between neighbours.
std::vector<bool> edges_of(const Depth& depth, const CompareRequest& request) {
  const int width = depth.width, height = depth.height, reach = request.edge_px;
  std::vector<bool> out(depth.z_m.size(), false);
  const auto index = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  const auto jumps = [&](std::size_t a, std::size_t b) {
    if (!has_depth(depth, a) || !has_depth(depth, b)) return false;
    const double noise = std::hypot(noise_at(depth, a), noise_at(depth, b));
    return std::fabs(static_cast<double>(depth.z_m[a]) - static_cast<double>(depth.z_m[b])) > std::max(request.edge_step_m, 6 * noise);
  };
  const auto mark = [&](int column, int row, bool below) {  // the pixel and the one to its right, or below it, are at 1 from the edge
    const int right = column + (below ? 0 : 1), down = row + (below ? 1 : 0), more = reach - 1;
    for (int v = std::max(0, row - more); v <= std::min(height - 1, down + more); ++v)
      for (int u = std::max(0, column - more); u <= std::min(width - 1, right + more); ++u) out[index(u, v)] = true;
  };
  if (reach < 1) return out;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      if (column + 1 < width && jumps(index(column, row), index(column + 1, row))) mark(column, row, false);
      if (row + 1 < height && jumps(index(column, row), index(column, row + 1))) mark(column, row, true);
    }
  return out;
}

/// Whether the claimed noise is the noise.
void take_chi2(const Depth& a, const Depth& b, const std::vector<std::size_t>& pixels, const std::vector<ComparedPixel>& compared,
               bool fit_shift, Comparison& out) {
  out.chi2 = out.chi2_error = unknown;
  if (a.range_m.empty() || b.range_m.empty()) return;
  std::vector<double> differences, variances;
  for (const ComparedPixel& one : compared) {
    const std::size_t pixel = pixels[one.place];
    const double variance = std::pow(noise_at(a, pixel), 2) + std::pow(noise_at(b, pixel), 2);
    const double difference = static_cast<double>(a.range_m[pixel]) - static_cast<double>(b.range_m[pixel]);
    if (one.edge || !(variance > 0) || !std::isfinite(difference)) continue;
    differences.push_back(difference), variances.push_back(variance);
  }
  if (differences.size() < 2) return;
  const double shift = fit_shift ? median_of(differences) : 0;
  std::vector<double> ratios;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const double ratio = std::pow(differences[i] - shift, 2) / variances[i];
    if (ratio > outlier_sigmas * outlier_sigmas)
      ++out.chi2_outliers;
    else
      ratios.push_back(ratio);
  }
  if (ratios.size() < 2) return;
  const auto n = static_cast<double>(ratios.size());
  out.chi2 = mean_of(ratios), out.chi2_error = std::sqrt(squares_about(ratios, out.chi2) / (n - 1) / n);
  out.chi2_pixels = static_cast<std::int64_t>(ratios.size());
}

void take_distances(const std::vector<ComparedPixel>& compared, const CompareRequest& request, Comparison& out) {
  std::vector<double> bounds = request.distances_m;
  if (bounds.empty()) {
    const auto by = [](const ComparedPixel& a, const ComparedPixel& b) { return a.distance < b.distance; };
    const auto [nearest, farthest] = std::minmax_element(compared.begin(), compared.end(), by);
    constexpr int classes = 8;
    for (int i = 0; i <= classes; ++i) bounds.push_back(nearest->distance + i * (farthest->distance - nearest->distance) / classes);
    bounds.back() = std::nextafter(farthest->distance, 2 * farthest->distance);  // the farthest pixel is within
  }
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    const double low = bounds[i], high = bounds[i + 1];
    const Differences of = differences_of(compared, [&](const ComparedPixel& one) { return one.distance >= low && one.distance < high; });
    if (of.pixels > 0) out.by_distance.push_back({low, high, of});
  }
}

void take_flags(const Depth& a, const Depth& b, const std::vector<std::size_t>& pixels, const std::vector<ComparedPixel>& compared,
                Comparison& out) {
  const auto take = [&](const char* words, std::uint16_t bit) {
    DifferencesOfFlag one;
    one.flag = words;
    for (const std::size_t pixel : pixels) {
      if (((flags_at(a, pixel) | flags_at(b, pixel)) & bit) == 0) continue;
      const bool in_a = has_depth(a, pixel), in_b = has_depth(b, pixel);
      one.only_in_a += in_a && !in_b ? 1 : 0, one.only_in_b += in_b && !in_a ? 1 : 0;
    }
    one.of = differences_of(compared, [&](const ComparedPixel& pixel) { return (pixel.flags & bit) != 0; });
    if (one.only_in_a + one.only_in_b + one.of.pixels > 0) out.by_flag.push_back(one);
  };
#define TOFRAY_TAKE_FLAG(name, bit, invalid, letter, dark, light, words, ...) take(words, bit);
  TOFRAY_FLAGS(TOFRAY_TAKE_FLAG)
#undef TOFRAY_TAKE_FLAG
}

void take_histogram(const std::vector<ComparedPixel>& compared, Comparison& out) {
  constexpr int bins = 41;
  std::vector<double> sizes;
  for (const ComparedPixel& one : compared) sizes.push_back(std::fabs(one.difference));
  const double most = quantile(std::move(sizes), 0.98);
  out.histogram_step_m = most > 0 ? 2 * most / (bins - 2) : 1e-3;
  out.histogram_low_m = -out.histogram_step_m * bins / 2;
  out.histogram.assign(bins, 0);
  for (const ComparedPixel& one : compared) {
    const double place = std::floor((one.difference - out.histogram_low_m) / out.histogram_step_m);
    ++out.histogram[static_cast<std::size_t>(std::clamp(place, 0.0, bins - 1.0))];
  }
}

/// Pearson's r.
double correlation_of(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 2) return unknown;
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  double both = 0;
  for (std::size_t i = 0; i < a.size(); ++i) both += (a[i] - mean_a) * (b[i] - mean_b);
  const double product = squares_about(a, mean_a) * squares_about(b, mean_b);
  return product > 0 ? both / std::sqrt(product) : unknown;
}

double amplitudes_together(const Depth& a, const Depth& b, const std::vector<std::size_t>& pixels,
                           const std::vector<ComparedPixel>& compared) {
  if (a.amplitude_e.empty() || b.amplitude_e.empty()) return unknown;
  std::vector<double> of_a, of_b;
  for (const ComparedPixel& one : compared) {
    const std::size_t pixel = pixels[one.place];
    if (std::isfinite(a.amplitude_e[pixel]) && std::isfinite(b.amplitude_e[pixel]))
      of_a.push_back(a.amplitude_e[pixel]), of_b.push_back(b.amplitude_e[pixel]);
  }
  return correlation_of(of_a, of_b);
}

void check_comparison(const Depth& a, const Depth& b, const CompareRequest& request) {
  check_depth(a, "A"), check_depth(b, "B");
  if (a.width != b.width || a.height != b.height)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: A and B have different sizes\n  got {} x {} and {} x {}, expected the same pixels in "
                            "both: one camera, one mode, one binning",
                            a.width, a.height, b.width, b.height));
  for (const auto& [depth, name] : {std::pair{&a, "A"}, std::pair{&b, "B"}})
    if (request.range && depth->range_m.empty())
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} has no range\n  got z alone, expected range_m; compare z in its place", name));
  const bool rises = std::adjacent_find(request.distances_m.begin(), request.distances_m.end(),
                                        [](double low, double high) { return !(low < high); }) == request.distances_m.end();
  if (!rises || request.distances_m.size() == 1)
    throw Error(ErrorKind::bad_input,
                "error: the bounds of the classes by distance do not rise\n  expected two or more, such as 0.5, 1 and 2 m");
  if (!(request.edge_step_m > 0) || request.edge_px < 0 || request.edge_px > 1000)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: an edge cannot be a step of {:g} m and {} pixels wide\n  expected a step above 0 and 0 to "
                            "1000 pixels",
                            request.edge_step_m, request.edge_px));
}

}  // namespace

}  // namespace analysis

Comparison compare(const Depth& a, const Depth& b, const CompareRequest& request) {
  using analysis::ComparedPixel;
  analysis::check_comparison(a, b, request);
  Comparison out;
  out.region = analysis::region_within(request.region, a.width, a.height), out.range = request.range;
  const std::vector<std::size_t> pixels = analysis::pixels_of(out.region, a.width);
  const std::vector<float>&of_a = request.range ? a.range_m : a.z_m, &of_b = request.range ? b.range_m : b.z_m;
  const std::vector<bool> edges = analysis::edges_of(b, request);
  std::vector<ComparedPixel> compared;
  for (std::size_t place = 0; place < pixels.size(); ++place) {
    const std::size_t pixel = pixels[place];
    const bool in_a = analysis::has_depth(a, pixel) && std::isfinite(of_a[pixel]),
               in_b = analysis::has_depth(b, pixel) && std::isfinite(of_b[pixel]);
    ++(in_a && in_b ? out.both : in_a ? out.only_a : in_b ? out.only_b : out.neither);
    if (!in_a || !in_b) continue;
    const auto flags = static_cast<std::uint16_t>(analysis::flags_at(a, pixel) | analysis::flags_at(b, pixel));
    const double distance = of_b[pixel];
    compared.push_back({place, static_cast<double>(of_a[pixel]) - distance, distance, flags, edges[pixel]});
  }
  out.pixels = static_cast<std::int64_t>(pixels.size());
  if (compared.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: no pixel has a depth in both\n  got {} in A, {} in B, of {}; `tofray inspect FILE` says why "
                            "pixels are invalid",
                            out.only_a, out.only_b, out.pixels));
  if (request.fit_shift) {
    std::vector<double> values;
    for (const ComparedPixel& one : compared) values.push_back(one.difference);
    out.shift_m = analysis::median_of(std::move(values));
    for (ComparedPixel& one : compared) one.difference -= out.shift_m;
  }
  out.map_m.assign(pixels.size(), static_cast<float>(analysis::unknown));
  for (const ComparedPixel& one : compared) out.map_m[one.place] = static_cast<float>(one.difference);
  out.all = analysis::differences_of(compared, [](const ComparedPixel&) { return true; });
  out.flats = analysis::differences_of(compared, [](const ComparedPixel& one) { return !one.edge; });
  out.edges = analysis::differences_of(compared, [](const ComparedPixel& one) { return one.edge; });
  analysis::take_distances(compared, request, out);
  analysis::take_flags(a, b, pixels, compared, out);
  analysis::take_chi2(a, b, pixels, compared, request.fit_shift, out);
  analysis::take_histogram(compared, out);
  out.amplitude_correlation = analysis::amplitudes_together(a, b, pixels, compared);
  return out;
}

}  // namespace tofray
