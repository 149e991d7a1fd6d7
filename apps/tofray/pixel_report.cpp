// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "base/constants.h"
#include "pixel_chain.h"

namespace tofray::app {

namespace {

constexpr double degrees = 180 / base::pi;

std::string surface_text(const PixelChain& p) {
  if (p.object < 0) return "surface     nothing is seen here\n";
  std::string text = fmt::format("surface     object {}{}, reflectivity {:.4g}\n", p.object,
                                 p.object_name.empty() ? "" : " (" + p.object_name + ")", p.reflectivity);
  text += fmt::format("            range {:.6f} m, z {:.6f} m, at ({:.4f}, {:.4f}, {:.4f}) m\n", p.true_range_m, p.true_z_m,
                      p.position_m[0], p.position_m[1], p.position_m[2]);
  text += fmt::format("            normal ({:.4f}, {:.4f}, {:.4f}), seen at {:.1f} deg to it\n", p.normal[0], p.normal[1], p.normal[2],
                      p.incidence_rad * degrees);
  text += fmt::format("light       irradiance on the surface {:.4g} W/m2, radiance toward the camera {:.4g} W/(m2 sr)\n", p.irradiance_w_m2,
                      p.radiance_w_m2_sr);
  return text + fmt::format("            power on the pixel {:.4g} W\n", p.power_w);
}

std::string raw_text(const PixelChain& p) {
  if (p.raw_frames.empty()) return {};
  std::string text = fmt::format("raw frame   {:>14} {:>13} {:>11} {:>11} {:>10} {:>10} {:>10} {:>8}\n", "modulation MHz", "reference deg",
                                 "exposure us", "signal e", "tap A e", "tap B e", "A-B e", "code DN");
  for (std::size_t k = 0; k < p.raw_frames.size(); ++k) {
    const ChainRawFrame& one = p.raw_frames[k];
    const std::string modulation = one.lit ? fmt::format("{:.6g}", 1e-6 * one.modulation_frequency_hz) : "unlit";
    text += fmt::format("{:>9}   {:>14} {:>13.6g} {:>11.6g} {:>11.1f} {:>10.1f} {:>10.1f} {:>10.1f} {:>8.6g}\n", k, modulation,
                        one.reference_phase_rad * degrees, 1e6 * one.integration_time_s, one.signal_e, one.tap_a_e, one.tap_b_e,
                        one.difference_e, one.code_dn);
  }
  return text;
}

std::string phase_text(const PixelChain& p) {
  std::string text;
  for (const ChainPhase& one : p.phases) {
    text += fmt::format("phase       {:.6g} MHz: {:.2f} deg, amplitude {:.1f} e", 1e-6 * one.modulation_frequency_hz,
                        one.measured_turns * 360, one.amplitude_e);
    if (std::isfinite(one.calibrated_turns)) text += fmt::format("; calibrated {:.2f} deg", one.calibrated_turns * 360);
    if (std::isfinite(one.half_path_m))
      text += fmt::format("; half path {:.4f} m x ({:.0f} + {:.4f}) = {:.4f} m", one.half_wave_m, one.cycles, one.calibrated_turns,
                          one.half_path_m);
    text += "\n";
  }
  return text;
}

std::string depth_text(const PixelChain& p) {
  std::string flags;
  for (const std::string& one : p.flags) flags += (flags.empty() ? "" : ", ") + one;
  std::string text;
  if (std::isfinite(p.range_m)) {
    text = fmt::format("depth       range {:.6f} m, z {:.6f} m, point ({:.4f}, {:.4f}, {:.4f}) m\n", p.range_m, p.z_m, p.point_m[0],
                       p.point_m[1], p.point_m[2]);
    const double error = p.range_m - p.true_range_m;
    text += fmt::format("            noise {:.2f} mm (1 sigma)", 1e3 * p.noise_m);
    if (std::isfinite(error)) text += fmt::format(", error {:+.2f} mm, {:+.2f} sigma", 1e3 * error, error / p.noise_m);
    text += "\n";
  } else {
    text = fmt::format("depth       none{}{}\n", flags.empty() ? "" : ": ", flags);
  }
  text +=
      fmt::format("            amplitude {:.1f} e, ambient {:.1f} e, confidence {:.0f} of 255\n", p.amplitude_e, p.ambient_e, p.confidence);
  return text + fmt::format("            flags: {}\n", flags.empty() ? "none" : flags);
}

io::Json raw_json(const PixelChain& p) {
  io::Json list = io::Json::array();
  for (const ChainRawFrame& one : p.raw_frames) {
    io::Json json = io::Json::object();
    json.set("lit", one.lit)
        .set("modulation_frequency_hz", one.modulation_frequency_hz)
        .set("reference_phase_rad", one.reference_phase_rad);
    json.set("integration_time_s", one.integration_time_s)
        .set("signal_e", one.signal_e)
        .set("tap_a_e", one.tap_a_e)
        .set("tap_b_e", one.tap_b_e);
    list.push(std::move(json.set("difference_e", one.difference_e).set("raw_dn", one.code_dn)));
  }
  return list;
}

io::Json phases_json(const PixelChain& p) {
  io::Json list = io::Json::array();
  for (const ChainPhase& one : p.phases) {
    io::Json json = io::Json::object();
    json.set("modulation_frequency_hz", one.modulation_frequency_hz).set("amplitude_e", one.amplitude_e);
    json.set("measured_phase_rad", one.measured_turns * base::two_pi).set("calibrated_phase_rad", one.calibrated_turns * base::two_pi);
    list.push(std::move(json.set("half_wave_m", one.half_wave_m).set("cycles", one.cycles).set("half_path_m", one.half_path_m)));
  }
  return list;
}

}  // namespace

std::string pixel_text(const Arrays& arrays, int u, int v) {
  const PixelChain p = pixel_chain(arrays, u, v);
  std::string text = fmt::format("{}: pixel {}, {} of {} x {}\n\n", arrays.where(), u, v, arrays.width(), arrays.height());
  if (arrays.find("gt_range_m") != nullptr) text += surface_text(p) + "\n";
  text += raw_text(p) + "\n" + phase_text(p);
  return arrays.find("range_m") == nullptr ? text : text + "\n" + depth_text(p);
}

io::Json pixel_json(const Arrays& arrays, int u, int v) {
  const PixelChain p = pixel_chain(arrays, u, v);
  io::Json truth = io::Json::object(), depth = io::Json::object();
  truth.set("object_id", p.object)
      .set("object", p.object_name)
      .set("reflectivity", p.reflectivity)
      .set("range_m", p.true_range_m)
      .set("z_m", p.true_z_m);
  truth.set("position_m", io::Json::list(p.position_m)).set("normal", io::Json::list(p.normal)).set("incidence_rad", p.incidence_rad);
  truth.set("irradiance_w_m2", p.irradiance_w_m2).set("radiance_w_m2_sr", p.radiance_w_m2_sr).set("power_w", p.power_w);
  depth.set("range_m", p.range_m).set("z_m", p.z_m).set("point_m", io::Json::list(p.point_m)).set("noise_m", p.noise_m);
  depth.set("amplitude_e", p.amplitude_e)
      .set("ambient_e", p.ambient_e)
      .set("confidence", p.confidence)
      .set("flags", io::Json::list(p.flags));
  io::Json json = io::Json::object();
  json.set("file", arrays.where()).set("pixel", io::Json::list(std::array{u, v})).set("truth", std::move(truth));
  return json.set("raw_frames", raw_json(p)).set("phases", phases_json(p)).set("depth", std::move(depth));
}

}  // namespace tofray::app
