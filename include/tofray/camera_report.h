// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/scene.h"

/// What a camera can do in its mode, before anything is rendered.
namespace tofray {

/// Light that is not the camera's own, by the name that tables call it.
struct AmbientCase {
  std::string name = "in the dark";  ///< name in tables
  Ambient ambient;                   ///< none: darkness
  Pose pose;                         ///< pose of the camera, where the ambient light has a direction
};

/// All of the standard sun's light (100 % of sun_am15), from everywhere.
AmbientCase full_sun();

/// What a camera report is asked.
struct CameraQuestion {
  std::vector<double> distances_m;     ///< z on the optical axis, 1e-3 to 1e5; empty: 0.5, 1, 2 and 4 m
  std::vector<double> reflectivities;  ///< reflectivities of a matt surface that faces the camera, 0 to 1; empty: 0.2 and 0.8 [1]
  std::vector<AmbientCase> ambients;   ///< empty: darkness, and all of the standard sun (100 % of sun_am15) from everywhere
};

/// Range noise and wrong cycles at one distance.
struct NoiseAt {
  double z_m = 0;      ///< distance on the optical axis
  double sigma_m = 0;  ///< standard deviation of the range, expected; NaN: nothing comes back  [theory: noise-estimate]
  /// Share of pixels whose range is whole cycles off, whatever flag they get: how often noise makes unwrapping choose another cycle, of
  /// phases that have the exact density of a noisy phasor's. 0 with one modulation frequency; NaN where there is no phase.
  /// [1] [theory: noisy-phasor, wrong-cycle-share]
  double wrong_cycle = 0;
  bool saturated = false;  ///< there is no depth
};

/// Range noise and wrong cycles on the optical axis, of a matt surface that faces the camera.
struct NoiseAtDistances {
  double reflectivity = 0;                    ///< reflectivity of the surface [1]
  std::string ambient;                        ///< name of the light that is not the camera's own
  double saturated_up_to_m = 0;               ///< largest distance at which it saturates; 0: none from 5 cm on; everywhere_m: all distances
  std::vector<NoiseAt> at;                    ///< one for each distance
  static constexpr double everywhere_m = 20;  ///< largest distance at which saturation is looked for
};

/// What a camera can do in its mode.
struct CameraReport {
  int width = 0, height = 0;  ///< size of the image in pixels
  double width_deg = 0;       ///< field of view between the outer edges of the outermost pixels, through the middle [deg]
  double height_deg = 0;      ///< field of view between the outer edges of the outermost rows, through the middle [deg]
  double diagonal_deg = 0;    ///< field of view from corner to corner [deg]
  double pixel_width_m = 0;   ///< width that one pixel sees at 1 m on the axis
  double pixel_height_m = 0;  ///< height that one pixel sees at 1 m on the axis
  double outside = 0;         ///< share of the pixels that are outside the lens model [1]
  double unlit = 0;           ///< share of those that get less than a millionth of the brightest one's light of a wall at 1 m [1]
  double darkest = 0;         ///< signal of the darkest lit pixel over the brightest one's, of that wall [1]
  std::vector<double> modulation_frequency_hz;  ///< modulation frequencies of the mode
  std::vector<int> cycles;                      ///< cycles of each of them in the ambiguity range: M and N of two
  double ambiguity_range_m = 0;                 ///< ambiguity range of the mode; 0 where no raw frame is lit
  double low_signal_m = 0;                      ///< σ above this is flagged
  bool knows_ambient = true;                    ///< an unlit raw frame tells the camera how much noise ambient light makes
  std::vector<NoiseAtDistances> noise;          ///< ambient by ambient, in each by reflectivity; empty: no raw frame is lit, or no light
  std::vector<std::string> warnings;            ///< about the design, a line each
};

/// What the camera can do in its mode, from expected values: no scene is needed, and nothing is drawn at random.
/// @throws Error as a Simulator of the camera does; (bad_input) for a distance or a reflectivity out of range
CameraReport camera_report(const Camera& camera, const CameraQuestion& question = {});

}  // namespace tofray
