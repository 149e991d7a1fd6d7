// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "camera/pixel/view.h"

/// What decoding knows of the camera, frozen: from raw frames to depth.
namespace tofray::camera {

/// One modulation frequency as the decoder sees it.
struct DecodeModulation {
  float half_wave;      ///< R = c/(2f) [m], unambiguous half path
  float per_half_wave;  ///< 1/R
  float cycles;         ///< M: periods in the common range
  float frequency;      ///< [Hz]
  float integration_time;
  float ambient_scale;            ///< t_int over the grey frames' time
  float variance_factor;          ///< variance of the half path is this times V/Â²: (2/N)·(R/2π)²
  std::int32_t count, pairs;      ///< raw frames of this modulation; pairs of them with τ half a turn apart
  const std::int32_t* raw_frame;  ///< [count]
  const std::int32_t* pair;       ///< [pairs][2]
  /// [wiggling_nodes][4] φ − φ̂ in turns at equidistant φ̂, and the step to the next node; S/Â and the step likewise. Aligned to 16 bytes.
  const float* wiggling;
};

struct DecodeRawFrame {
  float cosine, sine;  ///< (2/N)·cos τ, (2/N)·sin τ
};

struct DecoderView {
  std::int32_t modulations, reference;  ///< reference: the modulation with the fewest cycles
  std::int32_t grey_frames;
  const std::int32_t* grey_frame;        ///< [grey_frames] the unlit ones
  const DecodeRawFrame* frame;           ///< [raw frames]
  const DecodeModulation* modulation;    ///< [modulations]
  float common_range, per_common_range;  ///< R_0 [m], 1/R_0
  std::int32_t wiggling_nodes;
  float light[3], light_square;                     ///< mean position of the lights and mean |L|², weighted by their power
  float least_trust;                                ///< what is less likely on the right cycle is no depth; 0: all are
  float noise_floor;                                ///< 2σ_r² + s²/12 + what lines add [e²]
  float output_floor;                               ///< the same without 2σ_r²
  float suppression_threshold, suppression_budget;  ///< [e⁻] of a tap; threshold 0: no suppression
  float suppression_variance;                       ///< 2κ²: variance of A−B for each electron off both taps
  float dark_rate_both;                             ///< dark electrons per second, both taps together: noise only
  float grey_dark;                                  ///< dark electrons that a tap of an unlit raw frame holds when it is read, the mean
  float noise_threshold;                            ///< [m]; infinite where noise is off, or the filter comes first
  float filtered_noise_threshold;                   ///< [m] of the noise that the adaptive filter left; else infinite
  float amplitude_threshold;                        ///< [e⁻]
  float per_confidence_noise;                       ///< 1/0.07 m
  float asymmetry_square, asymmetry_factor;         ///< square of the limit on |D_k + D_k'| [e²], and of that over V̂: 2k²
  float multipath_limit, multipath_factor;          ///< [m], k²
  std::int32_t rejected;                            ///< flags that make a depth invalid though they are but warnings
  float flying_near_z, flying_near_limit, flying_far_z, flying_far_limit;
  float flying_factor;        ///< square of how many σ a flying pixel is off; 0 where noise is off
  std::int32_t flying_check;  ///< 0: none are looked for
  ReadCurveView read;         ///< as of the sensor
  const float* delay;         ///< [modulations][height][width] [s] as far as it is known, or null
  std::int32_t delay_stride;  ///< of these, as of the sensor's
  std::int32_t effects;       ///< 0: it knows of no suppression, curve or delays
  bool operator==(const DecoderView&) const = default;
};

}  // namespace tofray::camera
