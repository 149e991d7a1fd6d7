// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/picture_map.h"

#include <algorithm>
#include <vector>

#include "base/srgb.h"

namespace tofray::assets {

namespace {

/// Of all 16-bit samples.
const std::vector<float>& linear_of_srgb() {
  static const std::vector<float> table = [] {
    std::vector<float> out(65536);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i] = static_cast<float>(base::linear_of_srgb(static_cast<double>(i) / 65535));
    }
    return out;
  }();
  return table;
}

}  // namespace

double luminance_at(const image::Image& picture, int x, int y, const std::array<double, 3>& color) {
  const std::vector<float>& linear = linear_of_srgb();
  const auto sample = [&](int channel) { return static_cast<double>(linear[picture.at(x, y, picture.channels < 3 ? 0 : channel)]); };
  return luminance(color[0] * sample(0), color[1] * sample(1), color[2] * sample(2));
}

PictureMap map_of_picture(const image::Image& picture, const std::array<double, 3>& color, const ReflectivityMap* opacity) {
  const auto map = std::make_shared<ReflectivityMap>();
  map->width = picture.width, map->height = picture.height;
  map->values.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  float brightest = 0;
  double sum = 0;
  std::size_t seen = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto value = static_cast<float>(luminance_at(picture, x, y, color));
      if (opacity == nullptr || opacity->values[map->values.size()] >= 0.5F)
        brightest = std::max(brightest, value), sum += static_cast<double>(value), ++seen;
      map->values.push_back(value);
    }
  if (brightest > 0)
    for (float& value : map->values) value = std::min(value / brightest, 1.0F);
  return {map, static_cast<double>(brightest), sum / static_cast<double>(std::max<std::size_t>(seen, 1))};
}

}  // namespace tofray::assets
