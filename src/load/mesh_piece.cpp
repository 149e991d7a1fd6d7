// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/mesh_piece.h"

#include <algorithm>
#include <string_view>

#include "base/limits.h"
#include "base/text.h"

namespace tofray::load {

namespace {
constexpr std::size_t longest_material_name = 200;
}

void count_texels(int width, int height, const base::Place& place, std::size_t& texels) {
  texels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texels <= static_cast<std::size_t>(base::limit::map_pixels.value)) return;
  base::fail(place, "the scene's meshes wear too many pixels of pictures",
             "at most " + std::to_string(base::limit::map_pixels.value) + " in all (`tofray --limits`), once for each material",
             ErrorKind::limit);
}

std::string shown_name(const std::string& name) {
  std::size_t end = 0;
  while (end < name.size() && end < longest_material_name) end += std::max<std::size_t>(base::utf8_length(name, end), 1);
  return base::printable(std::string_view(name).substr(0, end));
}

}  // namespace tofray::load
