// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>

#include "tofray/camera.h"
#include "yaml/tree.h"

/// Calibrations of other software as a profile's lens.
namespace tofray::load {

struct PixelGrid {
  int width = 0, height = 0;
  bool operator==(const PixelGrid&) const = default;
};

/// What such a file says of a lens. Pixel (0,0)'s centre is at (0.0, 0.0).
struct LensCalibration {
  std::string format;             ///< "OpenCV", "ROS camera_info", "Azure Kinect"
  Lens lens;                      ///< fx, fy, cx, cy and distortion alone
  std::optional<PixelGrid> size;  ///< of the images; none where the file does not say it
};

/// Reads what OpenCV's FileStorage writes as YAML or JSON (`camera_matrix` and `distortion_coefficients`, under the names that are usual),
/// what ROS's camera_calibration writes and `ros topic echo` prints of camera_info, and the raw calibration (JSON) of an Azure Kinect's depth
/// camera, whose numbers are shares of 1024 x 1024 pixels from the corner of the first one:
///
///     fx = W·f_x,  cx = W·c_x − crop − ½        W = 1024, or 512 of binned pixels
///
/// @param wanted  the image that is asked for; an Azure Kinect has one lens for several
/// @throws Error  naming what is missing, what is no distortion of ours (thin prism, tilt, …), and sizes that do not fit
LensCalibration lens_calibration(const std::string& text, const std::string& source, std::optional<PixelGrid> wanted);

/// A profile's text with that lens in the place of its own; f-number, transmission, vignetting and all else stay. Comments are lost.
/// @throws Error  where the profile, or the lens in it, is not good, or its sensor has another size
std::string profile_with_lens(const std::string& file_or_name, const LensCalibration& calibration, const std::string& source);

/// The block `lens` alone, as a profile has it.
std::string lens_block(const LensCalibration& calibration, const std::string& source);

/// Size of the sensor of a profile.
PixelGrid sensor_of(const std::string& file_or_name);

}  // namespace tofray::load
