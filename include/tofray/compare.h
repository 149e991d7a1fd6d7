// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tofray/frame.h"
#include "tofray/quality.h"

/// Two images of depth against each other: a simulation, a truth (depth_of()), a recording.
namespace tofray {

/// What is compared, and how pixels are parted.
struct CompareRequest {
  ImageRegion region;
  bool range = false;      ///< compare range_m; false: z_m
  bool fit_shift = false;  ///< one shift of all pixels, their median difference, is taken off first
  /// Bounds of the classes by distance in B, rising; empty: eight as wide as each other.
  std::vector<double> distances_m;
  /// Neighbours of B that differ by more than this, and by six times their noise where it is known, have an edge between them.
  double edge_step_m = 0.05;
  int edge_px = 2;  ///< pixels that are no farther from an edge, in columns and rows, are at it; others are flat
};

/// Of A − B. NaN where there is no pixel.
struct Differences {
  std::int64_t pixels = 0;
  double bias_m = 0;    ///< mean
  double median_m = 0;  ///< median
  double sigma_m = 0;   ///< standard deviation, divisor n − 1
  double spread_m = 0;  ///< 1.4826 times the median of the distances from the median: sigma, whatever a few outliers do
  double rmse_m = 0;    ///< root of the mean of the squares
  double p50_m = 0;     ///< half of the pixels differ by less than this, either way
  double p95_m = 0;     ///< 95 %
  double p99_m = 0;     ///< 99 %
};

/// Pixels whose depth in B is from low to below high.
struct DifferencesAt {
  double low_m = 0, high_m = 0;
  Differences of;
};

/// Pixels with a flag in A or in B.
struct DifferencesOfFlag {
  std::string flag;            ///< "filtered": a row of TOFRAY_FLAGS
  std::int64_t only_in_a = 0;  ///< pixels that have a depth in A alone
  std::int64_t only_in_b = 0;  ///< pixels that have a depth in B alone
  Differences of;              ///< differences of the pixels that have a depth in both
};

/// A − B: of all pixels and of parts of them.
struct Comparison {
  ImageRegion region;
  bool range = false;
  std::int64_t pixels = 0;   ///< pixels of the region
  std::int64_t both = 0;     ///< have a depth in A and in B: only these are compared
  std::int64_t only_a = 0;   ///< pixels with a depth in A alone
  std::int64_t only_b = 0;   ///< pixels with a depth in B alone
  std::int64_t neither = 0;  ///< pixels without a depth in either
  double shift_m = 0;        ///< shift that was taken off A
  Differences all, flats, edges;
  std::vector<DifferencesAt> by_distance;  ///< classes without a pixel are left out
  std::vector<DifferencesOfFlag> by_flag;  ///< flags that some pixel has
  /// Mean over the flat pixels of (range of A − range of B)²/(σ_A² + σ_B²), σ: noise_m of whichever has it. 1: noise_m says how noisy
  /// the depth is; above: it says too little, or a bias is beside it. NaN: neither has noise_m, or one has no range.
  double chi2 = 0;
  double chi2_error = 0;             ///< one standard error of it
  std::int64_t chi2_pixels = 0;      ///< number of pixels that it was made of
  std::int64_t chi2_outliers = 0;    ///< flat pixels left out of it: more than six sigmas off, as on a wrong cycle
  double amplitude_correlation = 0;  ///< Pearson's r of amplitude_e; NaN: one has none
  /// A − B of the region's pixels [height][width]; NaN: not in both.
  std::vector<float> map_m;
  /// How many differences lie from histogram_low_m + i · histogram_step_m to one step more; the first and the last hold all beyond.
  std::vector<std::int64_t> histogram;
  double histogram_low_m = 0, histogram_step_m = 0;
};

/// @throws Error (bad_input) where one has no depth, they differ in size, the region is not in the image, no pixel has a depth in both,
///         bounds do not rise
Comparison compare(const Depth& a, const Depth& b, const CompareRequest& request = {});

}  // namespace tofray
