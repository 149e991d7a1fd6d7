// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/sensor.h"

namespace tofray::effect {

/// Light of another camera that shines on the same surfaces.                                            [theory: interference]
struct OtherCamera {
  /// Its numbers stand in the raw frames, which each have their own.
  struct View {
    bool operator==(const View&) const = default;
  };
  template <class Camera, class Sensor>
  static void set(const Camera&, Sensor&) {}
  template <class Sensor>
  static bool on(const Sensor& s) {
    return s.raw_frames > 0 && s.frame[0].other != nullptr;
  }
  /// Of light, which the pixels collect as they do all light.
  template <class Pixel>
  static void bin(Pixel&, int) {}
  template <class Camera>
  static double variance(const Camera&) {
    return 0;
  }

  /// What it adds to the rate of both taps together and, where the gate swings, to that of their difference.
  template <class F>
  TOFRAY_INLINE static void change_rates(const RawFrameView& frame, int orders, const flow::Light<F>& light, Rates<F>& rates) {
    if (frame.other == nullptr) return;
    rates.ambient = num::fma(light.signal_rate, F(frame.other_light), rates.ambient);
    if (frame.lit == 0) return;
    const F *real = light.real + frame.modulation * orders, *imaginary = light.imaginary + frame.modulation * orders;
    rates.difference = rates.difference + (orders <= 4 ? correlated<4>(frame.other, real, imaginary)
                                                       : correlated<flow::max_harmonics>(frame.other, real, imaginary));
  }
};

}  // namespace tofray::effect
