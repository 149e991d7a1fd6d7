// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/picture_map.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tofray::load {

namespace {

/// IEC 61966-2-1, of all 16-bit samples.
const std::vector<float>& linear_of_srgb() {
  static const std::vector<float> table = [] {
    std::vector<float> out(65536);
    for (std::size_t i = 0; i < out.size(); ++i) {
      const double a = static_cast<double>(i) / 65535;
      out[i] = static_cast<float>(a <= 0.04045 ? a / 12.92 : std::pow((a + 0.055) / 1.055, 2.4));
    }
    return out;
  }();
  return table;
}

}  // namespace

double luminance(double red, double green, double blue) { return std::min(0.2126 * red + 0.7152 * green + 0.0722 * blue, 1.0); }

PictureMap map_of_picture(const image::Image& picture, const std::array<double, 3>& color) {
  const auto map = std::make_shared<ReflectivityMap>();
  map->width = picture.width, map->height = picture.height;
  map->values.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const std::vector<float>& linear = linear_of_srgb();
  float brightest = 0;
  double sum = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto sample = [&](int channel) { return static_cast<double>(linear[picture.at(x, y, picture.channels < 3 ? 0 : channel)]); };
      const auto value = static_cast<float>(luminance(color[0] * sample(0), color[1] * sample(1), color[2] * sample(2)));
      brightest = std::max(brightest, value), sum += static_cast<double>(value);
      map->values.push_back(value);
    }
  if (brightest > 0)
    for (float& value : map->values) value = std::min(value / brightest, 1.0F);
  return {map, static_cast<double>(brightest), sum / static_cast<double>(map->values.size())};
}

}  // namespace tofray::load
