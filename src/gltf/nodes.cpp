// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Nodes: a tree for each that has no parent, and the scenes that show some of them.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "base/text.h"
#include "gltf/reading.h"

namespace tofray::gltf {
namespace {

/// Column-major in files.
std::optional<Matrix> read_matrix(const Item& item) {
  std::array<double, 16> columns{};
  if (!item.numbers("matrix", columns)) return {};
  constexpr double rounding = 1e-4;
  Matrix out{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) out[row][column] = columns[4 * column + row];
    if (!(std::abs(columns[4 * column + 3] - (column == 3 ? 1 : 0)) <= rounding))
      item.fail_at("matrix", "has a last row that is not 0 0 0 1", "got " + base::number_text(columns[4 * column + 3]));
  }
  return out;
}

void read_rotation(Reading& reading, const Item& item, Node& node) {
  if (!item.numbers("rotation", node.rotation)) return;
  const double size = length(node.rotation);
  if (!(size > 1e-6 && size < 1e6)) item.fail_at("rotation", "is no rotation", "got a quaternion of length " + base::number_text(size));
  if (std::abs(size - 1) > 1e-3) reading.notices.add("rotations that are not of unit length are scaled");
  node.rotation = normalized(node.rotation);
}

/// Whether each primitive says which joints move its vertices, and all of them are the skin's.
void check_skin(const Reading& reading, const Item& item, const Node& node) {
  const std::size_t joints = reading.model.skins[static_cast<std::size_t>(node.skin)].joints.size();
  if (node.mesh == none) item.fail_at("skin", "is that of a node without a mesh", fmt::format("got skin {}", node.skin));
  const Mesh& mesh = reading.model.meshes[static_cast<std::size_t>(node.mesh)];
  if (!mesh.has_joints)
    item.fail_at("skin", "moves a mesh without joints", fmt::format("meshes[{}] has a primitive without JOINTS_0", node.mesh));
  if (mesh.most_joint >= joints)
    item.fail_at("skin", "has fewer joints than its mesh names",
                 fmt::format("meshes[{}] names joint {}, and there are {}, of which the first is 0", node.mesh, mesh.most_joint, joints));
}

constexpr unsigned normalized_too = written::real | written::normalized_unsigned | written::normalized_signed;
constexpr Wanted instance_vectors{"VEC3", nullptr, written::real, "VEC3 of floats"};
constexpr Wanted instance_rotations{"VEC4", nullptr, normalized_too, "VEC4 of floats or normalized numbers"};

Quaternion rotation_of(const Item& attributes, const std::vector<float>& all, std::size_t i) {
  const Quaternion q{all[4 * i], all[4 * i + 1], all[4 * i + 2], all[4 * i + 3]};
  const double size = length(q);
  if (!(size > 1e-6 && size < 1e6))
    attributes.fail_at("ROTATION", "is no rotation",
                       fmt::format("got a quaternion of length {} of instance {}", base::number_text(size), i));
  return normalized(q);
}

/// Where a node's mesh stands, each place in the node's own frame.
void read_instances(Reading& reading, const Item& item, Node& node) {
  const auto extensions = item.object("extensions");
  const auto extension = extensions ? extensions->object("EXT_mesh_gpu_instancing") : std::nullopt;
  if (!extension) return;
  const auto attributes = extension->object("attributes");
  if (!attributes || node.mesh == none)
    return reading.notices.add("instances without attributes, or of nodes without a mesh, are left out");
  if (node.skin != none) return reading.notices.add("instances of meshes with a skin are left out: one of each is shown");
  std::optional<std::uint64_t> count;
  const auto values = [&](const char* name, const Wanted& wanted) -> Floats {
    const int accessor = attributes->index(name, reading.accessors.size(), "accessors");
    if (accessor == none) return nullptr;
    const std::uint64_t its = reading.accessors[accessor].count;
    if (count && *count != its)
      attributes->fail_at(name, "has another number of instances", fmt::format("got {}, and another attribute has {}", its, *count));
    count = its;
    return reading.accessors.finite_floats(accessor, wanted, *attributes);
  };
  const Floats translation = values("TRANSLATION", instance_vectors), rotation = values("ROTATION", instance_rotations),
               scale = values("SCALE", instance_vectors);
  if (!count) return reading.notices.add("instances without TRANSLATION, ROTATION and SCALE are left out: one of each is shown");
  const auto vector = [](const Floats& all, std::size_t i, double otherwise) {
    return all ? Vec3{(*all)[3 * i], (*all)[3 * i + 1], (*all)[3 * i + 2]} : Vec3{otherwise, otherwise, otherwise};
  };
  node.instances.emplace();
  for (std::size_t i = 0; i < *count; ++i)
    node.instances->push_back(transform(vector(translation, i, 0),
                                        rotation ? rotation_of(*attributes, *rotation, i) : Quaternion{0, 0, 0, 1}, vector(scale, i, 1)));
}

Node read_node(Reading& reading, const Item& item, std::size_t nodes) {
  Node node;
  const Model& model = reading.model;
  node.name = item.name();
  node.children = item.indices("children", nodes, "nodes");
  node.mesh = item.index("mesh", model.meshes.size(), "meshes");
  node.skin = item.index("skin", model.skins.size(), "skins");
  node.camera = item.index("camera", model.cameras.size(), "cameras");
  if (node.skin != none) check_skin(reading, item, node);
  read_instances(reading, item, node);
  node.matrix = read_matrix(item);
  item.numbers("translation", node.translation);
  item.numbers("scale", node.scale);
  read_rotation(reading, item, node);
  if (node.matrix && (item.has("translation") || item.has("scale") || item.has("rotation")))
    item.fail("has a matrix and a translation, rotation or scale", "expected one of the two");
  if (item.has("weights")) {
    const std::size_t targets = node.mesh == none ? 0 : model.meshes[static_cast<std::size_t>(node.mesh)].weights.size();
    node.weights = item.all_numbers("weights");
    if (node.weights.size() != targets)
      item.fail_at("weights", "are not one for each morph target", fmt::format("got {}, and there are {}", node.weights.size(), targets));
  }
  return node;
}

void find_parents(Reading& reading, const std::vector<Item>& items) {
  auto& nodes = reading.model.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const int child : nodes[i].children) {
      int& parent = nodes[static_cast<std::size_t>(child)].parent;
      if (parent != none)
        items[static_cast<std::size_t>(child)].fail("has two parents", fmt::format("they are nodes[{}] and nodes[{}]", parent, i));
      parent = static_cast<int>(i);
    }
}

/// Fills parents_first. Each node has one parent at most, so that what no walk from a root meets lies on a cycle, or below one.
void put_in_order(Reading& reading, const std::vector<Item>& items) {
  Model& model = reading.model;
  std::vector<int> depth(model.nodes.size(), 0);
  const auto meet = [&](int node, int at_depth) {
    if (at_depth > base::limit::gltf_depth.value)
      items[static_cast<std::size_t>(node)].fail(
          "is too deep", fmt::format("nodes may stand {} deep below each other (`tofray --limits`)", base::limit::gltf_depth.value),
          ErrorKind::limit);
    depth[static_cast<std::size_t>(node)] = at_depth;
    model.parents_first.push_back(node);
  };
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].parent == none) meet(static_cast<int>(i), 1);
  for (std::size_t next = 0; next < model.parents_first.size(); ++next) {
    const auto node = static_cast<std::size_t>(model.parents_first[next]);
    for (const int child : model.nodes[node].children) meet(child, depth[node] + 1);
  }
  const auto lost = std::find(depth.begin(), depth.end(), 0);
  if (lost != depth.end()) items[static_cast<std::size_t>(lost - depth.begin())].fail("is below itself", "expected a tree of nodes");
}

void read_scenes(Reading& reading) {
  Model& model = reading.model;
  for (const Item& item : reading.root.objects("scenes")) {
    Scene& scene = model.scenes.emplace_back(Scene{item.name(), item.indices("nodes", model.nodes.size(), "nodes")});
    for (const int node : scene.nodes)
      if (const int parent = model.nodes[static_cast<std::size_t>(node)].parent; parent != none)
        item.fail_at("nodes", "has a node with a parent", fmt::format("nodes[{}] is a child of nodes[{}]", node, parent));
  }
  const int chosen = reading.root.index("scene", model.scenes.size(), "scenes");
  model.scene = chosen == none ? 0 : chosen;
  if (chosen == none && model.scenes.size() > 1)
    reading.notices.add("the file has several scenes and names none of them: the first is taken");
  if (!model.scenes.empty()) return;
  Scene& all = model.scenes.emplace_back();
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].parent == none) all.nodes.push_back(static_cast<int>(i));
}

}  // namespace

void read_nodes(Reading& reading) {
  const std::vector<Item> items = reading.root.objects("nodes");
  for (const Item& item : items) reading.model.nodes.push_back(read_node(reading, item, items.size()));
  find_parents(reading, items);
  put_in_order(reading, items);
  read_scenes(reading);
}

}  // namespace tofray::gltf
