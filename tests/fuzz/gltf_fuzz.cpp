// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any bytes as a glTF file: an Error, or a model whose parts are finite and whose indices are those of vertices, at any time. What stands
// before the first byte 0 is taken as JSON and what stands behind it as the bytes beside it, in a container with the right lengths; where there is
// no such byte, or all begins with "glTF", the bytes are the file itself.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "fuzz/shown.h"
#include "gltf/parts.h"
#include "gltf/pose.h"
#include "gltf/read.h"

namespace {

using namespace tofray;

constexpr std::size_t most_triangles = 3000;  // that nodes show: more would be slow, not different

std::string word(std::size_t value) {
  const auto number = static_cast<std::uint32_t>(value);
  std::string out(4, '\0');
  for (std::size_t k = 0; k < 4; ++k) out[k] = static_cast<char>(number >> 8 * k & 0xFF);
  return out;
}

std::string file_of(std::string_view data) {
  const std::size_t end = data.find('\0');
  if (end == std::string_view::npos || data.starts_with("glTF")) return std::string(data);
  const std::string_view json = data.substr(0, end), bytes = data.substr(end + 1);
  const std::string chunks =
      word(json.size()) + "JSON" + std::string(json) + word(bytes.size()) + std::string("BIN\0", 4) + std::string(bytes);
  return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
}

void look_at(const gltf::Model& model, const gltf::Pose& pose) {
  for (const gltf::Part& part : gltf::parts(model, pose)) {
    for (const auto& vertex : part.mesh.vertices)
      for (const float coordinate : vertex)
        if (!std::isfinite(coordinate)) std::abort();
    for (const auto& normal : part.normals) {
      const double length = std::sqrt(double{normal[0]} * normal[0] + double{normal[1]} * normal[1] + double{normal[2]} * normal[2]);
      if (length != 0 && !(std::abs(length - 1) < 1e-5)) std::abort();
    }
    for (const auto& triangle : part.mesh.triangles)
      for (const std::int32_t index : triangle)
        if (index < 0 || static_cast<std::size_t>(index) >= part.mesh.vertices.size()) std::abort();
    for (const std::size_t size : {part.normals.size(), part.texcoords[0].size(), part.texcoords[1].size(), part.colors.size()})
      if (size != 0 && size != part.mesh.vertices.size()) std::abort();
  }
}

std::size_t shown_triangles(const gltf::Model& model) {
  std::size_t sum = 0;
  for (const gltf::Node& node : model.nodes)
    if (node.mesh != gltf::none)
      for (const gltf::Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
        sum += primitive.triangles() * (1 + primitive.targets.size());
  return sum;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = file_of({reinterpret_cast<const char*>(data), size});
  const gltf::Resources beside = [](const std::string& path, std::size_t most) {
    if (path.empty() || path[0] == '/' || path.find('\0') != std::string::npos) std::abort();
    if (("/" + path + "/").find("/../") != std::string::npos) std::abort();
    return std::string(most < 200 ? most : 200, '\x3F');
  };
  try {
    const gltf::Model model = gltf::read("<fuzz>", bytes, beside);
    if (shown_triangles(model) > most_triangles) return 0;
    for (std::size_t scene = 0; scene < model.scenes.size() && scene < 4; ++scene)
      look_at(model, gltf::at(model, gltf::none, 0, static_cast<int>(scene)));
    for (std::size_t animation = 0; animation < model.animations.size() && animation < 4; ++animation)
      for (const double time : {-1.0, 0.0, 0.3, model.animations[animation].end_s, 1e300})
        look_at(model, gltf::at(model, static_cast<int>(animation), time));
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (!fuzz::may_be_shown(e)) std::abort();
  }
  return 0;
}
