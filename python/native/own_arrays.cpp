// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "own_arrays.h"

#include "arrays.h"

namespace tofray::python {

namespace {

int whole(py::ssize_t size) { return static_cast<int>(size); }  // require_array() lets no longer axis pass

/// The arrays of one object, which may have an axis of moments before the others or not.
struct Own {
  py::handle value;
  std::string what;
  bool moments = false;

  [[nodiscard]] py::object part(const char* name) const { return value.attr(name); }
  [[nodiscard]] Place place(const char* name) const { return {nullptr, what + "." + name}; }
  /// Whether the first array has that axis, which the others then have, too.
  void look(const char* name, py::ssize_t axes) {
    const py::object first = part(name);
    moments = py::isinstance<py::array>(first) && first.cast<py::array>().ndim() == axes + 1;
  }
  template <class T>
  void get(const char* name, std::vector<Extent> wanted, py::ssize_t moment_count, std::vector<T>& into, Shape* shape = nullptr) const {
    const py::object one = part(name);
    if (one.is_none()) return;
    if (moments) wanted.insert(wanted.begin(), {moment_count, "moments"});
    into = take<T>(one, wanted, place(name), shape);
  }
};

}  // namespace

Geometry geometry_from_python(py::handle value) {
  Own own{value, "Geometry"};
  own.look("z_m", 2);
  Geometry out;
  Shape shape;
  const Extent any_h{-1, "height"}, any_w{-1, "width"};
  own.get("z_m", {any_h, any_w}, -1, out.z_m, &shape);
  if (shape.empty()) refuse(own.place("z_m"), own.part("z_m"), "a float32 array of shape (height, width) or (moments, height, width)");
  const py::ssize_t moments = own.moments ? shape[0] : 1;
  const Extent h{shape[shape.size() - 2], "height"}, w{shape[shape.size() - 1], "width"}, lights{-1, "lights"};
  out.moments = whole(moments), out.height = whole(h.size), out.width = whole(w.size);
  own.get("normal", {h, w, {3, ""}}, moments, out.normal);
  own.get("diffuse", {h, w}, moments, out.diffuse);
  own.get("specular", {h, w}, moments, out.specular);
  own.get("exponent", {h, w}, moments, out.exponent);
  own.get("object_id", {h, w}, moments, out.object_id);
  own.get("shadow", {lights, h, w}, moments, out.shadow);
  own.get("sun_shadow", {h, w}, moments, out.sun_shadow);
  return out;
}

PixelLight light_from_python(py::handle value) {
  Own own{value, "PixelLight"};
  own.look("power_w", 3);
  PixelLight out;
  Shape shape;
  own.get("power_w", {{-1, "paths"}, {-1, "height"}, {-1, "width"}}, -1, out.power_w, &shape);
  if (shape.empty())
    refuse(own.place("power_w"), own.part("power_w"), "a float32 array of shape (paths, height, width) or (moments, paths, height, width)");
  const py::ssize_t moments = own.moments ? shape[0] : 1;
  const Extent paths{shape[shape.size() - 3], "paths"}, h{shape[shape.size() - 2], "height"}, w{shape[shape.size() - 1], "width"};
  out.moments = whole(moments), out.height = whole(h.size), out.width = whole(w.size);
  own.get("path_length_m", {paths, h, w}, moments, out.path_length_m);
  own.get("phasor_w", {paths, {-1, "modulation frequencies"}, {-1, "harmonics"}, h, w}, moments, out.phasor_w);
  own.get("ambient_e_per_s", {h, w}, moments, out.ambient_e_per_s);
  if (!own.part("light_of_path").is_none()) from_python(own.part("light_of_path"), out.light_of_path, own.place("light_of_path"));
  return out;
}

Transient transient_from_python(py::handle value) {
  const Own own{value, "Transient"};
  Transient out;
  Shape shape;
  own.get("e_per_s", {{-1, "bins"}, {-1, "height"}, {-1, "width"}}, 0, out.e_per_s, &shape);
  if (shape.empty()) refuse(own.place("e_per_s"), own.part("e_per_s"), "a float32 array of shape (bins, height, width)");
  out.bins = whole(shape[0]), out.height = whole(shape[1]), out.width = whole(shape[2]);
  own.get("ambient_e_per_s", {{shape[1], "height"}, {shape[2], "width"}}, 0, out.ambient_e_per_s);
  from_python(own.part("first_m"), out.first_m, own.place("first_m"));
  from_python(own.part("bin_width_m"), out.bin_width_m, own.place("bin_width_m"));
  return out;
}

}  // namespace tofray::python
