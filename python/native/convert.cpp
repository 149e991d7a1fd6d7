// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "convert.h"

namespace tofray::python {

std::string shown(py::handle value) {
  const std::string type = py::str(py::type::of(value).attr("__name__"));
  if (py::hasattr(value, "dtype") && py::hasattr(value, "shape"))
    return std::string(py::str(value.attr("dtype"))) + " " + type + " of shape " + std::string(py::str(value.attr("shape")));
  constexpr std::size_t longest = 60;
  const py::object said = py::reinterpret_steal<py::object>(PyObject_ASCII(value.ptr()));
  if (!said) {
    PyErr_Clear();
    return "an object of type " + type;
  }
  std::string text = py::str(said);
  if (text.size() > longest) text = text.substr(0, longest) + "...";
  return text + " (" + type + ")";
}

void refuse(const Place& place, py::handle got, const std::string& expected) {
  throw Error(ErrorKind::bad_input, place.text() + ": error: got " + shown(got) + "\n  expected " + expected);
}

py::handle model_class(const char* name) {
  // Lives as long as the interpreter. No guarded static: an import may let other threads run, which would wait for the guard.
  static PyObject* all = nullptr;
  if (all == nullptr) all = PyModule_GetDict(py::module_::import("tofray._model").release().ptr());
  if (PyObject* const found = PyDict_GetItemString(all, name)) return found;
  // Raw, Geometry and so on are of other files; the package holds what it has given once.
  static PyObject* package = nullptr;
  if (package == nullptr) package = py::module_::import("tofray").release().ptr();
  return py::handle(package).attr(name).cast<py::object>().release().dec_ref();
}

py::object new_object(const char* name) {
  const py::handle type = model_class(name);
  return type.attr("__new__")(type);
}

py::handle held_name(std::string_view name) { return PyUnicode_InternFromString(std::string(name).c_str()); }

void check_class(py::handle value, const char* name, const Place& place) {
  if (!py::isinstance(value, model_class(name))) refuse(place, value, std::string("a tofray.") + name);
}

py::object member_of(py::handle value, py::handle name, const Place& place) {
  py::object member = py::getattr(value, name, py::object());
  if (!member) throw Error(ErrorKind::bad_input, place.text() + ": error: is not set");
  return member;
}

py::object As<std::string>::out(const std::string& value) {
  // A name out of a file may hold any bytes.
  return py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(value.data(), static_cast<Py_ssize_t>(value.size()), "surrogateescape"));
}

std::string from_text(py::handle value, const Place& place) {
  if (!PyUnicode_Check(value.ptr())) refuse(place, value, "a text (str)");
  const py::object bytes = py::reinterpret_steal<py::object>(PyUnicode_AsEncodedString(value.ptr(), "utf-8", "surrogateescape"));
  if (!bytes) {
    PyErr_Clear();
    refuse(place, value, "a text that UTF-8 can hold");
  }
  return {PyBytes_AsString(bytes.ptr()), static_cast<std::size_t>(PyBytes_Size(bytes.ptr()))};
}

double from_number(py::handle value, const Place& place) {
  const bool number = PyFloat_Check(value.ptr()) || PyIndex_Check(value.ptr()) ||
                      (PyNumber_Check(value.ptr()) && !PyComplex_Check(value.ptr()) && !py::hasattr(value, "shape"));
  const bool scalar = py::hasattr(value, "dtype") && py::hasattr(value, "ndim") && py::cast<int>(value.attr("ndim")) == 0;
  if ((!number && !scalar) || PyBool_Check(value.ptr())) refuse(place, value, "a number");
  const double out = PyFloat_AsDouble(value.ptr());
  if (out == -1.0 && PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(place, value, "a number");
  }
  return out;
}

bool from_bool(py::handle value, const Place& place) {
  const std::string type = Py_TYPE(value.ptr())->tp_name;
  if (!PyBool_Check(value.ptr()) && type != "numpy.bool_" && type != "numpy.bool") refuse(place, value, "True or False");
  return PyObject_IsTrue(value.ptr()) == 1;
}

namespace {

/// A whole number of Python's; never a float or a bool.
py::object whole(py::handle value, const Place& place, const std::string& expected) {
  py::object out;
  if (PyIndex_Check(value.ptr()) && !PyBool_Check(value.ptr())) out = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!out) {
    PyErr_Clear();
    refuse(place, value, expected);
  }
  return out;
}

}  // namespace

long long from_whole(py::handle value, const Place& place, long long least, long long most) {
  const std::string expected = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  int beyond = 0;
  const long long out = PyLong_AsLongLongAndOverflow(whole(value, place, expected).ptr(), &beyond);
  if (beyond != 0 || out < least || out > most) refuse(place, value, expected);
  return out;
}

unsigned long long from_natural(py::handle value, const Place& place) {
  const std::string expected = "a whole number from 0 to 18446744073709551615";
  const unsigned long long out = PyLong_AsUnsignedLongLong(whole(value, place, expected).ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(place, value, expected);
  }
  return out;
}

std::vector<py::object> items_of(py::handle value, const Place& place, const std::string& expected, int count) {
  // Texts are sequences of texts, and a dict of its keys: neither is meant.
  const bool list =
      PySequence_Check(value.ptr()) && !PyUnicode_Check(value.ptr()) && !PyBytes_Check(value.ptr()) && !PyDict_Check(value.ptr());
  py::object fast;
  if (list) fast = py::reinterpret_steal<py::object>(PySequence_Fast(value.ptr(), ""));
  if (!fast) {
    PyErr_Clear();
    refuse(place, value, expected);
  }
  std::vector<py::object> out;
  const Py_ssize_t size = PySequence_Fast_GET_SIZE(fast.ptr());
  if (count >= 0 && size != count) refuse(place, value, expected);
  out.reserve(static_cast<std::size_t>(size));
  // Converting an item may run Python's code, which may change the list: what is kept here is held.
  for (Py_ssize_t i = 0; i < size; ++i) out.push_back(py::reinterpret_borrow<py::object>(PySequence_Fast_GET_ITEM(fast.ptr(), i)));
  return out;
}

}  // namespace tofray::python
