// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

namespace tofray::effect {

/// Full wells that spill into their neighbours.                                                             [theory: blooming]
struct Blooming {
  struct View {
    std::int32_t blooms;   ///< 1: they do
    float blooming_share;  ///< of what overflows to each neighbour
    float blooming_limit;  ///< a pixel that receives more [e⁻] is flagged
    bool operator==(const View&) const = default;
  };
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    s.blooming_share = static_cast<float>(camera.pixel.blooming_share);
    s.blooming_limit = static_cast<float>(camera.pixel.blooming_limit_e);
    s.blooms = s.blooming_share > 0;
  }
  static bool on(const View& s) { return s.blooms != 0; }
  /// Of the pixels along one edge alone.
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    pixel.blooming_share /= n, pixel.blooming_limit_e *= n;
  }
  template <class Camera>
  static double variance(const Camera&) {
    return 0;
  }

  /// Charge above full well, both taps together.
  template <class F, class Sensor>
  TOFRAY_INLINE static F overflow_of(const Sensor& s, const TapPair<F>& charge) {
    return num::max(charge.a - F(s.full_well), F(0.0f)) + num::max(charge.b - F(s.full_well), F(0.0f));
  }
  /// Notes it, for the pass that looks at neighbours.
  template <bool drawn, class F, class Sensor, class Kept>
  TOFRAY_INLINE static void change_charge(const Sensor& s, const RawFrameView& frame, int, FrameIndex, Kept& e, Chain<F>& chain) {
    if constexpr (drawn) {
      if (s.blooms != 0 && frame.lit != 0) e.overflow = num::max(e.overflow, overflow_of<F>(s, chain.charge));
    }
  }
  /// A pixel that gets more than the limit of what its neighbours' wells cannot hold is flagged as saturated.
  TOFRAY_INLINE static bool flags(const View& s, float spilled) { return spilled * s.blooming_share > s.blooming_limit; }
};

}  // namespace tofray::effect
