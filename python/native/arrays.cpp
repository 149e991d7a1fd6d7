// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

namespace tofray::python {

namespace {

std::string wanted_text(const py::dtype& type, const std::vector<Extent>& wanted) {
  std::string shape;
  for (const Extent& one : wanted) shape += (shape.empty() ? "" : ", ") + (one.size < 0 ? one.letter : std::to_string(one.size));
  if (wanted.size() == 1) shape += ",";
  const std::string name = py::str(type.attr("name"));
  return "a " + name + " array of shape (" + shape + "), in C order; as in np.ascontiguousarray(x, dtype=np." + name + ")";
}

}  // namespace

Shape require_array(py::handle value, const py::dtype& type, const std::vector<Extent>& wanted, const Place& place) {
  const std::string expected = wanted_text(type, wanted);
  if (!py::isinstance<py::array>(value)) refuse(place, value, expected);
  // A masked array's mask, or a matrix's own rules, would be lost without a word.
  const std::string kind = py::str(py::type::of(value).attr("__name__"));
  if (kind != "ndarray" && kind != "memmap") refuse(place, value, expected);
  const auto array = py::reinterpret_borrow<py::array>(value);
  if (!array.dtype().equal(type)) refuse(place, value, expected);
  bool fits = array.ndim() == static_cast<py::ssize_t>(wanted.size());
  for (std::size_t i = 0; fits && i < wanted.size(); ++i)
    fits = wanted[i].size < 0 || array.shape(static_cast<py::ssize_t>(i)) == wanted[i].size;
  if (!fits) refuse(place, value, expected);
  const int flags = array.flags();
  if ((flags & py::array::c_style) == 0)
    throw Error(ErrorKind::bad_input,
                place.text() + ": error: got " + shown(value) + " that does not lie in C order\n  expected " + expected);
  if ((flags & py::detail::npy_api::NPY_ARRAY_ALIGNED_) == 0)
    throw Error(ErrorKind::bad_input, place.text() + ": error: got " + shown(value) + " that is not aligned\n  expected x.copy()");
  constexpr py::ssize_t most = std::numeric_limits<int>::max();
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    if (array.shape(i) > most) refuse(place, value, "at most 2147483647 values along an axis");
  return Shape(array.shape(), array.shape() + array.ndim());
}

}  // namespace tofray::python
