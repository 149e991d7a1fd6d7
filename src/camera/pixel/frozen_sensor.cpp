// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/pixel/frozen_sensor.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/curve.h"
#include "base/readout.h"
#include "camera/pixel/other_camera.h"
#include "camera/pixel/spread_spectrum.h"
#include "camera/pixel/temperature_drift.h"
#include "num/philox.h"
#include "num/setup_math.h"

namespace tofray::camera {

using namespace base;
namespace setup = num::setup;
using num::single;

namespace {

num::RoundKeys keys_of(std::uint64_t seed) {
  return num::round_keys(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32));
}

Gate gate_at(double phase) {
  const double quarters = phase / (pi / 2), whole = std::rint(quarters);
  if (std::abs(quarters - whole) > 1e-9) return Gate::other;
  return static_cast<Gate>(static_cast<int>(whole - 4 * std::floor(whole / 4)));
}

}  // namespace

double dark_current(const Camera& camera) {
  return effect::DarkCurrent::rate(camera, [](double x) { return setup::exp(x); });
}

FrozenSensor::FrozenSensor(const Camera& profile, const ImageCamera& camera, const Modulations& modulations, int orders, std::uint64_t seed,
                           bool noise)
    : camera_(camera), modulations_(modulations), orders_(orders), patterns_(profile, camera, modulations) {
  SensorView& s = view_;
  s.raw_frames = static_cast<std::int32_t>(camera_.mode.sequence.size());
  effect::set(camera_, s);
  s.noise = !noise ? Noise::off : effect::ReadNoise::of(camera_) < effect::least_merged_read_noise ? Noise::apart : Noise::merged;
  s.keys = keys_ = keys_of(seed);
  freeze_raw_frames();
  freeze_read_curve();
  s.effects = effect::any_of(effect::Effects{}, s);
  patterns_.set(s);
}

void FrozenSensor::freeze_raw_frames() {
  const std::size_t values = 2 * static_cast<std::size_t>(orders_), count = camera_.mode.sequence.size();
  const bool another = camera_.interference.share > 0;
  gates_.resize(count * values);
  if (another) other_gates_.resize(gates_.size());
  for (std::size_t k = 0; k < count; ++k) {
    raw_frames_.push_back({camera_.mode.sequence[k].lit, std::max(modulations_.of_raw_frame[k], 0), 0.0f, 0.0f, Gate::other,
                           gates_.data() + k * values, another ? other_gates_.data() + k * values : nullptr, 0.0f});
  }
  take_integration_times();
  view_.frame = raw_frames_.data();
  view_.drifts = camera_.temperature.warm_up_m != 0 || another || camera_.auto_exposure.speed > 0;
  freeze_gates(drift_m(camera_.temperature, 0));
}

void FrozenSensor::take_integration_times() {
  std::vector<double> seconds;
  const double dark = dark_current(camera_);
  for (std::size_t k = 0; k < raw_frames_.size(); ++k) {
    seconds.push_back(camera_.mode.sequence[k].integration_time_s);
    raw_frames_[k].integration_time = single(seconds[k]), raw_frames_[k].dark = single(dark * seconds[k]);
  }
  start_ = base::raw_frame_starts_s(seconds, camera_.readout_time_s);
}

bool FrozenSensor::at_quarter_turns() const {
  return std::none_of(raw_frames_.begin(), raw_frames_.end(),
                      [](const RawFrameView& k) { return k.lit != 0 && k.gate_kind == Gate::other; });
}

/// τ − τ_0 + δ, where δ = 2π·f·n/c·2·(half path by which the sensor has drifted).
double FrozenSensor::gate_phase(std::size_t raw_frame) const {
  const auto modulation = static_cast<std::size_t>(raw_frames_[raw_frame].modulation);
  const double frequency = mean_frequency(camera_.spread_spectrum, modulations_.frequency_hz[modulation]);
  const double drift = 4 * pi * drifted_m_ * frequency * camera_.refractive_index / speed_of_light;
  return reference_phase_of(camera_.mode.sequence[raw_frame]) - first_phase(camera_.mode, modulations_, modulation) + drift;
}

/// cos and sin of m times the gates' phases.
void FrozenSensor::freeze_gates(double half_path_m) {
  drifted_m_ = half_path_m;
  std::size_t at = 0;
  for (std::size_t k = 0; k < raw_frames_.size(); ++k, at += 2 * static_cast<std::size_t>(orders_)) {
    if (raw_frames_[k].lit == 0) continue;
    const double phase = gate_phase(k);
    raw_frames_[k].gate_kind = gate_at(phase);
    for (int h = 0; h < orders_; ++h) {
      float* const gate = &gates_[at + 2 * static_cast<std::size_t>(h)];
      gate[0] = single(setup::cos((2 * h + 1) * phase)), gate[1] = single(setup::sin((2 * h + 1) * phase));
    }
  }
}

/// What another camera's light does in each raw frame of a frame.                                       [theory: interference]
void FrozenSensor::freeze_other_camera(double time_s, std::uint64_t index) {
  const Interference& other = camera_.interference;
  for (std::size_t k = 0; k < raw_frames_.size(); ++k) {
    const double exposure = camera_.mode.sequence[k].integration_time_s;
    const auto words = num::philox<float>(0, static_cast<std::uint32_t>(k) | (static_cast<std::uint32_t>(effect::other_camera) << 16),
                                          static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), view_.keys);
    const OtherLight light = other_light(other, time_s + start_[k] + 0.5 * exposure, view_.noise == Noise::off ? nullptr : &words);
    raw_frames_[k].other_light = single(light.share);
    if (raw_frames_[k].lit == 0) continue;
    float* const gate = &other_gates_[k * 2 * static_cast<std::size_t>(orders_)];
    write_other_gate(light, other.frequency_difference_hz * exposure, gate_phase(k), orders_, gate);
  }
}

void FrozenSensor::freeze_read_curve() {
  const Curve& curve = camera_.pixel.nonlinearity;
  if (curve.x.empty()) return;
  const ClampedCurve read(curve, "nonlinearity");
  read_.resize(2 * read_cells);
  const double ends = std::min(curve.x.back(), camera_.pixel.full_well_e);
  effect::Nonlinearity::tabulate([&](double charge) { return read.evaluate(charge); }, ends, read_cells, read_.data(), view_);
}

const SensorView& FrozenSensor::at(double time_s, std::uint64_t index, std::optional<std::uint64_t> seed) {
  const double drift = drift_m(camera_.temperature, time_s);
  if (drift != drifted_m_) freeze_gates(drift);
  view_.keys = seed ? keys_of(*seed) : keys_;
  if (!other_gates_.empty()) freeze_other_camera(time_s, index);
  return view_;
}

}  // namespace tofray::camera
