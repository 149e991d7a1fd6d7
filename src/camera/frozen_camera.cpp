// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/frozen_camera.h"

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "base/curve.h"
#include "base/faults.h"
#include "base/limits.h"
#include "base/readout.h"
#include "camera/emitters.h"
#include "camera/image_camera.h"
#include "camera/other_camera.h"
#include "camera/subpixel.h"
#include "camera/waveform.h"
#include "num/philox.h"
#include "num/setup_math.h"

namespace tofray::camera {

using namespace base;
namespace setup = num::setup;
using num::single;

static_assert(flow::max_lights == limit::lights.value);

FrozenCamera::FrozenCamera(const Camera& camera, bool noise, std::uint64_t seed, int subpixel, int threads)
    : sensor_pixels_(camera.sensor),
      one_pixel_(camera.pixel),
      readout_(camera.readout),
      camera_(with_emitters(ImageCamera(camera))),
      modulations_(modulations_of(camera.mode)),
      scatter_(camera_.lens.scatter, camera_.sensor, camera_.pixel) {
  if (camera.mode.sequence.size() > flow::max_raw_frames) throw Error(ErrorKind::limit, "error: more than 64 raw frames in one sequence");
  freeze_lens(subpixel, threads);
  const ClampedCurve efficiency(camera.pixel.quantum_efficiency, "quantum_efficiency");
  for (const Illumination& light : camera_.illumination) {
    lights_.push_back(freeze_light(light, efficiency.evaluate(light.illumination_wavelength_m)));
    if (camera.power_model == PowerModel::paper_literal && lights_.back().table.empty()) {
      refuse(
          "power_model paper_literal needs light sources with a table\n"
          "  got a cone or lobe; take the pattern flat_top or table, or the power_model tofray");
    }
  }
  for (const FrozenLight& light : lights_) light_views_.push_back(light.view);
  freeze_phasors();
  freeze_sequence(seed, noise);
  freeze_read_curve();
  sensor_.effects = effect::any_of(effect::Effects{}, sensor_);
  freeze_patterns();
  const bool quarters =
      std::none_of(raw_frames_.begin(), raw_frames_.end(), [](const RawFrameView& k) { return k.lit != 0 && k.gate_kind == Gate::other; });
  phasors_.sums_alone =
      quarters && lights_.size() == 1 && camera_.spread_spectrum.width == 0 && sensor_.drifts == 0 && sensor_.delay == nullptr;
  freeze_decoder(noise);
}

void FrozenCamera::freeze_lens(int subpixel, int threads) {
  const Sensor& sensor = camera_.sensor;
  middle_ = FrozenLens::shared({camera_.lens, sensor.width, sensor.height, {0, 0}, 1}, threads);
  subpixel_.count = 1;
  if (subpixel > 1) {
    for (const SubpixelSample& sample : subpixel_samples(sensor, subpixel)) {
      samples_.push_back(
          FrozenLens::shared({camera_.lens, sensor.width, sensor.height, sample.offset_px, 1.0 / (subpixel * subpixel)}, threads));
      sample_views_.push_back(samples_.back()->view());
      shares_.push_back(single(sample.share));
    }
    subpixel_ = {static_cast<std::int32_t>(samples_.size()), sample_views_.data(), shares_.data()};
  }
  const double area = sensor.pixel_pitch_m * sensor.pixel_pitch_m * sensor.fill_factor;
  const double number = camera_.lens.f_number;
  power_.watts_per_radiance = single(pi * camera_.lens.transmission * area / (4 * number * number));  // [theory: eq. 2.5, 2.6]
  power_.paper_literal = camera_.power_model == PowerModel::paper_literal;
  const double focal_mm = 1e3 * camera_.lens.fx_px * sensor.pixel_pitch_m;
  power_.paper_scale = single(pi * area / (4 * number * number * focal_mm * focal_mm));  // [theory: eq. 2.11]
}

/// Reference phase of a modulation frequency's first raw frame.
double FrozenCamera::first_phase(std::size_t modulation) const {
  const auto at = std::find(modulations_.of_raw_frame.begin(), modulations_.of_raw_frame.end(), static_cast<int>(modulation));
  return reference_phase_of(camera_.mode.sequence[static_cast<std::size_t>(at - modulations_.of_raw_frame.begin())]);
}

/// Of the light, over the band that is swept.                                                              [theory: eq. 3.31]
double FrozenCamera::mean_frequency(std::size_t modulation) const {
  const SpreadSpectrum& spread = camera_.spread_spectrum;
  const double frequency = modulations_.frequency_hz[modulation];
  return spread.kind == SpreadSpectrum::Kind::down ? frequency * (1 - 0.5 * spread.width) : frequency;
}

void FrozenCamera::freeze_phasors() {
  const std::size_t lights = lights_.size(), modulations = modulations_.frequency_hz.size();
  std::vector<std::vector<Harmonic>> harmonics;  // [modulation][light]
  std::size_t most = 0;
  for (const double frequency : modulations_.frequency_hz) {
    for (const Illumination& light : camera_.illumination) {
      harmonics.push_back(correlation_harmonics(light, camera_.pixel, frequency));
      most = std::max(most, harmonics.back().size());
    }
  }
  if (most > flow::max_harmonics) throw Error(ErrorKind::limit, "error: more than 8 harmonics in a waveform");
  const std::size_t orders = most <= 4 ? 4 : flow::max_harmonics;
  sources_.assign(modulations * lights * orders * 2, 0.0f);
  for (std::size_t i = 0; i < modulations * lights; ++i) {
    for (const Harmonic& h : harmonics[i]) {
      float* const source = &sources_[2 * (i * orders + static_cast<std::size_t>(h.order / 2))];
      const double phase = h.phase_rad + h.order * first_phase(i / lights);
      source[0] = single(h.amplitude * setup::cos(phase)), source[1] = single(h.amplitude * setup::sin(phase));
    }
  }
  for (std::size_t i = 0; i < modulations; ++i) {
    ModulationView m{};
    const double frequency = mean_frequency(i), per_speed = camera_.refractive_index / speed_of_light;
    m.frequency = single(frequency);
    m.swept_turns_per_metre = single(0.5 * camera_.spread_spectrum.width * modulations_.frequency_hz[i] * per_speed);
    const double turns_per_metre = frequency * per_speed;
    m.turns_per_metre_high = single(turns_per_metre);
    m.turns_per_metre_low = single(turns_per_metre - static_cast<double>(m.turns_per_metre_high));
    m.source = sources_.data() + i * lights * orders * 2;
    phasor_modulations_.push_back(m);
  }
  phasors_ = {static_cast<std::int32_t>(modulations), static_cast<std::int32_t>(orders), phasor_modulations_.data(), 0};
}

namespace {

num::RoundKeys keys_of(std::uint64_t seed) {
  return num::round_keys(static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32));
}

}  // namespace

void FrozenCamera::freeze_sequence(std::uint64_t seed, bool noise) {
  SensorView& s = sensor_;
  s.raw_frames = static_cast<std::int32_t>(camera_.mode.sequence.size());
  effect::set(camera_, s);
  s.noise = !noise ? Noise::off : effect::ReadNoise::of(camera_) < effect::least_merged_read_noise ? Noise::apart : Noise::merged;
  s.keys = keys_ = keys_of(seed);
  const std::size_t values = 2 * static_cast<std::size_t>(phasors_.orders);
  const bool another = camera_.interference.share > 0;
  gates_.resize(camera_.mode.sequence.size() * values);
  if (another) other_gates_.resize(gates_.size());
  std::vector<double> integration_time_s;
  for (std::size_t k = 0; k < camera_.mode.sequence.size(); ++k) {
    const RawFrame& frame = camera_.mode.sequence[k];
    raw_frames_.push_back({frame.lit, std::max(modulations_.of_raw_frame[k], 0), single(frame.integration_time_s),
                           single(dark_current() * frame.integration_time_s), Gate::other, gates_.data() + k * values,
                           another ? other_gates_.data() + k * values : nullptr, 0.0f});
    integration_time_s.push_back(frame.integration_time_s);
  }
  s.frame = raw_frames_.data();
  s.drifts = camera_.temperature.warm_up_m != 0 || another || camera_.auto_exposure.speed > 0;
  start_ = base::raw_frame_starts_s(integration_time_s, camera_.readout_time_s);
  freeze_gates(drift_m(0));
}

void FrozenCamera::set_integration_times(const std::vector<double>& seconds) {
  double grey_time = 0;
  for (std::size_t k = 0; k < seconds.size(); ++k) {
    camera_.mode.sequence[k].integration_time_s = seconds[k];
    raw_frames_[k].integration_time = single(seconds[k]), raw_frames_[k].dark = single(dark_current() * seconds[k]);
    if (raw_frames_[k].lit == 0) grey_time += seconds[k];
  }
  start_ = base::raw_frame_starts_s(seconds, camera_.readout_time_s);
  for (std::size_t i = 0; i < grouped_.size(); ++i) {
    const double exposed = seconds[static_cast<std::size_t>(grouped_[i].front())];
    decode_modulations_[i].integration_time = single(exposed);
    decode_modulations_[i].ambient_scale = single(grey_time > 0 ? exposed / grey_time : 0);
  }
}

namespace {

Gate gate_at(double phase) {
  const double quarters = phase / (pi / 2), whole = std::rint(quarters);
  if (std::abs(quarters - whole) > 1e-9) return Gate::other;
  return static_cast<Gate>(static_cast<int>(whole - 4 * std::floor(whole / 4)));
}

}  // namespace

/// τ − τ_0 + δ, where δ = 2π·f·n/c·2·(half path by which the sensor has drifted).
double FrozenCamera::gate_phase(std::size_t raw_frame) const {
  const auto modulation = static_cast<std::size_t>(raw_frames_[raw_frame].modulation);
  const double drift = 4 * pi * drifted_m_ * mean_frequency(modulation) * camera_.refractive_index / speed_of_light;
  return reference_phase_of(camera_.mode.sequence[raw_frame]) - first_phase(modulation) + drift;
}

/// cos and sin of m times that.
void FrozenCamera::freeze_gates(double half_path_m) {
  drifted_m_ = half_path_m;
  std::size_t at = 0;
  for (std::size_t k = 0; k < raw_frames_.size(); ++k, at += 2 * static_cast<std::size_t>(phasors_.orders)) {
    if (raw_frames_[k].lit == 0) continue;
    const double phase = gate_phase(k);
    raw_frames_[k].gate_kind = gate_at(phase);
    for (int h = 0; h < phasors_.orders; ++h) {
      float* const gate = &gates_[at + 2 * static_cast<std::size_t>(h)];
      gate[0] = single(setup::cos((2 * h + 1) * phase)), gate[1] = single(setup::sin((2 * h + 1) * phase));
    }
  }
}

/// What another camera's light does in each raw frame of a frame.                                           [theory: eq. 3.24]
void FrozenCamera::freeze_other_camera(double time_s, std::uint64_t index) {
  const Interference& other = camera_.interference;
  for (std::size_t k = 0; k < raw_frames_.size(); ++k) {
    const double exposure = camera_.mode.sequence[k].integration_time_s;
    const auto words = num::philox<float>(0, static_cast<std::uint32_t>(k) | (static_cast<std::uint32_t>(effect::other_camera) << 16),
                                          static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), sensor_.keys);
    const OtherLight light = other_light(other, time_s + start_[k] + 0.5 * exposure, sensor_.noise == Noise::off ? nullptr : &words);
    raw_frames_[k].other_light = single(light.share);
    if (raw_frames_[k].lit == 0) continue;
    float* const gate = &other_gates_[k * 2 * static_cast<std::size_t>(phasors_.orders)];
    write_other_gate(light, other.frequency_difference_hz * exposure, gate_phase(k), phasors_.orders, gate);
  }
}

double FrozenCamera::dark_current() const {
  return effect::DarkCurrent::rate(camera_, [](double x) { return setup::exp(x); });
}

void FrozenCamera::freeze_read_curve() {
  const Curve& curve = camera_.pixel.nonlinearity;
  if (curve.x.empty()) return;
  const ClampedCurve read(curve, "nonlinearity");
  read_.resize(2 * read_cells);
  const double ends = std::min(curve.x.back(), camera_.pixel.full_well_e);
  effect::Nonlinearity::tabulate([&](double charge) { return read.evaluate(charge); }, ends, read_cells, read_.data(), sensor_);
}

double FrozenCamera::drift_m(double time_s) const {
  const Temperature& t = camera_.temperature;
  const double warm = t.warm_up_m == 0 ? 0 : t.warm_up_m * (1 - setup::exp(-(t.since_start_s + time_s) / t.warm_up_time_s));
  return t.drift_m_per_kelvin * (t.celsius - t.reference_celsius) + warm;
}

const SensorView& FrozenCamera::sensor(double time_s, std::uint64_t index, std::optional<std::uint64_t> seed) {
  const double drift = drift_m(time_s);
  if (drift != drifted_m_) freeze_gates(drift);
  sensor_.keys = seed ? keys_of(*seed) : keys_;
  if (!other_gates_.empty()) freeze_other_camera(time_s, index);
  return sensor_;
}

}  // namespace tofray::camera
