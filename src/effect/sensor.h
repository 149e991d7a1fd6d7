// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "flow/flow.h"
#include "num/philox.h"

/// What all effects of a sensor share: raw frames, draws, and the charge that passes through them. Kernel headers know no profile, so that
/// what comes of one is a template.
namespace tofray::effect {

/// When the gate opens, against the first raw frame of its modulation frequency.
enum class Gate : std::int32_t { in_phase, quarter_late, opposite, quarter_early, other };

/// Correlation and exposure of one raw frame.
struct RawFrameView {
  std::int32_t lit;
  std::int32_t modulation;  ///< index of the modulation frequency
  float integration_time;   ///< [s]
  float dark;               ///< dark electrons of a tap
  Gate gate_kind;
  const float* gate;  ///< [orders][2] cos and sin of m(τ − τ_0 + δ), δ the phase of temperature drift
  /// Gate for another camera's light, times its share of the own; null: there is no other camera.        [theory: interference]
  const float* other;
  float other_light;  ///< its share of the own
};

/// Light that meets a gate: Re Σ_m Z_m·e^{imτ} at any τ.                                          [theory: correlation]
template <int orders, class F>
TOFRAY_INLINE F correlated(const float* gate, const F* real, const F* imaginary) {
  F sum = F(0.0f);
  for (int h = 0; h < orders; ++h) sum = num::fma(real[h], F(gate[2 * h]), num::fnma(imaginary[h], F(gate[2 * h + 1]), sum));
  return sum;
}

/// What a draw with the sensor's keys is for: part of the random counter, beside pixel, raw frame and frame.
enum Purpose : std::uint32_t { shot_and_read = 0, merged = 1, suppression = 2, of_column = 3, of_row = 4, other_camera = 5 };

/// How charge is drawn: shot and read noise apart, or merged into one draw, whose law is as good as theirs from this read noise on.
enum class Noise : std::int32_t { off, apart, merged };
constexpr double least_merged_read_noise = 4;  ///< [e⁻]                                                  [theory: merged-noise]

/// What a sensor has whatever its effects are.
struct SensorBase {
  std::int32_t raw_frames;
  std::int32_t drifts;         ///< 1: the gates, or what they meet of another camera, are others in each frame
  const RawFrameView* frame;   ///< [raw_frames]
  const float* gain;           ///< [height][width] 1 + PRNU, both taps alike, or null
  const float* offset;         ///< [height][width] DSNU [DN], or null
  const float* delay;          ///< [modulations][height][width] [s], or null
  std::int32_t delay_stride;   ///< from one modulation's delays to the next's; 0: all have the same
  num::RoundKeys keys;         ///< of the seed
  Noise noise;                 ///< how charge is drawn
  std::int32_t width, height;  ///< of the image that is read out
  std::int32_t effects;        ///< 0: it is plain: it has none of Effects
  bool operator==(const SensorBase&) const = default;
};

struct FrameIndex {
  std::uint32_t low, high;
};

template <class F, class Sensor>
TOFRAY_INLINE num::Random4<F> draw(const Sensor& s, num::Int<F> pixel, int raw_frame, FrameIndex frame, Purpose purpose) {
  return num::philox<F>(num::to_uint(pixel), static_cast<std::uint32_t>(raw_frame) | (static_cast<std::uint32_t>(purpose) << 16), frame.low,
                        frame.high, s.keys);
}

/// Electrons of the two taps.
template <class F>
struct TapPair {
  F a, b;
};

/// Random words of a pixel that serve three raw frames, the first of which has a number that three divides. (No zeros for `block`: they would
/// cost 3 to 5 % of a frame.)
template <class F>
struct TapWords {
  num::Random4<F> block;
  std::int32_t first = -1;  ///< of these raw frames; below 0: nothing is drawn yet
};

/// A normal for each tap of raw frame k. Each of three words has a radius of 24 bits and 8 of an angle, the fourth ten more for each angle.
template <class F, class Sensor>
TOFRAY_INLINE TapPair<F> tap_normals(const Sensor& s, num::Int<F> pixel, int k, FrameIndex frame, Purpose purpose, TapWords<F>& words) {
  const int place = k % 3;
  if (words.first != k - place) words.block = draw<F>(s, pixel, k - place, frame, purpose), words.first = k - place;
  const num::Uint<F> radius = words.block.w[place], more = ((words.block.w[3] << (10 * place)) >> 8) & num::Uint<F>(0x00ffc000u);
  TapPair<F> out;
  num::normal_pair<F>(radius, (radius << 24) | more, out.a, out.b);
  return out;
}

/// Electrons per second that a raw frame collects, as another camera changes them.
template <class F>
struct Rates {
  F ambient;     ///< of both taps together, beside the signal
  F difference;  ///< A−B of the light alone
};

/// Charge of one raw frame, and the ADC's offset, on their way through the effects.
template <class F>
struct Chain {
  TapPair<F> charge;
  F offset;  ///< [DN]
};

/// Normals of the lines through a pack of pixels, of the frame's first raw frame; null: lines have no noise.
struct LinesOfPack {
  const float *columns, *row;
  std::int32_t count;  ///< pixels of the pack
};

/// A−B of the least and of the most code [e⁻]; the pixel's offset pattern is not in it.
template <class F>
struct CodeReach {
  F least, most;
};

/// What stays the same for a pixel over all raw frames of a frame, and what is computed once for several of them.
template <class F>
struct Exposure {
  num::Int<F> pixel;
  LinesOfPack lines;
  F gain_a, gain_b, offset;
  CodeReach<F> reach;  ///< with that offset
  TapWords<F> merged_words, suppression_words;
  F overflow;                   ///< of the lit raw frames: most charge for which both wells have no room, where that spills
  F most_charge, widest_level;  ///< of the lit raw frames: most charge of a tap, largest distance of a level from the valid codes' middle
};

}  // namespace tofray::effect
