// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

namespace tofray::effect {

/// From A−B to a code and back.                                               [theory: adc, noiseless-difference, gain-steps]
struct Adc {
  struct View {
    float per_step;                  ///< 1/s [DN/e⁻]
    float step;                      ///< s [e⁻/DN]
    float mid_code, max_code;        ///< [DN]
    float valid_middle, valid_half;  ///< [DN] valid range of codes as middle and half width
    bool operator==(const View&) const = default;
  };
  template <class Camera>
  static void set(const Camera& camera, View& s) {
    const auto f = [](double a) { return static_cast<float>(a); };
    const auto& adc = camera.adc;
    const double step = step_of(camera);
    s.per_step = f(1 / step), s.step = f(step), s.mid_code = f(adc.mid_code);
    s.max_code = f((1 << adc.bits) - 1);
    const double lower = camera.decoding.lower_saturation_dn.value_or(adc.valid_min);
    const double upper = camera.decoding.upper_saturation_dn.value_or(adc.valid_max);
    s.valid_middle = f(0.5 * (lower + upper)), s.valid_half = f(0.5 * (upper - lower));
  }
  /// Binned pixels are converted once.
  template <class Pixel>
  static void bin(Pixel&, int) {}
  /// Variance of rounding: s²/12.                                                                          [theory: phase-noise]
  template <class Camera>
  static double variance(const Camera& camera) {
    const double step = step_of(camera);
    return step * step / 12;
  }

  /// Electrons of A−B for each code, in the mode's gain.                                           [theory: gain-steps]
  template <class Camera>
  static double step_of(const Camera& camera) {
    return camera.adc.step_e_per_dn / camera.mode.gain;
  }
};

template <class F>
TOFRAY_INLINE CodeReach<F> reach_of_codes(const Adc::View& s, F offset) {
  const F zero = F(s.mid_code) + offset;
  return {-zero * F(s.step), (F(s.max_code) - zero) * F(s.step)};
}
/// A−B without rounding, held to what the codes reach.                                  [theory: noiseless-difference]
template <class F>
TOFRAY_INLINE F held_to_codes(const CodeReach<F>& reach, F difference) {
  return num::min(num::max(difference, reach.least), reach.most);
}

/// The ADC's level of A−B before it is rounded: (A−B)/s + mid + offset.                                  [theory: adc]
template <class F>
TOFRAY_INLINE F level_of(const Adc::View& s, F difference, F offset) {
  return num::fma(difference, F(s.per_step), F(s.mid_code) + offset);
}

/// Full well per tap, then A−B through the ADC: DN = round((A−B)/s + mid + offset), held to the code range.       [theory: adc]
/// @param charge  what is read of both taps
/// @param reach   of the codes, offset included; asked for where noise is off
/// @param known   a function that says of the taps' difference what it is without noise
template <class F, class Sensor, class Known>
TOFRAY_INLINE flow::Taps<F> read_out(const Sensor& s, const TapPair<F>& charge, F offset, const CodeReach<F>& reach, const Known& known) {
  flow::Taps<F> out;
  out.a = num::min(charge.a, F(s.full_read)), out.b = num::min(charge.b, F(s.full_read));
  const F difference = out.a - out.b;
  out.level = num::round_even(level_of<F>(s, difference, offset));
  out.code = num::min(num::max(out.level, F(0.0f)), F(s.max_code));
  out.difference = s.noise == Noise::off ? held_to_codes(reach, known(difference)) : (out.code - F(s.mid_code)) * F(s.step);
  return out;
}

template <class F, class Sensor>
TOFRAY_INLINE flow::Taps<F> read_out(const Sensor& s, const TapPair<F>& charge, F offset) {
  return read_out(s, charge, offset, reach_of_codes<F>(s, offset), [](F difference) TOFRAY_LAMBDA { return difference; });
}

}  // namespace tofray::effect
