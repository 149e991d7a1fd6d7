// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// tofray_rows: what the model's rows say of members, for python/tools/make_model.py and tests. A module of its own, which is not installed:
// who runs the package has it in docstrings.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "model/member_rows.h"

namespace tofray::python {

namespace {

namespace py = pybind11;

py::list rows() {
  py::list all;
  for (const model::MemberRow& row : model::member_rows().rows) {
    py::dict one;
    one["struct"] = row.record, one["member"] = row.member, one["key"] = row.key, one["doc"] = row.doc, one["group"] = row.group;
    one["tag"] = row.tag, one["kinds"] = row.kinds, one["may_be_absent"] = row.may_be_absent;
    py::list numbers;
    for (const model::MemberNumbers& each : row.numbers) numbers.append(py::make_tuple(each.name, each.unit, each.low, each.high));
    one["numbers"] = numbers;
    all.append(one);
  }
  return all;
}

/// (struct, member) of those that no user sets.
py::list without_row() {
  py::list all;
  for (const std::string& name : model::member_rows().without_row) {
    const std::size_t colon = name.find(':');
    all.append(py::make_tuple(name.substr(0, colon), name.substr(colon + 2)));
  }
  return all;
}

}  // namespace

PYBIND11_MODULE(tofray_rows, module) {
  module.def("rows", &rows);
  module.def("without_row", &without_row);
}

}  // namespace tofray::python
