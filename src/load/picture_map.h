// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <memory>

#include "image/read_image.h"
#include "tofray/scene.h"

/// Visible colours as reflectivities, out of glTF and MTL files.
namespace tofray::load {

/// Relative luminance (ITU-R BT.709) of linear red, green and blue, 1 at most.
double luminance(double red, double green, double blue);

/// A picture of colours as one of reflectivities: the luminance of each texel, decoded from sRGB, times a linear colour, over the brightest
/// one.
struct PictureMap {
  std::shared_ptr<ReflectivityMap> map;
  double brightest = 0, mean = 0;  ///< of the texels
};
PictureMap map_of_picture(const image::Image& picture, const std::array<double, 3>& color);

}  // namespace tofray::load
