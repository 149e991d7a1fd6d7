// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <pybind11/pybind11.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "members.h"
#include "tofray/tofray.h"

/// The public structs to objects of tofray._model and back. Python's objects are Python's own: none of them points into a C++ struct.
namespace tofray::python {

namespace py = pybind11;

/// Where a value stands, for messages: "scene.objects[2].shape.radius".
struct Place {
  const Place* in = nullptr;
  std::string name;
  [[nodiscard]] std::string text() const { return in == nullptr ? name : in->text() + name; }
};

/// "float64 array of shape (3, 3)", "'abc' (str)": what was got, short.
std::string shown(py::handle value);
/// @throws Error (bad_input)
[[noreturn]] void refuse(const Place& place, py::handle got, const std::string& expected);
/// A class of tofray._model, or another one of the package.
py::handle model_class(const char* name);
/// A new one whose members are not set.
py::object new_object(const char* name);
/// A name as Python has it, which lives as long as the interpreter.
py::handle held_name(std::string_view name);
/// @throws Error (bad_input) unless the value is of that class of tofray._model
void check_class(py::handle value, const char* name, const Place& place);
/// @throws Error (bad_input) where it is not set
py::object member_of(py::handle value, py::handle name, const Place& place);

std::string from_text(py::handle value, const Place& place);
double from_number(py::handle value, const Place& place);
bool from_bool(py::handle value, const Place& place);
long long from_whole(py::handle value, const Place& place, long long least, long long most);
unsigned long long from_natural(py::handle value, const Place& place);
/// The items of a list, a tuple, or an array of one dimension. @param count  so many; −1: any number
std::vector<py::object> items_of(py::handle value, const Place& place, const std::string& expected, int count = -1);

py::object mesh_to_python(const std::shared_ptr<const TriangleMesh>& mesh);
py::object map_to_python(const std::shared_ptr<const ReflectivityMap>& map);
py::object vectors_to_python(const std::shared_ptr<const VectorMap>& map);
py::object motion_to_python(const std::shared_ptr<const MeshMotion>& motion);
std::shared_ptr<const TriangleMesh> mesh_from_python(py::handle value, const Place& place);
std::shared_ptr<const ReflectivityMap> map_from_python(py::handle value, const Place& place);
std::shared_ptr<const VectorMap> vectors_from_python(py::handle value, const Place& place);
std::shared_ptr<const MeshMotion> motion_from_python(py::handle value, const Place& place);

/// How a type of C++ looks in Python: its name for stubs, and both ways. The structs come first.
template <class T>
struct As;

template <class T>
py::object to_python(const T& value) {
  return As<T>::out(value);
}
template <class T>
void from_python(py::handle value, T& into, const Place& place) {
  As<T>::in(value, into, place);
}

template <Record T>
struct As<T> {
  static std::string type() { return record_name<T>(); }
  static py::object out(const T& value) {
    py::object object = new_object(record_name<T>().c_str());
    const py::handle* name = names().data();
    each_member(value, [&](std::string_view, const auto& member) { py::setattr(object, *name++, to_python(member)); });
    return object;
  }
  static void in(py::handle value, T& into, const Place& place) {
    check_class(value, record_name<T>().c_str(), place);
    const py::handle* held = names().data();
    each_member(into, [&](std::string_view name, auto& member) {
      const Place here{&place, "." + std::string(name)};
      from_python(member_of(value, *held++, here), member, here);
    });
  }

 private:
  /// Names of its members as Python has them. (A static that other threads may wait for: making texts lets none of them run.)
  static const auto& names() {
    static const auto all = [] {
      std::array<py::handle, member_count<T>> out;
      for (std::size_t i = 0; i < out.size(); ++i) out[i] = held_name(member_names<T>[i]);
      return out;
    }();
    return all;
  }
};

template <>
struct As<double> {
  static std::string type() { return "float"; }
  static py::object out(double value) { return py::float_(value); }
  static void in(py::handle value, double& into, const Place& place) { into = from_number(value, place); }
};
template <>
struct As<bool> {
  static std::string type() { return "bool"; }
  static py::object out(bool value) { return py::bool_(value); }
  static void in(py::handle value, bool& into, const Place& place) { into = from_bool(value, place); }
};
template <>
struct As<int> {
  static std::string type() { return "int"; }
  static py::object out(int value) { return py::int_(value); }
  static void in(py::handle value, int& into, const Place& place) {
    into = static_cast<int>(from_whole(value, place, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
  }
};
template <>
struct As<std::int64_t> {
  static std::string type() { return "int"; }
  static py::object out(std::int64_t value) { return py::int_(value); }
  static void in(py::handle value, std::int64_t& into, const Place& place) {
    into = from_whole(value, place, std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max());
  }
};
template <class T>
requires(std::is_same_v<T, unsigned long> || std::is_same_v<T, unsigned long long>) struct As<T> {
  static std::string type() { return "int"; }
  static py::object out(T value) { return py::int_(value); }
  static void in(py::handle value, T& into, const Place& place) { into = static_cast<T>(from_natural(value, place)); }
};
template <>
struct As<std::string> {
  static std::string type() { return "str"; }
  static py::object out(const std::string& value);
  static void in(py::handle value, std::string& into, const Place& place) { into = from_text(value, place); }
};

template <>
struct As<std::filesystem::path> {
  static std::string type() { return "str"; }
  static py::object out(const std::filesystem::path& value) { return to_python(value.native()); }
  static void in(py::handle value, std::filesystem::path& into, const Place& place) { into = from_text(value, place); }
};
template <class A, class B>
struct As<std::pair<A, B>> {
  static std::string type() { return "tuple[" + As<A>::type() + ", " + As<B>::type() + "]"; }
  static py::object out(const std::pair<A, B>& value) { return py::make_tuple(to_python(value.first), to_python(value.second)); }
  static void in(py::handle value, std::pair<A, B>& into, const Place& place) {
    const std::vector<py::object> items = items_of(value, place, "2 values", 2);
    from_python(items[0], into.first, Place{&place, "[0]"}), from_python(items[1], into.second, Place{&place, "[1]"});
  }
};

template <class T>
requires std::is_enum_v<T>
struct As<T> {
  static std::string type() {
    std::string all;
    for (const std::string_view name : enumerators<T>())
      if (!name.empty()) all += (all.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    return "Literal[" + all + "]";
  }
  static py::object out(T value) { return py::str(std::string(enumerators<T>().at(static_cast<std::size_t>(value)))); }
  static void in(py::handle value, T& into, const Place& place) {
    constexpr auto names = enumerators<T>();
    if (PyUnicode_Check(value.ptr())) {
      const std::string text = from_text(value, place);
      for (std::size_t i = 0; i < names.size(); ++i)
        if (!names[i].empty() && names[i] == text) {
          into = static_cast<T>(i);
          return;
        }
    }
    const std::string all = type();
    refuse(place, value, "one of " + all.substr(8, all.size() - 9));
  }
};

template <class T, std::size_t N>
struct As<std::array<T, N>> {
  static std::string type() {
    std::string all = "tuple[";
    for (std::size_t i = 0; i < N; ++i) all += (i == 0 ? "" : ", ") + As<T>::type();
    return all + "]";
  }
  static py::object out(const std::array<T, N>& value) {
    py::tuple all(N);
    for (std::size_t i = 0; i < N; ++i) all[i] = to_python(value[i]);
    return all;
  }
  static void in(py::handle value, std::array<T, N>& into, const Place& place) {
    const std::vector<py::object> items = items_of(value, place, std::to_string(N) + " values", static_cast<int>(N));
    for (std::size_t i = 0; i < N; ++i) from_python(items[i], into[i], Place{&place, "[" + std::to_string(i) + "]"});
  }
};

template <class T>
struct As<std::vector<T>> {
  static std::string type() { return "list[" + As<T>::type() + "]"; }
  static py::object out(const std::vector<T>& value) {
    py::list all(value.size());
    for (std::size_t i = 0; i < value.size(); ++i) all[i] = to_python(value[i]);
    return all;
  }
  static void in(py::handle value, std::vector<T>& into, const Place& place) {
    const std::vector<py::object> items = items_of(value, place, "a list of " + As<T>::type());
    into.assign(items.size(), T{});
    for (std::size_t i = 0; i < items.size(); ++i) from_python(items[i], into[i], Place{&place, "[" + std::to_string(i) + "]"});
  }
};

template <class T>
struct As<std::optional<T>> {
  static std::string type() { return As<T>::type() + " | None"; }
  static py::object out(const std::optional<T>& value) { return value ? to_python(*value) : py::none(); }
  static void in(py::handle value, std::optional<T>& into, const Place& place) {
    into.reset();
    if (!value.is_none()) from_python(value, into.emplace(), place);
  }
};

template <class... T>
struct As<std::variant<T...>> {
  static std::string type() {
    std::string all;
    ((all += (all.empty() ? "" : " | ") + As<T>::type()), ...);
    return all;
  }
  static py::object out(const std::variant<T...>& value) {
    return std::visit([](const auto& one) { return to_python(one); }, value);
  }
  static void in(py::handle value, std::variant<T...>& into, const Place& place) {
    const auto take = [&]<class One>(One*) {
      if (!py::isinstance(value, model_class(record_name<One>().c_str()))) return false;
      from_python(value, into.template emplace<One>(), place);
      return true;
    };
    if (!(take(static_cast<T*>(nullptr)) || ...)) refuse(place, value, "one of " + type());
  }
};

#define TOFRAY_SHARED(T, to, from, word)                                                                    \
  template <>                                                                                               \
  struct As<std::shared_ptr<const T>> {                                                                     \
    static std::string type() { return word " | None"; }                                                    \
    static py::object out(const std::shared_ptr<const T>& value) { return value ? to(value) : py::none(); } \
    static void in(py::handle value, std::shared_ptr<const T>& into, const Place& place) {                  \
      into = value.is_none() ? nullptr : from(value, place);                                                \
    }                                                                                                       \
  };
TOFRAY_SHARED(TriangleMesh, mesh_to_python, mesh_from_python, "TriangleMesh")
TOFRAY_SHARED(ReflectivityMap, map_to_python, map_from_python, "ReflectivityMap")
TOFRAY_SHARED(VectorMap, vectors_to_python, vectors_from_python, "VectorMap")
TOFRAY_SHARED(MeshMotion, motion_to_python, motion_from_python, "MeshMotion")
#undef TOFRAY_SHARED

template <>
struct As<FrameProgress*> {  // Simulator.progress has it
  static std::string type() { return "None"; }
  static py::object out(FrameProgress*) { return py::none(); }
  static void in(py::handle, FrameProgress*& into, const Place&) { into = nullptr; }
};

}  // namespace tofray::python
