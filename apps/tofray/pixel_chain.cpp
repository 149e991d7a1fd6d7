// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pixel_chain.h"

#include <fmt/core.h>

#include <cmath>

#include "base/calibration.h"
#include "base/constants.h"
#include "base/readout.h"
#include "base/text.h"
#include "camera/frozen_camera.h"
#include "depth/decode.h"
#include "results.h"
#include "results/meta.h"
#include "results/meta_camera.h"
#include "simulator/check.h"
#include "tofray/error.h"
#include "tofray/load.h"

namespace tofray::app {

namespace {

std::array<double, 3> triple(const Arrays& arrays, const char* name, std::size_t pixel) {
  return {arrays.at(name, 3 * pixel), arrays.at(name, 3 * pixel + 1), arrays.at(name, 3 * pixel + 2)};
}

/// What the scene in `meta` calls object number `index`.
std::string name_of_object(const Arrays& arrays, long index) {
  const files::Json* scene = arrays.meta().find("scene");
  const files::Json* objects = scene == nullptr ? nullptr : scene->find("objects");
  if (objects == nullptr || !objects->is_array() || index < 0 || static_cast<std::size_t>(index) >= objects->items()->size()) return {};
  for (const char* key : {"name", "shape"}) {
    const files::Json* found = (*objects->items())[static_cast<std::size_t>(index)].find(key);
    if (found != nullptr && found->is_string() && !found->string()->empty()) return *found->string();
  }
  return {};
}

void read_truth(const Arrays& arrays, std::size_t pixel, PixelChain& out) {
  const double object = arrays.at("gt_object_id", pixel);
  out.object = std::abs(object) < 1e9 ? std::lround(object) : -1;
  out.object_name = name_of_object(arrays, out.object);
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

double meta_number(const Arrays& arrays, const char* section, const char* key, double otherwise) {
  const files::Json* camera = arrays.meta().find("camera");
  const files::Json* group = camera == nullptr ? nullptr : camera->find(section);
  const files::Json* found = group == nullptr ? nullptr : group->find(key);
  double value = otherwise;
  if (found != nullptr) found->number(value);
  return value;
}

void read_raw_frames(const Arrays& arrays, std::size_t pixel, PixelChain& out) {
  const std::size_t pixels = arrays.width() * arrays.height();
  const double step = meta_number(arrays, "adc", "step_e_per_dn", std::nan("")) / meta_number(arrays, "mode", "gain", 1),
               mid = meta_number(arrays, "adc", "mid_code", std::nan(""));
  const double most = step * (std::exp2(meta_number(arrays, "adc", "bits", std::nan(""))) - 1 - mid);
  for (std::size_t k = 0; k < arrays.phases(); ++k) {
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
    if (!std::isfinite(one.difference_e) || results::is_noise_free(arrays.meta())) {
      one.difference_e = std::fmax(std::fmin(one.tap_a_e - one.tap_b_e, most), -step * mid);
    }
    out.raw_frames.push_back(one);
  }
}

/// What decodes the arrays: the camera in `meta`; where there is none, any with their raw frames, whose phases it can estimate, too.
Camera camera_of(const Arrays& arrays, const PixelChain& chain) {
  if (arrays.meta().find("camera") != nullptr) return results::camera_of_meta(arrays.meta_text(), arrays.where());
  Camera any = load_camera("pico-flexx");
  any.sensor.width = static_cast<int>(arrays.width()), any.sensor.height = static_cast<int>(arrays.height());
  any.mode.sequence.clear();
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
    phase.calibrated_turns = phase.half_wave_m = phase.cycles = phase.half_path_m = std::nan("");
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

/// Wiggling and delay taken out, and the cycles that go with the range that was found.
void calibrate(const camera::DecoderView& d, std::size_t pixel, PixelChain& chain) {
  for (std::size_t i = 0; i < chain.phases.size() && i < static_cast<std::size_t>(d.modulations); ++i) {
    ChainPhase& phase = chain.phases[i];
    const camera::DecodeModulation& m = d.modulation[i];
    float slope = 0;
    const auto calibrated = static_cast<double>(depth::unwiggle<float>(d, m, static_cast<float>(phase.measured_turns), slope));
    const double delay = d.delay == nullptr ? 0 : static_cast<double>(d.delay[i * static_cast<std::size_t>(d.delay_stride) + pixel]);
    phase.calibrated_turns = calibrated - delay * phase.modulation_frequency_hz;
    phase.calibrated_turns -= std::floor(phase.calibrated_turns);
    phase.half_wave_m = static_cast<double>(m.half_wave);
    phase.cycles = std::round(half_path(chain, d) / phase.half_wave_m - phase.calibrated_turns) + 0.0;  // no -0
    phase.half_path_m = phase.half_wave_m * (phase.cycles + phase.calibrated_turns);
  }
}

void read_depth(const Arrays& arrays, std::size_t pixel, PixelChain& out) {
  out.range_m = arrays.at("range_m", pixel), out.z_m = arrays.at("z_m", pixel), out.noise_m = arrays.at("noise_m", pixel);
  out.amplitude_e = arrays.at("amplitude_e", pixel), out.ambient_e = arrays.at("ambient_e", pixel),
  out.confidence = arrays.at("confidence", pixel);
  out.noise_threshold_m = meta_number(arrays, "decoding", "noise_threshold_m", std::nan(""));
  out.point_m = triple(arrays, "points_m", pixel);
  const double flags = arrays.at("flags", pixel);
  const unsigned bits = flag_bits(flags);
  for (std::size_t bit = 0; bit < flag_names().size(); ++bit) {
    if ((bits >> bit & 1u) != 0) out.flags.push_back(flag_names()[bit]);
  }
}

}  // namespace

void refuse_outside(const Arrays& arrays, int u, int v) {
  if (arrays.width() == 0)
    throw Error(
        ErrorKind::bad_input,
        arrays.where() +
            ": error: there is no image in this file\n  expected raw, z_m or another array with pixels; `tofray list arrays` has them all");
  if (static_cast<std::size_t>(u) >= arrays.width() || static_cast<std::size_t>(v) >= arrays.height())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: pixel {},{} is outside the image\n  expected a column of 0 to {} and a row of 0 to {}", u, v,
                            arrays.width() - 1, arrays.height() - 1));
}

PixelChain pixel_chain(const Arrays& arrays, int u, int v) {
  refuse_outside(arrays, u, v);
  const std::size_t pixel = static_cast<std::size_t>(v) * arrays.width() + static_cast<std::size_t>(u);
  PixelChain chain;
  chain.u = u, chain.v = v;
  read_truth(arrays, pixel, chain);
  read_raw_frames(arrays, pixel, chain);
  read_depth(arrays, pixel, chain);
  if (chain.raw_frames.empty()) return chain;
  const bool known = arrays.meta().find("camera") != nullptr;
  const Camera profile = camera_of(arrays, chain);
  const Sensor image = base::as_read_out(profile).sensor;
  if (static_cast<std::size_t>(image.width) != arrays.width() || static_cast<std::size_t>(image.height) != arrays.height() ||
      profile.mode.sequence.size() != chain.raw_frames.size())
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: error: the camera in meta is not the one of the arrays\n  got an image of {} x {} pixels with {} raw frames, "
                    "and arrays of {} x {} pixels with {}",
                    base::printable(arrays.where()), image.width, image.height, profile.mode.sequence.size(), arrays.width(),
                    arrays.height(), chain.raw_frames.size()));
  try {
    if (!known) simulator::check(profile);  // its raw frames come from arrays that anybody can write
    const camera::FrozenCamera frozen(base::with_offsets(profile), true, 0);
    estimate_phases(frozen.decoder(), chain);
    if (known) calibrate(frozen.decoder(), pixel, chain);
  } catch (const Error&) {
    if (known) throw;  // without a camera: raw frames of which nobody can tell phases
  }
  return chain;
}

}  // namespace tofray::app
