// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/reflectivity_map.h"
#include "shape/mesh_detail.h"
#include "trace/nearest.h"

namespace tofray::trace {

/// Turns a mean of the corners' normals to the side of its triangle that is seen. Where it faces away from the camera nevertheless, as it
/// does at the rim of a coarse ball, it is turned back until it does not.
template <class F>
TOFRAY_FN void face_as_shaded(const shape::Direction<F>& n, Mask<F> its, const Ray<F>& ray, Surface<F>& out) {
  const auto known = its & (flow::square_of(n.x, n.y, n.z) > F(0.25f));
  const F side = num::fma(n.x, out.nx, num::fma(n.y, out.ny, n.z * out.nz));
  const F sign = num::select(side < F(0.0f), F(-1.0f), F(1.0f)), per = ray.inverse_length;
  const F x = ray.x * per, y = ray.y * per, z = ray.z * per;
  const F cosine = -sign * num::fma(n.x, x, num::fma(n.y, y, n.z * z)), missing = num::max(F(0.02f) - cosine, F(0.0f));
  const F nx = num::fnma(missing, x, n.x * sign), ny = num::fnma(missing, y, n.y * sign), nz = num::fnma(missing, z, n.z * sign);
  const F unit = F(1.0f) / num::sqrt(flow::square_of(nx, ny, nz));
  out.nx = num::select(known, nx * unit, out.nx), out.ny = num::select(known, ny * unit, out.ny),
  out.nz = num::select(known, nz * unit, out.nz);
  out.cos_view = num::select(known, num::max(cosine, F(0.02f)) * unit, out.cos_view);
}

/// What a picture says at a place scales a surface's matt part.
template <class F>
TOFRAY_FN void scale_matt(const brdf::MaterialView& material, F by, Mask<F> its, flow::Finish<F>& out) {
  out.reflectivity = num::select(its, num::fma(by - F(1.0f), F(material.matt), out.reflectivity), out.reflectivity);
  for (int i = 0; i < flow::brdf_numbers; ++i)
    if (i < material.matt_numbers) out.number[i] = num::select(its, out.number[i] * by, out.number[i]);
}

/// Smooth normals and reflectivity maps of the meshes that have them.
/// @param across  area that a pixel sees there, across the ray [m²]
template <class F>
TOFRAY_APART void add_details(const scene::SceneView& s, F across, const Ray<F>& ray, const Hit<F>& hit, Surface<F>& out) {
  const shape::FacetColumns<F> facet(s.facets, hit.facet);
  // What a pixel sees of the surface, by the triangle's own normal: a mean of several would let it see more than there is.
  const F seen = across / num::max(out.cos_view, F(1e-3f));
  Int<F> left = num::select(out.found, Int<F>(1), Int<F>(0));
  for (int i = 0; i < num::lanes<F>; ++i) {
    if (num::lane(left, i) == 0) continue;
    const std::int32_t row = num::lane(facet.facet, i);
    const auto its = out.found & (facet.facet == Int<F>(row));
    left = num::select(its, Int<F>(0), left);
    const shape::Facet& one = facet.at(row);
    if (one.details == nullptr) continue;
    const shape::MeshDetail<F> detail = shape::mesh_detail(one, num::select(its, hit.triangle, Int<F>(0)), out.x, out.y, out.z);
    face_as_shaded(detail.normal, its, ray, out);
    const brdf::MaterialView& material = s.materials[one.material];
    if (material.map >= 0)
      scale_matt(material, brdf::map_value(s.maps[material.map], detail.u, detail.v, seen * detail.uv_per_area), its, out.finish);
  }
}

}  // namespace tofray::trace
