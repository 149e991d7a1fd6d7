// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "tofray/compare.h"
#include "tofray/quality.h"

/// The numbers of quality and comparison by name: a header alone, for what stands on the libraries' public functions, too.
namespace tofray::analysis {

/// A number of a Quality, as JSON, CSV, limits and Python call it; the name ends in its unit.
struct QualityMetric {
  const char* name;
  double Quality::*member;
  bool at_least;      ///< a limit is the least that is good; false: the most, of either sign
  const char* what;   ///< in a few words
  const char* needs;  ///< where it is unknown: what would make it known
};

inline const std::vector<QualityMetric>& quality_metrics() {
  constexpr const char *points = "points of the pixels: points_m, or the lens's intrinsics", *frames = "two frames or more",
                       *truth = "ground truth of each pixel: gt_z_m", *step = "a region with one step between two surfaces",
                       *depth = "pixels with a depth";
  static const std::vector<QualityMetric> all = {
      {"fill_rate_percent", &Quality::fill_rate_percent, true, "RealSense: valid pixels over all pixels", depth},
      {"plane_distance_m", &Quality::plane_distance_m, false, "z of the fitted plane on the optical axis", points},
      {"plane_tilt_rad", &Quality::plane_tilt_rad, false, "between its normal and the optical axis", points},
      {"plane_fit_rms_m", &Quality::plane_fit_rms_m, false, "RealSense: root mean square of distances to it", points},
      {"plane_fit_rms_percent", &Quality::plane_fit_rms_percent, false, "RealSense: the same over plane_distance", points},
      {"z_accuracy_percent", &Quality::z_accuracy_percent, false, "RealSense: median error over the true distance",
       "points, and the true distance of the wall: truth, or ground truth in the file"},
      {"temporal_noise_percent", &Quality::temporal_noise_percent, false, "RealSense: median of sigma over median of each pixel", frames},
      {"temporal_noise_m", &Quality::temporal_noise_m, false, "over the frames, root of the mean variance of z",
       "two frames or more in which one pixel is valid"},
      {"spatial_noise_m", &Quality::spatial_noise_m, false, "from pixel to pixel about the plane, the same in all frames",
       "two frames or more, and points of the pixels"},
      {"total_noise_m", &Quality::total_noise_m, false, "both together", points},
      {"noise_chi2", &Quality::noise_chi2, false, "variance of the range over noise_m squared: 1 is honest",
       "two frames or more with range_m and noise_m"},
      {"noise_chi2_error", &Quality::noise_chi2_error, false, "its standard error", "two frames or more with range_m and noise_m"},
      {"outliers_percent", &Quality::outliers_percent, false, "pixels not in it: six noise_m off in a frame, as on a wrong cycle",
       "two frames or more with range_m and noise_m"},
      {"bias_m", &Quality::bias_m, false, "mean of z less the truth", truth},
      {"bias_median_m", &Quality::bias_median_m, false, "its median", truth},
      {"rmse_m", &Quality::rmse_m, false, "root mean square of z less the truth", truth},
      {"amplitude_e", &Quality::amplitude_e, true, "mean of the valid pixels", "amplitude_e"},
      {"amplitude_spread_percent", &Quality::amplitude_spread_percent, false, "its standard deviation over the mean", "amplitude_e"},
      {"edge_step_m", &Quality::edge_step_m, false, "far surface less near one", step},
      {"edge_width_px", &Quality::edge_width_px, false, "10 % to 90 % of the step; between two pixels it is 0.8", step},
      {"edge_shift_px", &Quality::edge_shift_px, false, "less that of the truth; above 0: the near surface is too wide",
       "a region with one step, and ground truth of it"},
      {"flying_pixels_percent", &Quality::flying_pixels_percent, false, "within 2 px of the step, 10 % to 90 % between", step},
      {"flying_flags_percent", &Quality::flying_flags_percent, false, "pixels that the camera calls flying", "flags"},
  };
  return all;
}

/// A number of Differences.
struct DifferenceColumn {
  const char* name;
  double Differences::*member;
};

inline const std::vector<DifferenceColumn>& difference_columns() {
  static const std::vector<DifferenceColumn> all = {{"bias_m", &Differences::bias_m},   {"median_m", &Differences::median_m},
                                                    {"sigma_m", &Differences::sigma_m}, {"spread_m", &Differences::spread_m},
                                                    {"rmse_m", &Differences::rmse_m},   {"p50_m", &Differences::p50_m},
                                                    {"p95_m", &Differences::p95_m},     {"p99_m", &Differences::p99_m}};
  return all;
}

}  // namespace tofray::analysis
