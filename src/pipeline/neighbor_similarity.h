// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/setup.h"

/// Which neighbours of a pixel see the same surface: what comes to them by other surfaces is nearly the same, too.
///                                                                                                               [theory: like-neighbours]
namespace tofray::pipeline {

using flow::Pixels;

/// What is known of a pixel where neighbours are compared.
template <class F>
struct SurfaceGuide {
  F x, y, z;     ///< [m]
  F nx, ny, nz;  ///< 0: the pixel sees nothing
  F reflectivity;
};

template <class F>
TOFRAY_INLINE void store_guide(const Setup& s, const flow::LightImage& image, const Pixels& p, const flow::Surface<F>& surface) {
  const std::int64_t pixels = std::int64_t{s.lens.width} * s.lens.height;
  const F values[flow::guide_planes] = {surface.x, surface.y, surface.z, surface.nx, surface.ny, surface.nz, surface.finish.reflectivity};
  for (int i = 0; i < flow::guide_planes; ++i)
    num::store(image.guide + i * pixels + p.index, num::select(surface.found, values[i], F(0.0f)), p.count);
}

/// The first of some pixels of a row.
struct InRow {
  Pixels p;
  int x, y, width, height;
};
TOFRAY_INLINE InRow in_row(const Setup& s, const Pixels& p) {
  return {p, p.index % s.lens.width, p.index / s.lens.width, s.lens.width, s.lens.height};
}

/// A plane's values dx, dy further on. Beyond the ends of the row any will do: is_within knows of them.
template <class F>
TOFRAY_INLINE F load_near(const float* plane, const InRow& at, int dx, int dy) {
  const int x = at.x + dx;
  const float* const row = plane + std::int64_t{at.y + dy} * at.width;
  if (x >= 0 && x + at.p.count <= at.width) return num::load<F>(row + x, at.p.count);
  using Int = num::Int<F>;
  const Int place = Int(x) + num::lane_index<F>(), last = Int(at.width - 1);
  return num::gather(row, num::select(place > last, last, num::select(place > Int(0), place, Int(0))));
}
template <class F>
TOFRAY_INLINE num::Mask<F> is_within(const InRow& at, int dx) {
  using Int = num::Int<F>;
  const Int place = Int(at.x + dx) + num::lane_index<F>();
  return (place > Int(-1)) & (Int(at.width) > place);
}

template <class F>
TOFRAY_INLINE SurfaceGuide<F> guide_near(const flow::LightImage& image, const InRow& at, int dx, int dy) {
  const std::int64_t pixels = std::int64_t{at.width} * at.height;
  const auto load = [&](int i) TOFRAY_LAMBDA { return load_near<F>(image.guide + i * pixels, at, dx, dy); };
  return {load(0), load(1), load(2), load(3), load(4), load(5), load(6)};
}

constexpr float least_cosine = 0.9f;     ///< of the angle between two normals that may be those of one surface
constexpr float most_off_plane = 0.02f;  ///< of the distance to the camera, that a neighbour may be off the plane through the pixel's point

/// How much a neighbour sees the same: 1 of the same plane, 0 of another surface.
template <class F>
TOFRAY_INLINE F similarity(const SurfaceGuide<F>& here, const SurfaceGuide<F>& there) {
  const F cosine = num::fma(here.nx, there.nx, num::fma(here.ny, there.ny, here.nz * there.nz));
  const F off = num::fma(here.nx, there.x - here.x, num::fma(here.ny, there.y - here.y, here.nz * (there.z - here.z)));
  const F most = F(most_off_plane * most_off_plane) * flow::square_of(here.x, here.y, here.z);
  const F turned = num::max((cosine - F(least_cosine)) * F(1.0f / (1.0f - least_cosine)), F(0.0f));
  const F near = num::max(F(1.0f) - off * off / num::max(most, F(1e-12f)), F(0.0f));
  return num::min(turned, F(1.0f)) * (near * near);
}

}  // namespace tofray::pipeline
