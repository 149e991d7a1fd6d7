// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/ply.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>

namespace tofray::results {

std::string cloud_ply(const Depth& depth) {
  std::string vertices;
  std::size_t count = 0;
  for (std::size_t i = 0; i < depth.z_m.size(); ++i) {
    if (!std::isfinite(depth.z_m[i])) continue;
    const float numbers[4] = {depth.points_m[3 * i], depth.points_m[3 * i + 1], depth.points_m[3 * i + 2], depth.amplitude_e[i]};
    char bytes[sizeof numbers];
    std::memcpy(bytes, numbers, sizeof numbers);
    vertices.append(bytes, sizeof bytes);
    vertices += static_cast<char>(depth.confidence[i]);
    ++count;
  }
  const std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "comment tofray: the valid points of {} x {} pixels; x right, y down, z forward; metres, electrons\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nproperty float amplitude\nproperty uchar "
      "confidence\nend_header\n",
      depth.width, depth.height, count);
  return header + vertices;
}

}  // namespace tofray::results
