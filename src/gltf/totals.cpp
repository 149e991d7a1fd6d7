// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How much there is: of each list, and of what all nodes show, since one mesh may stand in many places.
#include <fmt/core.h>

#include <algorithm>

#include "base/limits.h"
#include "gltf/reading.h"

namespace tofray::gltf {
namespace {

struct Total {
  const base::Limit& limit;
  const char* what;
  std::uint64_t sum = 0;

  /// Sums stay below 2^33 · 2^31.
  void add(const Item& root, std::uint64_t more) {
    sum += more;
    if (sum > static_cast<std::uint64_t>(limit.value))
      root.fail(fmt::format("the nodes show too many {}", what),
                fmt::format("got more than {} in all (`tofray --limits`); a mesh counts as often as nodes show it", limit.value),
                ErrorKind::limit);
  }
};

struct List {
  std::string_view name;
  const base::Limit& limit = base::limit::gltf_items;
};
constexpr List lists[] = {{"accessors"}, {"animations"}, {"buffers"},  {"bufferViews"},
                          {"cameras"},   {"images"},     {"samplers"}, {"materials", base::limit::materials},
                          {"meshes"},    {"scenes"},     {"skins"},    {"nodes", base::limit::gltf_nodes},
                          {"textures"}};

}  // namespace

void check_lists(const Item& root) {
  for (const List& list : lists)
    if (const std::size_t size = root.size(list.name); size > static_cast<std::size_t>(list.limit.value))
      root.fail_at(list.name, "are too many", fmt::format("got {}, at most {} (`tofray --limits`)", size, list.limit.value),
                   ErrorKind::limit);
}

void check_totals(const Reading& reading) {
  Total parts{base::limit::gltf_parts, "primitives"}, triangles{base::limit::mesh_triangles, "triangles"},
      vertices{base::limit::mesh_vertices, "vertices"}, morphs{base::limit::gltf_morphs, "vertices times morph targets"};
  for (const Node& node : reading.model.nodes) {
    if (node.mesh == none) continue;
    const Mesh& mesh = reading.model.meshes[static_cast<std::size_t>(node.mesh)];
    const std::uint64_t times = node.shown();  // below 2^28
    morphs.add(reading.root, mesh.weights.size());
    for (const Primitive& primitive : mesh.primitives) {
      const std::uint64_t used = std::min(primitive.vertices(), 3 * primitive.triangles());
      parts.add(reading.root, times);
      triangles.add(reading.root, times * primitive.triangles());
      vertices.add(reading.root, times * used);
      morphs.add(reading.root, times * (used * primitive.targets.size()));
    }
  }
}

}  // namespace tofray::gltf
