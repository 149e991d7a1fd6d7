// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/pixel_arrays.h"
#include "analysis/unwrap_candidates.h"
#include "base/calibration.h"
#include "base/constants.h"
#include "base/readout.h"
#include "base/text.h"
#include "camera/frozen_camera.h"
#include "depth/decode.h"
#include "simulator/check.h"
#include "tofray/error.h"
#include "tofray/pixel.h"

namespace tofray {

namespace {

std::array<double, 3> triple(const PixelArrays& arrays, const char* name, std::size_t pixel) {
  return {arrays.at(name, 3 * pixel), arrays.at(name, 3 * pixel + 1), arrays.at(name, 3 * pixel + 2)};
}

void read_truth(const PixelArrays& arrays, std::size_t pixel, PixelChain& out) {
  const double object = arrays.at("gt_object_id", pixel);
  out.object = std::abs(object) < 1e9 ? std::llround(object) : -1;
  out.true_range_m = arrays.at("gt_range_m", pixel), out.true_z_m = arrays.at("gt_z_m", pixel);
  out.reflectivity = arrays.at("gt_reflectivity", pixel);
  out.object_share = arrays.at("gt_object_share", pixel), out.mixed = arrays.at("gt_mixed", pixel);
  out.position_m = triple(arrays, "gt_position_m", pixel), out.normal = triple(arrays, "gt_normal", pixel);
  double cosine = 0;
  for (std::size_t i = 0; i < 3; ++i) cosine -= out.normal[i] * out.position_m[i] / out.true_range_m;
  out.incidence_rad = std::acos(std::fmin(1, cosine));
  out.irradiance_w_m2 = arrays.at("gt_irradiance_w_m2", pixel);
  out.radiance_w_m2_sr = arrays.at("gt_radiance_w_m2_sr", pixel);
  out.power_w = arrays.at("gt_power_w", pixel);
}

/// @param camera  none: what a code amounts to is unknown
void read_raw_frames(const PixelArrays& arrays, const Camera* camera, bool noise_free, std::size_t pixel, PixelChain& out) {
  const std::size_t pixels = static_cast<std::size_t>(arrays.width) * static_cast<std::size_t>(arrays.height);
  const double step = camera == nullptr ? std::nan("") : camera->adc.step_e_per_dn / camera->mode.gain,
               mid = camera == nullptr ? std::nan("") : camera->adc.mid_code;
  const double most = camera == nullptr ? std::nan("") : step * (std::exp2(camera->adc.bits) - 1 - mid);
  for (std::size_t k = 0; k < static_cast<std::size_t>(arrays.phases); ++k) {
    const std::size_t at = k * pixels + pixel;
    ChainRawFrame one;
    one.lit = arrays.at("lit", k) != 0;
    one.modulation_frequency_hz = arrays.at("modulation_frequency_hz", k), one.reference_phase_rad = arrays.at("reference_phase_rad", k);
    one.integration_time_s = arrays.at("integration_time_s", k);
    one.signal_e = arrays.at("gt_signal_e", at);
    one.direct_e = arrays.at("gt_direct_e", at), one.indirect_e = arrays.at("gt_indirect_e", at);
    one.multipath_m = arrays.at("gt_multipath_m", at), one.path_noise_m = arrays.at("gt_path_noise_m", at);
    one.tap_a_e = arrays.at("tap_a", at), one.tap_b_e = arrays.at("tap_b", at), one.code_dn = arrays.at("raw", at);
    one.difference_e = step * (one.code_dn - mid);
    // Without codes, or without noise, depth takes the taps without rounding, as far as codes would reach. (fmin and fmax pass over NaN.)
    if (!std::isfinite(one.difference_e) || noise_free) {
      one.difference_e = std::fmax(std::fmin(one.tap_a_e - one.tap_b_e, most), -step * mid);
    }
    out.raw_frames.push_back(one);
  }
}

/// The decoder of arrays whose camera is unknown: any with their raw frames, whose phases it can estimate, too.
Camera any_camera(const PixelArrays& arrays, const PixelChain& chain) {
  Camera any;
  any.sensor.width = arrays.width, any.sensor.height = arrays.height, any.sensor.pixel_pitch_m = 1e-5;
  any.lens.fx_px = any.lens.fy_px = arrays.width, any.lens.cx_px = 0.5 * (arrays.width - 1), any.lens.cy_px = 0.5 * (arrays.height - 1);
  any.pixel.quantum_efficiency = {{850e-9}, {0.5}}, any.pixel.contrast = {{0}, {1}};
  any.mode.frame_rate_hz = 1;
  for (const ChainRawFrame& k : chain.raw_frames)
    any.mode.sequence.push_back({k.lit, k.modulation_frequency_hz, k.reference_phase_rad, k.integration_time_s});
  return any;
}

/// Phase and amplitude of each modulation frequency, as stage 4 estimates them. (Its decoder has one without raw frames where none is lit.)
void estimate_phases(const camera::DecoderView& d, PixelChain& out) {
  std::vector<float> difference;
  for (const ChainRawFrame& k : out.raw_frames) difference.push_back(static_cast<float>(k.difference_e));
  for (int i = 0; i < d.modulations && d.modulation[i].count > 0; ++i) {
    const camera::DecodeModulation& m = d.modulation[i];
    const depth::Estimate<float> e = depth::estimate(d, m, difference.data());
    ChainPhase phase;
    phase.modulation_frequency_hz = out.raw_frames[static_cast<std::size_t>(m.raw_frame[0])].modulation_frequency_hz;
    phase.amplitude_e = static_cast<double>(e.amplitude);
    phase.measured_turns = std::isfinite(e.amplitude) ? static_cast<double>(e.turns) : std::nan("");
    phase.calibrated_turns = phase.half_wave_m = phase.cycles = phase.half_path_m = phase.noise_e = std::nan("");
    out.phases.push_back(phase);
  }
}

/// Half the way from the light to the surface that was measured and back.
double half_path(const PixelChain& chain, const camera::DecoderView& d) {
  double out = 0, from_light = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double p = chain.point_m[i], q = p - static_cast<double>(d.light[i]);
    out += p * p, from_light += q * q;
  }
  return 0.5 * (std::sqrt(out) + std::sqrt(from_light));
}

/// Wiggling and delay taken out, the cycles that go with the range that was found, and those that might have been.
void calibrate(const camera::DecoderView& d, const camera::LensView& lens, std::size_t pixel, PixelChain& chain) {
  std::vector<float> difference, turns, weight;
  for (const ChainRawFrame& k : chain.raw_frames) difference.push_back(static_cast<float>(k.difference_e));
  const float grey = depth::grey_sum<false>(d, difference.data());
  for (std::size_t i = 0; i < chain.phases.size() && i < static_cast<std::size_t>(d.modulations); ++i) {
    ChainPhase& phase = chain.phases[i];
    const camera::DecodeModulation& m = d.modulation[i];
    const auto [calibrated, slope, light] = depth::unwiggle<float>(d, m, static_cast<float>(phase.measured_turns));
    const double delay = d.delay == nullptr ? 0 : static_cast<double>(d.delay[i * static_cast<std::size_t>(d.delay_stride) + pixel]);
    phase.calibrated_turns = static_cast<double>(calibrated) - delay * phase.modulation_frequency_hz;
    phase.calibrated_turns -= std::floor(phase.calibrated_turns);
    phase.half_wave_m = static_cast<double>(m.half_wave);
    phase.cycles = std::round(half_path(chain, d) / phase.half_wave_m - phase.calibrated_turns) + 0.0;  // no -0
    phase.half_path_m = phase.half_wave_m * (phase.cycles + phase.calibrated_turns);
    const depth::Estimate<float> e = depth::estimate(d, m, difference.data());
    const float variance = depth::variance_of(d, m, difference.data(), e, light, grey * m.ambient_scale);
    phase.noise_e = std::sqrt(2 * static_cast<double>(variance) / m.count);
    turns.push_back(static_cast<float>(phase.calibrated_turns)), weight.push_back(depth::inverse_variance(m, e, variance, slope));
  }
  chain.candidates = analysis::unwrap_candidates(d, lens, pixel, turns, weight);
}

void read_depth(const PixelArrays& arrays, const Camera* camera, std::size_t pixel, PixelChain& out) {
  out.range_m = arrays.at("range_m", pixel), out.z_m = arrays.at("z_m", pixel), out.noise_m = arrays.at("noise_m", pixel);
  out.amplitude_e = arrays.at("amplitude_e", pixel), out.ambient_e = arrays.at("ambient_e", pixel),
  out.confidence = arrays.at("confidence", pixel);
  out.noise_threshold_m = camera == nullptr ? std::nan("") : camera->decoding.noise_threshold_m;
  out.point_m = triple(arrays, "points_m", pixel);
  const double flags = arrays.at("flags", pixel);
  out.flags = flags >= 0 && flags <= 65535 ? static_cast<int>(flags) : 0;
}

/// One array of a frame; NaN beyond its end.
template <class Values>
double element(const Values& values, std::size_t i) {
  return i < values.size() ? static_cast<double>(values[i]) : std::nan("");
}

}  // namespace

PixelArrays pixel_arrays(const Frame& frame) {
  PixelArrays out;
  out.width = frame.depth.width > 0 ? frame.depth.width : frame.raw.width > 0 ? frame.raw.width : frame.truth.width;
  out.height = frame.depth.width > 0 ? frame.depth.height : frame.raw.width > 0 ? frame.raw.height : frame.truth.height;
  out.phases = static_cast<int>(frame.raw.lit.size());
  out.at = [&frame](std::string_view name, std::size_t i) -> double {
#define TOFRAY_ELEMENT(row, part, member, ...) \
  if (name == #row) return element(frame.part.member, i);
    TOFRAY_FRAME_ARRAYS(TOFRAY_ELEMENT)
#undef TOFRAY_ELEMENT
    return std::nan("");
  };
  return out;
}

std::size_t analysis::pixel_index(const PixelArrays& arrays, int u, int v, const std::string& where) {
  if (arrays.width <= 0 || arrays.height <= 0)
    throw Error(ErrorKind::bad_input, where +
                                          ": error: there is no image in it\n  expected raw, z_m or another array with pixels; "
                                          "`tofray list arrays` has them all");
  if (u < 0 || v < 0 || u >= arrays.width || v >= arrays.height)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: pixel {},{} is outside the image\n  expected a column of 0 to {} and a row of 0 to {}", u, v,
                            arrays.width - 1, arrays.height - 1));
  return static_cast<std::size_t>(v) * static_cast<std::size_t>(arrays.width) + static_cast<std::size_t>(u);
}

PixelChain pixel_chain(const PixelArrays& arrays, const Camera* camera, bool noise_free, int u, int v, const std::string& where) {
  const std::size_t pixel = analysis::pixel_index(arrays, u, v, where);
  PixelChain chain;
  chain.u = u, chain.v = v;
  read_truth(arrays, pixel, chain);
  read_raw_frames(arrays, camera, noise_free, pixel, chain);
  read_depth(arrays, camera, pixel, chain);
  if (chain.raw_frames.empty()) return chain;
  const Camera profile = camera == nullptr ? any_camera(arrays, chain) : *camera;
  const base::ImageExtent image = base::image_extent(profile);
  if (image.width != arrays.width || image.height != arrays.height || profile.mode.sequence.size() != chain.raw_frames.size())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: the camera is not the one of the arrays\n  got an image of {} x {} pixels with {} raw frames, "
                            "and arrays of {} x {} pixels with {}",
                            base::printable(where), image.width, image.height, profile.mode.sequence.size(), arrays.width, arrays.height,
                            chain.raw_frames.size()));
  try {
    if (camera == nullptr) simulator::check(profile);  // its raw frames come from arrays that anybody can write
    const camera::FrozenCamera frozen(base::with_offsets(profile), true, 0);
    estimate_phases(frozen.decoder(), chain);
    if (camera != nullptr) calibrate(frozen.decoder(), frozen.lens(), pixel, chain);
  } catch (const Error&) {
    if (camera != nullptr) throw;  // without a camera: raw frames of which nobody can tell phases
  }
  return chain;
}

PixelChain analysis::chain_of(const PixelArrays& arrays, const Camera& camera, const camera::FrozenCamera& frozen, bool noise_free, int u,
                              int v) {
  const std::size_t pixel = pixel_index(arrays, u, v);
  PixelChain chain;
  chain.u = u, chain.v = v;
  read_raw_frames(arrays, &camera, noise_free, pixel, chain);
  read_depth(arrays, &camera, pixel, chain);
  estimate_phases(frozen.decoder(), chain);
  calibrate(frozen.decoder(), frozen.lens(), pixel, chain);
  return chain;
}

PixelChain pixel_chain(const Frame& frame, const Camera& camera, int u, int v, Noise noise) {
  return pixel_chain(pixel_arrays(frame), &camera, noise == Noise::off, u, v);
}

}  // namespace tofray
