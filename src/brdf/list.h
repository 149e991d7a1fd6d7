// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "brdf/ggx.h"
#include "brdf/lambert.h"
#include "brdf/oren_nayar.h"
#include "brdf/phong.h"
#include "brdf/retro.h"
#include "num/list.h"

/// All BRDFs, and where they are evaluated. No other file but a BRDF's own names it.
namespace tofray::brdf {

/// In the order of Material::Brdf. The first one needs no numbers but the reflectivity.
using Brdfs = num::List<Lambert, Phong, OrenNayar, Ggx, Retro>;

template <class... T, class Said>
MaterialView view_of(num::List<T...>, const Said& material) {
  MaterialView out{};
  const int which = static_cast<int>(material.brdf);
  ((num::place_in<T>(Brdfs{}) == which ? void(out = T::view(material)) : void()), ...);
  out.brdf = which;
  return out;
}
/// Of a material of the public structs.
template <class Said>
MaterialView view_of(const Said& material) {
  return view_of(Brdfs{}, material);
}

/// Diffuse and specular shares as other renderers give them: Phong where there is a lobe.
template <class F>
TOFRAY_INLINE Finish<F> lambert_and_lobe(F diffuse, F specular, F exponent) {
  const num::Int<F> phong(num::place_in<Phong>(Brdfs{}));
  return {diffuse + specular, {diffuse, specular, exponent}, num::select(specular > F(0.0f), phong, num::Int<F>(0))};
}

/// f_r of those whose lobes are narrow takes directions, too. Apart: these are few surfaces, and long functions.
template <class T, class F>
concept Narrow = requires(Finish<F> of, Cosines<F> cosine, Directions<F> directions) {
  T::f_r(of, cosine, directions);
};
template <class T, class F>
TOFRAY_NOINLINE F narrow(const Finish<F>& of, const Cosines<F>& cosine, const Directions<F>& directions) {
  return T::f_r(of, cosine, directions);
}

/// The lanes whose surfaces have the BRDF T.
/// @param directions  a function, called where they are needed
template <class T, class F, class Toward>
TOFRAY_INLINE void evaluate(const Finish<F>& of, const Cosines<F>& cosine, const Toward& directions, F& f_r) {
  constexpr int place = num::place_in<T>(Brdfs{});
  if constexpr (place > 0) {
    const auto its = of.brdf == num::Int<F>(place);
    if (!num::any(its)) return;
    if constexpr (Narrow<T, F>) {
      const Finish<F> copy = of;  // what is handed to a function lies in memory; `of` need not
      const Cosines<F> cosines = cosine;
      f_r = num::select(its, narrow<T>(copy, cosines, directions()), f_r);
    } else {
      f_r = num::select(its, T::f_r(of, cosine), f_r);
    }
  }
}

template <class... T, class F, class Toward>
TOFRAY_INLINE void evaluate_each(num::List<T...>, const Finish<F>& of, const Cosines<F>& cosine, const Toward& directions, F& f_r) {
  (evaluate<T>(of, cosine, directions, f_r), ...);
}

/// What of light from everywhere a surface sends on to the camera: of those that say it, as they are seen; else the reflectivity.
template <class... T, class F>
TOFRAY_INLINE void albedo_of_each(num::List<T...>, const Finish<F>& of, F cosine, F& albedo) {
  const auto one = [&]<class One>(num::List<One>) TOFRAY_LAMBDA {
    if constexpr (requires { One::albedo(of, cosine); }) {
      const auto its = of.brdf == num::Int<F>(num::place_in<One>(Brdfs{}));
      if (num::any(its)) albedo = num::select(its, One::albedo(of, cosine), albedo);
    }
  };
  (one(num::List<T>{}), ...);
}
/// @param cosine  of the angle at which it is seen
template <class F>
TOFRAY_INLINE F albedo(const Finish<F>& of, F cosine) {
  F out = of.reflectivity;
  if (num::any(of.brdf > num::Int<F>(0))) albedo_of_each(Brdfs{}, of, cosine, out);
  return out;
}

/// f_r [1/sr]: how a surface sends light on.                [theory: lambert, phong, oren-nayar, ggx, ggx-masking, retro-reflector]
/// @param directions  a function that gives Directions<F>: called where they are needed
template <class F, class Toward>
TOFRAY_INLINE F reflection(const Finish<F>& of, const Cosines<F>& cosine, const Toward& directions) {
  F f_r = Lambert::f_r(of, cosine);
  if (num::any(of.brdf > num::Int<F>(0))) evaluate_each(Brdfs{}, of, cosine, directions, f_r);
  return f_r;
}

}  // namespace tofray::brdf
