// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/parts.h"
#include "gltf/pose.h"
#include "gltf/read.h"
#include "support/samples.h"
#include "support/text.h"

namespace tofray::gltf_test {

using gltf::Model;
using gltf::Part;
using gltf::Pose;
using gltf::read;
using Document = nlohmann::json;
using Vertices = std::vector<std::array<float, 3>>;
using Triangles = std::vector<std::array<std::int32_t, 3>>;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string out(values.size() * sizeof(T), '\0');
  if (!values.empty()) std::memcpy(out.data(), values.data(), out.size());  // the tests run on little-endian machines
  return out;
}

inline std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return out;
}

inline std::string word(std::uint32_t value) { return bytes_of<std::uint32_t>({value}); }

inline std::string chunk(const std::string& type, const std::string& data) {
  return word(static_cast<std::uint32_t>(data.size())) + type + data;
}

inline std::string glb_of(const std::string& chunks) {
  return "glTF" + word(2) + word(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
}

template <class T>
constexpr int component_type() {
  if (std::is_same_v<T, std::int8_t>) return 5120;
  if (std::is_same_v<T, std::uint8_t>) return 5121;
  if (std::is_same_v<T, std::int16_t>) return 5122;
  if (std::is_same_v<T, std::uint16_t>) return 5123;
  return std::is_same_v<T, std::uint32_t> ? 5125 : 5126;
}

/// A glTF file that a test builds: its JSON, which any test may change, and the bytes of its one buffer.
struct File {
  Document json = {{"asset", {{"version", "2.0"}}}};
  std::string binary;

  /// Adds to a list of the document. @return its index there
  int add(const std::string& list, const Document& item) {
    json[list].push_back(item);
    return static_cast<int>(json[list].size()) - 1;
  }
  int view(const std::string& bytes) {
    binary.resize((binary.size() + 3) / 4 * 4, '\xEE');
    binary += bytes;
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", binary.size() - bytes.size()}, {"byteLength", bytes.size()}});
  }
  int accessor(int view, int component, const std::string& type, std::size_t count, std::size_t offset = 0) {
    return add("accessors", {{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}, {"byteOffset", offset}});
  }
  template <class T>
  int accessor(const std::vector<T>& values, const std::string& type, bool normalized = false) {
    const std::map<std::string, std::size_t> widths = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const int added = accessor(view(bytes_of(values)), component_type<T>(), type, values.size() / widths.at(type));
    if (normalized) json["accessors"].back()["normalized"] = true;
    return added;
  }
  int floats(const std::vector<float>& values, const std::string& type) { return accessor<float>(values, type); }

  /// A mesh of one primitive.
  int mesh(const Document& attributes, int indices = -1) {
    Document primitive = {{"attributes", attributes}};
    if (indices >= 0) primitive["indices"] = indices;
    return add("meshes", {{"primitives", Document::array({primitive})}});
  }
  Document& primitive(int mesh) { return json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]; }
  int node(const Document& node) { return add("nodes", node); }

  /// The bytes as a buffer of the document.
  [[nodiscard]] Document with_buffer(const std::string& uri) const {
    Document out = json;
    if (binary.empty()) return out;
    if (!out.contains("buffers")) out["buffers"] = Document::array({{{"byteLength", binary.size()}}});
    if (!uri.empty()) out["buffers"][0]["uri"] = uri;
    return out;
  }
  /// JSON with the bytes in it.
  [[nodiscard]] std::string text() const { return with_buffer("data:application/octet-stream;base64," + base64(binary)).dump(); }
  [[nodiscard]] std::string text_beside(const std::string& uri) const { return with_buffer(uri).dump(); }
  [[nodiscard]] std::string glb() const {
    std::string text = with_buffer("").dump(), bytes = binary;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    return glb_of(chunk("JSON", text) + (bytes.empty() ? "" : chunk(std::string("BIN\0", 4), bytes)));
  }
};

inline Model model_of(const File& file) { return read("m", file.glb(), {}); }

/// All that the default scene shows, at rest or at a time of the first animation.
inline std::vector<Part> parts_at_rest(const Model& model) { return gltf::parts(model, gltf::at(model, gltf::none, 0)); }
inline std::vector<Part> parts_at(const Model& model, double time_s) { return gltf::parts(model, gltf::at(model, 0, time_s)); }

inline const double half_root = std::sqrt(0.5);  ///< sine and cosine of 45°: of the quaternion of a quarter turn

/// One triangle, counterclockwise as seen from +z.
inline const std::vector<float> corner_positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
inline const Vertices corner_vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

/// One node with one mesh of one triangle.
inline File triangle_file() {
  File file;
  file.mesh({{"POSITION", file.floats(corner_positions, "VEC3")}});
  file.node({{"mesh", 0}});
  return file;
}

/// A triangle that goes 3 m to the right in 2 s.
inline File animated_file() {
  File file = triangle_file();
  const int times = file.floats({0, 2}, "SCALAR"), places = file.floats({0, 0, 0, 3, 0, 0}, "VEC3");
  file.add("animations", {{"samplers", {{{"input", times}, {"output", places}}}},
                          {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}});
  return file;
}

inline std::string message_of(const std::string& bytes, ErrorKind kind = ErrorKind::bad_input, const gltf::Resources& files = {}) {
  const Error error = out_test::error_of([&] { (void)read("m", bytes, files); });
  EXPECT_EQ(error.kind(), kind) << error.what();
  return error.what();
}

inline void expect_fault(const std::string& bytes, const std::string& part, ErrorKind kind = ErrorKind::bad_input) {
  const std::string message = message_of(bytes, kind);
  EXPECT_EQ(message.rfind("m:", 0), 0U) << message;
  EXPECT_TRUE(test::has(message, part)) << message << "\nexpected: " << part;
}

inline void expect_near(const std::array<float, 3>& got, const std::array<double, 3>& expected, double tolerance) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(got[k], expected[k], tolerance) << "coordinate " << k;
}

inline bool has_notice(const Model& model, const std::string& part) {
  return std::any_of(model.notices.begin(), model.notices.end(), [&](const std::string& one) { return test::has(one, part); });
}

}  // namespace tofray::gltf_test
