// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "meshes.h"

#include <cstring>

#include "arrays.h"

namespace tofray::python {

namespace {

template <class T, std::size_t N>
std::vector<std::array<T, N>> rows_of(py::handle value, const char* letter, py::ssize_t count, const Place& place) {
  const std::vector<T> flat = take<T>(value, {{count, letter}, {static_cast<py::ssize_t>(N), ""}}, place);
  std::vector<std::array<T, N>> out(flat.size() / N);
  if (!flat.empty()) std::memcpy(out.data(), flat.data(), flat.size() * sizeof(T));
  return out;
}

/// A view that keeps the mesh alive. Read-only: simulators and scenes share it.
template <class T, std::size_t N>
py::array rows_view(py::handle self, const std::vector<std::array<T, N>>& rows) {
  return view<T>(reinterpret_cast<const T*>(rows.data()), {static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(N)}, self,
                 false);
}

template <class T>
void refuse_indices(const std::vector<T>& triangles, std::size_t vertices) {
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::int32_t index : triangles[i])
      if (index < 0 || static_cast<std::size_t>(index) >= vertices)
        throw Error(ErrorKind::bad_input, "triangles[" + std::to_string(i) + "]: error: names vertex " + std::to_string(index) +
                                              "\n  expected 0 to " + std::to_string(vertices) + " - 1: the mesh has so many vertices");
}

std::shared_ptr<TriangleMesh> make_mesh(const py::object& vertices, const py::object& triangles, const py::object& normals,
                                        const py::object& texcoords, const py::object& shades) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->vertices = rows_of<float, 3>(vertices, "n", -1, {nullptr, "vertices"});
  mesh->triangles = rows_of<std::int32_t, 3>(triangles, "m", -1, {nullptr, "triangles"});
  const auto count = static_cast<py::ssize_t>(mesh->vertices.size());
  if (!normals.is_none()) mesh->normals = rows_of<float, 3>(normals, "", count, {nullptr, "normals"});
  if (!texcoords.is_none()) mesh->texcoords = rows_of<float, 2>(texcoords, "", count, {nullptr, "texcoords"});
  if (!shades.is_none()) mesh->shades = take<float>(shades, {{count, ""}}, {nullptr, "shades"});
  refuse_indices(mesh->triangles, mesh->vertices.size());
  return mesh;
}

void put_values(const py::object& values, Shape& shape, std::vector<float>& out) {
  out = take<float>(values, {{-1, "height"}, {-1, "width"}}, {nullptr, "values"}, &shape);
}
void put_values(const py::object& values, Shape& shape, std::vector<std::array<float, 3>>& out) {
  const std::vector<float> flat = take<float>(values, {{-1, "height"}, {-1, "width"}, {3, ""}}, {nullptr, "values"}, &shape);
  out.resize(flat.size() / 3);
  if (!flat.empty()) std::memcpy(out.data(), flat.data(), flat.size() * sizeof(float));
}
py::array view_of(const py::object& self, const ReflectivityMap& map) {
  return view<float>(map.values.data(), {map.height, map.width}, self, false);
}
py::array view_of(const py::object& self, const VectorMap& map) {
  return view<float>(reinterpret_cast<const float*>(map.values.data()), {map.height, map.width, 3}, self, false);
}

template <class Map>
std::shared_ptr<Map> make_map(const py::object& values, const py::object& wrap_u, const py::object& wrap_v) {
  auto map = std::make_shared<Map>();
  Shape shape;
  put_values(values, shape, map->values);
  map->height = static_cast<int>(shape[0]), map->width = static_cast<int>(shape[1]);
  from_python(wrap_u, map->wrap_u, {nullptr, "wrap_u"});
  from_python(wrap_v, map->wrap_v, {nullptr, "wrap_v"});
  return map;
}

/// A motion out of Python: a function that gives the vertices, and the normals, at a time.
class CalledMotion final : public MeshMotion {
 public:
  explicit CalledMotion(py::object at) : at_(std::move(at)) {}
  CalledMotion(const CalledMotion&) = delete;
  CalledMotion& operator=(const CalledMotion&) = delete;
  ~CalledMotion() override {
    if (Py_IsInitialized() == 0) {
      at_.release();  // the interpreter is gone, and the function with it
      return;
    }
    const py::gil_scoped_acquire lock;
    at_ = py::object();
  }
  void at(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const override {
    const py::gil_scoped_acquire lock;
    try {
      ask(time_s, vertices, normals);
    } catch (py::error_already_set& fault) {
      const std::string said = fault.what();
      pending_callback_fault() = std::make_shared<py::error_already_set>(fault);
      throw Error(ErrorKind::bad_input, "MeshMotion: error: its function raised " + said);
    }
  }
  [[nodiscard]] py::object function() const { return at_; }

 private:
  void ask(double time_s, std::vector<std::array<float, 3>>& vertices, std::vector<std::array<float, 3>>& normals) const {
    const Place place{nullptr, "MeshMotion.at(" + std::to_string(time_s) + ")"};
    py::object got = at_(time_s);
    py::object turned = py::none();
    if (PyTuple_Check(got.ptr()) && PyTuple_GET_SIZE(got.ptr()) == 2) {
      turned = py::reinterpret_borrow<py::object>(PyTuple_GET_ITEM(got.ptr(), 1));
      got = py::reinterpret_borrow<py::object>(PyTuple_GET_ITEM(got.ptr(), 0));
    }
    vertices = rows_of<float, 3>(got, "vertices", -1, place);  // that they are as many as before is looked at by whoever asks
    if (!turned.is_none()) normals = rows_of<float, 3>(turned, "vertices", -1, place);
  }

  py::object at_;
};

[[noreturn]] void refuse_pickling(const char* what, const char* way_out) {
  PyErr_SetString(PyExc_TypeError, (std::string(what) + " cannot be pickled\n  expected " + way_out).c_str());
  throw py::error_already_set();
}

std::shared_ptr<MeshMotion> make_motion(const py::object& at) {
  if (PyCallable_Check(at.ptr()) == 0) refuse({nullptr, "at"}, at, "a function of the time in seconds that gives the vertices");
  return std::make_shared<CalledMotion>(at);
}

constexpr const char* motion_doc = R"(How a mesh changes its shape with time, in its own frame.

Parameters
----------
at : function
    Of the time in seconds: gives the vertices, float32 array [vertex, 3], m, as many as the mesh has; or a tuple of them and the
    normals, float32 array [vertex, 3], 1. It is called at the middle of exposures, and may be asked for one time more than once.)";

void bind_motion(py::module_& module) {
  py::class_<MeshMotion, std::shared_ptr<MeshMotion>>(module, "MeshMotion", motion_doc)
      .def(py::init(&make_motion), py::arg("at"))
      .def("__reduce__",
           [](py::object self) -> py::object {
             const auto* called = dynamic_cast<const CalledMotion*>(self.cast<const MeshMotion*>());
             if (called == nullptr) refuse_pickling("the motion of a glTF file's mesh", "the scene to be loaded again by its file");
             return py::make_tuple(py::type::of(self), py::make_tuple(called->function()));
           })
      .def("__deepcopy__", [](py::object self, const py::object&) { return self; });
}

}  // namespace

std::shared_ptr<py::error_already_set>& pending_callback_fault() {
  thread_local std::shared_ptr<py::error_already_set> fault;
  return fault;
}

void raise_callback_fault() {
  const auto fault = std::move(pending_callback_fault());
  pending_callback_fault().reset();
  if (fault) throw *fault;
}

namespace {

constexpr const char* mesh_doc =
    R"(Triangles that share vertices, both sides of which reflect. Never changes: scenes and simulators share it.

Parameters
----------
vertices : float32 array [vertex, 3], m
    In the mesh's own frame.
triangles : int32 array [triangle, 3], 1
    Three indices of vertices each.
normals : float32 array [vertex, 3], 1, optional
    Of unit length, outward or inward, 0 where there is none: light and camera see the mean of a triangle's three.
texcoords : float32 array [vertex, 2], 1, optional
    (u, v) in the material's map.
shades : float32 array [vertex], 1, optional
    0 to 1: scale the material's matt part, as its map does.

Raises
------
Error
    For an array of another dtype, shape or order, and for an index that no vertex has.)";

constexpr const char* map_doc = R"(A picture of how much a surface sends back. Never changes: scenes and simulators share it.

Parameters
----------
values : float32 array [height, width], 1
    0 to 1: 1 where it is its material's diffuse reflectivity, 0 where it is black. (u, v) = (0, 0) is the corner of the first.
wrap_u, wrap_v : {"repeat", "mirror", "clamp"}
    What is seen beyond 0 to 1.

Raises
------
Error
    For an array of another dtype, shape or order. (Values beyond 0 to 1 are refused by whoever simulates.))";

constexpr const char* vector_map_doc =
    R"(A picture of three numbers, which its user gives a meaning. Never changes: scenes and simulators share it.

Parameters
----------
values : float32 array [height, width, 3], 1
    How a normal leans (along u, along v, along the mesh's normal), or a surface's finish (k_d, F_0, alpha). (u, v) = (0, 0) is the
    corner of the first.
wrap_u, wrap_v : {"repeat", "mirror", "clamp"}
    What is seen beyond 0 to 1.

Raises
------
Error
    For an array of another dtype, shape or order. (Values out of their range are refused by whoever simulates.))";

void bind_mesh(py::module_& module) {
  using Mesh = TriangleMesh;
  py::class_<Mesh, std::shared_ptr<Mesh>>(module, "TriangleMesh", mesh_doc)
      .def(py::init(&make_mesh), py::arg("vertices"), py::arg("triangles"), py::arg("normals") = py::none(),
           py::arg("texcoords") = py::none(), py::arg("shades") = py::none())
      .def_property_readonly(
          "vertices", [](py::object self) { return rows_view(self, self.cast<const Mesh&>().vertices); },
          "float32 array [vertex, 3], m, read-only.")
      .def_property_readonly(
          "triangles", [](py::object self) { return rows_view(self, self.cast<const Mesh&>().triangles); },
          "int32 array [triangle, 3], 1, read-only.")
      .def_property_readonly(
          "normals", [](py::object self) { return rows_view(self, self.cast<const Mesh&>().normals); },
          "float32 array [vertex, 3], 1, read-only; of no rows where there are none.")
      .def_property_readonly(
          "texcoords", [](py::object self) { return rows_view(self, self.cast<const Mesh&>().texcoords); },
          "float32 array [vertex, 2], 1, read-only; of no rows where there are none.")
      .def_property_readonly(
          "shades",
          [](py::object self) {
            const std::vector<float>& shades = self.cast<const Mesh&>().shades;
            return view<float>(shades.data(), {static_cast<py::ssize_t>(shades.size())}, self, false);
          },
          "float32 array [vertex], 1, read-only; empty where there are none.")
      .def("__eq__",
           [](const Mesh& self, py::handle other) {
             if (!py::isinstance<Mesh>(other)) return false;
             const Mesh& is = other.cast<const Mesh&>();
             return self.vertices == is.vertices && self.triangles == is.triangles && self.normals == is.normals &&
                    self.texcoords == is.texcoords && self.shades == is.shades;
           })
      .def("__hash__", [](const Mesh& self) { return py::hash(py::make_tuple(self.vertices.size(), self.triangles.size())); })
      .def("__repr__",
           [](const Mesh& self) {
             return "TriangleMesh(" + std::to_string(self.vertices.size()) + " vertices, " + std::to_string(self.triangles.size()) +
                    " triangles)";
           })
      .def("__reduce__",
           [](py::object self) {
             const Mesh& mesh = self.cast<const Mesh&>();
             const auto kept = [&](const char* name, bool there) {
               return there ? py::object(self.attr(name).attr("copy")()) : py::none();
             };
             return py::make_tuple(py::type::of(self),
                                   py::make_tuple(kept("vertices", true), kept("triangles", true), kept("normals", !mesh.normals.empty()),
                                                  kept("texcoords", !mesh.texcoords.empty()), kept("shades", !mesh.shades.empty())));
           })
      .def("__deepcopy__", [](py::object self, const py::object&) { return self; });
}

template <class Map>
void bind_map(py::module_& module, const char* name, const char* doc, const char* values_doc) {
  py::class_<Map, std::shared_ptr<Map>>(module, name, doc)
      .def(py::init(&make_map<Map>), py::arg("values"), py::arg("wrap_u") = "repeat", py::arg("wrap_v") = "repeat")
      .def_property_readonly(
          "values",
          [](py::object self) {
            const Map& map = self.cast<const Map&>();
            return view_of(self, map);
          },
          values_doc)
      .def_property_readonly(
          "wrap_u", [](const Map& self) { return to_python(self.wrap_u); }, "What is seen beyond 0 to 1, along rows.")
      .def_property_readonly(
          "wrap_v", [](const Map& self) { return to_python(self.wrap_v); }, "What is seen beyond 0 to 1, along columns.")
      .def_readonly("width", &Map::width, "Values of a row.")
      .def_readonly("height", &Map::height, "Rows.")
      .def("__eq__",
           [](const Map& self, py::handle other) {
             if (!py::isinstance<Map>(other)) return false;
             const Map& is = other.cast<const Map&>();
             return self.values == is.values && self.width == is.width && self.wrap_u == is.wrap_u && self.wrap_v == is.wrap_v;
           })
      .def("__hash__", [](const Map& self) { return py::hash(py::make_tuple(self.width, self.height)); })
      .def("__repr__", [name = std::string(name)](
                           const Map& self) { return name + "(" + std::to_string(self.width) + " x " + std::to_string(self.height) + ")"; })
      .def("__reduce__",
           [](py::object self) {
             return py::make_tuple(py::type::of(self),
                                   py::make_tuple(self.attr("values").attr("copy")(), self.attr("wrap_u"), self.attr("wrap_v")));
           })
      .def("__deepcopy__", [](py::object self, const py::object&) { return self; });
}

}  // namespace

void bind_meshes(py::module_& module) {
  bind_mesh(module);
  bind_map<ReflectivityMap>(module, "ReflectivityMap", map_doc, "float32 array [height, width], 1, read-only.");
  bind_map<VectorMap>(module, "VectorMap", vector_map_doc, "float32 array [height, width, 3], 1, read-only.");
  bind_motion(module);
}

// Python sees no way to change them, so constness is all that is cast away.
py::object mesh_to_python(const std::shared_ptr<const TriangleMesh>& mesh) { return py::cast(std::const_pointer_cast<TriangleMesh>(mesh)); }
py::object map_to_python(const std::shared_ptr<const ReflectivityMap>& map) {
  return py::cast(std::const_pointer_cast<ReflectivityMap>(map));
}
py::object vectors_to_python(const std::shared_ptr<const VectorMap>& map) { return py::cast(std::const_pointer_cast<VectorMap>(map)); }
py::object motion_to_python(const std::shared_ptr<const MeshMotion>& motion) {
  return py::cast(std::const_pointer_cast<MeshMotion>(motion));
}

std::shared_ptr<const TriangleMesh> mesh_from_python(py::handle value, const Place& place) {
  if (!py::isinstance<TriangleMesh>(value)) refuse(place, value, "a tofray.TriangleMesh, or None");
  return value.cast<std::shared_ptr<TriangleMesh>>();
}
std::shared_ptr<const ReflectivityMap> map_from_python(py::handle value, const Place& place) {
  if (!py::isinstance<ReflectivityMap>(value)) refuse(place, value, "a tofray.ReflectivityMap, or None");
  return value.cast<std::shared_ptr<ReflectivityMap>>();
}
std::shared_ptr<const VectorMap> vectors_from_python(py::handle value, const Place& place) {
  if (!py::isinstance<VectorMap>(value)) refuse(place, value, "a tofray.VectorMap, or None");
  return value.cast<std::shared_ptr<VectorMap>>();
}
std::shared_ptr<const MeshMotion> motion_from_python(py::handle value, const Place& place) {
  if (!py::isinstance<MeshMotion>(value)) refuse(place, value, "a tofray.MeshMotion, or None");
  return value.cast<std::shared_ptr<MeshMotion>>();
}

}  // namespace tofray::python
