// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <memory>
#include <vector>

#include "camera/frozen_camera.h"
#include "depth/decode.h"
#include "power/phasors.h"
#include "raw/expose.h"
#include "support/statistics.h"

/// One pixel on the bench: light goes in by hand, raw frames and depth come out. The plain float's kernels.
namespace tofray::test {

/// A camera without optics to speak of: half duty and its first harmonic alone, light at the pupil, no dark current,
/// no read noise, 16 bits of 1 e⁻, wells without a bottom.
/// @param amplitude  C: first harmonic of the correlation, for any modulation frequency
inline Camera bench_camera(const std::vector<double>& frequencies_hz = {60.24e6}, int phases = 4, double amplitude = 0.7,
                           bool grey = false) {
  Camera camera;
  camera.sensor = {1, 1, 10e-6, 1.0};
  camera.lens.fx_px = camera.lens.fy_px = 200;
  camera.lens.vignetting = Lens::Vignetting::off;
  Illumination light;
  light.power_w = 0.2;
  light.waveform.harmonics = 1;
  camera.illumination.push_back(light);
  camera.pixel.quantum_efficiency = {{850e-9}, {0.4}};
  camera.pixel.contrast = {{60e6}, {amplitude * pi * pi / 8}};  // half duty: a_1 = 8/π²·K
  camera.adc = {16, 1.0, 32768, 0, 65535};
  camera.mode.name = "bench", camera.mode.frame_rate_hz = 5;
  if (grey) camera.mode.sequence.push_back({false, 0, 0, 1e-3});
  for (const double f : frequencies_hz) {
    for (int k = 0; k < phases; ++k) camera.mode.sequence.push_back({true, f, two_pi * k / phases, 1e-3});
  }
  return camera;
}

/// What falls on the pixel in each raw frame of 1 ms.
struct Incoming {
  double signal_e = 0;     ///< S
  double half_path_m = 0;  ///< ℓ/2
  double ambient_e = 0;    ///< B
};

struct Measured {
  std::vector<flow::Taps<float>> taps;
  flow::Depth<float> depth{};
  [[nodiscard]] double difference(std::size_t k) const { return static_cast<double>(taps[k].difference); }
};

class Bench {
 public:
  explicit Bench(const Camera& camera, bool noise = false, std::uint64_t seed = 1)
      : camera_(std::make_unique<camera::FrozenCamera>(camera, noise, seed)), sensor_(camera_->sensor(0)) {}

  [[nodiscard]] const camera::SensorView& sensor() const { return sensor_; }
  [[nodiscard]] const camera::PhasorView& phasors() const { return camera_->phasors(); }
  /// Path i comes from light source i.
  [[nodiscard]] flow::Light<float> light_of(const std::vector<flow::Path<float>>& paths) const {
    flow::Light<float> light{};
    for (std::size_t l = 0; l < paths.size(); ++l) {
      power::add_path(phasors(), power::all_of(phasors()), static_cast<int>(l), paths[l], l == 0, light);
    }
    power::add_up(phasors(), power::all_of(phasors()), light);
    return light;
  }
  [[nodiscard]] const camera::DecoderView& decoder() const { return camera_->decoder(); }

  /// All raw frames of one pixel.
  /// @param saturated  whether a lit one clipped or left the valid codes, if asked for
  [[nodiscard]] std::vector<flow::Taps<float>> expose(const Incoming& in, int pixel = 0, std::uint64_t frame = 0,
                                                      bool* saturated = nullptr) const {
    flow::Light<float> light = light_of({{static_cast<float>(in.signal_e * 1e3), static_cast<float>(2 * in.half_path_m)}});
    light.ambient_rate = static_cast<float>(in.ambient_e * 1e3);
    const effect::FrameIndex index{static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(frame >> 32)};
    std::vector<float> line_normals(static_cast<std::size_t>(effect::LineNoise::line_draws(sensor_)));
    for (int i = 0; i < effect::LineNoise::line_draws(sensor_); ++i) effect::LineNoise::draw_line(sensor_, index, i, line_normals.data());
    effect::Exposure<float> exposure = raw::start<float>(sensor_, {pixel, 1}, line_normals.data());
    if (sensor_.delay != nullptr) power::delay_by(phasors(), power::all_of(phasors()), sensor_, {pixel, 1}, light);
    std::vector<flow::Taps<float>> taps;
    for (int k = 0; k < sensor_.raw_frames; ++k) taps.push_back(raw::expose(sensor_, k, light, phasors().orders, index, exposure));
    if (saturated != nullptr) *saturated = raw::saturated(sensor_, exposure);
    return taps;
  }

  [[nodiscard]] flow::Depth<float> decode(const std::vector<float>& difference, bool clipped = false, int pixel = 0) const {
    return depth::decode<float>(camera_->decoder(), difference.data(), clipped, false, flow::make_ray(0.0f, 0.0f, 1.0f), {pixel, 1});
  }

  [[nodiscard]] Measured measure(const Incoming& in, int pixel = 0, std::uint64_t frame = 0) const {
    Measured out;
    bool clipped = false;
    out.taps = expose(in, pixel, frame, &clipped);
    std::vector<float> difference;
    for (const auto& t : out.taps) difference.push_back(t.difference);
    out.depth = decode(difference, clipped, pixel);
    return out;
  }

  /// Phase φ̂ [turns] and amplitude Â of one modulation frequency, before any table.
  [[nodiscard]] depth::Estimate<float> estimate(const std::vector<flow::Taps<float>>& taps, int modulation = 0) const {
    float difference[flow::max_raw_frames] = {};
    for (std::size_t k = 0; k < taps.size(); ++k) difference[k] = taps[k].difference;
    return depth::estimate<float>(camera_->decoder(), camera_->decoder().modulation[modulation], difference);
  }

 private:
  std::unique_ptr<camera::FrozenCamera> camera_;
  camera::SensorView sensor_;
};

/// Whether one raw frame of this charge flags its pixel.
inline bool flags(const camera::SensorView& sensor, const camera::RawFrameView& frame, const effect::TapPair<float>& charge) {
  effect::Exposure<float> exposure{};
  raw::watch(sensor, frame, num::max(charge.a, charge.b), effect::read_out(sensor, charge, 0.0f), exposure);
  return raw::saturated(sensor, exposure);
}

/// The nearest of all angles that are whole turns apart: in [−½, ½) turns.
inline double wrapped(double turns) { return turns - std::floor(turns + 0.5); }

}  // namespace tofray::test
