// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

/// The camera's illumination, frozen for rendering, and how much of what comes back meets a pixel.
namespace tofray::camera {

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

}  // namespace tofray::camera
