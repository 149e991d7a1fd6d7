// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/map_levels.h"

#include <algorithm>
#include <utility>

namespace tofray::scene {

namespace {

std::size_t index_of(int row, int width, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
}

/// Calls add(texel, share) for the texels of a line of `from` that make texel `i` of a line of `to`; the shares' sum is 1.
template <class Add>
void each_share(int from, int to, int i, const Add& add) {
  const double low = static_cast<double>(from) * i / to, high = static_cast<double>(from) * (i + 1) / to;
  for (int k = static_cast<int>(low); k < from && k < high; ++k)
    add(k, (std::min(high, k + 1.0) - std::max(low, static_cast<double>(k))) / (high - low));
}

}  // namespace

MapLevels::MapLevels(std::vector<float> values, int width, int height, ReflectivityMap::Wrap wrap_u, ReflectivityMap::Wrap wrap_v)
    : texels(std::move(values)) {
  view.wrap[0] = static_cast<std::int32_t>(wrap_u), view.wrap[1] = static_cast<std::int32_t>(wrap_v);
  for (std::size_t start = 0;;) {
    const int level = view.levels++;
    view.start[level] = static_cast<std::int32_t>(start), view.width[level] = width, view.height[level] = height;
    if ((width == 1 && height == 1) || view.levels == brdf::most_map_levels) break;
    const int columns = std::max(1, width / 2), rows = std::max(1, height / 2);
    const std::size_t next = texels.size();
    texels.resize(next + index_of(rows, columns, 0));
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        double mean = 0;
        each_share(height, rows, y, [&](int row, double of_row) {
          each_share(width, columns, x, [&](int column, double of_column) {
            mean += of_row * of_column * static_cast<double>(texels[start + index_of(row, width, column)]);
          });
        });
        texels[next + index_of(y, columns, x)] = static_cast<float>(mean);
      }
    start = next, width = columns, height = rows;
  }
  view.texel_count = static_cast<std::int32_t>(texels.size());
  view.texels = texels.data();
}

}  // namespace tofray::scene
