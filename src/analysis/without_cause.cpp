// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/without_cause.h"

#include <algorithm>
#include <array>
#include <utility>

#include "scene/motion.h"

namespace tofray::analysis {

namespace {

using Off = bool (*)(FrameInputs&, double time_s);

bool noise_off(FrameInputs& in, double /*time_s*/) { return std::exchange(in.options.noise, Noise::off) != Noise::off; }

bool multipath_off(FrameInputs& in, double /*time_s*/) { return std::exchange(in.scene.transport.bounces, 0) > 0; }

bool wiggling_off(FrameInputs& in, double /*time_s*/) {
  bool any = false;
  for (Illumination& light : in.camera.illumination) {
    any = any || (light.waveform.kind != Waveform::Kind::sine && light.waveform.harmonics > 1);
    light.waveform.harmonics = 1;
  }
  return any;
}

bool mixed_pixel_off(FrameInputs& in, double /*time_s*/) { return std::exchange(in.options.subpixel, 1) > 1; }

/// Keyframes so far apart that next to nothing moves within a frame, with the same pose at the time of the truth.
template <class Key>
void spread(std::vector<Key>& keyframes, double time_s) {
  constexpr double slower = 1e4;
  for (Key& one : keyframes) one.time_s = time_s + slower * (one.time_s - time_s);
}

/// How it is turned at a time.
Rotation turned(const Object& object, double time_s) {
  const shape::Mat turn = scene::product(scene::motion_at(object, {0, 0, 0}, time_s).turn, scene::rotation_matrix(object.rotation));
  std::array<double, 16> matrix{};
  matrix[15] = 1;
  for (std::size_t i = 0; i < 3; ++i) matrix[4 * i] = turn.row[i].x, matrix[4 * i + 1] = turn.row[i].y, matrix[4 * i + 2] = turn.row[i].z;
  Rotation out;
  out.quaternion = pose_from_matrix(matrix).quaternion;
  return out;
}

bool motion_off(FrameInputs& in, double time_s) {
  bool any = in.scene.camera.keyframes.size() > 1;
  spread(in.scene.camera.keyframes, time_s);
  for (Object& object : in.scene.objects) {
    if (!scene::moves(object)) continue;
    any = true;
    if (!object.keyframes.empty()) {
      spread(object.keyframes, time_s);
      continue;
    }
    object.rotation = turned(object, time_s);
    for (std::size_t i = 0; i < 3; ++i) object.position[i] += object.velocity_m_per_s[i] * time_s;
    object.velocity_m_per_s = object.angular_velocity_rad_per_s = {0, 0, 0};
  }
  return any;
}

bool scatter_off(FrameInputs& in, double /*time_s*/) {
  const bool any = in.camera.lens.scatter != Scatter();
  in.camera.lens.scatter = {};
  return any;
}

bool crosstalk_off(FrameInputs& in, double /*time_s*/) {
  Pixel& pixel = in.camera.pixel;
  const bool any = pixel.crosstalk_left_right > 0 || pixel.crosstalk_up_down > 0;
  pixel.crosstalk_left_right = pixel.crosstalk_up_down = 0;
  return any;
}

bool filter_off(FrameInputs& in, double /*time_s*/) {
  Decoding& decoding = in.camera.decoding;
  const bool any = decoding.temporal_frames > 1 || decoding.filter.kind != ImageFilter::Kind::none;
  decoding.temporal_frames = 1, decoding.filter = {};
  return any;
}

bool interference_off(FrameInputs& in, double /*time_s*/) { return std::exchange(in.camera.interference.share, 0.0) > 0; }

bool drift_off(FrameInputs& in, double /*time_s*/) {
  Temperature& of = in.camera.temperature;
  const bool any = (of.drift_m_per_kelvin != 0 && of.celsius != of.reference_celsius) || of.warm_up_m != 0;
  of.drift_m_per_kelvin = of.warm_up_m = 0;
  return any;
}

struct Switch {
  std::string_view cause;
  Off off;
};
constexpr Switch switches[] = {{"noise", noise_off},
                               {"multipath", multipath_off},
                               {"wiggling", wiggling_off},
                               {"mixed_pixel", mixed_pixel_off},
                               {"motion", motion_off},
                               {"scatter", scatter_off},
                               {"crosstalk", crosstalk_off},
                               {"filter", filter_off},
                               {"interference", interference_off},
                               {"drift", drift_off}};

}  // namespace

const std::vector<std::string_view>& causes_of_inputs() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> out;
    for (const Switch& found : switches) out.push_back(found.cause);
    return out;
  }();
  return names;
}

std::optional<FrameInputs> without(std::string_view cause, const FrameInputs& in, double time_s) {
  const auto* found = std::find_if(std::begin(switches), std::end(switches), [&](const Switch& one) { return one.cause == cause; });
  FrameInputs out = in;
  if (found == std::end(switches) || !found->off(out, time_s)) return {};
  return out;
}

}  // namespace tofray::analysis
