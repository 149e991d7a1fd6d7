// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/mesh_piece.h"

#include <algorithm>
#include <string_view>

#include "base/limits.h"
#include "base/text.h"

namespace tofray::assets {

namespace {
constexpr std::size_t longest_material_name = 200;

std::string and_more(const std::vector<std::string>& names) {
  return base::in_quotes(names[0]) + (names.size() > 1 ? " and " + std::to_string(names.size() - 1) + " more" : std::string());
}
}  // namespace

void count_texels(int width, int height, const base::Place& place, std::size_t& texels) {
  texels += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (texels <= static_cast<std::size_t>(base::limit::map_pixels.value)) return;
  base::fail(place, "the scene's meshes wear too many pixels of pictures",
             "at most " + std::to_string(base::limit::map_pixels.value) + " in all (`tofray --limits`), once for each material",
             ErrorKind::limit);
}

void count_pictures(const Material& material, const base::Place& place, std::size_t& texels) {
  const auto count = [&](const auto& map) {
    if (map != nullptr) count_texels(map->width, map->height, place, texels);
  };
  count(material.map), count(material.normals), count(material.finish), count(material.opacity);
}

std::vector<std::string> notices_of(const std::vector<const FileMaterial*>& materials) {
  using From = FileMaterial::From;
  std::vector<std::string> out, colourless, finishes, colors, normals, through, alphas;
  bool without = false;
  for (const FileMaterial* one : materials) {
    without = without || one->from == From::nothing;
    if (one->from == From::colourless) colourless.push_back(one->name);
    if (one->mean_finish) finishes.push_back(one->name);
    if (one->mean_color) colors.push_back(one->name);
    if (one->lost_normals) normals.push_back(one->name);
    if (one->lets_through) through.push_back(one->name);
    if (one->lost_alpha) alphas.push_back(one->name);
  }
  if (without) out.emplace_back("triangles without a material get a reflectivity of 0.5");
  if (!colourless.empty()) out.push_back("no MTL file says a colour of material " + and_more(colourless) + ": a reflectivity of 0.5");
  if (!finishes.empty()) out.push_back("metal and roughness of material " + and_more(finishes) + " are the means of a picture");
  if (!colors.empty()) out.push_back("colours of vertices vary at material " + and_more(colors) + ": of what is metal their mean is used");
  if (!normals.empty())
    out.push_back("the picture of normals of material " + and_more(normals) +
                  " is left out: it is grey, or lies elsewhere on the triangles than the first picture");
  if (!through.empty())
    out.push_back(
        "material " + and_more(through) +
        " lets light through in part (alphaMode BLEND): it is a surface where its alpha is 0.5 or more, and nothing where it is less");
  if (!alphas.empty())
    out.push_back("material " + and_more(alphas) +
                  " is cut out by alphas of vertices, or by a picture without texture coordinates: they are left out");
  return out;
}

std::string shown_name(const std::string& name) {
  std::size_t end = 0;
  while (end < name.size() && end < longest_material_name) end += std::max<std::size_t>(base::utf8_length(name, end), 1);
  return base::printable(std::string_view(name).substr(0, end));
}

}  // namespace tofray::assets
