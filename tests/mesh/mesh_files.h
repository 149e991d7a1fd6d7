// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/read_mesh.h"
#include "support/samples.h"
#include "support/text.h"
#include "support/told.h"

namespace tofray::mesh_test {

using mesh::Format;
using mesh::ReadMesh;
using Vertices = std::vector<std::array<float, 3>>;
using Triangles = std::vector<std::array<std::int32_t, 3>>;

/// A corner of a cube at the origin, cut off: what most files here hold.
inline const Vertices corner_vertices = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0.5F}};
inline const Triangles corner_triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

inline void expect_mesh(const ReadMesh& read, const Vertices& vertices, const Triangles& triangles, std::size_t not_finite = 0) {
  EXPECT_EQ(read.mesh.vertices, vertices);
  EXPECT_EQ(read.mesh.triangles, triangles);
  EXPECT_EQ(read.not_finite, not_finite);
}

inline void expect_corner(const ReadMesh& read) { expect_mesh(read, corner_vertices, corner_triangles); }

inline bool has_sound_details(const ReadMesh& read) {
  const auto& normals = read.mesh.normals;
  const auto& texcoords = read.mesh.texcoords;
  const auto unit_or_zero = [](const auto& n) {
    const double square = static_cast<double>(n[0]) * n[0] + static_cast<double>(n[1]) * n[1] + static_cast<double>(n[2]) * n[2];
    return square == 0 || std::abs(square - 1) < 1e-6;
  };
  const auto in_reach = [](const auto& t) { return std::abs(t[0]) <= 1e6F && std::abs(t[1]) <= 1e6F; };
  const auto is_one = [&](std::int32_t i) { return i >= -1 && i < static_cast<std::int32_t>(read.materials.size()); };
  const auto fits = [](const auto& rows, std::size_t count) { return rows.empty() || rows.size() == count; };
  return fits(normals, read.mesh.vertices.size()) && fits(texcoords, read.mesh.vertices.size()) &&
         fits(read.material_of, read.mesh.triangles.size()) && std::all_of(normals.begin(), normals.end(), unit_or_zero) &&
         std::all_of(texcoords.begin(), texcoords.end(), in_reach) && std::all_of(read.material_of.begin(), read.material_of.end(), is_one);
}

/// Whether a mesh may be handed on: finite vertices, indices within them, at least one triangle.
inline bool is_sound(const ReadMesh& read) {
  const auto finite = [](const auto& vertex) {
    return std::all_of(vertex.begin(), vertex.end(), [](float x) { return std::isfinite(x); });
  };
  const auto within = [&](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](std::int32_t i) { return i >= 0 && static_cast<std::size_t>(i) < read.mesh.vertices.size(); });
  };
  const auto& vertices = read.mesh.vertices;
  const auto& triangles = read.mesh.triangles;
  return !triangles.empty() && std::all_of(vertices.begin(), vertices.end(), finite) &&
         std::all_of(triangles.begin(), triangles.end(), within) && has_sound_details(read);
}

/// Whether bytes give a mesh, which then is sound; else an error that may be shown and names the file.
inline bool is_taken(Format format, std::string_view bytes) {
  try {
    EXPECT_TRUE(is_sound(mesh::parse(format, bytes, "hostile")));
    return true;
  } catch (const Error& error) {
    test::expect_told(error, "hostile");
    return false;
  }
}

/// A file and what the error says of it.
struct Fault {
  std::string bytes;
  std::string message;
};

inline void expect_faults(Format format, const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    SCOPED_TRACE(base::printable(fault.bytes).substr(0, 2000));
    const Error error = out_test::error_of([&] { (void)mesh::parse(format, fault.bytes, "m"); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    EXPECT_TRUE(test::has(error.what(), fault.message)) << error.what() << "\nexpected: " << fault.message;
  }
}

inline std::string replaced(const std::string& text, const std::string& what, const std::string& by) {
  std::string out;
  std::size_t from = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, from)) {
    out += text.substr(from, at - from) + by;
    from = at + what.size();
  }
  return out + text.substr(from);
}

/// The bytes of a number in either order.
template <class T>
std::string number_bytes(T value, bool big_endian) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big_endian) std::reverse(bytes.begin(), bytes.end());  // the tests run on little-endian machines
  return bytes;
}

/// Writes what stands behind a PLY file's header, in any encoding.
struct PlyWriter {
  enum class Encoding { text, little, big };
  Encoding encoding;
  std::string bytes;

  PlyWriter(Encoding chosen, const std::string& header) : encoding(chosen) {
    constexpr const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    bytes = std::string("ply\nformat ") + names[static_cast<int>(chosen)] + " 1.0\n" + header + "end_header\n";
  }
  template <class T>
  PlyWriter& put(double value) {
    if (encoding == Encoding::text)
      bytes += base::number_text(value) + " ";
    else
      bytes += number_bytes(static_cast<T>(value), encoding == Encoding::big);
    return *this;
  }
  PlyWriter& end_row() {
    if (encoding == Encoding::text) bytes.back() = '\n';
    return *this;
  }
};

inline constexpr PlyWriter::Encoding every_encoding[] = {PlyWriter::Encoding::text, PlyWriter::Encoding::little, PlyWriter::Encoding::big};

/// The corner, with coordinates, lengths of lists and indices of these types.
template <class Coordinate, class Length, class Index>
std::string corner_ply(PlyWriter::Encoding encoding, const std::string& coordinate, const std::string& length, const std::string& index,
                       const std::string& list = "vertex_indices", double scale = 1) {
  PlyWriter file(encoding, "comment of the tests\nelement vertex 4\nproperty " + coordinate + " x\nproperty " + coordinate +
                               " y\nproperty " + coordinate + " z\nelement face 4\nproperty list " + length + " " + index + " " + list +
                               "\n");
  for (const auto& vertex : corner_vertices) {
    for (const float number : vertex) file.put<Coordinate>(static_cast<double>(number) * scale);
    file.end_row();
  }
  for (const auto& triangle : corner_triangles) {
    file.put<Length>(3);
    for (const std::int32_t one : triangle) file.put<Index>(one);
    file.end_row();
  }
  return file.bytes;
}

inline std::string plain_ply(PlyWriter::Encoding encoding) {
  return corner_ply<float, std::uint8_t, std::int32_t>(encoding, "float", "uchar", "int");
}

/// A triangle whose vertices have normals and texture coordinates.
inline std::string full_ply(PlyWriter::Encoding encoding) {
  PlyWriter file(encoding,
                 "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                 "property float nz\nproperty double s\nproperty uchar t\nelement face 1\nproperty list uchar uchar vertex_index\n");
  for (std::size_t i = 0; i < 3; ++i) {
    for (const float number : corner_vertices[i]) file.put<float>(static_cast<double>(number));
    file.put<float>(0).put<float>(0.6).put<float>(0.8).put<double>(0.5).put<std::uint8_t>(static_cast<double>(i)).end_row();
  }
  file.put<std::uint8_t>(3).put<std::uint8_t>(0).put<std::uint8_t>(1).put<std::uint8_t>(2).end_row();
  return file.bytes;
}

inline const std::string corner_obj =
    "# the corner\nv 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 0.5\nf 1 3 2\nf 1/1 2/2 4/1\nf 1//1 4//1 3//2\nf 2/1/1 3/1/1 4/2/2\n";

/// A square with all that OBJ files say besides.
inline const std::string full_obj =
    "mtllib a.mtl b c.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nvn 0.6 0 0.8\nusemtl red\n"
    "f 1/1/1 2/2/1 3/3/2\nusemtl blue\nf -4/-3/-2 3/3/1 4//2\n";

/// The corner; STL gives each triangle its corners, whose first order of coming is that of these vertices.
inline const Vertices stl_vertices = {{0, 0, 0}, {0, 2, 0}, {1, 0, 0}, {0, 0, 0.5F}};
inline const Triangles stl_triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {2, 1, 3}};

inline std::string text_stl() {
  std::string text = "solid corner of a cube\n";
  for (const auto& triangle : corner_triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const std::int32_t i : triangle) {
      text += "      vertex";
      for (const float number : corner_vertices[static_cast<std::size_t>(i)]) text += " " + base::number_text(static_cast<double>(number));
      text += "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid corner of a cube\n";
}

inline std::string binary_stl(std::string header = "binary", const Vertices& vertices = corner_vertices) {
  header.resize(80, ' ');
  header += number_bytes(static_cast<std::uint32_t>(corner_triangles.size()), false);
  for (const auto& triangle : corner_triangles) {
    header += std::string(12, '\x7F');  // the normal
    for (const std::int32_t i : triangle)
      for (const float number : vertices[static_cast<std::size_t>(i)]) header += number_bytes(number, false);
    header += "\x34\x12";  // attributes
  }
  return header;
}

}  // namespace tofray::mesh_test
