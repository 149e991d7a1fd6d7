// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "flow/flow.h"

/// The scene as seen from one point (the camera or a light): what a ray that leaves this point needs to know of each object.
///
/// For rays P = o + t·d of one common origin o the inverse range w = 1/t along d is linear in d for planes and triangles, and so
/// are the edges of a triangle and the sides of a box: no division is left in the test, and the nearest surface is the largest w.
/// Coordinates are the camera frame's, relative to o. Each form knows the facet that its hit names, and the object it belongs to.
namespace tofray::scene {

/// Rectangle that holds every direction in which an object can be hit; infinite where it reaches z <= 0.
using flow::Bounds;

/// w = d·m; hit where w > horizon (|n·d| >= 1e-6).
struct PlaneForm {
  float m[3];
  float horizon;
  std::int32_t facet, object;
};

/// |t·d − c| = R, in the stable form: the chord's distance from the centre comes from l = c − (d·c/d·d)·d.
struct SphereForm {
  float c[3];
  float radius_squared;
  float inverse_power;        ///< 1 / (|c|² − R²); negative inside
  std::int32_t facet, object;
  std::int32_t inside;        ///< 1: the origin is inside the sphere
  std::int32_t own_blocks;    ///< light's view: 1 where light and camera are on different sides of its surface
  Bounds bounds;
};

/// Per axis k of the box: d_k = d·axis_k. The ray is inside the slab for w_out_k <= w <= w_in_k, with
/// w_in = d_k·near_scale + near_offset and w_out = max(d_k·far_scale[0], d_k·far_scale[1]).
struct BoxForm {
  float axis[3][3];
  float near_scale[3], near_offset[3];
  float far_scale[3][2];
  std::int32_t facet, object; ///< facet of axis 0; those of axes 1 and 2 follow
  std::int32_t inside;        ///< 1: the origin is inside the box: it sees the far side
  std::int32_t own_blocks;
  Bounds bounds;
};

/// Inside where the three d·edge are >= 0; w = d·m. An edge shared by two triangles has exactly opposite numbers in them; edge_low is
/// what rounding took from the unit vector edge.
struct TriangleForm {
  float m[3];
  float edge[3][3], edge_low[3][3];
  std::int32_t facet, object;
  Bounds bounds;
};

struct Forms {
  const PlaneForm* planes;
  const SphereForm* spheres;
  const BoxForm* boxes;
  const TriangleForm* triangles;
  std::int32_t plane_count, sphere_count, box_count, triangle_count;
};

/// The same for parallel light that travels along −s: a point P (camera frame) is in shadow where the ray P + t·s, t > 0, hits.
struct ParallelPlane {      ///< t = P·m + c
  float m[3], c;
  std::int32_t object;
};
struct ParallelSphere {
  float c[3], radius_squared;
  std::int32_t object;
  std::int32_t own_blocks;  ///< 1: the camera is inside
};
struct ParallelBox {        ///< p_k = P·axis_k + offset_k, from the centre; slab k is left at t = (±half_k − p_k)·inverse_k
  float axis[3][3], offset[3], half[3], inverse[3];
  std::int32_t object;
  std::int32_t own_blocks;
};
struct ParallelTriangle {   ///< inside where P·edge_i + edge_offset_i >= 0; t = P·m + c
  float m[3], c, edge[3][3], edge_offset[3];
  std::int32_t object;
};
struct ParallelForms {
  const ParallelPlane* planes;
  const ParallelSphere* spheres;
  const ParallelBox* boxes;
  const ParallelTriangle* triangles;
  std::int32_t plane_count, sphere_count, box_count, triangle_count;
};

/// What light does where it lands: unit normal n = flat + P·inverse_radius (turned toward the viewer when used) and material.
struct Facet {
  float flat[3];
  float inverse_radius;      ///< 0 for flat facets; a sphere has flat = −c/R
  float diffuse, specular, exponent;
  std::int32_t object, material;
};
constexpr int facet_floats = sizeof(Facet) / sizeof(float);

/// The frozen scene of one frame. What moves has forms and facets of its own for each raw frame (`slot`).
struct SceneView {
  Forms camera_still;
  const Forms* camera_moving;        ///< [slot]
  const Forms* light_still;          ///< [light]
  const Forms* light_moving;         ///< [slot][light]
  ParallelForms sun_still;
  const ParallelForms* sun_moving;   ///< [slot]
  const Facet* facets;               ///< still ones, then those of slot 0, 1 …
  std::int32_t slots;                ///< 0: nothing moves; else one for each raw frame
  std::int32_t lights;
  std::int32_t any_specular;
  std::int32_t facet_count;
};

}  // namespace tofray::scene
