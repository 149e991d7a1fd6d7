// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "effect/adc.h"
#include "effect/blooming.h"
#include "effect/crosstalk.h"
#include "effect/dark_current.h"
#include "effect/line_noise.h"
#include "effect/nonlinearity.h"
#include "effect/other_camera.h"
#include "effect/pixel_patterns.h"
#include "effect/read_noise.h"
#include "effect/suppression.h"
#include "effect/tap_mismatch.h"
#include "num/list.h"

/// All effects of a sensor, in the order in which charge meets them. No other file but an effect's own names it, unless to ask for something
/// that it alone has.
///
///     an effect T       what a sensor may have; one that has none of them is plain
///     T::View           its numbers for kernels: a part of SensorView
///     T::set            sets them, out of a camera
///     T::on             its switch: whether a sensor has it
///     T::bin            its numbers where n × n pixels are read as one                    [theory: binned-charge, binned-patterns]
///     T::variance       what it adds to the variance of A−B whatever the charge [e²]                          [theory: phase-noise]
///
/// and its formula, one of three:
///
///     T::change_rates   of what is collected per second
///     T::change_charge  of what the taps hold, or of the offset with which it is read. `drawn` is true for raw frames, and false for the
///                       levels that they would have without noise
///     T::change_reading of what is read of the charge
namespace tofray::effect {

using Effects = num::List<OtherCamera, TapMismatch, Suppression, LineNoise, Blooming, Nonlinearity>;

/// What every sensor has: no switch, and their formulas stand where they are used.
using Always = num::List<DarkCurrent, Crosstalk, PixelPatterns, ReadNoise, Adc>;

template <class List>
struct ViewsOf;
template <class... T>
struct ViewsOf<num::List<T...>> : T::View... {
  bool operator==(const ViewsOf&) const = default;
};

/// Sequence, charge, ADC: all that kernels know of a sensor.
struct SensorView : SensorBase, ReadNoise::View, Adc::View, ViewsOf<Effects> {
  bool operator==(const SensorView&) const = default;
};

/// The numbers that kernels take from a camera as they are.
template <class... T, class Camera>
void set_each(num::List<T...>, const Camera& camera, SensorView& s) {
  (T::set(camera, s), ...);
}
template <class Camera>
void set(const Camera& camera, SensorView& s) {
  s.width = camera.sensor.width, s.height = camera.sensor.height;
  ReadNoise::set(camera, s), Adc::set(camera, s);
  set_each(Effects{}, camera, s);
}

/// Whether a sensor has any of them.
template <class... T>
bool any_of(num::List<T...>, const SensorView& s) {
  return (T::on(s) || ...);
}

template <class... T, class Pixel>
void bin_each(num::List<T...>, Pixel& pixel, int n) {
  (T::bin(pixel, n), ...);
}
/// Charges of n × n pixels add before they are read: what is of each pixel adds, what the amplifier does comes once.
///                                                                                                 [theory: binned-charge, binned-patterns]
template <class Pixel>
void bin(Pixel& pixel, int n) {
  bin_each(Effects{}, pixel, n), bin_each(Always{}, pixel, n);
}

template <class... T, class Camera>
double variance_of_each(num::List<T...>, const Camera& camera) {
  double sum = Adc::variance(camera);
  ((sum += T::variance(camera)), ...);
  return sum;
}
/// Variance of A−B that has nothing to do with charge: rounding, column and row noise [e²].    [theory: phase-noise, column-noise]
template <class Camera>
double output_variance(const Camera& camera) {
  return variance_of_each(Effects{}, camera);
}

template <class T, class F>
constexpr bool changes_rates = requires(const RawFrameView& frame, const flow::Light<F>& light, Rates<F>& rates) {
  T::change_rates(frame, 1, light, rates);
};
template <class T, class F>
constexpr bool changes_charge = requires(const SensorView& s, const RawFrameView& frame, FrameIndex index, Exposure<F>& e,
                                         Chain<F>& chain) {
  T::template change_charge<true>(s, frame, 0, index, e, chain);
};
template <class T, class F>
constexpr bool changes_reading = requires(const SensorView& s, TapPair<F>& charge) {
  T::change_reading(s, charge);
};

template <class... T, class F>
TOFRAY_INLINE void change_rates(num::List<T...>, const RawFrameView& frame, int orders, const flow::Light<F>& light, Rates<F>& rates) {
  static_assert(((changes_rates<T, F> + changes_charge<T, F> + changes_reading<T, F> == 1) && ...), "an effect has one formula");
  const auto one = [&]<class One>(num::List<One>) TOFRAY_LAMBDA {
    if constexpr (changes_rates<One, F>) One::change_rates(frame, orders, light, rates);
  };
  (one(num::List<T>{}), ...);
}
template <bool drawn, class... T, class Kept, class F>
TOFRAY_INLINE void change_charge(num::List<T...>, const SensorView& s, const RawFrameView& frame, int k, FrameIndex index, Kept& e,
                                 Chain<F>& chain) {
  const auto one = [&]<class One>(num::List<One>) TOFRAY_LAMBDA {
    if constexpr (changes_charge<One, F>) One::template change_charge<drawn>(s, frame, k, index, e, chain);
  };
  (one(num::List<T>{}), ...);
}
template <class... T, class F>
TOFRAY_INLINE void change_reading(num::List<T...>, const SensorView& s, TapPair<F>& charge) {
  const auto one = [&]<class One>(num::List<One>) TOFRAY_LAMBDA {
    if constexpr (changes_reading<One, F>) One::change_reading(s, charge);
  };
  (one(num::List<T>{}), ...);
}

}  // namespace tofray::effect
