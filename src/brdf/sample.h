// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/around.h"
#include "brdf/list.h"

/// Ways that light may have come from, drawn as a surface's BRDF weighs them.
///
/// With l drawn at a density of pdf per solid angle, the mean of weight·L over many ways, weight = f_r·(n·l)/pdf, is what a surface
/// sends on of the radiance L(l) that reaches it. Matt parts are drawn by the cosine, lobes by themselves. A BRDF that has a lobe says so by
/// three functions: lobe_share, the probability with which it is taken; lobe_way, a direction out of it; lobe_pdf, how dense those are.
namespace tofray::brdf {

template <class F>
struct Sampled {
  Direction<F> light;  ///< toward where the light comes from, of unit length
  F weight;            ///< 0 where that is below the surface
};

template <class T, class F>
concept Lobed = requires(Finish<F> of, Cosines<F> cosine, Directions<F> directions, F a) {
  T::lobe_share(of, a);
  T::lobe_way(of, directions, a, a);
  T::lobe_pdf(of, cosine, directions);
};

/// Of the density (n·l)/π.                                                                           [theory: cosine-sampling]
template <class F>
TOFRAY_INLINE Direction<F> cosine_way(const Direction<F>& normal, F u, F v) {
  return beside(normal, num::sqrt(F(1.0f) - u), num::sqrt(u), v);
}

/// Matt part or lobe: u says which, and what is left of it where. Whichever it was, the weight is by the density of both, which keeps it
/// from growing where one part alone is rare.                                                      [theory: mixture-sampling]
template <class T, class F>
TOFRAY_NOINLINE Sampled<F> matt_or_lobe(const Finish<F>& of, const Direction<F>& normal, const Direction<F>& view, F u, F v) {
  const F cos_view = inner(normal, view), share = T::lobe_share(of, cos_view), rest = F(1.0f) - share;
  const auto lobe = u < share;
  const F again = num::select(lobe, u, u - share) / num::select(lobe, share, rest);
  const Direction<F> from_lobe = T::lobe_way(of, Directions<F>{normal, {}, view}, again, v);
  const Direction<F> light = unit(select(lobe, from_lobe, cosine_way(normal, again, v)));
  const Cosines<F> cosine{inner(normal, light), cos_view, inner(light, view)};
  const Directions<F> directions{normal, light, view};
  const F pdf = num::fma(share, T::lobe_pdf(of, cosine, directions), rest * F(per_pi) * cosine.light);
  F f_r;
  if constexpr (Narrow<T, F>) {
    f_r = T::f_r(of, cosine, directions);
  } else {
    f_r = T::f_r(of, cosine);
  }
  return {light, num::select(cosine.light > F(0.0f), f_r * cosine.light / pdf, F(0.0f))};
}

/// The lanes whose surfaces have the BRDF T; `out` holds those that Lambert's would have.
template <class T, class F>
TOFRAY_INLINE void sample_those(const Finish<F>& of, const Direction<F>& normal, const Direction<F>& view, F u, F v, Sampled<F>& out) {
  constexpr int place = num::place_in<T>(Brdfs{});
  if constexpr (place > 0) {
    const auto its = of.brdf == num::Int<F>(place);
    if (!num::any(its)) return;
    if constexpr (Lobed<T, F>) {
      const Finish<F> copy = of;  // what is handed to a function lies in memory; the caller's need not
      const Direction<F> normals = normal, views = view;
      const Sampled<F> own = matt_or_lobe<T>(copy, normals, views, u, v);
      out = {select(its, own.light, out.light), num::select(its, own.weight, out.weight)};
    } else {
      const Cosines<F> cosine{inner(normal, out.light), inner(normal, view), inner(out.light, view)};
      out.weight = num::select(its, T::f_r(of, cosine) * F(3.14159265f), out.weight);
    }
  }
}

template <class... T, class F>
TOFRAY_INLINE void sample_each(num::List<T...>, const Finish<F>& of, const Direction<F>& normal, const Direction<F>& view, F u, F v,
                               Sampled<F>& out) {
  (sample_those<T>(of, normal, view, u, v, out), ...);
}

/// A way that light may have come from, and what it weighs.
///                               [theory: cosine-sampling, mixture-sampling, phong-sampling, ggx-sampling, retro-sampling]
/// @param normal, view  of unit length, the view (to where light goes) above the surface: n·v > 0
/// @param u, v          in [0, 1): a pair for each way, evenly spread over the square
template <class F>
TOFRAY_INLINE Sampled<F> sample(const Finish<F>& of, const Direction<F>& normal, const Direction<F>& view, F u, F v) {
  Sampled<F> out{cosine_way(normal, u, v), of.reflectivity};
  if (num::any(of.brdf > num::Int<F>(0))) sample_each(Brdfs{}, of, normal, view, u, v, out);
  return out;
}

}  // namespace tofray::brdf
