// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/clustering.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace tofray::scene {

namespace {

using Point = std::array<double, 3>;

constexpr float infinite = std::numeric_limits<float>::infinity();

/// The middle of the shape's box.
template <class T>
Point middle_of(const T& shape) {
  Point out{};
  for (std::size_t k = 0; k < 3; ++k) {
    const shape::Span span = span_along(shape, {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0});
    out[k] = 0.5 * (span.low + span.high);
  }
  return out;
}

/// The coordinate in which the points are farthest apart.
std::size_t widest(const std::vector<Point>& points, const std::int32_t* from, const std::int32_t* to) {
  Point low{}, high{};
  low.fill(1e300), high.fill(-1e300);
  for (; from != to; ++from) {
    const Point& point = points[static_cast<std::size_t>(*from)];
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], point[k]), high[k] = std::max(high[k], point[k]);
  }
  const Point size{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  return static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
}

/// Halves them, at a multiple of 32, until 32 are left.
void sort(const std::vector<Point>& points, std::int32_t* from, std::int32_t* to) {
  if (to - from <= cluster_size) return std::sort(from, to);
  const std::size_t k = widest(points, from, to);
  std::int32_t* const half = from + ((to - from) / 2 + cluster_size - 1) / cluster_size * cluster_size;
  std::nth_element(from, half, to, [&](std::int32_t a, std::int32_t b) {
    return points[static_cast<std::size_t>(a)][k] < points[static_cast<std::size_t>(b)][k];
  });
  sort(points, from, half), sort(points, half, to);
}

void put(ManyBounds& many, int i, const Bounds& one, float near) {
  many.x_min[i] = one.x_min, many.x_max[i] = one.x_max, many.y_min[i] = one.y_min, many.y_max[i] = one.y_max;
  many.near[i] = near;
}

constexpr Bounds none{infinite, -infinite, infinite, -infinite};

/// What holds all of them.
Bounds around(const ManyBounds& many) {
  Bounds out = none;
  for (int i = 0; i < cluster_size; ++i) {
    out = {std::min(out.x_min, many.x_min[i]), std::max(out.x_max, many.x_max[i]), std::min(out.y_min, many.y_min[i]),
           std::max(out.y_max, many.y_max[i])};
  }
  return out;
}

float nearest_of(const ManyBounds& many) { return *std::min_element(many.near, many.near + cluster_size); }

/// One row.
/// @param begins  (body): from which depth on it is met
template <class Form, class Begins>
void fill(const std::int32_t* bodies, int clusters, const Form* forms, const Begins& begins, ManyBounds* of_bodies,
          ManyBounds* of_clusters) {
  for (int c = 0; c < clusters; ++c) {
    for (int i = 0; i < cluster_size; ++i) {
      const std::int32_t body = bodies[c * cluster_size + i];
      if (body < 0) {
        put(of_bodies[c], i, none, infinite);
      } else {
        put(of_bodies[c], i, forms[body].bounds, begins(body));
      }
    }
    put(of_clusters[c / cluster_size], c % cluster_size, around(of_bodies[c]), nearest_of(of_bodies[c]));
  }
  for (int c = clusters; c % cluster_size != 0; ++c) put(of_clusters[c / cluster_size], c % cluster_size, none, infinite);
  const int groups = (clusters + cluster_size - 1) / cluster_size;
  ManyBounds* const of_groups = of_clusters + groups;
  for (int g = 0; g < groups; ++g) put(of_groups[g / cluster_size], g % cluster_size, around(of_clusters[g]), nearest_of(of_clusters[g]));
  for (int g = groups; g % cluster_size != 0; ++g) put(of_groups[g / cluster_size], g % cluster_size, none, infinite);
}

/// The places in clusters, the nearest to the camera first: who looks at those first learns soonest what is hidden behind them.
void sort_by_depth(const ManyBounds* of_bodies, int clusters, int bodies, std::int32_t* ranks, std::int32_t* order) {
  const auto near = [&](std::int32_t place) { return of_bodies[place / cluster_size].near[place % cluster_size]; };
  std::iota(order, order + clusters * cluster_size, 0);
  std::sort(order, order + clusters * cluster_size,
            [&](std::int32_t a, std::int32_t b) { return near(a) < near(b) || (near(a) == near(b) && a < b); });
  for (int i = 0; i < bodies; ++i) ranks[order[i]] = i;
}

/// A point where no ray comes to: at its least distance along one axis it is beyond all that is met.
constexpr float nowhere = 3e38f;
/// Boxes are larger than what they hold by this share of how far away it is, which is more than rounding.
constexpr double around_it = 1e-5;

template <class T>
void put_box(ManyBoxes& many, int i, const T& shape) {
  for (std::size_t k = 0; k < 3; ++k) {
    const shape::Span span = span_along(shape, {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0});
    const double room = around_it * farthest(span);
    many.low[k][i] = num::single(span.low - room), many.high[k][i] = num::single(span.high + room);
  }
}
void put_nothing(ManyBoxes& many, int i) {
  for (std::size_t k = 0; k < 3; ++k) many.low[k][i] = many.high[k][i] = nowhere;
}
/// The box around those of a cluster.
void put_around(ManyBoxes& many, int i, const ManyBoxes& its) {
  for (std::size_t k = 0; k < 3; ++k) {
    many.low[k][i] = infinite, many.high[k][i] = -infinite;
    for (std::size_t j = 0; j < cluster_size; ++j) {
      if (its.low[k][j] >= nowhere) continue;
      many.low[k][i] = std::min(many.low[k][i], its.low[k][j]), many.high[k][i] = std::max(many.high[k][i], its.high[k][j]);
    }
  }
}

/// The boxes of a moment.
template <class T>
void fill_boxes(const SceneView& scene, const BodiesOf<T>& of, int moment, const std::int32_t* bodies, int clusters, ManyBoxes* of_bodies,
                ManyBoxes* of_clusters) {
  for (int c = 0; c < clusters; ++c) {
    for (int i = 0; i < cluster_size; ++i) {
      const std::int32_t body = bodies[c * cluster_size + i];
      if (body < 0) {
        put_nothing(of_bodies[c], i);
      } else {
        put_box(of_bodies[c], i, body_at(scene, of.at(moment, body), moment));
      }
    }
    put_around(of_clusters[c / cluster_size], c % cluster_size, of_bodies[c]);
  }
  for (int c = clusters; c % cluster_size != 0; ++c) put_nothing(of_clusters[c / cluster_size], c % cluster_size);
}

std::size_t in_rows(int each, int rows) { return static_cast<std::size_t>(each) * static_cast<std::size_t>(rows); }

template <class T>
void build_one(const SceneView& scene, const BodiesOf<T>& of, int moments, ClusterMemory<T>& memory, ClustersOf<T>& out) {
  if (of.count <= cluster_size) return;
  std::vector<Point> middles;
  for (int i = 0; i < of.count; ++i) middles.push_back(middle_of(body_at(scene, of.at(0, i), 0)));
  memory.bodies.resize(static_cast<std::size_t>(of.count));
  std::iota(memory.bodies.begin(), memory.bodies.end(), 0);
  sort(middles, memory.bodies.data(), memory.bodies.data() + of.count);
  out.count = (of.count + cluster_size - 1) / cluster_size;
  out.upper = out.groups() + (out.groups() + cluster_size - 1) / cluster_size;
  memory.bodies.resize(in_rows(cluster_size, out.count), -1);
  memory.bodies.resize(in_rows(cluster_size, 3 * out.count));  // ranks and order
  const int rows = moments * (1 + scene.lights), light_rows = scene.has_sun != 0 ? moments : 0;
  memory.bodies_seen.resize(in_rows(out.count, rows)), memory.clusters_seen.resize(in_rows(out.upper, rows));
  memory.bodies_along.resize(in_rows(out.count, light_rows)), memory.clusters_along.resize(in_rows(out.upper, light_rows));
  const int moments_around = scene.bounces != 0 ? moments : 0;
  memory.bodies_around.resize(in_rows(out.count, moments_around)), memory.clusters_around.resize(in_rows(out.groups(), moments_around));
  out.bodies = memory.bodies.data();
  out.bodies_around = memory.bodies_around.data(), out.clusters_around = memory.clusters_around.data();
  out.bodies_seen = memory.bodies_seen.data(), out.clusters_seen = memory.clusters_seen.data();
  out.bodies_along = memory.bodies_along.data(), out.clusters_along = memory.clusters_along.data();
}

template <class T>
void update_one(const SceneView& scene, const Group& group, ClusterMemory<T>& memory) {
  const ClustersOf<T>& of = group.clusters.of<T>();
  if (of.count == 0) return;
  const auto clusters = static_cast<std::size_t>(of.count), groups = static_cast<std::size_t>(of.groups()),
             upper = static_cast<std::size_t>(of.upper);
  const auto bodies = static_cast<std::size_t>(group.bodies.of<T>().count);
  const DerivedOf<T>& derived = group.derived.of<T>();
  const auto shape_at = [&](std::int32_t body, std::size_t moment) {
    const int m = static_cast<int>(moment);
    return body_at(scene, group.bodies.of<T>().at(m, body), m);
  };
  const auto eyes = static_cast<std::size_t>(1 + scene.lights);
  for (std::size_t row = 0; row < memory.bodies_seen.size() / clusters; ++row) {
    const shape::Vec eye = row % eyes == 0 ? shape::Vec{0, 0, 0} : scene.light_positions[row % eyes - 1];
    fill(
        of.bodies, of.count, derived.forms + row * bodies, [&](std::int32_t body) { return begins_at(shape_at(body, row / eyes), eye); },
        &memory.bodies_seen[row * clusters], &memory.clusters_seen[row * upper]);
  }
  for (std::size_t row = 0; row < memory.bodies_along.size() / clusters; ++row)
    fill(
        of.bodies, of.count, derived.along + row * bodies,
        [&](std::int32_t body) { return begins_along(shape_at(body, row), scene.toward_sun[row]); }, &memory.bodies_along[row * clusters],
        &memory.clusters_along[row * upper]);
  for (std::size_t row = 0; row < memory.bodies_around.size() / clusters; ++row)
    fill_boxes(scene, group.bodies.of<T>(), static_cast<int>(row), of.bodies, of.count, &memory.bodies_around[row * clusters],
               &memory.clusters_around[row * groups]);
  std::int32_t* const ranks = memory.bodies.data() + of.count * cluster_size;
  sort_by_depth(memory.bodies_seen.data(), of.count, group.bodies.of<T>().count, ranks, ranks + of.count * cluster_size);
}

template <class... T, class Each>
void each_bounded(shape::List<T...>, const Each& each) {
  const auto one = [&]<class One>(shape::List<One> which) {
    if constexpr (shape::bounded<One>) each(which);
  };
  (one(shape::List<T>{}), ...);
}

}  // namespace

void Clustering::build(const SceneView& scene, Group& group, int moments) {
  each_bounded(shape::Shapes{},
               [&]<class T>(shape::List<T>) { build_one(scene, group.bodies.of<T>(), moments, memory_.of<T>(), group.clusters.of<T>()); });
}

void Clustering::update(const SceneView& scene, const Group& group) {
  each_bounded(shape::Shapes{}, [&]<class T>(shape::List<T>) { update_one<T>(scene, group, memory_.of<T>()); });
}

}  // namespace tofray::scene
