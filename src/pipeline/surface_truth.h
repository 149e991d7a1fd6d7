// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "camera/lens/image_motion.h"
#include "pipeline/store.h"
#include "shape/mesh_detail.h"
#include "trace/nearest.h"

/// Ground truth that nothing else of the pipeline asks for: of the triangle that a pixel sees, and of how the point there moves.
namespace tofray::pipeline {

template <class F>
struct Seen {
  num::Int<F> class_number;                   ///< of the object, -1: none
  num::Int<F> triangle;                       ///< in the user's list, -1: no mesh
  F u, v;                                     ///< texture coordinates
  flow::Direction<F> velocity;                ///< in the camera's frame [m/s]
  F flow_u, flow_v;                           ///< of its image, until one frame later [px]
  flow::Direction<F> own_velocity, own_step;  ///< of a mesh that changes its shape, in the camera's frame
};

template <class F>
TOFRAY_INLINE flow::Direction<F> chosen(num::Mask<F> which, const flow::Direction<F>& a, const flow::Direction<F>& b) {
  return {num::select(which, a.x, b.x), num::select(which, a.y, b.y), num::select(which, a.z, b.z)};
}

/// Of a surface that is no object's, or none.
template <class F>
TOFRAY_INLINE Seen<F> nothing_known() {
  const F none = nan<F>();
  const F zero = F(0.0f);
  return {num::Int<F>(-1), num::Int<F>(-1), none, none, {none, none, none}, none, none, {zero, zero, zero}, {zero, zero, zero}};
}

/// The lanes that see meshes, one mesh after the other.
template <class F>
TOFRAY_INLINE void look_at_triangle(const scene::SceneView& s, const flow::Hit<F>& hit, const flow::Surface<F>& p, Seen<F>& out) {
  using Int = num::Int<F>;
  shape::for_each_facet<F>(s.facets, hit.facet, p.found, [&](const shape::Facet& one, num::Mask<F> its) TOFRAY_LAMBDA {
    if (one.triangles == nullptr) return;
    const Int triangle = num::select(its, hit.triangle, Int(0));
    out.triangle = num::select(its, shape::mesh_number<F>(one, triangle), out.triangle);
    if (shape::has_steps(one)) {
      const shape::MeshStep<F> step = shape::mesh_step(one, triangle, p.x, p.y, p.z);
      out.own_velocity = chosen(its, step.velocity, out.own_velocity), out.own_step = chosen(its, step.step, out.own_step);
    }
    if (!shape::has_texcoords(one)) return;
    const shape::MeshDetail<F> detail = shape::mesh_detail(one, triangle, p.x, p.y, p.z);
    out.u = num::select(its, detail.u, out.u), out.v = num::select(its, detail.v, out.v);
  });
}

/// Where the image of a surface's points goes: u right, v down [px]; known while it is in the image of the lens.
template <class F>
struct ImageFlow {
  F u, v;
  num::Mask<F> known;
};
/// @param first, at  step and turn are those of the rows from `first` on, `at` numbers further
/// @param change     of the shape itself
template <class F>
TOFRAY_INLINE ImageFlow<F> image_flow(const Setup& s, const scene::MotionView& first, num::Int<F> at, const flow::Ray<F>& ray,
                                      const flow::Surface<F>& p, const flow::Direction<F>& change) {
  const auto vector = [&](const float* from) TOFRAY_LAMBDA {
    return flow::Direction<F>{num::gather(from, at), num::gather(from + 1, at), num::gather(from + 2, at)};
  };
  const flow::Direction<F> step = vector(first.step), to{p.x + change.x, p.y + change.y, p.z + change.z};
  const auto along = [&](const flow::Direction<F>& row, F start)
                         TOFRAY_LAMBDA { return num::fma(row.x, to.x, num::fma(row.y, to.y, num::fma(row.z, to.z, start))); };
  const flow::Direction<F> moved{along(vector(first.turn), step.x + change.x), along(vector(first.turn + 3), step.y + change.y),
                                 along(vector(first.turn + 6), step.z + change.z)};
  ImageFlow<F> out;
  out.known = p.found & camera::image_motion(s.lens.projection, ray, p.z, moved, out.u, out.v);
  out.u = out.u + F(0.0f), out.v = out.v + F(0.0f);
  return out;
}
template <class F>
TOFRAY_INLINE num::Int<F> motion_row(const Setup& s, const flow::Surface<F>& p) {
  using Int = num::Int<F>;
  return num::gather(s.scene.motion_of, num::select(p.found, p.object, Int(0))) * Int(scene::motion_numbers);
}

/// As the camera sees it. (Adding 0 leaves one kind of zero.)
template <class F>
TOFRAY_INLINE void look_at_motion(const Setup& s, const flow::Ray<F>& ray, const flow::Surface<F>& p, Seen<F>& out) {
  const num::Int<F> at = motion_row(s, p);
  const F zero = F(0.0f);
  const auto column = [&](const float* first) TOFRAY_LAMBDA { return num::gather(first, at); };
  const auto vector = [&](const float* first) TOFRAY_LAMBDA {
    return flow::Direction<F>{column(first), column(first + 1), column(first + 2)};
  };
  const scene::MotionView& first = *s.scene.motions;
  const flow::Direction<F> v = vector(first.velocity), spin = vector(first.spin);
  const flow::Direction<F>&own = out.own_velocity, &change = out.own_step;
  const flow::Direction<F> velocity{v.x + num::fma(spin.y, p.z, num::fnma(spin.z, p.y, own.x)) + zero,
                                    v.y + num::fma(spin.z, p.x, num::fnma(spin.x, p.z, own.y)) + zero,
                                    v.z + num::fma(spin.x, p.y, num::fnma(spin.y, p.x, own.z)) + zero};
  out.velocity = chosen(p.found, velocity, out.velocity);
  const ImageFlow<F> flow = image_flow(s, first, at, ray, p, change);
  out.flow_u = num::select(flow.known, flow.u, out.flow_u), out.flow_v = num::select(flow.known, flow.v, out.flow_v);
}

template <class F>
TOFRAY_INLINE void store_seen(const flow::FrameView& out, const Pixels& p, const Seen<F>& seen) {
  if (out.gt_class_id != nullptr) num::store(out.gt_class_id + p.index, seen.class_number, p.count);
  if (out.gt_triangle_id != nullptr) num::store(out.gt_triangle_id + p.index, seen.triangle, p.count);
  store2(out.gt_texcoord, p, seen.u, seen.v);
  store3(out.gt_velocity_m_per_s, p, seen.velocity.x, seen.velocity.y, seen.velocity.z);
  store2(out.gt_flow_px, p, seen.flow_u, seen.flow_v);
}

/// Whether any array of truth is wanted that this file stores.
TOFRAY_INLINE bool wants_seen(const flow::FrameView& out) {
  return out.gt_class_id != nullptr || out.gt_triangle_id != nullptr || out.gt_texcoord != nullptr || out.gt_velocity_m_per_s != nullptr ||
         out.gt_flow_px != nullptr;
}

/// Finds what arrays of truth say of the surface that a pixel sees, and stores it.
template <class F>
TOFRAY_NOINLINE void store_surface_truth(const Setup& s, const flow::FrameView& out, const Pixels& p, const flow::Ray<F>& ray,
                                         const flow::Hit<F>& hit, const flow::Surface<F>& surface) {
  Seen<F> seen = nothing_known<F>();
  const num::Int<F> none(-1), object = num::select(surface.found, surface.object, num::Int<F>(0));
  seen.class_number = num::select(surface.found, num::gather(s.scene.class_of, object), none);
  look_at_triangle(s.scene, hit, surface, seen);
  look_at_motion(s, ray, surface, seen);
  store_seen(out, p, seen);
}

/// Optical flow of what a pixel sees in the raw frames k … last − 1 to the time of the truth.         [theory: raw-frame-flow]
/// @param moment  at which they look at the scene
/// @param truth   that is the time of the truth: nothing has moved since
template <class F>
TOFRAY_NOINLINE void store_phase_flow(const Setup& s, float* to, const Pixels& p, int k, int last, int moment, bool truth,
                                      const flow::Ray<F>& ray, const flow::Hit<F>& hit, const flow::Surface<F>& surface) {
  F u = num::select(surface.found, F(0.0f), nan<F>()), v = u;
  if (!truth) {
    Seen<F> seen = nothing_known<F>();
    look_at_triangle(s.scene, hit, surface, seen);
    const scene::MotionView& first = s.scene.to_truth[moment * (1 + s.scene.movers)];
    const ImageFlow<F> flow = image_flow(s, first, motion_row(s, surface), ray, surface, seen.own_step);
    u = num::select(flow.known, flow.u, nan<F>()), v = num::select(flow.known, flow.v, nan<F>());
  }
  for (; k < last; ++k) store2(to, Pixels{p.index + k * s.lens.width * s.lens.height, p.count}, u, v);
}
/// Nothing is known of it.
template <class F>
TOFRAY_INLINE void store_no_phase_flow(const Setup& s, float* to, const Pixels& p) {
  for (int k = 0; k < s.sensor.raw_frames && to != nullptr; ++k)
    store2(to, Pixels{p.index + k * s.lens.width * s.lens.height, p.count}, nan<F>(), nan<F>());
}

}  // namespace tofray::pipeline
