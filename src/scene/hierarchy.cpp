// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/hierarchy.h"

#include <algorithm>
#include <array>
#include <limits>

#include "base/content.h"
#include "base/shared.h"

namespace tofray::scene {

namespace {

using shape::MeshNode;

constexpr int bins = 16;
constexpr std::size_t leaf_size = shape::block_width;  ///< triangles that are not worth a cut
constexpr int greedy_levels = 18;                      ///< below them a node is cut in halves: eight of them reach any number of triangles

/// Boxes by their corners. An empty one is the wrong way round.
struct Bounds3 {
  std::array<float, 3> low, high;
  Bounds3() { low.fill(std::numeric_limits<float>::infinity()), high.fill(-std::numeric_limits<float>::infinity()); }
  void add(const std::array<float, 3>& p) {
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  void add(const Bounds3& other) { add(other.low), add(other.high); }
  [[nodiscard]] float half_area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
  }
};

void put_box(const Bounds3& bounds, Hierarchy& out) {
  for (int k = 0; k < 3; ++k) {
    const double low = static_cast<double>(bounds.low[static_cast<std::size_t>(k)]),
                 high = static_cast<double>(bounds.high[static_cast<std::size_t>(k)]);
    out.center[k] = 0.5 * (low + high), out.half[k] = 0.5 * (high - low);
  }
}

/// Calls take(corner, its vertex's number, place) for the corners of a block's triangles.
template <class Take>
void each_corner(const TriangleMesh& mesh, const shape::MeshTriangles& block, const Take& take) {
  for (std::size_t i = 0; i < shape::block_width; ++i) {
    const auto& corners = mesh.triangles[static_cast<std::size_t>(block.number[i])];
    for (std::size_t c = 0; c < 3; ++c) take(c, static_cast<std::size_t>(corners[c]), i);
  }
}

void put_corners(const TriangleMesh& mesh, shape::MeshTriangles& block) {
  each_corner(mesh, block, [&](std::size_t c, std::size_t vertex, std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) block.corner[c][k][i] = mesh.vertices[vertex][k];
  });
}
void put_normals(const TriangleMesh& mesh, const shape::MeshTriangles& block, shape::MeshDetails& details) {
  each_corner(mesh, block, [&](std::size_t c, std::size_t vertex, std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) details.normal[c][k][i] = mesh.normals.empty() ? 0 : mesh.normals[vertex][k];
  });
}

struct Item {
  Bounds3 bounds;
  std::array<float, 3> middle;
  std::int32_t number;
};

/// Items [first, last) and the box round them.
struct Range {
  std::size_t first, last;
  Bounds3 bounds;
  [[nodiscard]] std::size_t count() const { return last - first; }
};

class Builder {
 public:
  Builder(const TriangleMesh& mesh, Hierarchy& out) : mesh_(mesh), out_(out) {
    items_.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Item item;
      for (const std::int32_t corner : mesh.triangles[i]) item.bounds.add(mesh.vertices[static_cast<std::size_t>(corner)]);
      for (std::size_t k = 0; k < 3; ++k) item.middle[k] = 0.5f * (item.bounds.low[k] + item.bounds.high[k]);
      item.number = static_cast<std::int32_t>(i);
      items_.push_back(item);
    }
  }

  void build() {
    const Range all = range(0, items_.size());
    out_.triangles.reserve(items_.size() / 12 + 1);  // of 16 places 13 are filled, mostly
    out_.nodes.emplace_back();
    struct Job {
      std::int32_t node;
      int level;
      Range range;
    };
    std::vector<Job> jobs;
    if (all.count() > 0) jobs.push_back({0, 0, all});
    while (!jobs.empty()) {
      const Job job = jobs.back();
      jobs.pop_back();
      const std::vector<Range> parts = divided(job.range, job.level);
      MeshNode node{};
      for (const Range& part : parts) {
        const auto i = static_cast<std::size_t>(node.children++);
        for (std::size_t k = 0; k < 3; ++k) node.low[k][i] = part.bounds.low[k], node.high[k][i] = part.bounds.high[k];
        if (part.count() <= leaf_size) {
          node.child[i] = leaf(part);
        } else {
          node.child[i] = static_cast<std::int32_t>(out_.nodes.size());
          out_.nodes.emplace_back();
          jobs.push_back({node.child[i], job.level + 1, part});
        }
      }
      out_.nodes[static_cast<std::size_t>(job.node)] = node;
    }
    if (all.count() > 0) put_box(all.bounds, out_);
  }

 private:
  [[nodiscard]] Range range(std::size_t first, std::size_t last) const {
    Range out{first, last, {}};
    for (std::size_t i = first; i < last; ++i) out.bounds.add(items_[i].bounds);
    return out;
  }

  /// Up to eight parts: the one with the largest box is cut again and again; far down, the one with the most triangles.
  std::vector<Range> divided(const Range& whole, int level) {
    std::vector<Range> parts = {whole};
    while (parts.size() < shape::mesh_width) {
      std::size_t best = parts.size();
      float most = -1;
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (parts[i].count() <= leaf_size) continue;
        const float size = level < greedy_levels ? parts[i].bounds.half_area() : static_cast<float>(parts[i].count());
        if (size > most) most = size, best = i;
      }
      if (best == parts.size()) break;
      const std::size_t middle = level < greedy_levels ? cut(parts[best]) : halve(parts[best]);
      const Range before = parts[best];
      parts[best] = range(before.first, middle);
      parts.push_back(range(middle, before.last));
    }
    return parts;
  }

  struct Bin {
    Bounds3 bounds;
    std::size_t count = 0;
  };
  struct Cut {
    float cost = std::numeric_limits<float>::infinity();
    std::size_t axis = 0, bin = 0;
  };

  /// Puts the items before and after the cheapest cut in their order. @return where it is
  std::size_t cut(const Range& part) {
    Bounds3 middles;
    for (std::size_t i = part.first; i < part.last; ++i) middles.add(items_[i].middle);
    std::array<float, 3> per{};
    for (std::size_t k = 0; k < 3; ++k) per[k] = 0.999f * bins / (middles.high[k] - middles.low[k]);
    const auto bin_of = [&](const Item& item, std::size_t k) {
      return std::min<std::size_t>(bins - 1, static_cast<std::size_t>((item.middle[k] - middles.low[k]) * per[k]));
    };
    std::array<std::array<Bin, bins>, 3> table;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(per[k] < std::numeric_limits<float>::max())) continue;  // all middles at one place
      for (std::size_t i = part.first; i < part.last; ++i) {
        Bin& bin = table[k][bin_of(items_[i], k)];
        bin.bounds.add(items_[i].bounds), ++bin.count;
      }
    }
    Cut best;
    for (std::size_t k = 0; k < 3; ++k) cheapest(table[k], k, best);
    if (best.cost == std::numeric_limits<float>::infinity()) return halve(part);
    const auto middle =
        std::partition(begin(part.first), begin(part.last), [&](const Item& item) { return bin_of(item, best.axis) <= best.bin; });
    return static_cast<std::size_t>(middle - items_.begin());
  }

  /// A leaf costs as much whether it is full or not.
  static float blocks(std::size_t count) { return static_cast<float>((count + leaf_size - 1) / leaf_size); }

  static void cheapest(const std::array<Bin, bins>& table, std::size_t axis, Cut& best) {
    std::array<float, bins> after{};
    Bounds3 bounds;
    std::size_t count = 0;
    for (std::size_t i = bins - 1; i > 0; --i) {
      bounds.add(table[i].bounds), count += table[i].count;
      after[i] = count == 0 ? std::numeric_limits<float>::infinity() : bounds.half_area() * blocks(count);
    }
    bounds = {}, count = 0;
    for (std::size_t i = 0; i + 1 < bins; ++i) {
      bounds.add(table[i].bounds), count += table[i].count;
      const float cost = count == 0 ? std::numeric_limits<float>::infinity() : bounds.half_area() * blocks(count) + after[i + 1];
      if (cost < best.cost) best = {cost, axis, i};
    }
  }

  /// Half of the items on each side, along the longest way between their middles.
  std::size_t halve(const Range& part) {
    Bounds3 middles;
    for (std::size_t i = part.first; i < part.last; ++i) middles.add(items_[i].middle);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (middles.high[k] - middles.low[k] > middles.high[axis] - middles.low[axis]) axis = k;
    const std::size_t middle = part.first + part.count() / 2;
    std::nth_element(begin(part.first), begin(middle), begin(part.last), [axis](const Item& a, const Item& b) {
      return a.middle[axis] != b.middle[axis] ? a.middle[axis] < b.middle[axis] : a.number < b.number;
    });
    return middle;
  }

  std::int32_t leaf(const Range& part) {
    const auto block = static_cast<std::int32_t>(out_.triangles.size());
    shape::MeshTriangles& triangles = out_.triangles.emplace_back();
    for (std::size_t i = 0; i < shape::block_width; ++i) triangles.number[i] = items_[std::min(part.first + i, part.last - 1)].number;
    put_corners(mesh_, triangles);
    if (!mesh_.normals.empty() || !mesh_.texcoords.empty() || !mesh_.shades.empty()) add_details(triangles);
    return shape::leaf_of(block, static_cast<std::int32_t>(part.count()));
  }

  void add_details(const shape::MeshTriangles& triangles) {
    shape::MeshDetails& details = out_.details.emplace_back();
    put_normals(mesh_, triangles, details);
    each_corner(mesh_, triangles, [&](std::size_t c, std::size_t vertex, std::size_t i) {
      for (std::size_t k = 0; k < 2; ++k) details.texcoord[c][k][i] = mesh_.texcoords.empty() ? 0 : mesh_.texcoords[vertex][k];
      details.shade[c][i] = mesh_.shades.empty() ? 1 : mesh_.shades[vertex];
    });
  }

  std::vector<Item>::iterator begin(std::size_t at) { return items_.begin() + static_cast<std::ptrdiff_t>(at); }

  const TriangleMesh& mesh_;
  Hierarchy& out_;
  std::vector<Item> items_;
};

}  // namespace

Hierarchy build_hierarchy(const TriangleMesh& mesh) {
  Hierarchy out;
  Builder(mesh, out).build();
  out.has_texcoords = !mesh.texcoords.empty(), out.has_shades = !mesh.shades.empty();
  return out;
}

std::shared_ptr<const Hierarchy> shared_hierarchy(const TriangleMesh& mesh) {
  base::Content content;
  content.add(mesh.vertices), content.add(mesh.triangles), content.add(mesh.normals);
  content.add(mesh.texcoords), content.add(mesh.shades);
  return base::shared<base::Content, Hierarchy>().get(
      content, [&] { return build_hierarchy(mesh); },
      [](const Hierarchy& made) {
        return made.nodes.size() * sizeof made.nodes[0] + made.triangles.size() * sizeof made.triangles[0] +
               made.details.size() * sizeof made.details[0];
      });
}

void refit(const Hierarchy& from, const TriangleMesh& mesh, Hierarchy& out) {
  out = from;
  for (std::size_t i = 0; i < out.triangles.size(); ++i) {
    put_corners(mesh, out.triangles[i]);
    if (!out.details.empty()) put_normals(mesh, out.triangles[i], out.details[i]);
  }
  // A node's children come behind it.
  std::vector<Bounds3> boxes(out.nodes.size());
  for (std::size_t n = out.nodes.size(); n-- > 0;) {
    MeshNode& node = out.nodes[n];
    for (std::size_t i = 0; i < static_cast<std::size_t>(node.children); ++i) {
      Bounds3 box;
      if (node.child[i] >= 0) {
        box = boxes[static_cast<std::size_t>(node.child[i])];
      } else {
        each_corner(mesh, out.triangles[static_cast<std::size_t>(shape::block_of(node.child[i]))],
                    [&](std::size_t, std::size_t vertex, std::size_t) { box.add(mesh.vertices[vertex]); });
      }
      for (std::size_t k = 0; k < 3; ++k) node.low[k][i] = box.low[k], node.high[k][i] = box.high[k];
      boxes[n].add(box);
    }
  }
  if (!out.triangles.empty()) put_box(boxes[0], out);
}

std::vector<shape::MeshSteps> steps_of(const Hierarchy& of, const TriangleMesh& mesh, const Vertices& before, const Vertices& after,
                                       double apart_s, const Vertices& now, const Vertices& later) {
  std::vector<shape::MeshSteps> out(of.triangles.size());
  for (std::size_t b = 0; b < out.size(); ++b)
    each_corner(mesh, of.triangles[b], [&](std::size_t c, std::size_t vertex, std::size_t i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto change = [&](const Vertices& from, const Vertices& to) {
          return static_cast<double>(to[vertex][k]) - static_cast<double>(from[vertex][k]);
        };
        out[b].velocity[c][k][i] = static_cast<float>(change(before, after) / (2 * apart_s));
        out[b].step[c][k][i] = static_cast<float>(change(now, later));
      }
    });
  return out;
}

}  // namespace tofray::scene
