// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Between keyframes: constant, linear, along the great circle of two rotations, or the cubic Hermite spline of glTF's appendix C.
#include "gltf/channels.h"

#include <algorithm>
#include <cmath>

#include "num/setup_math.h"

namespace tofray::gltf {
namespace {

/// A time between keyframes `before` and `before` + 1: a share in [0, 1) of their distance; 0 at the last one.
struct Between {
  std::size_t before = 0;
  double share = 0, distance_s = 0;
};

Between between(const std::vector<float>& times, double time_s) {
  const auto after = std::upper_bound(times.begin(), times.end(), time_s, [](double t, float key) { return t < static_cast<double>(key); });
  if (after == times.begin()) return {};
  const auto before = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end()) return {before, 0, 0};
  const double start = times[before], distance = static_cast<double>(*after) - start;
  return {before, (time_s - start) / distance, distance};
}

Quaternion quaternion(const float* at) { return normalized({at[0], at[1], at[2], at[3]}); }

/// The shorter way from a to b, both of unit length, at constant speed.
Quaternion slerp(const Quaternion& a, Quaternion b, double share) {
  const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  Quaternion difference{}, sum{}, out{};
  for (std::size_t i = 0; i < 4; ++i) {
    b[i] = dot < 0 ? -b[i] : b[i];
    difference[i] = a[i] - b[i], sum[i] = a[i] + b[i];
  }
  const double angle = 2 * num::setup::atan2(length(difference), length(sum));  // 0 … π/2
  constexpr double tiny = 1e-6;                                                 // chord and arc differ by angle² / 24
  const double first = angle < tiny ? 1 - share : num::setup::sin((1 - share) * angle),
               second = angle < tiny ? share : num::setup::sin(share * angle);
  for (std::size_t i = 0; i < 4; ++i) out[i] = first * a[i] + second * b[i];
  return normalized(out);
}

void cubic(const Channel& channel, const Between& at, std::span<double> values) {
  const std::size_t width = channel.width;
  const float* here = channel.values->data() + at.before * 3 * width;  // in-tangent, value, out-tangent
  const float* next = at.distance_s > 0 ? here + 3 * width : here;
  const double t = at.share, d = at.distance_s;
  for (std::size_t i = 0; i < width; ++i)
    values[i] = (2 * t * t * t - 3 * t * t + 1) * here[width + i] + d * (t * t * t - 2 * t * t + t) * here[2 * width + i] +
                (-2 * t * t * t + 3 * t * t) * next[width + i] + d * (t * t * t - t * t) * next[i];
}

/// To unit length; where the spline passes through zero, or out of measure, the rotation of the keyframe before.
void make_rotation(const Channel& channel, const Between& at, std::span<double> values) {
  const Quaternion spline{values[0], values[1], values[2], values[3]};
  const double size = length(spline);
  const Quaternion out =
      size > 1e-9 && std::isfinite(size) ? normalized(spline) : quaternion(channel.values->data() + (at.before * 3 + 1) * 4);
  std::copy(out.begin(), out.end(), values.begin());
}

}  // namespace

void evaluate(const Channel& channel, double time_s, std::span<double> values) {
  const Between at = between(*channel.times_s, time_s);
  const bool rotation = channel.path == Channel::Path::rotation;
  if (channel.interpolation == Channel::Interpolation::cubic_spline) {
    cubic(channel, at, values);
    if (rotation) make_rotation(channel, at, values);
    return;
  }
  const bool constant = channel.interpolation == Channel::Interpolation::step || at.share == 0;
  const float* here = channel.values->data() + at.before * channel.width;
  const float* next = constant ? here : here + channel.width;
  if (rotation) {
    const Quaternion out = slerp(quaternion(here), quaternion(next), constant ? 0 : at.share);
    std::copy(out.begin(), out.end(), values.begin());
    return;
  }
  for (std::size_t i = 0; i < channel.width; ++i) {
    const double a = here[i], b = next[i];
    values[i] = constant ? a : (1 - at.share) * a + at.share * b;
  }
}

}  // namespace tofray::gltf
