// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "datasets.h"

#include "convert.h"
#include "tofray/dataset.h"

namespace tofray::python {

void bind_datasets(py::module_& module) {
  py::class_<Dataset>(module, "Dataset")
      .def(py::init([](const std::string& file) {
        const py::gil_scoped_release free;
        return Dataset(file);
      }))
      .def_property_readonly("name", &Dataset::name)
      .def_property_readonly("license", &Dataset::license)
      .def_property_readonly("samples", &Dataset::samples)
      .def_property_readonly("views", &Dataset::views)
      .def_property_readonly("combinations", &Dataset::combinations)
      .def("scene_yaml", &Dataset::scene_yaml, py::call_guard<py::gil_scoped_release>())
      .def("scene",
           [](const Dataset& set, std::uint64_t sample, std::uint64_t view) {
             Scene scene;
             {
               const py::gil_scoped_release free;
               scene = set.scene(sample, view);
             }
             return to_python(scene);
           })
      .def("drawn",
           [](const Dataset& set, std::uint64_t sample, std::uint64_t view) {
             py::list out;
             for (const Drawn& one : set.drawn(sample, view)) out.append(py::make_tuple(one.path, one.form, one.text, one.value));
             return out;
           })
      .def("noise_seed", &Dataset::noise_seed)
      .def("split", &Dataset::split);
}

}  // namespace tofray::python
