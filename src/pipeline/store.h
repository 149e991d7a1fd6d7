// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "depth/decode.h"
#include "pipeline/setup.h"

/// From a pixel's values to the frame's arrays. Invalid values become one written NaN: those that arithmetic makes differ between machines.
namespace tofray::pipeline {

using flow::Pixels;

template <class F>
TOFRAY_INLINE F nan() {
  return num::from_bits(num::Uint<F>(0x7fc00000u));
}

template <class F>
TOFRAY_INLINE void store(float* to, const Pixels& p, F value) {
  if (to != nullptr) num::store(to + p.index, value, p.count);
}
template <class F>
TOFRAY_INLINE void store2(float* to, const Pixels& p, F x, F y) {
  if (to != nullptr) num::store2(to + 2 * p.index, x, y, p.count);
}
template <class F>
TOFRAY_INLINE void store3(float* to, const Pixels& p, F x, F y, F z) {
  if (to != nullptr) num::store3(to + 3 * p.index, x, y, z, p.count);
}

template <class F>
TOFRAY_INLINE void store_taps(int pixels, const flow::FrameView& out, const Pixels& p, int k, const flow::Taps<F>& taps, TapStores how) {
  const Pixels at{p.index + k * pixels, p.count};
  if constexpr (num::can_store_past<F>) {
    if (how == TapStores::past_caches) {
      num::store_past(out.tap_a + at.index, taps.a);
      num::store_past(out.tap_b + at.index, taps.b);
      num::store_past(out.raw + at.index, num::to_int(taps.code));
      return;
    }
    if (how == TapStores::all) {
      num::store(out.tap_a + at.index, taps.a, at.count);
      num::store(out.tap_b + at.index, taps.b, at.count);
      num::store(out.raw + at.index, num::to_int(taps.code), at.count);
      return;
    }
  }
  store(out.tap_a, at, taps.a), store(out.tap_b, at, taps.b);
  if (out.raw != nullptr) num::store(out.raw + at.index, num::to_int(taps.code), at.count);
}

/// Says early where the taps, and the depth, of some pixels will be written: a frame is larger than the near caches, and a store that misses
/// them waits for its line.
template <class F>
TOFRAY_INLINE void fetch_taps(int pixels, const flow::FrameView& out, const Pixels& p, int k, TapStores how) {
  if (p.count == 0 || how == TapStores::past_caches) return;
  const std::int32_t at = p.index + k * pixels;
  num::fetch_to<F>(out.tap_a, at, p.count), num::fetch_to<F>(out.tap_b, at, p.count), num::fetch_to<F>(out.raw, at, p.count);
}
template <class F>
TOFRAY_INLINE void fetch_depth(const flow::FrameView& out, const Pixels& p) {
  if (p.count == 0) return;
  const auto fetch = [&](const auto* to) TOFRAY_LAMBDA { num::fetch_to<F>(to, p.index, p.count); };
  fetch(out.z_m), fetch(out.range_m), fetch(out.amplitude_e), fetch(out.ambient_e), fetch(out.noise_m), fetch(out.confidence),
      fetch(out.flags);
  num::fetch_to<F>(out.points_m, 3 * p.index, 3 * p.count);
}

/// What the surface shows: the paper's matrices.
/// @param material  says the number of its material, where that is wanted
template <class F, class Material>
TOFRAY_INLINE void store_truth(const flow::FrameView& out, const Pixels& p, const flow::Surface<F>& s, const flow::Radiometry<F>& r,
                               Material material) {
  const auto value = [&](F a) TOFRAY_LAMBDA { return num::select(s.found, a, nan<F>()); };
  store(out.gt_range_m, p, value(s.range));
  store(out.gt_z_m, p, value(s.z));
  store(out.gt_reflectivity, p, value(s.finish.reflectivity));
  store3(out.gt_position_m, p, value(s.x), value(s.y), value(s.z));
  store3(out.gt_normal, p, value(s.nx), value(s.ny), value(s.nz));
  if (out.gt_object_id != nullptr) num::store(out.gt_object_id + p.index, num::select(s.found, s.object, num::Int<F>(-1)), p.count);
  if (out.gt_material_id != nullptr) num::store(out.gt_material_id + p.index, num::select(s.found, material(), num::Int<F>(-1)), p.count);
  store(out.gt_irradiance_w_m2, p, r.irradiance);
  store(out.gt_radiance_w_m2_sr, p, r.radiance);
  store(out.gt_power_w, p, r.power);
}

/// Point, z and confidence of a valid range; NaN and 0 elsewhere.
template <class F>
TOFRAY_INLINE void store_range(const flow::FrameView& out, const Pixels& p, const flow::Ray<F>& ray, F range, num::Int<F> confidence,
                               num::Int<F> flags) {
  const auto valid = (flags & num::Int<F>(depth::invalid)) == num::Int<F>(0);
  const F z = num::select(valid, range * ray.inverse_length, nan<F>());
  store(out.z_m, p, z);
  store(out.range_m, p, num::select(valid, range, nan<F>()));
  store3(out.points_m, p, num::select(valid, ray.x * z, nan<F>()), num::select(valid, ray.y * z, nan<F>()), z);
  if (out.confidence != nullptr) {
    num::store(out.confidence + p.index, num::select(valid, confidence, num::Int<F>(0)), p.count);
  }
  if (out.flags != nullptr) num::store(out.flags + p.index, flags, p.count);
}

}  // namespace tofray::pipeline
