// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "camera/decoder/frozen_decoder.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "base/calibration.h"
#include "base/constants.h"
#include "base/faults.h"
#include "base/text.h"
#include "base/vec.h"
#include "camera/decoder/wiggling.h"
#include "camera/pixel/frozen_sensor.h"
#include "num/setup_math.h"
#include "tofray/flags.h"

namespace tofray::camera {

using namespace base;
namespace setup = num::setup;
using num::single;

namespace {

constexpr int wiggling_nodes = 1024;
constexpr double least_contrast = 1e-6;  // of a light with which a distance could still be measured

/// Reference phases and raw frames of one modulation frequency.
struct Group {
  std::vector<std::int32_t> raw_frame;
  std::vector<double> tau;
  double integration_time = 0;
};

Group group_of(const Mode& mode, const Modulations& modulations, int modulation) {
  Group g;
  double sums[4] = {0, 0, 0, 0};
  for (std::size_t k = 0; k < mode.sequence.size(); ++k) {
    if (modulations.of_raw_frame[k] != modulation) continue;
    const RawFrame& frame = mode.sequence[k];
    if (!g.tau.empty() && frame.integration_time_s != g.integration_time) {
      refuse("raw frames of one modulation frequency have different integration times; depth needs them equal");
    }
    g.integration_time = frame.integration_time_s;
    g.raw_frame.push_back(static_cast<std::int32_t>(k));
    const double tau = reference_phase_of(frame);
    g.tau.push_back(tau);
    for (int h = 0; h < 2; ++h) {
      sums[2 * h] += setup::cos((h + 1) * tau), sums[2 * h + 1] += setup::sin((h + 1) * tau);
    }
  }
  // Σ e^{iτ} = Σ e^{2iτ} = 0 is what (2/N)Σ D e^{−iτ} needs to see neither a constant nor the mirror image.
  const double most = std::max({std::abs(sums[0]), std::abs(sums[1]), std::abs(sums[2]), std::abs(sums[3])});
  if (g.tau.size() < 3 || most > 1e-6 * static_cast<double>(g.tau.size())) {
    refuse("each modulation frequency needs at least three equally spaced reference phases, such as 0, 90, 180 and 270 deg");
  }
  return g;
}

/// Raw frames two and two, where their reference phases are half a turn apart.
std::vector<std::int32_t> pairs_of(const Group& g) {
  std::vector<std::int32_t> out;
  for (std::size_t j = 0; j < g.tau.size(); ++j) {
    for (std::size_t i = j + 1; i < g.tau.size(); ++i) {
      if (std::abs(setup::cos(g.tau[i] - g.tau[j]) + 1) > 1e-9 || out.size() == flow::max_raw_frames) continue;
      out.insert(out.end(), {g.raw_frame[j], g.raw_frame[i]});
    }
  }
  return out;
}

/// A light source as the decoder counts it: by its share of the electrons that all of them make of one and the same surface.
struct Share {
  const Illumination* light;
  double weight;
};

/// Shares of all lights, equal ones where none has any power.
std::vector<Share> shares_of(const std::vector<Illumination>& lights, const std::vector<LightView>& frozen) {
  std::vector<Share> shares;
  double sum = 0;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    shares.push_back({&lights[l], lights[l].power_w * static_cast<double>(frozen[l].electrons_per_joule)});
    sum += shares.back().weight;
  }
  for (Share& share : shares) share.weight = sum > 0 ? share.weight / sum : 1 / static_cast<double>(shares.size());
  return shares;
}

/// Harmonics of light that comes from all sources by their shares: Σ_l w_l·a_m,l·e^{iψ_m,l}.           [theory: several-lights]
/// Where there is no light source, a sine stands for it.
std::vector<Harmonic> harmonics_of(const std::vector<Share>& shares, const Pixel& pixel, double frequency) {
  if (shares.empty()) return {{1, 1, 0}};
  std::vector<std::complex<double>> phasors;
  for (const Share& share : shares) {
    for (const Harmonic& h : correlation_harmonics(*share.light, pixel, frequency)) {
      const auto at = static_cast<std::size_t>(h.order / 2);
      if (phasors.size() <= at) phasors.resize(at + 1);
      phasors[at] += share.weight * h.amplitude * std::complex<double>(setup::cos(h.phase_rad), setup::sin(h.phase_rad));
    }
  }
  std::vector<Harmonic> out;
  for (std::size_t i = 0; i < phasors.size(); ++i) {
    const double real = phasors[i].real(), imaginary = phasors[i].imag();
    out.push_back({static_cast<int>(2 * i + 1), setup::hypot(real, imaginary), setup::atan2(imaginary, real)});
  }
  return out;
}

bool is_even(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least <= 1e-6 * *most;
}

/// The table as kernels read it: correction, and light for each electron of the amplitude, each with the step to the next node.
/// @param contrast  amplitude of the first harmonic, which all nodes have that are alike but for rounding
std::vector<float> with_steps(const WigglingTable& table, double contrast) {
  std::vector<float> out;
  std::vector<double> light;
  for (const double one : table.amplitude) light.push_back(1 / one);
  if (is_even(table.amplitude)) light.assign(light.size(), 1 / contrast);
  for (std::size_t j = 0; j < light.size(); ++j) {
    const std::size_t next = (j + 1) % light.size();
    out.insert(out.end(), {single(table.correction[j]), single(table.correction[next] - table.correction[j]), single(light[j]),
                           single(light[next] - light[j])});
  }
  return out;
}

/// What a specimen's calibration says of measured phases: all that they are too large by, but for the pixel's own part.
///                                                                                                           [theory: specimen-calibration]
std::vector<double> correction_of(const FrequencyCalibration& one, double drifted_m, double half_wave, bool wiggles) {
  std::vector<double> out;
  for (int j = 0; j < wiggling_nodes; ++j) {
    double too_large = one.phase_offset_rad + two_pi * drifted_m / half_wave;
    for (std::size_t i = 0; wiggles && i < one.wiggling_cos_rad.size(); ++i) {
      const double angle = static_cast<double>(i + 1) * two_pi * j / wiggling_nodes;
      too_large += one.wiggling_cos_rad[i] * setup::cos(angle) + one.wiggling_sin_rad[i] * setup::sin(angle);
    }
    out.push_back(-too_large / two_pi);
  }
  return out;
}

/// The table of measured phases as decoding knows it. Without the waveform all phases have the amplitude of its first harmonic.
WigglingTable known_wiggling(const Camera& camera, double frequency, const std::vector<Harmonic>& harmonics,
                             const std::vector<double>& tau) {
  const DecoderCalibration& known = camera.decoding.calibration;
  if (known.kind == DecoderCalibration::Kind::exact) return *shared_wiggling_table(harmonics, tau, wiggling_nodes);
  WigglingTable out;
  out.amplitude.assign(wiggling_nodes, harmonics.front().amplitude), out.correction.assign(wiggling_nodes, 0.0);
  if (known.kind == DecoderCalibration::Kind::none) return out;
  const FrequencyCalibration* one = calibration_at(known, frequency);
  if (one == nullptr) refuse("the calibration has no " + number_text(1e-6 * frequency) + " MHz");
  const double drifted = one->drift_m_per_kelvin * (camera.temperature.celsius - known.reference_celsius);
  const double half_wave = speed_of_light / camera.refractive_index / (2 * frequency);
  out.correction = correction_of(*one, drifted, half_wave, camera.decoding.wiggling_correction);
  return out;
}

}  // namespace

std::vector<Harmonic> mean_harmonics(const Camera& camera, const std::vector<LightView>& lights, double frequency_hz) {
  return harmonics_of(shares_of(camera.illumination, lights), camera.pixel, frequency_hz);
}

FrozenDecoder::FrozenDecoder(const ImageCamera& camera, const std::vector<LightView>& lights, const Modulations& modulations,
                             const SensorView& sensor, bool noise)
    : camera_(camera), lights_(lights), modulations_(modulations) {
  DecoderView& d = view_;
  d.modulations = static_cast<std::int32_t>(modulations_.frequency_hz.size());
  d.wiggling_nodes = wiggling_nodes;
  for (std::size_t k = 0; k < camera_.mode.sequence.size(); ++k)
    if (!camera_.mode.sequence[k].lit) grey_frames_.push_back(static_cast<std::int32_t>(k));
  d.grey_frames = static_cast<std::int32_t>(grey_frames_.size()), d.grey_frame = grey_frames_.data();
  raw_frames_.resize(camera_.mode.sequence.size());
  if (d.modulations > 0) {
    freeze_modulations();
  } else {
    freeze_without_modulation();
  }
  d.frame = raw_frames_.data(), d.modulation = decode_modulations_.data();
  freeze_lights();
  freeze_noise(sensor, noise);
  freeze_checks(noise);
  freeze_known_delays(sensor);
  d.effects = d.delay != nullptr || d.suppression_threshold > 0 || d.read.cell != nullptr;
}

/// Exposures of all unlit raw frames together [s].
double FrozenDecoder::grey_time() const {
  double sum = 0;
  for (const RawFrame& frame : camera_.mode.sequence)
    if (!frame.lit) sum += frame.integration_time_s;
  return sum;
}

void FrozenDecoder::take_integration_times() {
  const double grey = grey_time();
  for (std::size_t i = 0; i < grouped_.size(); ++i) {
    const double exposed = camera_.mode.sequence[static_cast<std::size_t>(grouped_[i].front())].integration_time_s;
    decode_modulations_[i].integration_time = single(exposed);
    decode_modulations_[i].ambient_scale = single(grey > 0 ? exposed / grey : 0);
  }
}

/// The mean of |L|², not the square of the mean: then ℓ² − 2rℓ = |L|² − 2r·u·L holds of the means, but for the paths' spread.
///                                                                                              [theory: several-lights]
void FrozenDecoder::freeze_lights() {
  const std::vector<Share> shares = shares_of(camera_.illumination, lights_);
  Vec3 mean{0, 0, 0};
  double square = 0;
  for (const Share& share : shares) {
    mean = mean + share.weight * share.light->position;
    square += share.weight * dot(share.light->position, share.light->position);
  }
  for (std::size_t k = 0; k < 3; ++k) view_.light[k] = single(mean[k]);
  // No path is that long: without a light source nothing that is measured is a return.
  view_.light_square = shares.empty() ? std::numeric_limits<float>::max() : single(square);
}

/// What the variance of a half path is made of, beside shot noise, and from which noise on a depth is none.
void FrozenDecoder::freeze_noise(const SensorView& sensor, bool noise) {
  DecoderView& d = view_;
  const Decoding& decoding = camera_.decoding;
  const double read_noise = effect::ReadNoise::of(camera_), output = effect::output_variance(camera_), dark = dark_current(camera_);
  d.noise_floor = single(2 * read_noise * read_noise + output), d.output_floor = single(output);
  d.suppression_threshold = sensor.suppression_threshold, d.suppression_budget = sensor.suppression_budget;
  d.suppression_variance = single(effect::Suppression::variance_per_electron(camera_));
  d.dark_rate_both = single(2 * dark);
  // Suppression takes dark charge off, too.
  if (d.grey_frames > 0) d.grey_dark = single(effect::Suppression::left_of(camera_, dark * grey_time() / d.grey_frames));
  d.read = sensor.read;
  // What weighs by 1/σ̂² may have all pixels, however noisy: the noise that it leaves says which are good.
  const bool after_filter = decoding.filter.kind == ImageFilter::Kind::adaptive;
  d.noise_threshold = d.filtered_noise_threshold = std::numeric_limits<float>::max();
  if (noise) (after_filter ? d.filtered_noise_threshold : d.noise_threshold) = single(decoding.noise_threshold_m);
  // An adaptive filter takes no pixels that are likely on a wrong cycle: others that are wrong by as much agree with them, and no noise says so.
  constexpr double likely = 0.9;
  d.least_trust = after_filter && noise ? single(likely) : 0.0f;
  d.per_confidence_noise = single(1 / decoding.noise_threshold_m);
}

/// Limits of the checks that a depth has to pass.
void FrozenDecoder::freeze_checks(bool noise) {
  DecoderView& d = view_;
  const Decoding& decoding = camera_.decoding;
  d.amplitude_threshold = single(decoding.amplitude_threshold_e);
  d.asymmetry_square = single(decoding.asymmetry_limit_e * decoding.asymmetry_limit_e);
  d.asymmetry_factor = single(2 * decoding.asymmetry_sigmas * decoding.asymmetry_sigmas);
  d.multipath_limit = single(decoding.multipath_limit_m);
  d.multipath_factor = single(decoding.multipath_sigmas * decoding.multipath_sigmas);
  d.rejected = (decoding.asymmetry_reject ? flag_inconsistent_phases : 0) + (decoding.multipath_reject ? flag_inconsistent_frequencies : 0);
  d.flying_near_z = single(decoding.flying_near_z_m), d.flying_near_limit = single(decoding.flying_near_limit_m);
  d.flying_far_z = single(decoding.flying_far_z_m), d.flying_far_limit = single(decoding.flying_far_limit_m);
  d.flying_factor = noise ? single(decoding.flying_sigmas * decoding.flying_sigmas) : 0, d.flying_check = decoding.flying_check ? 1 : 0;
}

void FrozenDecoder::freeze_modulations() {
  DecoderView& d = view_;
  const double grey = grey_time();
  const double wave_speed = speed_of_light / camera_.refractive_index;
  const std::vector<Share> shares = shares_of(camera_.illumination, lights_);
  for (int i = 0; i < d.modulations; ++i) {
    const std::size_t at = static_cast<std::size_t>(i);
    const Group group = group_of(camera_.mode, modulations_, i);
    const double count = static_cast<double>(group.tau.size()), frequency = modulations_.frequency_hz[at];
    auto harmonics = harmonics_of(shares, camera_.pixel, frequency);
    const double contrast = harmonics.front().amplitude;
    if (!(contrast >= least_contrast)) {
      refuse("next to nothing is left of the modulation\n  got a contrast of " + number_text(contrast) + " at " +
             number_text(1e-6 * frequency) + " MHz; mind the pixel's contrast, bandwidths, rise time, jitter and modulation depth");
    }
    if (!camera_.decoding.wiggling_correction) harmonics.resize(1);
    const WigglingTable table = known_wiggling(camera_, frequency, harmonics, group.tau);
    wiggling_.push_back(with_steps(table, contrast));
    const double half_wave = wave_speed / (2 * frequency);
    DecodeModulation& m = decode_modulations_.emplace_back();
    m.half_wave = single(half_wave), m.per_half_wave = single(1 / half_wave), m.cycles = single(modulations_.cycles[at]),
    m.frequency = single(frequency);
    m.integration_time = single(group.integration_time);
    m.wiggling = wiggling_.back().data();
    m.ambient_scale = single(grey > 0 ? group.integration_time / grey : 0),
    m.variance_factor = single(2 / (count * 4 * pi * pi) * half_wave * half_wave);
    grouped_.push_back(group.raw_frame), pairs_.push_back(pairs_of(group));
    m.raw_frame = grouped_.back().data(), m.count = static_cast<std::int32_t>(grouped_.back().size());
    m.pair = pairs_.back().data(), m.pairs = static_cast<std::int32_t>(pairs_.back().size() / 2);
    if (modulations_.cycles[at] < modulations_.cycles[static_cast<std::size_t>(d.reference)]) d.reference = i;
    for (std::size_t j = 0; j < group.tau.size(); ++j) {
      raw_frames_[static_cast<std::size_t>(group.raw_frame[j])] = {single(2 / count * setup::cos(group.tau[j])),
                                                                   single(2 / count * setup::sin(group.tau[j]))};
    }
  }
  const double common = wave_speed / (2 * modulations_.base_hz);
  d.common_range = single(common), d.per_common_range = single(1 / common);
}

/// How late each pixel is, as far as decoding knows it.
void FrozenDecoder::freeze_known_delays(const SensorView& sensor) {
  const DecoderCalibration& known = camera_.decoding.calibration;
  if (known.kind == DecoderCalibration::Kind::exact) view_.delay = sensor.delay, view_.delay_stride = sensor.delay_stride;
  if (known.kind != DecoderCalibration::Kind::specimen) return;
  const auto has_phases = [](const FrequencyCalibration& one) { return !one.pixel_phase_rad.empty(); };
  if (std::none_of(known.frequencies.begin(), known.frequencies.end(), has_phases)) return;
  const std::size_t pixels = static_cast<std::size_t>(camera_.sensor.width) * static_cast<std::size_t>(camera_.sensor.height);
  for (const double frequency : modulations_.frequency_hz) {
    const FrequencyCalibration* one = calibration_at(known, frequency);
    const bool knows = one != nullptr && has_phases(*one);
    if (knows && one->pixel_phase_rad.size() != pixels) refuse("the calibration's pixels' phases are of another image");
    for (std::size_t i = 0; i < pixels; ++i) known_late_.push_back(knows ? single(one->pixel_phase_rad[i] / (two_pi * frequency)) : 0.0f);
  }
  view_.delay = known_late_.data(), view_.delay_stride = static_cast<std::int32_t>(pixels);
}

/// One modulation without raw frames: its amplitude is 0, which says "no return" of every pixel; ambient light is that of the mean exposure.
void FrozenDecoder::freeze_without_modulation() {
  DecoderView& d = view_;
  d.modulations = 1;
  wiggling_.emplace_back(4 * wiggling_nodes, 0.0f);
  DecodeModulation& m = decode_modulations_.emplace_back();
  m.half_wave = m.per_half_wave = m.cycles = m.variance_factor = 1;
  m.ambient_scale = single(1.0 / d.grey_frames);
  m.wiggling = wiggling_[0].data();
  d.common_range = d.per_common_range = 1;
}

}  // namespace tofray::camera
