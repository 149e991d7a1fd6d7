// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <memory>

#include "base/srgb.h"
#include "image/read_image.h"
#include "tofray/scene.h"

/// Visible colours as reflectivities, out of glTF and MTL files.
namespace tofray::assets {

using base::luminance;

/// Of a texel, decoded from sRGB, times a linear colour.
double luminance_at(const image::Image& picture, int x, int y, const std::array<double, 3>& color);

/// A picture of colours as one of reflectivities: the luminance of each texel, decoded from sRGB, times a linear colour, over the brightest
/// one.
/// @param opacity  of its size: texels below ½ are not asked which is brightest, nor for the mean. Null: there are none
struct PictureMap {
  std::shared_ptr<ReflectivityMap> map;
  double brightest = 0, mean = 0;  ///< of the texels
};
PictureMap map_of_picture(const image::Image& picture, const std::array<double, 3>& color, const ReflectivityMap* opacity = nullptr);

}  // namespace tofray::assets
