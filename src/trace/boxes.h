// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "trace/visible.h"

/// Which of many bodies rays from anywhere can meet.
///
/// Rays that have bounced go their own ways, so that a rectangle that holds all of a pack's holds everything. Each of them asks 32 boxes of
/// clusters at once, and then the 32 boxes of bodies in those that it meets; what any of them can meet, all of them are tested against. It
/// leaves out what no ray meets, and changes no result.
namespace tofray::trace {

using scene::ManyBoxes;

/// The rays of a pack, to be looked at one by one.
template <class F>
struct RaysApart {
  float low[3][num::lanes<F>], high[3][num::lanes<F>];  ///< where they begin, and a little before and beyond
  float per[3][num::lanes<F>];                          ///< 1/direction
  float far[num::lanes<F>];                             ///< what lies beyond does not matter, in lengths of the direction
  std::uint32_t wanted;                                 ///< a bit for each
};

/// How far beside a box rays still meet it, as a share of where they begin: more than rounding, and than meshes' rays begin before them.
constexpr float beside_box = 1e-5f;

template <class F>
TOFRAY_NOINLINE void take_apart(const shape::FreeRay<F>& ray, F far, Mask<F> wanted, RaysApart<F>& out) {
  const F room = F(beside_box) * (num::abs(ray.x) + num::abs(ray.y) + num::abs(ray.z));
  const F from[3] = {ray.x, ray.y, ray.z}, way[3] = {ray.dx, ray.dy, ray.dz};
  for (int k = 0; k < 3; ++k) {
    num::store(out.low[k], from[k] - room, num::lanes<F>), num::store(out.high[k], from[k] + room, num::lanes<F>);
    num::store(out.per[k], shape::inverse_of(way[k]), num::lanes<F>);
  }
  num::store(out.far, far * F(1.0f + beside_box), num::lanes<F>);
  out.wanted = num::lanes_of(wanted);
}

/// A bit for each of 32 boxes that ray number i meets.
template <class F>
TOFRAY_INLINE std::uint32_t boxes_met(const ManyBoxes& many, const RaysApart<F>& rays, int i) {
  std::uint32_t out = 0;
  for (int first = 0; first < scene::cluster_size; first += num::lanes<F>) {
    F near = F(0.0f), far = F(rays.far[i]);
    for (int k = 0; k < 3; ++k) {
      const F per = F(rays.per[k][i]);
      const F a = (num::load<F>(many.low[k] + first, num::lanes<F>) - F(rays.high[k][i])) * per;
      const F b = (num::load<F>(many.high[k] + first, num::lanes<F>) - F(rays.low[k][i])) * per;
      near = num::max(near, num::min(a, b)), far = num::min(far, num::max(a, b));
    }
    out |= num::lanes_of(near <= far * F(1.0f + beside_box)) << first;
  }
  return out;
}

/// Calls run(body) for each body that any of the rays can meet, in no order.
template <class F, class Run>
TOFRAY_INLINE void each_in_reach(const scene::Boxes& boxes, const RaysApart<F>& rays, const Run& run) {
  for (int first = 0; first < boxes.count; first += scene::cluster_size) {
    std::uint32_t of_ray[num::lanes<F>], clusters = 0;
    for (std::uint32_t left = rays.wanted; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      of_ray[i] = boxes_met<F>(boxes.of_clusters[first / scene::cluster_size], rays, i), clusters |= of_ray[i];
    }
    for (; clusters != 0; clusters &= clusters - 1) {
      const int cluster = __builtin_ctz(clusters);
      std::uint32_t bodies = 0;
      for (std::uint32_t left = rays.wanted; left != 0; left &= left - 1) {
        const int i = __builtin_ctz(left);
        if ((of_ray[i] >> cluster & 1) != 0) bodies |= boxes_met<F>(boxes.of_bodies[first + cluster], rays, i);
      }
      for (; bodies != 0; bodies &= bodies - 1) {
        const std::int32_t body = boxes.bodies[(first + cluster) * scene::cluster_size + __builtin_ctz(bodies)];
        if (body >= 0) run(body);
      }
    }
  }
}

/// Whether boxes are asked at all: one pixel at a time, as on a GPU, looks at each body.
template <class T, class F>
constexpr bool has_boxes = shape::bounded<T>&& num::lanes<F> > 1;

/// A group of the scene at one moment, and the rays that ask for it, taken apart once somebody wants them to be.
template <class F>
struct Asking {
  const scene::Group& group;
  int moment;
  shape::FreeRay<F> ray;
  F far;
  Mask<F> wanted;
  RaysApart<F>& rays;
  bool apart = false;

  template <class T>
  TOFRAY_INLINE scene::Boxes boxes() {
    const scene::Boxes out = group.clusters.template of<T>().around(moment);
    if (out.count > 0 && !apart) take_apart<F>(ray, far, wanted, rays), apart = true;
    return out;
  }
};

/// Points whose way to a light, or to the sun, something is in.
template <class T, class F>
TOFRAY_NOINLINE void block_in_boxes(const scene::FormsOf<T>& forms, const scene::Boxes& boxes, const RaysApart<F>& rays, const Ray<F>& ray,
                                    const Place<F>& p, Mask<F>& dark) {
  each_in_reach<F>(boxes, rays, [&](int body) TOFRAY_LAMBDA { dark = blocked_by_one<T>(forms.at[body], ray, p, dark); });
}
template <class T, class F>
TOFRAY_NOINLINE void block_in_boxes(const scene::AlongsOf<T>& forms, const scene::Boxes& boxes, const RaysApart<F>& rays, const float* sun,
                                    const Place<F>& p, Mask<F>& dark) {
  const F margin = F(shadow_margin) * p.range;
  each_in_reach<F>(boxes, rays, [&](int body) TOFRAY_LAMBDA { dark = blocked_along_one<T>(forms.at[body], sun, p, margin, dark); });
}

/// What a group's forms are to a light, or to the sun, shape by shape: a list of all of them takes longer than to ask the few that there are.
struct FormsInTurn {
  const scene::Group& group;
  int row;
  template <class T>
  TOFRAY_INLINE scene::FormsOf<T> of() const {
    return group.seen_from<T>(row);
  }
};
struct AlongsInTurn {
  const scene::Group& group;
  int row;
  template <class T>
  TOFRAY_INLINE scene::AlongsOf<T> of() const {
    return group.seen_along<T>(row);
  }
};

/// @param light  the ray from it, or the direction to the sun
template <class T, class F, class Views, class Light>
TOFRAY_INLINE void block_by(const Views& views, Asking<F>& asking, const Light& light, const Place<F>& p, Mask<F>& dark) {
  if (asking.group.bodies.template of<T>().count == 0) return;
  if constexpr (has_boxes<T, F>) {
    const scene::Boxes boxes = asking.template boxes<T>();
    if (boxes.count > 0) {
      // What is handed to a function lies in memory; the originals need not.
      const Light light_copy = light;
      const Place<F> copy = p;
      Mask<F> dark_copy = dark;
      block_in_boxes<T, F>(views.template of<T>(), boxes, asking.rays, light_copy, copy, dark_copy);
      dark = dark_copy;
      return;
    }
  }
  if constexpr (requires { light.inverse_length; }) {
    dark = blocked_by<T>(Uncut{views}, light, p, dark);
  } else {
    dark = blocked_along<T>(Uncut{views}, light, p, dark);
  }
}
template <class... T, class F, class Views, class Light>
TOFRAY_INLINE Mask<F> block_by_each(shape::List<T...>, const Views& views, Asking<F> asking, const Light& light, const Place<F>& p) {
  Mask<F> dark = F(1.0f) < F(0.0f);
  (block_by<T>(views, asking, light, p, dark), ...);
  return dark;
}

/// Points anywhere that a group's forms keep from a light. [as blocked]
/// @param row  of its forms, that of the light
/// @param at   the light's position
template <class F>
TOFRAY_NOINLINE Mask<F> blocked_anywhere(const scene::Group& group, int moment, int row, const float* at, const Ray<F>& ray,
                                         const Place<F>& p) {
  RaysApart<F> rays;
  const Asking<F> asking{group, moment, {F(at[0]), F(at[1]), F(at[2]), ray.x, ray.y, ray.z}, F(1.0f), p.found, rays};
  return block_by_each(shape::Shapes{}, FormsInTurn{group, row}, asking, ray, p);
}
/// Where something stands between a place anywhere and the sun. [as blocked_parallel]
template <class F>
TOFRAY_NOINLINE Mask<F> blocked_parallel_anywhere(const scene::Group& group, int moment, const float* sun, const Place<F>& p) {
  RaysApart<F> rays;
  const Asking<F> asking{group, moment, {p.x, p.y, p.z, F(sun[0]), F(sun[1]), F(sun[2])}, F(shape::never), p.found, rays};
  return block_by_each(shape::Shapes{}, AlongsInTurn{group, moment}, asking, sun, p);
}

}  // namespace tofray::trace
