// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "shape/mesh_alone.h"

/// Which triangle of a mesh a ray from anywhere meets, on any machine.
namespace tofray::shape {

/// Looks for a triangle nearer than hit.t, which stays as it is where there is none.
template <bool any, class F>
TOFRAY_INLINE void search_mesh(const MeshTree& mesh, const MeshRay<F>& ray, F shortest, Mask<F> wanted, MeshHit<F>& hit) {
  if constexpr (num::lanes<F> == 1) {
    search_together<any>(mesh, ray, shortest, wanted, hit);
  } else if (mesh.cut != nullptr) {
    search_alone<any, true, F>(mesh, ray, shortest, wanted, hit);
  } else {
    search_alone<any, false, F>(mesh, ray, shortest, wanted, hit);
  }
}
template <bool any, class H>
TOFRAY_INLINE void search_mesh(const MeshTree& mesh, const MeshRay<num::Twin<H>>& ray, num::Twin<H> shortest, num::TwinMask<H> wanted,
                               MeshHit<num::Twin<H>>& hit) {
  search_in_halves<H>(ray, shortest, wanted, hit, [&](const MeshRay<H>& half, H from, Mask<H> its, MeshHit<H>& of_half) TOFRAY_LAMBDA {
    search_mesh<any>(mesh, half, from, its, of_half);
  });
}

/// Beyond it nothing is nearer than the hit so far, however t and 1/w are rounded.
template <class F>
TOFRAY_INLINE F far_of(const flow::Hit<F>& hit) {
  const auto before = hit.w > F(0.0f);
  return num::select(before, F(1.0f + 0x1p-20f) / num::select(before, hit.w, F(1.0f)), F(3e38f));
}

/// The triangle that was found at t (−1: none), where it is nearer than the hit so far.
template <class F>
TOFRAY_INLINE void take(const MeshForm& form, F t, Int<F> triangle, flow::Hit<F>& hit) {
  const auto met = triangle > Int<F>(-1);
  const F w = F(1.0f) / num::select(met, t, F(1.0f));
  const auto nearer = met & (w > hit.w);
  hit.w = num::select(nearer, w, hit.w);
  hit.facet = num::select(nearer, Int<F>(form.facet), hit.facet);
  hit.triangle = num::select(nearer, triangle, hit.triangle);
}

/// The nearest triangle, where it is nearer than the hit so far.
template <class F>
TOFRAY_INLINE void nearest_in(const MeshForm& form, const Ray<F>& ray, flow::Hit<F>& hit) {
  MeshHit<F> found{far_of(hit), Int<F>(0x7fffffff), Int<F>(-1)};
  search_mesh<false>(form, in_mesh(form, {ray.x, ray.y, ray.z}), F(nearest_mesh), F(0.0f) <= F(0.0f), found);
  take(form, found.t, found.triangle, hit);
}

/// Whether a triangle stands before t = `far`.
template <class F>
TOFRAY_INLINE Mask<F> stands_before(const MeshForm& form, const Ray<F>& ray, F far, Mask<F> wanted) {
  MeshHit<F> found{far, Int<F>(0), Int<F>(-1)};
  search_mesh<true>(form, in_mesh(form, {ray.x, ray.y, ray.z}), F(0.0f), wanted, found);
  return found.triangle > Int<F>(-1);
}

/// Whether a triangle stands beyond the margin on the way to the light.
template <class F>
TOFRAY_INLINE Mask<F> blocks(const MeshAlong& form, const Place<F>& p, const float*, F margin) {
  const MeshRay<F> ray = in_mesh(form, {p.x, p.y, p.z});
  MeshHit<F> found{F(3e38f), Int<F>(0), Int<F>(-1)};
  search_mesh<true>(form, ray, margin, p.found, found);
  return found.triangle > Int<F>(-1);
}

/// The distance at which a ray first meets a triangle, further on than `least` and nearer than `far`.
/// @param triangle  which one; −1: none
template <class F>
TOFRAY_INLINE F distance_to(const MeshFree& form, const FreeRay<F>& ray, F least, F far, Mask<F> wanted, Int<F>& triangle) {
  MeshHit<F> found{far, Int<F>(0x7fffffff), Int<F>(-1)};
  search_mesh<false>(form, in_mesh(form, ray), least, wanted, found);
  triangle = found.triangle;
  return num::select(triangle > Int<F>(-1), found.t, F(never));
}

}  // namespace tofray::shape
