// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/numpy.h>

#include <complex>
#include <string>
#include <vector>

#include "convert.h"

/// numpy's arrays: ours as views that keep their memory alive, others' as they lie or not at all.
namespace tofray::python {

using Shape = std::vector<py::ssize_t>;

/// Of a shape that is wanted: any number. Its letter stands in messages.
struct Extent {
  py::ssize_t size;  ///< −1: any
  const char* letter;
};

/// Refuses what is no numpy array of this type and order, with as many axes as `wanted`. What numpy could convert is refused, too: nobody
/// shall pay for a copy of gigabytes, or lose digits, without having asked.
/// @return its shape
Shape require_array(py::handle value, const py::dtype& type, const std::vector<Extent>& wanted, const Place& place);

template <class T>
py::dtype dtype_of() {
  return py::dtype::of<T>();
}

/// The array's values.
template <class T>
std::vector<T> take(py::handle value, const std::vector<Extent>& wanted, const Place& place, Shape* shape = nullptr) {
  const Shape found = require_array(value, dtype_of<T>(), wanted, place);
  if (shape != nullptr) *shape = found;
  const auto array = py::reinterpret_borrow<py::array>(value);
  const T* const first = static_cast<const T*>(array.data());
  return std::vector<T>(first, first + array.size());
}

/// A view of memory that `keeper` holds.
template <class T>
py::array view(const T* first, const Shape& shape, py::handle keeper, bool writeable) {
  py::array out(dtype_of<T>(), shape, {}, first, keeper);
  if (!writeable) py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

}  // namespace tofray::python
