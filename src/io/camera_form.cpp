// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "base/ranges.h"
#include "io/form.h"

/// The tables of a camera profile.
namespace tofray::io {

namespace {

using enum base::Dimension;

namespace range = base::range;
const auto curve_points = static_cast<int>(base::limit::curve_points.value);

Form share(const std::string& example) { return number(fraction, range::share, example); }
Form wavelength() { return number(length, range::wavelength_m, "850 nm"); }
Form modulation_frequency() { return number(frequency, range::modulation_frequency_hz, "80.32 MHz"); }
Form integration_time() { return number(time, range::integration_time_s, "2000 us"); }

Form curve(const std::string& x_key, Form x, Form y, const std::string& y_key = "value") {
  return map({required(x_key, list(std::move(x), 2, curve_points), "ascending"),
              required(y_key, list(std::move(y), 2, curve_points), "one for each " + x_key + "; a not-a-knot spline goes through them")});
}

Form sensor() {
  const base::Range side{1, static_cast<double>(base::limit::sensor_side.value)};
  return map({required("width", integer(side, "224"), "pixels"), required("height", integer(side, "172"), "pixels"),
              required("pixel_pitch", number(length, range::pixel_pitch_m, "12 um"), "from pixel to pixel"),
              optional("fill_factor", number(fraction, range::fill_factor, "0.8"), "1", "share of the pixel's area that collects light")});
}

Form lens() {
  Form k = number(none, range::distortion, "-0.3");
  Form distortion = map({optional("k1", k, "0", "radial, r^2"), optional("k2", k, "0", "radial, r^4"), optional("p1", k, "0", "tangential"),
                         optional("p2", k, "0", "tangential"), optional("k3", k, "0", "radial, r^6")});
  Form vignetting =
      either({choice({"cos4", "off"}), curve("angle", number(angle, range::vignetting_angle_rad, "30 deg"), number(none, range::vignetting_factor, "0.6"), "factor")});
  return map({required("fx", number(pixel, range::focal_length_px, "212 px"), "focal length over pixel pitch, along a row"),
              required("fy", number(pixel, range::focal_length_px, "212 px"), "the same along a column"),
              required("cx", number(pixel, range::principal_point_px, "111.5 px"), "principal point; the centre of pixel (0, 0) is at (0, 0)"),
              required("cy", number(pixel, range::principal_point_px, "85.5 px"), "principal point"),
              optional("distortion", std::move(distortion), "{}", "Brown-Conrady, as in OpenCV"),
              required("f_number", number(none, range::f_number, "1.6"), "N"),
              optional("transmission", share("0.85"), "1", "of lens and filter at the illumination wavelength"),
              optional("vignetting", std::move(vignetting), "cos4",
                       "fall-off toward the corners: cos4, off, or a table over the angle to the axis")});
}

Form filter() {
  Form window =
      map({absent("center", wavelength(), "the illumination wavelength of the first light unless given"),
           optional("half_width", number(length, range::filter_half_width_m, "15 nm"), "15 nm", "passes center - half_width to center + half_width"),
           optional("peak", share("0.9"), "1", "transmission inside")});
  window.keys.push_back(
      absent("wavelength", list(wavelength(), 2, curve_points), "ascending; a table in place of center, half_width and peak"));
  window.keys.push_back(absent("transmission", list(share("0.9"), 2, curve_points), "one for each wavelength of the table"));
  return window;
}

Form samples() {
  const auto most = static_cast<int>(base::limit::table_samples.value);
  return list(list(number(none, range::pattern_sample, "1"), 2, most), 2, most);   // between two of them it is interpolated
}

Form pattern() {
  const Form half = number(angle, range::half_angle_rad, "43 deg");
  const Form width = number(angle, range::width_rad, "62 deg");
  const Form cells = integer(range::pattern_cells, "172");
  const std::vector<Key> ranges = {required("half_range_x", half, "the table covers +- this across its columns"),
                                   required("half_range_y", half, "the table covers +- this across its rows")};
  std::vector<Key> measured = {
      absent("samples", samples(), "rows (from -half_range_y on) of samples (from -half_range_x on), any unit"),
      absent("file", text("a file", "pattern.csv"), "the same as text, one row a line, beside the profile or below")};
  measured.insert(measured.end(), ranges.begin(), ranges.end());
  std::vector<Key> flat = {required("width", width, "full width across x at half the peak"),
                           required("height", width, "the same across y"),
                           absent("half_range_x", half, "zero beyond +- this; the width unless given"),
                           absent("half_range_y", half, "zero beyond +- this; the height unless given"),
                           absent("columns", cells, "cells of the table it stands for"),
                           absent("rows", cells, "cells of the table it stands for")};
  Form form = tagged("kind", {{"lambertian", {}},
                              {"cone", {required("half_angle", half, "uniform up to this angle to the axis")}},
                              {"cosine_lobe", {required("exponent", number(none, range::lobe_exponent, "4"), "n of cos^n")}},
                              {"flat_top", std::move(flat)},
                              {"table", std::move(measured)}});
  form.forms[4].exactly_one = {"samples", "file"};
  return form;
}

Form waveform() {
  const Key bandwidth = optional("bandwidth", number(frequency, range::bandwidth_hz, "200 MHz"), "0", "single pole of the light source; 0: none");
  const Key jitter = optional("jitter", number(time, range::jitter_s, "50 ps"), "0", "Gaussian, 1 sigma");
  const Key harmonics = optional("harmonics", integer(range::harmonics, "4"), "4", "how many odd harmonics are kept: 1, 3, 5, 7 …");
  Form correlation = list(number(none, range::correlation, "0.5"), 4, curve_points);
  Form form = tagged(
      "kind", {{"rectangular",
                {optional("duty", number(fraction, range::duty, "25 %"), "50 %", "width at half height over the period"),
                 optional("rise_time", number(time, range::rise_time_s, "1 ns"), "0", "linear edge, 0 to 100 %"), bandwidth, jitter, harmonics}},
               {"sine",
                {optional("modulation_depth", number(fraction, range::modulation_depth, "90 %"), "100 %", "d of the light 1 + d cos"), bandwidth,
                 jitter}},
               {"measured",
                {absent("correlation", std::move(correlation),
                        "(A-B)/(A+B) at equally spaced reference phases over one period, light and pixel at no distance"),
                 absent("file", text("a file", "correlation.csv"), "the same as text, beside the profile or below"), harmonics}}});
  form.forms[2].exactly_one = {"correlation", "file"};
  return form;
}

Form illumination() {
  Form light = map({optional("position", list(number(length, range::light_position_m, "15.47 mm"), 3, 3), "[0, 0, 0]", "in the camera's frame"),
                    optional("axis", list(number(none, range::component, "1"), 3, 3), "[0, 0, 1]", "in the camera's frame"),
                    required("illumination_wavelength", number(length, range::illumination_wavelength_m, "850 nm"), ""),
                    required("power", number(power, range::power_w, "0.2 W"), "optical, of a lit raw frame, mean over the modulation period"),
                    required("pattern", pattern(), "how the light is spread over directions"),
                    required("waveform", waveform(), "how it is modulated")});
  light.keys[2].doc = "of the light source";
  return list(std::move(light), 0, static_cast<int>(base::limit::lights.value));
}

Form pixel_form() {
  const Form electrons = number(charge, range::charge_e, "50 e");
  Form patterns = map({optional("prnu", number(fraction, range::share, "1 %"), "0", "photo response non-uniformity, 1 sigma"),
                       optional("dsnu", number(code, range::dsnu_dn, "2 DN"), "0", "offset pattern, 1 sigma"),
                       optional("delay", number(time, range::delay_s, "20 ps"), "0", "fixed delay per pixel, 1 sigma"),
                       optional("seed", integer({0, 9007199254740991.0}, "1"), "1", "which specimen of the sensor")});
  Form suppression =
      map({required("threshold", electrons, "starts when the smaller tap reaches it; 0: no suppression"),
           required("budget", electrons, "largest charge taken off each tap"),
           optional("noise_factor", number(none, range::noise_factor, "1"), "1", "each tap's removed charge x adds a variance of noise_factor^2 x")});
  return map(
      {required("quantum_efficiency", either({share("0.4"), curve("wavelength", wavelength(), share("0.4"))}), "electrons per photon"),
       optional("contrast", either({share("0.75"), curve("modulation_frequency", modulation_frequency(), share("0.75"))}), "1",
                "demodulation contrast of the pixel itself"),
       optional("bandwidth", number(frequency, range::bandwidth_hz, "180 MHz"), "0", "single pole of the gate; 0: none"),
       optional("full_well", number(charge, range::full_well_e, "100000 e"), "1e30 e", "per tap"),
       optional("read_noise", number(charge, range::read_noise_e, "50 e"), "0", "per tap, reset and read, 1 sigma"),
       optional("dark_current", number(charge_rate, range::dark_current_e_per_s, "1000 e/s"), "0", "per tap"),
       optional("patterns", std::move(patterns), "{}", "what differs from pixel to pixel"),
       absent("suppression", std::move(suppression), "background suppression; none unless given")});
}

Form adc() {
  const Form code_form = integer(range::code_dn, "400");
  return map({required("bits", integer(range::adc_bits, "12"), "codes go from 0 to 2^bits - 1"),
              required("step", number(charge_per_code, range::adc_step_e_per_dn, "20 e/DN"), "electrons of A-B per code"),
              absent("mid_code", number(none, range::code_dn, "2048"), "code of A-B = 0; the middle unless given"),
              absent("valid_min", code_form, "codes below are flagged as saturated; 0 unless given"),
              absent("valid_max", code_form, "codes above are flagged as saturated; the largest unless given")});
}

Form decoding() {
  const Form limit = number(length, range::flying_limit_m, "18 mm");
  Form flying = map({optional("near_z", number(length, range::flying_z_m, "1 m"), "1 m", "the limit on |dz| grows linearly from here"),
                     optional("near_limit", limit, "18 mm", "limit at near_z and before"),
                     optional("far_z", number(length, range::flying_z_m, "4.5 m"), "4.5 m", "… to here"),
                     optional("far_limit", limit, "140 mm", "limit at far_z and beyond")});
  Form filters = tagged("kind", {{"none", {}},
                                 {"gaussian", {optional("sigma", number(pixel, range::gaussian_sigma_px, "1 px"), "1 px", "width of the kernel")}},
                                 {"median", {optional("radius", integer(range::median_radius_px, "1"), "1", "window of (2 radius + 1)^2 pixels")}}});
  return map({optional("wiggling_correction", boolean(), "true", "take out what the harmonics do to the phase"),
              optional("low_signal_noise", number(length, range::low_signal_noise_m, "70 mm"), "70 mm",
                       "more noise than this: flagged as low signal; also the scale of confidence"),
              optional("flying_pixel", std::move(flying), "{}", "limits of the flying pixel flag"),
              optional("inconsistent_range", number(length, range::inconsistent_range_m, "0.1 m"), "0.1 m", "two modulation frequencies may differ by this"),
              optional("filter", std::move(filters), "none", "over the range image")});
}

Form temperature() {
  return map({optional("actual", number(celsius, range::celsius, "25 degC"), "25 degC", "of the camera"),
              optional("reference", number(celsius, range::celsius, "25 degC"), "25 degC", "at which the range has no drift"),
              optional("drift", number(drift, range::drift_m_per_kelvin, "0.2 mm/K"), "0", "range per kelvin off the reference"),
              optional("warm_up", number(length, range::warm_up_m, "5 mm"), "0", "range drifts by this while the camera warms up, first order"),
              optional("warm_up_time", number(time, range::warm_up_time_s, "600 s"), "600 s", "its time constant"),
              optional("since_start", number(time, range::since_start_s, "600 s"), "1e9 s", "how long the camera has run at frame 0")});
}

Form modes() {
  const Form tau = number(angle, range::reference_phase_rad, "90 deg");
  Form entry = map({optional("lit", boolean(), "true", "whether the camera's light is on"),
                    absent("modulation_frequency", modulation_frequency(), "of lit raw frames"),
                    absent("reference_phase", either({tau, list(tau, 1, static_cast<int>(base::limit::raw_frames.value))}),
                           "of lit raw frames; a list makes one raw frame of each"),
                    required("integration_time", integration_time(), "of each raw frame")});
  Form mode =
      map({required("frame_rate", number(frequency, range::frame_rate_hz, "5 Hz"), "frame i starts at i / frame_rate"),
           required("sequence", list(std::move(entry), 1, static_cast<int>(base::limit::raw_frames.value)), "the raw frames, in order")});
  return dictionary(std::move(mode), 1, static_cast<int>(base::limit::modes.value));
}

FileForm make() {
  FileForm file;
  file.kind = "camera";
  file.title = "tofray camera profile: lens, light, pixel, ADC, modes and decoding";
  file.provenance = true;
  Form timing = map({optional("readout_time", number(time, range::pause_s, "3.5 ms"), "0", "from the end of one exposure to the start of the next"),
                     optional("min_integration_time", number(time, range::pause_s, "27 us"), "0", "shortest exposure the camera can do")});
  file.root = map(
      {required("name", text("a name", "mycam"), "of the camera"), required("sensor", sensor(), "the grid of pixels"),
       required("lens", lens(), "from directions to pixels"), optional("filter", filter(), "{}", "before the sensor, for ambient light"),
       required("illumination", illumination(), "the camera's own lights, which add up"),
       required("pixel", pixel_form(), "the two-tap pixel"), required("adc", adc(), "from electrons to codes"),
       optional("decoding", decoding(), "{}", "from raw frames to depth"),
       optional("temperature", temperature(), "{}", "drift of the range"), optional("timing", std::move(timing), "{}", "of the readout"),
       optional("refractive_index", number(none, range::refractive_index, "1.0003"), "1", "of the medium"),
       optional("power_model", choice({"tofray", "paper_literal"}), "tofray",
                "paper_literal: the printed formula of the paper, for comparison only"),
       required("modes", modes(), "the camera's use cases by name; the first is the default"),
       absent("mode", text("a mode", "MODE_9_5FPS_2000"), "which of the modes; the first unless given"),
       absent("integration_time", integration_time(), "takes the place of that of every lit raw frame of the mode")});
  return file;
}

}  // namespace

const FileForm& camera_form() {
  static const FileForm form = make();
  return form;
}

}  // namespace tofray::io
