// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "tofray/camera.h"

namespace tofray::camera {

/// The camera whose pixels are those of the image: region and binning are in its numbers, and nothing is left to be binned. What deals with the
/// image's pixels takes this type, so that a profile, whose pixels are the sensor's, cannot take its place. Wherever a profile will do, this
/// will, too: a camera that reads all of its pixels one by one is its own image's.  [theory: image-pixels, binned-charge, binned-patterns]
struct ImageCamera : Camera {
  ImageCamera() = default;  ///< a profile's defaults: all pixels are read, one by one
  /// @param profile  was seen to be good
  explicit ImageCamera(const Camera& profile);
};

}  // namespace tofray::camera
