// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "base/text.h"
#include "simulator/check.h"
#include "simulator/checks.h"

namespace tofray::simulator {

using namespace base;

namespace {

void check_sensor(const Sensor& sensor, std::size_t raw_frames) {
  const Range side{1, static_cast<double>(limit::sensor_side.value)};
  within(sensor.width, side, "sensor.width");
  within(sensor.height, side, "sensor.height");
  within(sensor.pixel_pitch_m, range::pixel_pitch_m, "sensor.pixel_pitch_m");
  within(sensor.fill_factor, range::fill_factor, "sensor.fill_factor");
  const auto pixels = static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height);
  at_most(pixels, limit::sensor_pixels.value, "pixels of the sensor");
  at_most(pixels * raw_frames, limit::raw_samples.value, "pixels times raw frames of one frame");
}

void check_lens(const Lens& lens) {
  within(lens.fx_px, range::focal_length_px, "lens.fx_px");
  within(lens.fy_px, range::focal_length_px, "lens.fy_px");
  within(lens.cx_px, range::principal_point_px, "lens.cx_px");
  within(lens.cy_px, range::principal_point_px, "lens.cy_px");
  for (const double k : {lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}) within(k, range::distortion, "a distortion coefficient of the lens");
  within(lens.f_number, range::f_number, "lens.f_number");
  within(lens.transmission, range::share, "lens.transmission");
  if (lens.vignetting == Lens::Vignetting::table) {
    samples(lens.vignetting_table.x, range::vignetting_angle_rad, lens.vignetting_table.y, range::vignetting_factor, 1,
            "lens.vignetting_table");
  }
}

void check_filter(const Filter& filter) {
  if (!filter.table.y.empty()) return samples(filter.table.x, range::wavelength_m, filter.table.y, range::share, 1, "filter.table");
  within(filter.center_m, range::wavelength_m, "filter.center_m");
  within(filter.half_width_m, range::filter_half_width_m, "filter.half_width_m");
  within(filter.peak, range::share, "filter.peak");
}

void check_pattern(const Pattern& p, const std::string& path) {
  const bool table = p.kind == Pattern::Kind::table, flat_top = p.kind == Pattern::Kind::flat_top;
  if (p.kind == Pattern::Kind::cone) within(p.half_angle_rad, range::half_angle_rad, path + ".half_angle_rad");
  if (p.kind == Pattern::Kind::cosine_lobe) within(p.exponent, range::lobe_exponent, path + ".exponent");
  if (flat_top) {
    within(p.width_rad, range::width_rad, path + ".width_rad");
    within(p.height_rad, range::width_rad, path + ".height_rad");
  }
  // Of a flat top, 0 says that it is chosen for it.
  if (table || (flat_top && p.columns != 0)) within(p.columns, range::pattern_cells, path + ".columns");
  if (table || (flat_top && p.rows != 0)) within(p.rows, range::pattern_cells, path + ".rows");
  if (table || (flat_top && p.half_range_x_rad != 0)) within(p.half_range_x_rad, range::width_rad, path + ".half_range_x_rad");
  if (table || (flat_top && p.half_range_y_rad != 0)) within(p.half_range_y_rad, range::width_rad, path + ".half_range_y_rad");
  if (p.columns > 0 && p.rows > 0)
    at_most(static_cast<std::size_t>(p.columns) * static_cast<std::size_t>(p.rows), limit::table_samples.value, "samples of " + path);
  if (!table) return;
  if (p.samples.size() != static_cast<std::size_t>(p.columns) * static_cast<std::size_t>(p.rows)) {
    refuse(path + ".samples does not have rows times columns", "got " + std::to_string(p.samples.size()) + " samples");
  }
  within(p.samples, range::pattern_sample, path + ".samples");
  double sum = 0;
  for (const double sample : p.samples) sum += sample;
  if (!(sum > 0)) refuse(path + " is dark", "expected a sample above 0");
}

void check_light(const Illumination& light, const std::string& path) {
  within(light.position, range::light_position_m, path + ".position");
  direction(light.axis, path + ".axis");
  within(light.illumination_wavelength_m, range::illumination_wavelength_m, path + ".illumination_wavelength_m");
  within(light.power_w, range::power_w, path + ".power_w");
  check_pattern(light.pattern, path + ".pattern");
  const Waveform& w = light.waveform;
  const std::string in = path + ".waveform.";
  if (w.kind != Waveform::Kind::sine) within(w.harmonics, range::harmonics, in + "harmonics");
  if (w.kind == Waveform::Kind::measured) {
    at_most(w.correlation.size(), limit::curve_points.value, "samples of " + in + "correlation");
    return within(w.correlation, range::correlation, in + "correlation");
  }
  if (w.kind == Waveform::Kind::sine) within(w.modulation_depth, range::modulation_depth, in + "modulation_depth");
  if (w.kind == Waveform::Kind::rectangular) {
    within(w.duty, range::duty, in + "duty");
    within(w.rise_time_s, range::rise_time_s, in + "rise_time_s");
  }
  within(w.bandwidth_hz, range::bandwidth_hz, in + "bandwidth_hz");
  within(w.jitter_s, range::jitter_s, in + "jitter_s");
}

void check_pixel(const Pixel& pixel) {
  samples(pixel.quantum_efficiency.x, range::wavelength_m, pixel.quantum_efficiency.y, range::share, 1, "pixel.quantum_efficiency");
  samples(pixel.contrast.x, range::modulation_frequency_hz, pixel.contrast.y, range::share, 1, "pixel.contrast");
  within(pixel.bandwidth_hz, range::bandwidth_hz, "pixel.bandwidth_hz");
  within(pixel.full_well_e, range::full_well_e, "pixel.full_well_e");
  within(pixel.read_noise_e, range::read_noise_e, "pixel.read_noise_e");
  within(pixel.dark_current_e_per_s, range::dark_current_e_per_s, "pixel.dark_current_e_per_s");
  within(pixel.prnu, range::share, "pixel.prnu");
  within(pixel.dsnu_dn, range::dsnu_dn, "pixel.dsnu_dn");
  within(pixel.delay_s, range::delay_s, "pixel.delay_s");
  within(pixel.suppression_threshold_e, range::charge_e, "pixel.suppression_threshold_e");
  within(pixel.suppression_budget_e, range::charge_e, "pixel.suppression_budget_e");
  within(pixel.suppression_noise_factor, range::noise_factor, "pixel.suppression_noise_factor");
}

void check_adc(const Adc& adc) {
  within(adc.bits, range::adc_bits, "adc.bits");
  const Range codes{0, static_cast<double>((1 << adc.bits) - 1)};
  within(adc.step_e_per_dn, range::adc_step_e_per_dn, "adc.step_e_per_dn");
  within(adc.mid_code, codes, "adc.mid_code");
  within(adc.valid_min, codes, "adc.valid_min");
  within(adc.valid_max, codes, "adc.valid_max");
  if (adc.valid_min >= adc.valid_max) {
    refuse("adc.valid_min is not below adc.valid_max", "got " + std::to_string(adc.valid_min) + " and " + std::to_string(adc.valid_max));
  }
}

void check_decoding(const Decoding& decoding) {
  within(decoding.low_signal_noise_m, range::low_signal_noise_m, "decoding.low_signal_noise_m");
  within(decoding.flying_near_z_m, range::flying_z_m, "decoding.flying_near_z_m");
  within(decoding.flying_far_z_m, range::flying_z_m, "decoding.flying_far_z_m");
  within(decoding.flying_near_limit_m, range::flying_limit_m, "decoding.flying_near_limit_m");
  within(decoding.flying_far_limit_m, range::flying_limit_m, "decoding.flying_far_limit_m");
  if (!(decoding.flying_far_z_m - decoding.flying_near_z_m >= 1e-6)) {
    refuse("decoding.flying_far_z_m is not beyond decoding.flying_near_z_m",
           "got " + number_text(decoding.flying_far_z_m) + " and " + number_text(decoding.flying_near_z_m));
  }
  within(decoding.inconsistent_range_m, range::inconsistent_range_m, "decoding.inconsistent_range_m");
  const ImageFilter& filter = decoding.filter;
  if (filter.kind == ImageFilter::Kind::gaussian) within(filter.sigma_px, range::gaussian_sigma_px, "decoding.filter.sigma_px");
  if (filter.kind == ImageFilter::Kind::median) within(filter.radius_px, range::median_radius_px, "decoding.filter.radius_px");
}

void check_temperature(const Temperature& t) {
  within(t.celsius, range::celsius, "temperature.celsius");
  within(t.reference_celsius, range::celsius, "temperature.reference_celsius");
  within(t.drift_m_per_kelvin, range::drift_m_per_kelvin, "temperature.drift_m_per_kelvin");
  within(t.warm_up_m, range::warm_up_m, "temperature.warm_up_m");
  within(t.warm_up_time_s, range::warm_up_time_s, "temperature.warm_up_time_s");
  within(t.since_start_s, range::since_start_s, "temperature.since_start_s");
}

void check_mode(const Mode& mode) {
  if (mode.sequence.empty()) refuse("the camera's mode has no raw frames", "expected at least one in mode.sequence");
  at_most(mode.sequence.size(), limit::raw_frames.value, "raw frames in mode.sequence");
  within(mode.frame_rate_hz, range::frame_rate_hz, "mode.frame_rate_hz");
  for (std::size_t k = 0; k < mode.sequence.size(); ++k) {
    const RawFrame& raw = mode.sequence[k];
    const std::string path = "mode.sequence[" + std::to_string(k) + "]";
    within(raw.integration_time_s, range::integration_time_s, path + ".integration_time_s");
    if (!raw.lit) continue;
    within(raw.modulation_frequency_hz, range::modulation_frequency_hz, path + ".modulation_frequency_hz");
    within(raw.reference_phase_rad, range::reference_phase_rad, path + ".reference_phase_rad");
  }
}

}  // namespace

void check(const Camera& camera) {
  check_mode(camera.mode);
  check_sensor(camera.sensor, camera.mode.sequence.size());
  check_lens(camera.lens);
  check_filter(camera.filter);
  at_most(camera.illumination.size(), limit::lights.value, "light sources");
  for (std::size_t l = 0; l < camera.illumination.size(); ++l)
    check_light(camera.illumination[l], "illumination[" + std::to_string(l) + "]");
  check_pixel(camera.pixel);
  check_adc(camera.adc);
  check_decoding(camera.decoding);
  check_temperature(camera.temperature);
  within(camera.refractive_index, range::refractive_index, "refractive_index");
  within(camera.readout_time_s, range::pause_s, "readout_time_s");
  within(camera.min_integration_time_s, range::pause_s, "min_integration_time_s");
}

void check(const SimulatorOptions& options) {
  at_most(options.threads > 0 ? static_cast<std::size_t>(options.threads) : 0, limit::threads.value, "threads");
}

}  // namespace tofray::simulator
