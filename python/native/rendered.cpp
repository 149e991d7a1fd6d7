// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "rendered.h"

#include <span>
#include <utility>

#include "arrays.h"
#include "convert.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

/// The values of an array where they lie, which its caller holds; nothing for None.
template <class T>
std::span<const T> lying(const py::dict& words, const char* name, std::vector<Extent> wanted) {
  const py::object value = words[name];
  if (value.is_none()) return {};
  require_array(value, dtype_of<T>(), wanted, {nullptr, name});
  const auto array = py::reinterpret_borrow<py::array>(value);
  return {static_cast<const T*>(array.data()), static_cast<std::size_t>(array.size())};
}

template <class T>
void word(const py::dict& words, const char* name, T& into) {
  from_python(words[name], into, {nullptr, name});
}

/// Of numbers that nobody copies.
template <class T>
py::object given_away(std::vector<T>&& values, Shape shape) {
  if (values.empty()) return py::none();
  auto* const kept = new std::vector<T>(std::move(values));
  const py::capsule keeper(kept, [](void* at) { delete static_cast<std::vector<T>*>(at); });
  return view<T>(kept->data(), shape, keeper, true);
}

/// @return the arrays of a Geometry, and notices. Of one moment they have no axis of it
py::tuple from_pictures_of(const py::object& camera, const py::dict& words, bool by_moments) {
  Camera one;
  from_python(camera, one, {nullptr, "camera"});
  RenderedPictures given;
  word(words, "pinhole", given.pinhole), word(words, "moments", given.moments), word(words, "still", given.still);
  word(words, "along_ray", given.along_ray), word(words, "background", given.background_m), word(words, "normal_axes", given.normal_axes);
  word(words, "other_reflectivity", given.other_reflectivity);
  std::vector<std::pair<int, Material>> materials;
  word(words, "materials", materials);
  for (auto& [label, material] : materials) given.materials.push_back({label, std::move(material)});
  const Extent moments{given.moments, ""}, h{given.pinhole.height, ""}, w{given.pinhole.width, ""}, three{3, ""};
  given.z_m = lying<float>(words, "z", {moments, h, w}), given.normal = lying<float>(words, "normal", {moments, h, w, three});
  given.labels = lying<std::int32_t>(words, "labels", {moments, h, w});
  given.reflectivity = lying<float>(words, "reflectivity", {moments, h, w});
  given.colour = lying<float>(words, "colour", {moments, h, w, three});
  given.screen_colour = lying<std::uint8_t>(words, "screen_colour", {moments, h, w, three});
  SampledPictures out;
  {
    const py::gil_scoped_release free;
    out = from_pictures(one, given);
  }
  Geometry& seen = out.geometry;
  Shape image{seen.height, seen.width};
  if (by_moments) image.insert(image.begin(), seen.moments);
  Shape vectors = image;
  vectors.push_back(3);
  return py::make_tuple(given_away(std::move(seen.z_m), image), given_away(std::move(seen.normal), vectors),
                        given_away(std::move(seen.diffuse), image), given_away(std::move(seen.specular), image),
                        given_away(std::move(seen.exponent), image), given_away(std::move(seen.object_id), image), to_python(out.notices));
}

}  // namespace

void bind_rendered(py::module_& module) {
  module.def("from_pictures", &from_pictures_of);
  module.def("pinhole_for", [](const py::object& camera, double margin, double oversample, double pixel_centre) {
    Camera one;
    from_python(camera, one, {nullptr, "camera"});
    return to_python(pinhole_for(one, margin, oversample, pixel_centre));
  });
  module.def("load_material", [](const py::object& name) { return to_python(load_material(from_text(name, {nullptr, "name"}))); });
}

}  // namespace tofray::python
