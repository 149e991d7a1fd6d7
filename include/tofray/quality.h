// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/frame.h"

/// How good depth is, in the words of makers: of one frame of a flat wall, of several of them, and of a step. Simulated and measured
/// frames alike.
namespace tofray {

/// Pixels from column `u` and row `v` on: u ≤ column < u + width.
struct ImageRegion {
  int u = 0, v = 0;
  int width = 0, height = 0;  ///< both 0: the whole image
};

/// Under which conditions a maker says its numbers; a light meter, a target and a warm camera are the user's to bring.
struct QualityPreset {
  std::string name;    ///< name for QualityRequest::preset: "basler"
  std::string maker;   ///< "Basler blaze"
  int side = 0;        ///< side of the square in the middle of the image that is measured; 0: the whole image
  int frames = 1;      ///< number of frames that are taken
  std::string target;  ///< target and light of the maker's measurement
  std::string stated;  ///< the maker's statement of its camera; empty: none that could be cited
};
/// Makers' conditions that have a name.
const std::vector<QualityPreset>& quality_presets();

/// What is measured, and against what.
struct QualityRequest {
  ImageRegion region;
  std::string preset;  ///< name of one of quality_presets(): its region, where `region` is empty, and notes; empty: none
  double truth_m = 0;  ///< true z of the wall on the optical axis; 0: what the truth says, where it is given
};

/// Numbers of the frames of one region; NaN: unknown, `tofray quality` says what each needs.
/// A pixel is valid in a frame where z is finite and above 0, and no flag says that it is not. Those of RealSense are defined as in its
/// Depth Quality Tool (rs-depth-quality), with each frame's own plane, and are the mean of the frames.
struct Quality {
  ImageRegion region;
  int frames = 0;
  std::vector<std::string> notes;  ///< differences between the frames and the preset's conditions

  double fill_rate_percent = 0;       ///< RealSense: valid pixels over all pixels
  double plane_distance_m = 0;        ///< z of the plane on the optical axis; planes are fitted to all valid points
  double plane_tilt_rad = 0;          ///< between the plane's normal and the optical axis
  double plane_fit_rms_m = 0;         ///< RealSense: √(Σd²/n) of distances d to the plane, without the 0.5 % of least and of largest z
  double plane_fit_rms_percent = 0;   ///< plane_fit_rms_m over plane_distance_m
  double z_accuracy_percent = 0;      ///< RealSense: median of (plane_distance_m − truth + d) over the truth; above 0: too far
  double temporal_noise_percent = 0;  ///< RealSense: median over pixels of σ over median, each over the frames; divisor n; never valid: 0

  double temporal_noise_m = 0;  ///< √(mean over pixels of the variance of z over the frames), divisor n − 1
  double spatial_noise_m = 0;   ///< what is the same in all frames: √(spread of the mean image's z about its plane, less temporal²/n)
  double total_noise_m = 0;     ///< √(temporal² + spatial²); of one frame its spread about its plane
  double noise_chi2 = 0;        ///< variance of the range over the frames, over the mean of noise_m²: 1 where noise_m is honest
  double noise_chi2_error = 0;  ///< one standard error of it: √(2/((n − 1) · pixels))
  double outliers_percent = 0;  ///< pixels left out of it: in a frame more than six noise_m from their median, as on a wrong cycle

  double bias_m = 0;         ///< mean of z − true z, of all valid pixels of all frames
  double bias_median_m = 0;  ///< their median
  double rmse_m = 0;         ///< root of the mean of their squares

  double amplitude_e = 0;               ///< mean amplitude of the valid pixels
  double amplitude_spread_percent = 0;  ///< its standard deviation over the mean, of the mean image

  double edge_step_m = 0;            ///< far less near, where the region has two surfaces with one step between them
  double edge_width_px = 0;          ///< from 10 % to 90 % of the step, median of the lines that cross it; between two pixels it is 0.8
  double edge_shift_px = 0;          ///< its middle less that of the truth, median; above 0: the near surface is too wide
  double flying_pixels_percent = 0;  ///< valid pixels within 2 of the step that are 10 % to 90 % between its surfaces
  double flying_flags_percent = 0;   ///< pixels of the region that the camera itself calls flying
};

/// Depth out of the truth, to be compared or measured as a frame's: z, range and points.
Depth depth_of(const Truth& truth);

/// @param frames  of a camera and a scene that stand still, all of one size; of each z_m is needed, and points_m for planes
/// @param truth   of the same pixels: z_m of it is needed; may be null
/// @throws Error (bad_input) where there is no frame, none with a depth, for sizes that differ, a region that is not in the image, an
///         unknown preset
Quality quality(const std::vector<Depth>& frames, const QualityRequest& request = {}, const Depth* truth = nullptr);

}  // namespace tofray
