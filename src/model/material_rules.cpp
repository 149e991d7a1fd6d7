// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a material's numbers and its pictures have to keep to.
#include <algorithm>
#include <cmath>
#include <string>

#include "base/text.h"
#include "model/rules.h"

namespace tofray::model {

using base::number_text;

namespace {

/// @return whether there is a value for each pixel
template <class Map, class Complain>
bool has_its_size(const Map& map, const std::string& name, const Complain& complain) {
  if (map.width < 1 || map.height < 1 || map.width > 32767 || map.height > 32767) {
    complain("the " + name + " has no size that it may have",
             "got " + std::to_string(map.width) + " x " + std::to_string(map.height) + ", expected 1 to 32767 each");
    return false;
  }
  const auto pixels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  if (map.values.size() == pixels) return true;
  complain("the " + name + " has not as many values as pixels",
           "got " + std::to_string(map.values.size()) + ", expected " + std::to_string(pixels));
  return false;
}

template <class Complain>
void check_map(const ReflectivityMap& map, const std::string& name, const Complain& complain) {
  if (!has_its_size(map, name, complain)) return;
  const auto bad = std::find_if(map.values.begin(), map.values.end(), [](float a) { return !(a >= 0 && a <= 1); });
  if (bad != map.values.end())
    complain("value " + std::to_string(bad - map.values.begin()) + " of the " + name + " is out of range",
             "got " + number_text(static_cast<double>(*bad)) + ", expected 0 to 1");
}

std::string texel_text(const std::array<float, 3>& texel) {
  const auto text = [&](std::size_t k) { return number_text(static_cast<double>(texel[k])); };
  return "got [" + text(0) + ", " + text(1) + ", " + text(2) + "]";
}

template <class Complain>
void check_normals(const VectorMap& map, const Complain& complain) {
  if (!has_its_size(map, "map of normals", complain)) return;
  const auto bad = std::find_if(map.values.begin(), map.values.end(), [](const std::array<float, 3>& n) {
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return !(n[2] > 0 && length >= 0.5F && length <= 1.5F);
  });
  if (bad != map.values.end())
    complain("value " + std::to_string(bad - map.values.begin()) + " of the map of normals is no direction out of the surface",
             texel_text(*bad) + ", expected a third number above 0 and a length of 0.5 to 1.5");
}

template <class Complain>
void check_finish(const Material& material, const Complain& complain) {
  const VectorMap& map = *material.finish;
  if (material.brdf != Material::Brdf::ggx)
    return complain("the material has a map of its finish", "expected the brdf ggx, or no such map");
  if (!has_its_size(map, "map of the finish", complain)) return;
  const auto is_share = [](float a) { return a >= 0 && a <= 1; };
  const auto bad = std::find_if(map.values.begin(), map.values.end(), [&](const std::array<float, 3>& of) {
    return !(is_share(of[0]) && is_share(of[1]) && of[2] >= 0.001F && of[2] <= 1);
  });
  if (bad != map.values.end())
    complain("value " + std::to_string(bad - map.values.begin()) + " of the map of the finish is out of range",
             texel_text(*bad) + ", expected k_d and F_0 of 0 to 1 and an alpha of 0.001 to 1");
}

}  // namespace

void materials_send_back_no_more_than_they_get(const Material& material, Complaints& complaints) {
  const auto complain = [&](const std::string& what, const std::string& more) { complaints.add(material, nullptr, what, more); };
  if (material.map != nullptr) check_map(*material.map, "reflectivity map", complain);
  if (material.opacity != nullptr) check_map(*material.opacity, "map of opacity", complain);
  if (material.normals != nullptr) check_normals(*material.normals, complain);
  if (material.finish != nullptr) check_finish(material, complain);
  const auto together = [&](const char* which, double lobe) {
    if (material.diffuse + lobe > 1 + 1e-12)
      complaints.add(
          material, nullptr, std::string("diffuse + ") + which + " is more than 1",
          "got " + number_text(material.diffuse) + " + " + number_text(lobe) + "; a surface cannot send back more light than it gets");
  };
  if (material.brdf == Material::Brdf::retro) return together("retro", material.retro);
  if (material.brdf != Material::Brdf::ggx) together("specular", material.specular);
}

}  // namespace tofray::model
