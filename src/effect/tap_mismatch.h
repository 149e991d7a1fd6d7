// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

namespace tofray::effect {

/// Taps of which one collects more than the other, and holds more before any charge comes.              [theory: tap-mismatch]
struct TapMismatch {
  struct View {
    std::int32_t taps_differ;    ///< 1: by the two numbers below
    float half_gain_mismatch;    ///< g/2
    float half_offset_mismatch;  ///< [e⁻] of a tap
    bool operator==(const View&) const = default;
  };
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    s.half_gain_mismatch = static_cast<float>(0.5 * camera.pixel.tap_gain_mismatch);
    s.half_offset_mismatch = static_cast<float>(0.5 * camera.pixel.tap_offset_mismatch_e);
    s.taps_differ = s.half_gain_mismatch != 0 || s.half_offset_mismatch != 0;
  }
  static bool on(const View& s) { return s.taps_differ != 0; }
  /// Offsets are charge, which adds.
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    pixel.tap_offset_mismatch_e *= static_cast<double>(n) * n;
  }
  template <class Camera>
  static double variance(const Camera&) {
    return 0;
  }

  /// One tap collects 1 + g/2 of what it should, the other 1 − g/2.
  template <class F>
  TOFRAY_INLINE static void change_gains(const View& s, Exposure<F>& e) {
    if (s.half_gain_mismatch == 0) return;
    e.gain_a = num::fma(e.gain_a, F(s.half_gain_mismatch), e.gain_a);
    e.gain_b = num::fnma(e.gain_b, F(s.half_gain_mismatch), e.gain_b);
  }

  /// PRNU is of light alone: dark charge comes as if there were none.                                 [theory: charge-order]
  template <class F>
  TOFRAY_INLINE static TapPair<F> dark_less_in_gain(const View& s, const RawFrameView& frame, const Exposure<F>& e) {
    const F half = F(s.half_gain_mismatch), dark = F(frame.dark);
    return {dark * ((F(1.0f) + half) - e.gain_a), dark * ((F(1.0f) - half) - e.gain_b)};
  }

  /// A−B of a lit raw frame without noise.
  /// @param common, rate  electrons per second of both taps together, and of their difference
  template <class F, class Sensor>
  TOFRAY_INLINE static F known_difference(const Sensor& s, const RawFrameView& frame, F common, F rate, const Exposure<F>& e) {
    const F of_rate = F(0.5f * frame.integration_time) * rate * (e.gain_a + e.gain_b);
    const F each = num::fma(common, F(0.5f * frame.integration_time), F(frame.dark));
    const F difference = num::fma(each, e.gain_a - e.gain_b, of_rate) + F(2 * s.half_offset_mismatch);
    if (s.gain == nullptr) return difference;
    const TapPair<F> less = dark_less_in_gain<F>(s, frame, e);
    return difference + (less.a - less.b);
  }

  /// What the taps hold before any charge comes.
  template <bool drawn, class F, class Kept>
  TOFRAY_INLINE static void change_charge(const View& s, const RawFrameView&, int, FrameIndex, Kept&, Chain<F>& chain) {
    if (s.half_offset_mismatch == 0) return;
    chain.charge = {chain.charge.a + F(s.half_offset_mismatch), chain.charge.b - F(s.half_offset_mismatch)};
  }
};

}  // namespace tofray::effect
