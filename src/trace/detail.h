// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/reflectivity_map.h"
#include "shape/mesh_lean.h"
#include "trace/nearest.h"

namespace tofray::trace {

/// Turns a mean of the corners' normals to the side of its triangle that is seen. Where it faces away from the camera nevertheless, as it
/// does at the rim of a coarse ball, it is turned back until it does not.
/// @param of  whose side of the triangle counts: n, or what n leans away from
template <class F>
TOFRAY_INLINE void face_as_shaded(const shape::Direction<F>& n, const shape::Direction<F>& of, Mask<F> its, const Ray<F>& ray,
                                  Surface<F>& out) {
  const auto known = its & (flow::square_of(n.x, n.y, n.z) > F(0.25f));
  const F side = num::fma(of.x, out.nx, num::fma(of.y, out.ny, of.z * out.nz));
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
/// @param matt  what of the reflectivity it scales
template <class F>
TOFRAY_INLINE void scale_matt(const brdf::MaterialView& material, F matt, F by, Mask<F> its, flow::Finish<F>& out) {
  out.reflectivity = num::select(its, num::fma(by - F(1.0f), matt, out.reflectivity), out.reflectivity);
  for (int i = 0; i < flow::brdf_numbers; ++i)
    if (i < material.matt_numbers) out.number[i] = num::select(its, out.number[i] * by, out.number[i]);
}

/// A mesh's pictures at the places that a pack of pixels sees.
template <class F>
struct Pictures {
  const brdf::MapView* maps;
  F u, v, seen;  ///< seen: the area that a pixel sees, in units of a picture
  TOFRAY_INLINE F at(std::int32_t map) const { return brdf::map_value(maps[map], u, v, seen); }
};

/// Numbers, reflectivity and matt part as pictures have them.
/// @return the matt part
template <class F>
TOFRAY_INLINE F take_finish(const Pictures<F>& pictures, std::int32_t first, Mask<F> its, flow::Finish<F>& out) {
  for (int i = 0; i < flow::brdf_numbers; ++i) out.number[i] = num::select(its, pictures.at(first + i), out.number[i]);
  out.reflectivity = num::select(its, pictures.at(first + flow::brdf_numbers), out.reflectivity);
  return pictures.at(first + flow::brdf_numbers + 1);
}

/// A mesh's own normals, the mean of the corners' or else the triangle's, as a picture lets them lean.
/// @param first  of three pictures
template <class F>
TOFRAY_INLINE void face_as_leaning(const shape::Facet& one, Int<F> triangle, const shape::Direction<F>& smooth, const Pictures<F>& pictures,
                                   std::int32_t first, Mask<F> its, const Ray<F>& ray, Surface<F>& out) {
  const shape::MeshAxes<F> axes = shape::mesh_axes<F>(one, triangle);
  const auto is_smooth = flow::square_of(smooth.x, smooth.y, smooth.z) > F(0.25f);
  const auto chosen = [&](F a, F b) TOFRAY_LAMBDA { return num::select(is_smooth, a, b); };
  const shape::Direction<F> normal{chosen(smooth.x, axes.normal.x), chosen(smooth.y, axes.normal.y), chosen(smooth.z, axes.normal.z)};
  const shape::Direction<F> lean{pictures.at(first), pictures.at(first + 1), pictures.at(first + 2)};
  face_as_shaded(shape::leaning(axes, normal, lean), normal, its, ray, out);
}

/// Smooth normals, pictures and shades of the meshes that have them.
/// @param across  area that a pixel sees there, across the ray [m²]
template <class F>
TOFRAY_NOINLINE void add_details(const scene::SceneView& s, F across, const Ray<F>& ray, const Hit<F>& hit, Surface<F>& out) {
  // What a pixel sees of the surface, by the triangle's own normal: a mean of several would let it see more than there is.
  const F seen = across / num::max(out.cos_view, F(1e-3f));
  out.flat = {out.nx, out.ny, out.nz}, out.leans = true;
  shape::for_each_facet<F>(s.facets, hit.facet, out.found, [&](const shape::Facet& one, Mask<F> its) TOFRAY_LAMBDA {
    if (one.details == nullptr) return;
    const Int<F> triangle = num::select(its, hit.triangle, Int<F>(0));
    const shape::MeshDetail<F> detail = shape::mesh_detail(one, triangle, out.x, out.y, out.z);
    const brdf::MaterialView& material = s.materials[one.material];
    const Pictures<F> pictures{s.maps, detail.u, detail.v, seen * detail.uv_per_area};
    if (material.normals >= 0)
      face_as_leaning(one, triangle, detail.normal, pictures, material.normals, its, ray, out);
    else
      face_as_shaded(detail.normal, detail.normal, its, ray, out);
    F matt = F(material.matt), by = detail.shade;
    if (material.finish >= 0) matt = take_finish(pictures, material.finish, its, out.finish);
    if (material.map >= 0) by = by * pictures.at(material.map);
    if (material.map >= 0 || shape::has_shades(one)) scale_matt(material, matt, by, its, out.finish);
  });
}

}  // namespace tofray::trace
