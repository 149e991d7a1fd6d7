// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <iterator>
#include <variant>

#include "base/limits.h"
#include "base/text.h"
#include "base/vec.h"
#include "model/check.h"
#include "model/tables.h"

/// What a scene file may say of each shape, and what has to hold between a shape's members.
namespace tofray::model {

using base::number_text;
using enum base::Dimension;

template <>
const Table& table_of<Plane>() {
  static const Table rows =
      table<Plane>(number<&Plane::point>("point", coordinate, "a point of the plane [m]").required(),
                   number<&Plane::normal>("normal", component, "normal, of any length but zero; both sides reflect").direction());
  return rows;
}

template <>
const Table& table_of<Sphere>() {
  static const Table rows =
      table<Sphere>(number<&Sphere::center>("center", coordinate, "centre [m]").required(),
                    number<&Sphere::radius>("radius", {length, {base::shortest_m, 1e5}, "25 cm"}, "radius [m]").required());
  return rows;
}

template <>
const Table& table_of<Box>();

namespace {
void boxes_are_thick(const Box& box, Complaints& complaints) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!(box.max[k] - box.min[k] >= base::shortest_m))
      complaints.add(box, &box.min, std::string("the box's min is not below its max in ") + "xyz"[k],
                     "got " + number_text(box.min[k]) + " m and " + number_text(box.max[k]) + " m, expected a thickness of at least 1 um",
                     ErrorKind::bad_input, static_cast<long long>(k));
}
}  // namespace

template <>
const Table& table_of<Box>() {
  static const Table rows =
      table<Box>(number<&Box::min>("min", coordinate, "corner with the smallest x, y and z, before the rotation [m]").required(),
                 number<&Box::max>("max", coordinate, "opposite corner, before the rotation [m]").required())
          .check_with(boxes_are_thick);
  return rows;
}

/// In code, a triangle without an area is good: no ray hits it.
template <>
const Table& table_of<Triangle>() {
  static const Table rows = table<Triangle>(number<&Triangle::vertices>("vertices", coordinate, "three corners [m]").required());
  return rows;
}

template <>
const Table& table_of<Cylinder>() {
  static const Table rows = table<Cylinder>(
      number<&Cylinder::center>("center", coordinate, "centre, halfway between the caps [m]").required(),
      number<&Cylinder::axis>("axis", component, "axis from cap to cap, of any length but zero").required().direction(),
      number<&Cylinder::radius>("radius", {length, {base::shortest_m, 1e5}, "5 cm"}, "radius [m]").required(),
      number<&Cylinder::height>("height", {length, {base::shortest_m, 1e5}, "20 cm"}, "height, from cap to cap [m]").required());
  return rows;
}

template <>
const Table& table_of<Rectangle>() {
  static const Table rows =
      table<Rectangle>(number<&Rectangle::center>("center", coordinate, "centre [m]").required(),
                       number<&Rectangle::size>("size", {length, {base::shortest_m, 1e5}, "40 cm", true},
                                                "width and height, along x and y before the rotation; both sides reflect [m]")
                           .required());
  return rows;
}

template <>
const Table& table_of<Disk>() {
  static const Table rows =
      table<Disk>(number<&Disk::center>("center", coordinate, "centre [m]").required(),
                  number<&Disk::normal>("normal", component, "normal, of any length but zero; both sides reflect").required().direction(),
                  number<&Disk::radius>("radius", {length, {base::shortest_m, 1e5}, "15 cm"}, "radius [m]").required());
  return rows;
}

template <>
const Table& table_of<Capsule>();

namespace {
void capsules_have_a_length(const Capsule& capsule, Complaints& complaints) {
  using base::operator-;
  if (base::length(capsule.end - capsule.start) < base::shortest_m)
    complaints.add(capsule, &capsule.end, "the capsule ends where it starts",
                   "expected points at least 1 um apart; a sphere has the same shape without them");
}
}  // namespace

template <>
const Table& table_of<Capsule>() {
  static const Table rows =
      table<Capsule>(number<&Capsule::start>("start", coordinate, "centre of one of the round ends [m]").required(),
                     number<&Capsule::end>("end", coordinate, "centre of the other round end, another point than start [m]").required(),
                     number<&Capsule::radius>("radius", {length, {base::shortest_m, 1e5}, "5 cm"}, "radius [m]").required())
          .check_with(capsules_have_a_length);
  return rows;
}

template <>
const Table& table_of<Cone>() {
  static const Table rows =
      table<Cone>(number<&Cone::base>("base", coordinate, "centre of the base [m]").required(),
                  number<&Cone::axis>("axis", component, "axis from the base to the tip, of any length but zero").required().direction(),
                  number<&Cone::radius>("radius", {length, {base::shortest_m, 1e5}, "10 cm"}, "radius of the base [m]").required(),
                  number<&Cone::height>("height", {length, {base::shortest_m, 1e5}, "30 cm"}, "height, from base to tip [m]").required());
  return rows;
}

namespace {
template <class Complain>
void check_shades(const TriangleMesh& mesh, const Complain& complain) {
  if (!mesh.shades.empty() && mesh.shades.size() != mesh.vertices.size())
    return complain("the mesh has not as many shades as vertices", "got " + std::to_string(mesh.shades.size()) + " for " +
                                                                       std::to_string(mesh.vertices.size()) +
                                                                       " vertices; expected none, or one for each");
  for (std::size_t i = 0; i < mesh.shades.size(); ++i)
    if (!(mesh.shades[i] >= 0 && mesh.shades[i] <= 1))
      return complain("the shade of vertex " + std::to_string(i) + " of the mesh is out of range",
                      "got " + number_text(static_cast<double>(mesh.shades[i])) + ", expected 0 to 1");
}

void meshes_have_triangles(const Mesh& mesh, Complaints& complaints) {
  const auto complain = [&](const std::string& what, const std::string& more) { complaints.add(mesh, &mesh.file, what, more); };
  if (mesh.triangles == nullptr) return complain("the mesh has no triangles", "expected Mesh::triangles to point to some");
  const TriangleMesh& all = *mesh.triangles;
  const auto& vertices = all.vertices;
  const auto& triangles = all.triangles;
  if (vertices.size() > static_cast<std::size_t>(base::limit::mesh_vertices.value) ||
      triangles.size() > static_cast<std::size_t>(base::limit::mesh_triangles.value))
    return complaints.add(mesh, &mesh.file, "the mesh is too large",
                          "got " + std::to_string(vertices.size()) + " vertices and " + std::to_string(triangles.size()) +
                              " triangles, at most " + std::to_string(base::limit::mesh_vertices.value) + " and " +
                              std::to_string(base::limit::mesh_triangles.value) + " (`tofray --limits`)",
                          ErrorKind::limit);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (const float x : vertices[i])
      if (!(std::abs(x) <= base::farthest_m))
        return complain("vertex " + std::to_string(i) + " of the mesh is beyond the world",
                        "got " + number_text(static_cast<double>(x)) + " m, expected at most " + number_text(base::farthest_m) + " m");
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (const std::int32_t corner : triangles[i])
      if (corner < 0 || static_cast<std::size_t>(corner) >= vertices.size())
        return complain("triangle " + std::to_string(i) + " of the mesh has a corner that there is not",
                        "got vertex " + std::to_string(corner) + " of " + std::to_string(vertices.size()) + ", which count from 0");
  const auto check_details = [&](const auto& rows, const char* what, float most) {
    if (!rows.empty() && rows.size() != vertices.size())
      return complain(
          std::string("the mesh has not as many ") + what + " as vertices",
          "got " + std::to_string(rows.size()) + " for " + std::to_string(vertices.size()) + " vertices; expected none, or one for each");
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const float x : rows[i])
        if (!(std::abs(x) <= most))
          return complain(
              std::string(what) + " of vertex " + std::to_string(i) + " of the mesh are out of range",
              "got " + number_text(static_cast<double>(x)) + ", expected numbers up to " + number_text(static_cast<double>(most)));
  };
  check_details(all.normals, "normals", 2.0F);
  check_details(all.texcoords, "texture coordinates", 1e6F);
  check_shades(all, complain);
}
}  // namespace

/// Of a mesh set in code, the triangles alone count.
template <>
const Table& table_of<Mesh>() {
  static const Table rows =
      table<Mesh>(
          words<&Mesh::file>("file", "a file", "chair.glb",
                             "OBJ, PLY, STL or glTF, beside the scene or below; or tofray:bumpy-ball, tofray:wavy-floor")
              .required(),
          number<&Mesh::scale>("scale", {none, {1e-9, 1e9}, "0.001"}, "scale from the file's numbers to metres: 0.001 for a file in mm")
              .scales_lengths(),
          choice<&Mesh::up>("up", {"automatic", "y", "z", "-y", "none"},
                            "the file's axis that is up, turned to `world_up`; automatic: y of an OBJ or glTF, z of a PLY or STL file; "
                            "none: the file's axes are the world's"),
          words<&Mesh::animation>("animation", "a name, a number or all", "all",
                                  "animation of a glTF file that `time` and `play` refer to: its name, its number from 0 on, or all at "
                                  "once; the first unless given"),
          number<&Mesh::time_s>("time", {time, {0, 1e6}, "1.5 s"}, "time of a glTF file's animation; the file's rest pose unless given")
              .absent(),
          choice<&Mesh::play>("play", {"still", "once", "loop"},
                              "whether a glTF file's animation plays, from `time` (or its start) on: once or repeatedly"),
          words<&Mesh::sha256>("", "", "", ""),  // the reader's
          no_row<&Mesh::left_out, &Mesh::guessed, &Mesh::notices, &Mesh::triangles, &Mesh::motion>("what the file holds"))
          .check_with(meshes_have_triangles);
  return rows;
}

namespace {
template <class... T>
std::vector<const Table& (*)()> tables_in(const std::variant<T...>*) {
  return {&table_of<T>...};
}
}  // namespace

const std::vector<std::string>& names_of_shapes() {
  static constexpr const char* names[] = {"plane", "sphere", "box", "triangle", "cylinder", "rectangle", "disk", "capsule", "cone", "mesh"};
  static_assert(std::size(names) == std::variant_size_v<decltype(Object::shape)>);
  static const std::vector<std::string> out(std::begin(names), std::end(names));
  return out;
}

std::vector<const Table& (*)()> tables_of_shapes() { return tables_in(static_cast<const decltype(Object::shape)*>(nullptr)); }

}  // namespace tofray::model
