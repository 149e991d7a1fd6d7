// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

namespace tofray::effect {

/// Background suppression: equal charge off both taps.                                       [theory: background-suppression]
struct Suppression {
  struct View {
    float suppression_threshold, suppression_budget;  ///< [e⁻] of a tap; threshold 0: no suppression
    float suppression_noise;                          ///< factor κ
    bool operator==(const View&) const = default;
  };
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    s.suppression_threshold = static_cast<float>(camera.pixel.suppression_threshold_e);
    s.suppression_budget = static_cast<float>(camera.pixel.suppression_budget_e);
    s.suppression_noise = static_cast<float>(camera.pixel.suppression_noise_factor);
  }
  static bool on(const View& s) { return s.suppression_threshold > 0; }
  template <class Pixel>
  static void bin(Pixel& pixel, int n) {
    const double all = static_cast<double>(n) * n;
    pixel.suppression_threshold_e *= all, pixel.suppression_budget_e *= all;
  }
  /// Its noise depends on what it takes: see variance_per_electron.
  template <class Camera>
  static double variance(const Camera&) {
    return 0;
  }
  /// 2κ²: variance of A−B for each electron off both taps.
  template <class Camera>
  static double variance_per_electron(const Camera& camera) {
    return 2 * camera.pixel.suppression_noise_factor * camera.pixel.suppression_noise_factor;
  }
  /// Charge of a tap that holds `charge` of its own, both taps alike, as it is read.
  template <class Camera>
  static double left_of(const Camera& camera, double charge) {
    if (!(camera.pixel.suppression_threshold_e > 0)) return charge;
    const double above = charge - camera.pixel.suppression_threshold_e, excess = above > 0 ? above : 0;
    return charge - (camera.pixel.suppression_budget_e < excess ? camera.pixel.suppression_budget_e : excess);
  }

  /// x = min(budget, max(0, min(A, B) − threshold)).
  template <class F>
  TOFRAY_INLINE static F removed(const View& s, const TapPair<F>& charge) {
    const F excess = num::max(num::min(charge.a, charge.b) - F(s.suppression_threshold), F(0.0f));
    return num::min(excess, F(s.suppression_budget));
  }
  /// Takes it off; each removal adds its own variance κ²·x.
  template <class F, class Sensor>
  TOFRAY_INLINE static TapPair<F> suppress(const Sensor& s, const TapPair<F>& charge, num::Int<F> pixel, int k, FrameIndex frame,
                                           TapWords<F>& words) {
    const F off = removed<F>(s, charge);
    TapPair<F> left{charge.a - off, charge.b - off};
    if (s.noise != Noise::off && s.suppression_noise > 0 && num::any(off > F(0.0f))) {
      const TapPair<F> normal = tap_normals<F>(s, pixel, k, frame, Purpose::suppression, words);
      const F sigma = F(s.suppression_noise) * num::sqrt(off);
      left.a = num::fma(sigma, normal.a, left.a), left.b = num::fma(sigma, normal.b, left.b);
    }
    return left;
  }

  template <bool drawn, class F, class Sensor, class Kept>
  TOFRAY_INLINE static void change_charge(const Sensor& s, const RawFrameView&, int k, FrameIndex index, Kept& e, Chain<F>& chain) {
    if (!(s.suppression_threshold > 0)) return;
    if constexpr (drawn) {
      chain.charge = suppress<F>(s, chain.charge, e.pixel, k, index, e.suppression_words);
    } else {
      const F off = removed<F>(s, chain.charge);
      chain.charge = {chain.charge.a - off, chain.charge.b - off};
    }
  }
};

}  // namespace tofray::effect
