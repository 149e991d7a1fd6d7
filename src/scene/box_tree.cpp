// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/box_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include "base/parallel.h"

namespace tofray::scene {

namespace {

using shape::MeshNode;
using QuadInt = std::int32_t __attribute__((vector_size(16)));

constexpr int bins = 16;
constexpr std::size_t leaf_size = shape::block_width;  ///< triangles that are not worth a cut
constexpr int greedy_levels = 18;                      ///< below them a node is cut in halves: eight of them reach any number of triangles
constexpr std::size_t few = 10'000;                    ///< triangles whose boxes are there as soon as threads would be
constexpr std::size_t many = 200'000;                  ///< items that are cut half by half

/// x, y and z of an item's low corner, beside which its number lies.
Quad low_of(const BoxItem& item) {
  QuadInt words;
  std::memcpy(&words, &item, sizeof words);
  words &= QuadInt{-1, -1, -1, 0};
  Quad out;
  std::memcpy(&out, &words, sizeof out);
  return out;
}
/// x, y and z of its high corner, and 0.
Quad high_of(const BoxItem& item) {
  static_assert(offsetof(BoxItem, low) == 0 && sizeof(BoxItem) == offsetof(BoxItem, high) + sizeof(Quad));
  Quad out;
  std::memcpy(&out, reinterpret_cast<const char*>(&item) + offsetof(BoxItem, high), sizeof out);
  return out;
}
/// Twice the middle of its box.
Quad middle_of(const BoxItem& item) { return low_of(item) + high_of(item); }

/// Items [first, last), the box around them, and the one around (twice) their middles.
struct Part {
  std::size_t first = 0, last = 0;
  Bounds3 bounds, middles;
  [[nodiscard]] std::size_t count() const { return last - first; }
};
/// What a node holds.
struct Parts {
  std::array<Part, shape::mesh_width> part;
  std::size_t count = 0;
};

/// Which of 16 bins an item is in, along each axis. All are in the first one along an axis on which their middles are at one place.
struct Binning {
  Quad low, per{};
  explicit Binning(const Bounds3& middles) : low(middles.low) {
    for (int k = 0; k < 3; ++k) {
      const float one = 0.999f * bins / (middles.high[k] - middles.low[k]);
      per[k] = one < std::numeric_limits<float>::max() ? one : 0.0f;
    }
    low[3] = 0;
  }
  [[nodiscard]] QuadInt of(const Quad& middle) const {
    constexpr QuadInt none{}, last{bins - 1, bins - 1, bins - 1, bins - 1};
    QuadInt bin = __builtin_convertvector((middle - low) * per, QuadInt);
    bin = bin < none ? none : bin;
    return last < bin ? last : bin;
  }
};

/// The cheapest place between two bins.
struct Cut {
  float cost = std::numeric_limits<float>::infinity();
  int axis = 0, bin = 0;
  std::size_t before = 0;  ///< items
  Bounds3 bounds_before, bounds_after;
};

struct Bins {
  std::array<Bounds3, bins> bounds;
  std::array<std::size_t, bins> count{};

  void add(const Bins& other) {
    for (std::size_t i = 0; i < bins; ++i) bounds[i].add(other.bounds[i]), count[i] += other.count[i];
  }

  /// A leaf costs as much whether it is full or not.
  static float blocks(std::size_t count) { return static_cast<float>((count + leaf_size - 1) / leaf_size); }

  void cheapest(int axis, Cut& best) const {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    std::array<float, bins> cost_after{};
    std::array<Bounds3, bins> after;
    Bounds3 sum;
    std::size_t items = 0;
    for (std::size_t i = bins - 1; i > 0; --i) {
      sum.add(bounds[i]), items += count[i];
      cost_after[i] = items == 0 ? infinite : sum.half_area() * blocks(items);
      after[i] = sum;
    }
    sum = {}, items = 0;
    for (std::size_t i = 0; i + 1 < bins; ++i) {
      sum.add(bounds[i]), items += count[i];
      const float cost = items == 0 ? infinite : sum.half_area() * blocks(items) + cost_after[i + 1];
      if (cost < best.cost) best = {cost, axis, static_cast<int>(i), items, sum, after[i + 1]};
    }
  }
};

/// Nodes and blocks of one part of the items; its node 0 holds all of that.
struct Grown {
  std::vector<MeshNode> nodes;
  std::vector<BoxBlock> blocks;
};

class Builder {
 public:
  Builder(const TriangleMesh& mesh, int threads, BoxTree& out)
      : mesh_(mesh), out_(out), threads_(mesh.triangles.size() < few ? 1 : threads) {}

  void build() {
    const Part all = take_items();
    out_.bounds = all.bounds;
    out_.nodes.emplace_back();
    if (all.count() == 0) return;
    std::vector<Job> jobs = {{0, 0, all}};
    if (all.count() >= few) {
      for (int round = 0; round < 2; ++round) jobs = divide_all(jobs);
    }
    std::vector<Grown> grown(jobs.size());
    base::in_parallel(static_cast<int>(jobs.size()), threads_,
                      [&](int i) { grow(jobs[static_cast<std::size_t>(i)], grown[static_cast<std::size_t>(i)]); });
    for (std::size_t i = 0; i < jobs.size(); ++i) append(grown[i], jobs[i].node);
  }

 private:
  /// What a node, which is there already, is to hold.
  struct Job {
    std::int32_t node;
    int level;
    Part part;
  };

  Part take_items() {
    const std::size_t count = mesh_.triangles.size();
    constexpr std::size_t chunk = 1 << 14;
    const std::size_t chunks = (count + chunk - 1) / chunk;
    out_.items.resize(count);
    std::vector<Part> parts(chunks);
    base::in_parallel(static_cast<int>(chunks), threads_, [&](int c) {
      Part& part = parts[static_cast<std::size_t>(c)];
      const std::size_t first = static_cast<std::size_t>(c) * chunk;
      for (std::size_t i = first; i < std::min(first + chunk, count); ++i) {
        Bounds3 box;
        for (const std::int32_t corner : mesh_.triangles[i]) {
          const auto& vertex = mesh_.vertices[static_cast<std::size_t>(corner)];
          box.add(Quad{vertex[0], vertex[1], vertex[2], 0});
        }
        BoxItem& item = out_.items[i];
        for (int k = 0; k < 3; ++k) item.low[k] = box.low[k], item.high[k] = box.high[k];
        item.number = static_cast<std::int32_t>(i);
        part.bounds.add(box), part.middles.add(middle_of(item));
      }
    });
    Part all;
    all.last = count;
    for (const Part& part : parts) all.bounds.add(part.bounds), all.middles.add(part.middles);
    return all;
  }

  [[nodiscard]] Part part_of(std::size_t first, std::size_t last) const {
    Part out{first, last, {}, {}};
    for (std::size_t i = first; i < last; ++i)
      out.bounds.add(low_of(out_.items[i]), high_of(out_.items[i])), out.middles.add(middle_of(out_.items[i]));
    return out;
  }

  /// Up to eight parts: the one with the largest box is cut again and again; far down, the one with the most triangles.
  void divide(const Part& whole, int level, Parts& out) {
    out.part[0] = whole, out.count = 1;
    while (out.count < out.part.size()) {
      std::size_t best = out.count;
      float most = -1;
      for (std::size_t i = 0; i < out.count; ++i) {
        const Part& part = out.part[i];
        if (part.count() <= leaf_size) continue;
        const float size = level < greedy_levels ? part.bounds.half_area() : static_cast<float>(part.count());
        if (size > most) most = size, best = i;
      }
      if (best == out.count) break;
      const Part before = out.part[best];
      if (level < greedy_levels) {
        cut(before, out.part[best], out.part[out.count]);
      } else {
        halve(before, out.part[best], out.part[out.count]);
      }
      ++out.count;
    }
  }

  /// At the cheapest place.
  void cut(const Part& part, Part& before, Part& after) {
    const Binning binning(part.middles);
    std::array<Bins, 3> table;
    const std::size_t half = part.first + part.count() / 2;
    if (part.count() < many) {
      fill(part.first, part.last, binning, table);
    } else {
      std::array<std::array<Bins, 3>, 2> halves;
      base::in_parallel(2, threads_, [&](int i) {
        fill(i == 0 ? part.first : half, i == 0 ? half : part.last, binning, halves[static_cast<std::size_t>(i)]);
      });
      for (std::size_t k = 0; k < 3; ++k) table[k].add(halves[0][k]), table[k].add(halves[1][k]);
    }
    Cut best;
    for (int k = 0; k < 3; ++k)
      if (binning.per[k] > 0) table[static_cast<std::size_t>(k)].cheapest(k, best);
    if (best.cost == std::numeric_limits<float>::infinity()) return halve(part, before, after);
    before = {part.first, part.first + best.before, best.bounds_before, {}};
    after = {before.last, part.last, best.bounds_after, {}};
    std::array<Sides, 2> sides;
    if (part.count() < many) {
      sides[0] = sort(part.first, part.last, binning, best);
    } else {
      base::in_parallel(2, threads_, [&](int i) {
        sides[static_cast<std::size_t>(i)] = sort(i == 0 ? part.first : half, i == 0 ? half : part.last, binning, best);
      });
      // What is after the cut in the first half changes places with what is before it in the second, as much as there is of both.
      const std::size_t moved = std::min(half - sides[0].cut, sides[1].cut - half);
      const auto at = [&](std::size_t i) { return out_.items.begin() + static_cast<std::ptrdiff_t>(i); };
      std::swap_ranges(at(sides[0].cut), at(sides[0].cut + moved), at(sides[1].cut - moved));
    }
    for (const Sides& one : sides) before.middles.add(one.before), after.middles.add(one.after);
  }

  void fill(std::size_t first, std::size_t last, const Binning& binning, std::array<Bins, 3>& table) const {
    for (std::size_t i = first; i < last; ++i) {
      const BoxItem& item = out_.items[i];
      const Quad low = low_of(item), high = high_of(item);
      const QuadInt bin = binning.of(low + high);
      for (int k = 0; k < 3; ++k) {
        const auto b = static_cast<std::size_t>(bin[k]);
        table[static_cast<std::size_t>(k)].bounds[b].add(low, high), ++table[static_cast<std::size_t>(k)].count[b];
      }
    }
  }

  /// Where the items after a cut begin, and the boxes around the middles on both sides.
  struct Sides {
    std::size_t cut = 0;
    Bounds3 before, after;
  };
  /// Puts the items before and after a cut in their order. Which of them are before is as good as random: each is put where the next one
  /// before belongs, and what lay there goes where it was, without a branch.
  Sides sort(std::size_t first, std::size_t last, const Binning& binning, const Cut& at) {
    Bounds3 middles[2];
    std::size_t next = first;
    for (std::size_t i = first; i < last; ++i) {
      const BoxItem item = out_.items[i];
      const Quad middle = middle_of(item);
      const auto is_before = static_cast<std::size_t>(binning.of(middle)[at.axis] <= at.bin);
      out_.items[i] = out_.items[next];
      out_.items[next] = item;
      next += is_before;
      middles[is_before].add(middle);
    }
    return {next, middles[1], middles[0]};
  }

  /// Half of the items on each side, along the longest way between their middles.
  void halve(const Part& part, Part& before, Part& after) {
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (part.middles.high[k] - part.middles.low[k] > part.middles.high[axis] - part.middles.low[axis]) axis = k;
    const std::size_t middle = part.first + part.count() / 2, last = part.last;
    const auto at = [&](std::size_t i) { return out_.items.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(part.first), at(middle), at(last), [axis](const BoxItem& a, const BoxItem& b) {
      const float of_a = a.low[axis] + a.high[axis], of_b = b.low[axis] + b.high[axis];
      return of_a != of_b ? of_a < of_b : a.number < b.number;
    });
    before = part_of(part.first, middle), after = part_of(middle, last);
  }

  static void put_box(MeshNode& node, std::size_t i, const Part& part) {
    for (int k = 0; k < 3; ++k) node.low[k][i] = part.bounds.low[k], node.high[k][i] = part.bounds.high[k];
  }
  static std::int32_t block(const Part& part, std::vector<BoxBlock>& blocks) {
    blocks.push_back({static_cast<std::uint32_t>(part.first), static_cast<std::uint32_t>(part.count())});
    return shape::leaf_of(static_cast<std::int32_t>(blocks.size()) - 1, static_cast<std::int32_t>(part.count()));
  }

  /// A level of the nodes at the top, each divided by a thread. @return what their children are to hold
  std::vector<Job> divide_all(const std::vector<Job>& jobs) {
    std::vector<Parts> all(jobs.size());
    base::in_parallel(static_cast<int>(jobs.size()), threads_, [&](int i) {
      const Job& job = jobs[static_cast<std::size_t>(i)];
      divide(job.part, job.level, all[static_cast<std::size_t>(i)]);
    });
    std::vector<Job> out;
    for (std::size_t i = 0; i < jobs.size(); ++i) put_node(jobs[i], all[i], out_.nodes, out_.blocks, out);
    return out;
  }

  /// Fills a job's node: its small parts are blocks, and each of the others is a new node and a job.
  static void put_node(const Job& job, const Parts& parts, std::vector<MeshNode>& nodes, std::vector<BoxBlock>& blocks,
                       std::vector<Job>& jobs) {
    MeshNode node{};
    node.children = static_cast<std::int32_t>(parts.count);
    for (std::size_t i = 0; i < parts.count; ++i) {
      const Part& part = parts.part[i];
      put_box(node, i, part);
      if (part.count() <= leaf_size) {
        node.child[i] = block(part, blocks);
      } else {
        node.child[i] = static_cast<std::int32_t>(nodes.size());
        nodes.emplace_back();
        jobs.push_back({node.child[i], job.level + 1, part});
      }
    }
    nodes[static_cast<std::size_t>(job.node)] = node;
  }

  void grow(const Job& from, Grown& out) {
    out.blocks.reserve(from.part.count() / 12 + 1);  // of 16 places 13 are filled, mostly
    out.nodes.emplace_back();
    std::vector<Job> jobs = {{0, from.level, from.part}};
    Parts parts;
    while (!jobs.empty()) {
      const Job job = jobs.back();
      jobs.pop_back();
      divide(job.part, job.level, parts);
      put_node(job, parts, out.nodes, out.blocks, jobs);
    }
  }

  /// Its first node in place of one that is there, and the others behind all.
  void append(const Grown& grown, std::int32_t at) {
    const auto nodes = static_cast<std::int32_t>(out_.nodes.size()) - 1, blocks = static_cast<std::int32_t>(out_.blocks.size());
    const auto moved = [&](const MeshNode& from) {
      MeshNode node = from;
      for (int i = 0; i < node.children; ++i) {
        std::int32_t& child = node.child[i];
        child = child >= 0 ? child + nodes : shape::leaf_of(shape::block_of(child) + blocks, shape::count_of(child));
      }
      return node;
    };
    out_.nodes[static_cast<std::size_t>(at)] = moved(grown.nodes.front());
    for (std::size_t n = 1; n < grown.nodes.size(); ++n) out_.nodes.push_back(moved(grown.nodes[n]));
    out_.blocks.insert(out_.blocks.end(), grown.blocks.begin(), grown.blocks.end());
  }

  const TriangleMesh& mesh_;
  BoxTree& out_;
  int threads_;
};

}  // namespace

BoxTree build_box_tree(const TriangleMesh& mesh, int threads) {
  BoxTree out;
  Builder(mesh, threads, out).build();
  return out;
}

}  // namespace tofray::scene
