// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/store.h"
#include "shape/mesh_detail.h"
#include "trace/nearest.h"

/// Ground truth that nothing else of the pipeline asks for: of the triangle that a pixel sees.
namespace tofray::pipeline {

template <class F>
struct Seen {
  num::Int<F> triangle;  ///< in the user's list, -1: no mesh
  F u, v;                ///< texture coordinates
};

/// Of a surface that is no object's, or none.
template <class F>
TOFRAY_FN Seen<F> nothing_known() {
  return {num::Int<F>(-1), nan<F>(), nan<F>()};
}

/// The lanes that see meshes, one mesh after the other.
template <class F>
TOFRAY_FN void look_at_triangle(const scene::SceneView& s, const flow::Hit<F>& hit, const flow::Surface<F>& p, Seen<F>& out) {
  using Int = num::Int<F>;
  const shape::FacetColumns<F> facet(s.facets, hit.facet);
  Int left = num::select(p.found, Int(1), Int(0));
  for (int i = 0; i < num::lanes<F>; ++i) {
    if (num::lane(left, i) == 0) continue;
    const std::int32_t row = num::lane(facet.facet, i);
    const auto its = p.found & (facet.facet == Int(row));
    left = num::select(its, Int(0), left);
    const shape::Facet& one = facet.at(row);
    if (one.triangles == nullptr) continue;
    const Int triangle = num::select(its, hit.triangle, Int(0));
    out.triangle = num::select(its, shape::mesh_number<F>(one, triangle), out.triangle);
    if (!shape::has_texcoords(one)) continue;
    const shape::MeshDetail<F> detail = shape::mesh_detail(one, triangle, p.x, p.y, p.z);
    out.u = num::select(its, detail.u, out.u), out.v = num::select(its, detail.v, out.v);
  }
}

template <class F>
TOFRAY_FN void store_seen(const flow::FrameView& out, const Pixels& p, const Seen<F>& seen) {
  if (out.gt_triangle_id != nullptr) num::store(out.gt_triangle_id + p.index, seen.triangle, p.count);
  store2(out.gt_texcoord, p, seen.u, seen.v);
}

/// Whether anybody wants any of it.
TOFRAY_FN bool wants_seen(const flow::FrameView& out) { return out.gt_triangle_id != nullptr || out.gt_texcoord != nullptr; }

/// Finds and stores it.
template <class F>
TOFRAY_APART void look_closer(const Setup& s, const flow::FrameView& out, const Pixels& p, const flow::Hit<F>& hit,
                              const flow::Surface<F>& surface) {
  Seen<F> seen = nothing_known<F>();
  look_at_triangle(s.scene, hit, surface, seen);
  store_seen(out, p, seen);
}

}  // namespace tofray::pipeline
