// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

#include "effect/list.h"
#include "flow/flow.h"

/// The camera, frozen for rendering: plain numbers in single precision that kernels read. Built by FrozenCamera.
namespace tofray::camera {

// The sensor's part: what its effects read.
using effect::Gate;
using effect::Noise;
using effect::RawFrameView;
using effect::ReadCurveView;
using effect::SensorView;

/// The lens, for what moves to where no pixel looks: from directions to pixels.
struct ProjectionView {
  float fx, fy;  ///< [px]
  float k1, k2, p1, p2, k3;
  float limit;           ///< r² (undistorted) up to which the radial part grows
  float k4, k5, k6;      ///< 0 where the radial part is a polynomial
  std::int32_t fisheye;  ///< 1: k1 to k4 over the angle to the axis, p1 and p2 are 0
  bool operator==(const ProjectionView&) const = default;
};

/// Rays and lens by pixel.
struct LensView {
  std::int32_t width, height;
  float pixel_area;  ///< that a pixel sees of a plane 1 m before the camera, on the axis [m²]
  ProjectionView projection;
  const float *ray_x, *ray_y;   ///< [height][width] undistorted: d = (x, y, 1)
  const float* inverse_length;  ///< [height][width] 1/|d|
  const float* vignetting;      ///< [height][width] cos⁴α or a table's factor; 0 outside the lens model
  const flow::Bounds* tile;     ///< what each tile of pixels sees
  bool operator==(const LensView&) const = default;
};

/// Places within a pixel at which it sees the scene, one lens for each, and how much of the pixel's light each brings.
struct SubpixelView {
  std::int32_t count;    ///< 1 at least
  const LensView* lens;  ///< [count]; null: the pixel's middle alone sees the scene
  const float* share;    ///< [count] their sum is 1
  bool operator==(const SubpixelView&) const = default;
};

/// A part of the light that the lens scatters or neighbours collect, as a kernel over the sensor: K(dx, dy), zero beyond ±radius.
struct ScatterTerm {
  static constexpr int pad = 32;  ///< zeros before and behind each row of weights
  std::int32_t radius;
  const float* weights;  ///< [dy][dx] rows of pad + 2·radius + 1 + pad; of a separable kernel one: K = weights(dx)·column(dy)
  const float* column;   ///< [2·radius + 1]
};

/// Light that lens and filter scatter over the sensor, kept·δ + Σ_terms K, and after it charge that neighbours collect. [theory: eq. 3.27, 7.4]
struct ScatterView {
  float kept;  ///< 1 − share of the lens's scatter
  std::int32_t terms;
  std::int32_t separable;  ///< all of them are, but for the last one if it is what neighbours collect, which always is
  std::int32_t shares;     ///< 1: the last one is; it takes what those before have brought
  const ScatterTerm* term;
  [[nodiscard]] TOFRAY_FN bool is_sharing(int item) const { return shares != 0 && item + 1 == terms; }
  [[nodiscard]] TOFRAY_FN bool has_rows(int item) const { return separable != 0 || is_sharing(item); }
  bool operator==(const ScatterView&) const = default;
};

/// How one light spreads its power over directions: I(θx, θy) [W/sr].
struct PatternView {
  enum Kind : std::int32_t { cone, cosine_lobe, flat_top, table };
  Kind kind;
  float peak;                             ///< [W/sr] cone: inside; lobe and flat top: on the axis
  float cos_half_angle;                   ///< cone
  float exponent;                         ///< lobe
  float per_half_width, per_half_height;  ///< flat top: 1/(half width at half peak) [1/rad]
  const float* samples;                   ///< table [rows][columns], W/sr
  std::int32_t columns, rows;
  float per_rad_x, per_rad_y;        ///< cells per radian
  float half_range_x, half_range_y;  ///< [rad]
};

/// One light source in the camera frame.
struct LightView {
  float position[3];
  float rotation[3][3];  ///< rows: the source's own axes
  std::int32_t turned;   ///< 0: its axis is the camera's, rotation is the identity
  PatternView pattern;
  float electrons_per_joule;  ///< λ·QE/(hc)
};

/// From where ambient light comes.
enum class AmbientLight : std::int32_t { none, uniform, directional };

/// Watts on the pixel for a radiance of 1: π·T·pitch²·fill_factor/(4N²), without vignetting.
struct PowerView {
  float watts_per_radiance;
  float ambient_rate;      ///< electrons per second from a surface with ρ = 1, without vignetting
  float sun_direction[3];  ///< unit vector toward it at the time of the truth
  AmbientLight ambient;
  std::int32_t paper_literal;  ///< 1: the paper's printed formula (power/paper_literal.h)
  float paper_scale;           ///< its constant factor
  bool operator==(const PowerView&) const = default;
};

/// One modulation frequency: how the light of a path becomes phasors.
struct ModulationView {
  float turns_per_metre_high, turns_per_metre_low;  ///< f·n/c in two parts
  float frequency;                                  ///< [Hz], for delays by pixel
  float swept_turns_per_metre;  ///< half the swept band's width·n/c; 0: nothing is swept                        [theory: eq. 3.30]
  const float* source;          ///< [light][orders][2] a_m·e^{i(ψ_m + mτ_0)} of each light, τ_0 the modulation's first reference phase
};

/// All of them. `orders` of 1, 3, 5 … are kept, 4 or 8; those that a camera does not have are zero.
struct PhasorView {
  std::int32_t modulations, orders;
  const ModulationView* modulation;
  std::int32_t sums_alone;  ///< 1: there is one light, all gates stay at quarter turns and no pixel is late: no order is needed by itself
  bool operator==(const PhasorView&) const = default;
};

/// One modulation frequency as the decoder sees it.
struct DecodeModulation {
  float half_wave;      ///< R = c/(2f) [m], unambiguous half path
  float per_half_wave;  ///< 1/R
  float cycles;         ///< M: periods in the common range
  float frequency;      ///< [Hz]
  float per_contrast;   ///< 1/C, C the first harmonic's amplitude
  float integration_time;
  float ambient_scale;            ///< t_int over the grey frames' time
  float variance_factor;          ///< variance of the half path is this times V/Â²: (2/N)·(R/2π)²
  std::int32_t count, pairs;      ///< raw frames of this modulation; pairs of them with τ half a turn apart
  const std::int32_t* raw_frame;  ///< [count]
  const std::int32_t* pair;       ///< [pairs][2]
  const float* light;             ///< [wiggling_nodes][2] S/Â at equidistant φ̂, and the step to the next node; null: 1/C throughout
  const float* wiggling;          ///< [wiggling_nodes][2] φ − φ̂ in turns at equidistant φ̂, and the step to the next node
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
