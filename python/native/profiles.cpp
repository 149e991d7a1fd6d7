// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "profiles.h"

#include "convert.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

/// Source, text, numbers by key, and line and column by key.
py::tuple profile_of(const py::object& file, const py::object& mode, const py::dict& set) {
  CameraOptions options;
  from_python(mode, options.mode, {nullptr, "mode"});
  for (const auto& [key, value] : set) options.set.emplace_back(from_text(key, {nullptr, "set"}), from_text(value, {nullptr, "set"}));
  const std::string name = from_text(file, {nullptr, "file"});
  ProfileFile of;
  {
    const py::gil_scoped_release free;
    of = profile_file(name, options);
  }
  py::dict numbers, places;
  for (const ProfileNumber& one : of.numbers)
    numbers[one.key.c_str()] = py::make_tuple(one.unit, one.value, one.low, one.high, one.whole, one.assumed);
  for (const ProfilePlace& one : of.places) places[one.key.c_str()] = py::make_tuple(one.line, one.column);
  return py::make_tuple(of.source, of.text, numbers, places);
}

}  // namespace

void bind_profiles(py::module_& module) { module.def("profile_file", &profile_of); }

}  // namespace tofray::python
