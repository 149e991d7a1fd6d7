// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <string>
#include <vector>

#include "files/json.h"
#include "tofray/camera.h"

/// What a camera can do in its mode, before anything is rendered: `check` says it.
namespace tofray::app {

constexpr std::array report_distances_m = {0.5, 1.0, 2.0, 4.0};

/// Standard deviation of the range on the optical axis, of a matt surface that faces the camera.                [theory: eq. 4.9]
struct NoiseAtDistances {
  double reflectivity = 0;
  bool in_the_sun = false;                                  ///< all of the standard sun's light, from everywhere
  std::array<double, report_distances_m.size()> sigma_m{};  ///< NaN: nothing comes back
  std::array<bool, report_distances_m.size()> saturated{};  ///< there is no depth
  double saturated_up_to_m = 0;                             ///< from there on to the camera it is; 0: not from 5 cm on
};

struct CameraReport {
  int width = 0, height = 0;                               ///< of the image
  double width_deg = 0, height_deg = 0, diagonal_deg = 0;  ///< between the outer edges of the outermost pixels, through the middle
  double pixel_width_m = 0, pixel_height_m = 0;            ///< that one pixel sees at 1 m on the axis
  double outside = 0;                                      ///< share of the pixels that are outside the lens model
  double unlit = 0;                             ///< … that get less than a millionth of the brightest one's light of a wall at 1 m
  double darkest = 0;                           ///< signal of the darkest lit pixel over the brightest one's, of that wall
  std::vector<double> modulation_frequency_hz;  ///< of the mode
  double ambiguity_range_m = 0;
  double low_signal_m = 0;              ///< σ above this is flagged
  bool knows_ambient = true;            ///< an unlit raw frame tells the camera how much noise ambient light makes
  std::vector<NoiseAtDistances> noise;  ///< empty where the mode has no lit raw frame, or the camera no light
};

/// @throws Error as a Simulator of the camera does
CameraReport camera_report(const Camera& camera);
/// Some lines, for a person.
std::string report_text(const CameraReport& report);
files::Json report_json(const CameraReport& report);

}  // namespace tofray::app
