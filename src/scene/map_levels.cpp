// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/map_levels.h"

#include <algorithm>
#include <cstdint>
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

/// 1 for each texel of a picture of this size whose middle lies where there is a surface, else 0.
std::vector<float> covered_by(const ReflectivityMap& opacity, int width, int height) {
  std::vector<float> out;
  out.reserve(index_of(height, width, 0));
  const auto at = [](int i, int size, int of) { return static_cast<int>((2 * std::int64_t{i} + 1) * of / (2 * std::int64_t{size})); };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out.push_back(opacity.values[index_of(at(y, height, opacity.height), opacity.width, at(x, width, opacity.width))] >= 0.5F ? 1.0F
                                                                                                                                : 0.0F);
  return out;
}

}  // namespace

MapLevels::MapLevels(std::vector<float> values, int width, int height, ReflectivityMap::Wrap wrap_u, ReflectivityMap::Wrap wrap_v,
                     const ReflectivityMap* opacity, int most)
    : texels(std::move(values)) {
  std::vector<float> covered;  // share of each texel
  if (opacity != nullptr) covered = covered_by(*opacity, width, height);
  view.wrap[0] = static_cast<std::int32_t>(wrap_u), view.wrap[1] = static_cast<std::int32_t>(wrap_v);
  for (std::size_t start = 0;;) {
    const int level = view.levels++;
    view.start[level] = static_cast<std::int32_t>(start), view.width[level] = width, view.height[level] = height;
    if ((width == 1 && height == 1) || view.levels == most) break;
    const int columns = std::max(1, width / 2), rows = std::max(1, height / 2);
    const std::size_t next = texels.size();
    texels.resize(next + index_of(rows, columns, 0));
    if (opacity != nullptr) covered.resize(texels.size());
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x) {
        double mean = 0, weight = 0;
        each_share(height, rows, y, [&](int row, double of_row) {
          each_share(width, columns, x, [&](int column, double of_column) {
            const std::size_t i = start + index_of(row, width, column);
            const double share = of_row * of_column * (opacity != nullptr ? static_cast<double>(covered[i]) : 1);
            mean += share * static_cast<double>(texels[i]), weight += share;
          });
        });
        if (opacity != nullptr) {
          covered[next + index_of(y, columns, x)] = static_cast<float>(weight);
          mean = weight > 0 ? mean / weight : 0;
        }
        texels[next + index_of(y, columns, x)] = static_cast<float>(mean);
      }
    start = next, width = columns, height = rows;
  }
  view.texel_count = static_cast<std::int32_t>(texels.size());
  view.texels = texels.data();
  if (opacity != nullptr) give_means(covered);
}

/// Texels without a surface get what the one above them has, whose mean is that of a wider neighbourhood.
void MapLevels::give_means(const std::vector<float>& covered) {
  for (int level = view.levels - 2; level >= 0; --level) {
    const int width = view.width[level], height = view.height[level], columns = view.width[level + 1], rows = view.height[level + 1];
    const auto start = static_cast<std::size_t>(view.start[level]), above = static_cast<std::size_t>(view.start[level + 1]);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const std::size_t i = start + index_of(y, width, x);
        if (covered[i] > 0) continue;
        const auto in = [](int k, int size, int of) { return static_cast<int>(std::int64_t{k} * of / size); };
        texels[i] = texels[above + index_of(in(y, height, rows), columns, in(x, width, columns))];
      }
  }
}

}  // namespace tofray::scene
