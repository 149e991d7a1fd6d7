// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/pixel_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/constants.h"
#include "commands/results.h"
#include "results/array_table.h"
#include "run/file_pixel.h"

namespace tofray::app {

namespace {

constexpr double degrees = 180 / base::pi;

/// A number, or a dash where there is none: the file does not have its array, or it is invalid.
std::string shown(const char* format, double value) { return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value); }

std::string triple(const std::array<double, 3>& v) {
  return fmt::format("({}, {}, {})", shown("{:.4f}", v[0]), shown("{:.4f}", v[1]), shown("{:.4f}", v[2]));
}

/// Only frames with samples within the pixels know of it.
std::string share_text(const PixelChain& p) {
  if (std::isnan(p.object_share)) return {};
  return fmt::format("            {} % of the pixel's samples see {}{}\n", shown("{:.4g}", 100 * p.object_share),
                     p.object < 0 ? "nothing" : "it", p.mixed > 0 ? ": a mixed pixel" : "");
}

std::string surface_text(const PixelChain& p, const std::string& object_name, bool knows_object) {
  if (knows_object && p.object < 0) return "surface     nothing is seen here\n" + share_text(p);
  std::string text = fmt::format("surface     object {}{}, reflectivity {}\n", knows_object ? std::to_string(p.object) : "-",
                                 object_name.empty() ? "" : " (" + object_name + ")", shown("{:.4g}", p.reflectivity));
  text += fmt::format("            range {} m, z {} m, at {} m\n", shown("{:.6f}", p.true_range_m), shown("{:.6f}", p.true_z_m),
                      triple(p.position_m));
  text += fmt::format("            normal {}, seen at {} deg to it\n", triple(p.normal), shown("{:.1f}", p.incidence_rad * degrees));
  text += share_text(p);
  text += fmt::format("light       irradiance on the surface {} W/m2, radiance toward the camera {} W/(m2 sr)\n",
                      shown("{:.4g}", p.irradiance_w_m2), shown("{:.4g}", p.radiance_w_m2_sr));
  return text + fmt::format("            power on the pixel {} W\n", shown("{:.4g}", p.power_w));
}

std::string raw_text(const PixelChain& p) {
  if (p.raw_frames.empty()) return {};
  std::string text = fmt::format("raw frame   {:>14} {:>13} {:>11} {:>11} {:>10} {:>10} {:>10} {:>8}\n", "modulation MHz", "reference deg",
                                 "exposure us", "signal e", "tap A e", "tap B e", "A-B e", "code DN");
  for (std::size_t k = 0; k < p.raw_frames.size(); ++k) {
    const ChainRawFrame& one = p.raw_frames[k];
    const std::string modulation = one.lit ? shown("{:.6g}", 1e-6 * one.modulation_frequency_hz) : "unlit";
    text += fmt::format("{:>9}   {:>14} {:>13} {:>11} {:>11} {:>10} {:>10} {:>10} {:>8}\n", k, modulation,
                        shown("{:.6g}", one.reference_phase_rad * degrees), shown("{:.6g}", 1e6 * one.integration_time_s),
                        shown("{:.1f}", one.signal_e), shown("{:.1f}", one.tap_a_e), shown("{:.1f}", one.tap_b_e),
                        shown("{:.1f}", one.difference_e), shown("{:.6g}", one.code_dn));
  }
  return text;
}

/// The first raw frame of each modulation frequency.
std::vector<std::size_t> first_of_each_frequency(const PixelChain& p) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < p.raw_frames.size(); ++k) {
    const auto same = [&](std::size_t i) { return p.raw_frames[i].modulation_frequency_hz == p.raw_frames[k].modulation_frequency_hz; };
    if (p.raw_frames[k].lit && std::none_of(out.begin(), out.end(), same)) out.push_back(k);
  }
  return out;
}

std::string bounce_name(const BounceShare& one) {
  if (one.last == 0) return "direct";
  return one.first == one.last ? std::to_string(one.first) : fmt::format("{} to {}", one.first, one.last);
}

/// What each bounce brings; an element of `bounces` may be several.
std::string bounces_text(const PixelChain& p, const PixelBounces& bounces) {
  if (!bounces.unknown.empty()) return fmt::format("bounces     one by one unknown: {}\n", bounces.unknown);
  if (bounces.shares.empty()) return {};
  const std::vector<std::size_t> frequencies = first_of_each_frequency(p);
  std::string text = fmt::format("bounces   {:>10}", "light %");
  for (const std::size_t k : frequencies)
    text += fmt::format(" {:>16}", fmt::format("mm at {:.6g} MHz", 1e-6 * p.raw_frames[k].modulation_frequency_hz));
  text += "\n";
  for (const BounceShare& one : bounces.shares) {
    text += fmt::format("{:>9} {:>10.3f}", bounce_name(one), 100 * one.share);
    if (one.last > 0)
      for (const std::size_t k : frequencies) text += fmt::format(" {:>16}", shown("{:+.2f}", 1e3 * one.multipath_m[k]));
    text += "\n";
  }
  return text;
}

/// Only frames whose light bounced know of it.
std::string multipath_text(const PixelChain& p, const PixelBounces& bounces) {
  std::string text;
  for (const std::size_t k : first_of_each_frequency(p)) {
    const ChainRawFrame& one = p.raw_frames[k];
    if (std::isnan(one.indirect_e)) continue;
    text += fmt::format("multipath   {:.6g} MHz: {} % of the light came by several surfaces, half path {}{} mm\n",
                        1e-6 * one.modulation_frequency_hz, shown("{:.4g}", 100 * one.indirect_e / (one.direct_e + one.indirect_e)),
                        shown("{:+.2f}", 1e3 * one.multipath_m),
                        std::isfinite(one.path_noise_m) ? fmt::format(" +- {:.2f}", 1e3 * one.path_noise_m) : "");
  }
  return text.empty() ? text : text + bounces_text(p, bounces) + "\n";
}

std::string phase_text(const PixelChain& p) {
  std::string text;
  for (const ChainPhase& one : p.phases) {
    text += fmt::format("phase       {:.6g} MHz: {} deg, amplitude {} e", 1e-6 * one.modulation_frequency_hz,
                        shown("{:.2f}", one.measured_turns * 360), shown("{:.1f}", one.amplitude_e));
    if (std::isfinite(one.calibrated_turns)) text += fmt::format("; calibrated {:.2f} deg", one.calibrated_turns * 360);
    if (std::isfinite(one.half_path_m))
      text += fmt::format("; half path {:.4f} m x ({:.0f} + {:.4f}) = {:.4f} m", one.half_wave_m, one.cycles, one.calibrated_turns,
                          one.half_path_m);
    text += "\n";
  }
  return text;
}

/// What unwrapping chose from: the best few.
std::string unwrapping_text(const PixelChain& p) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, p.candidates.size()); ++i) {
    const UnwrapCandidate& one = p.candidates[i];
    std::string cycles;
    for (const double n : one.cycles) cycles += fmt::format("{}{:.0f}", cycles.empty() ? "" : " + ", n);
    text += fmt::format("{:<12}cycles {}: range {} m, half paths {} mm apart{}\n", i == 0 ? "unwrapping" : "", cycles,
                        shown("{:.4f}", one.range_m), shown("{:.2f}", 1e3 * std::sqrt(one.cost_m2)), one.chosen ? ": chosen" : "");
  }
  return text;
}

std::string depth_text(const PixelChain& p, const results::Arrays& arrays) {
  std::string flags;
  for (const std::string& one : names_of_flags(static_cast<unsigned>(p.flags))) flags += (flags.empty() ? "" : ", ") + one;
  const bool none = std::isnan(p.range_m) && arrays.find("range_m") != nullptr;
  std::string text = fmt::format("depth       none{}{}\n", flags.empty() ? "" : ": ", flags);
  if (none && std::isfinite(p.noise_m)) {
    const bool above = p.noise_m > p.noise_threshold_m;
    text += fmt::format("            noise {:.2f} mm (1 sigma){}\n", 1e3 * p.noise_m,
                        above ? fmt::format(", above camera.decoding.noise_threshold: {:.6g} mm", 1e3 * p.noise_threshold_m) : "");
  }
  if (!none) {
    text =
        fmt::format("depth       range {} m, z {} m, point {} m\n", shown("{:.6f}", p.range_m), shown("{:.6f}", p.z_m), triple(p.point_m));
    const double error = p.range_m - p.true_range_m;
    text += fmt::format("            noise {} mm (1 sigma)", shown("{:.2f}", 1e3 * p.noise_m));
    if (std::isfinite(error)) text += fmt::format(", error {:+.2f} mm, {} sigma", 1e3 * error, shown("{:+.2f}", error / p.noise_m));
    text += "\n";
  }
  text += fmt::format("            amplitude {} e, ambient {} e, confidence {} of 255\n", shown("{:.1f}", p.amplitude_e),
                      shown("{:.1f}", p.ambient_e), shown("{:.0f}", p.confidence));
  return text + fmt::format("            flags: {}\n", arrays.find("flags") == nullptr ? "-" : flags.empty() ? "none" : flags);
}

/// What a dash can come from.
std::string missing_text(const results::Arrays& arrays) {
  std::string names;
  for (const results::ArrayRow& row : results::array_table()) {
    // Of these no dash comes: where they are not known nothing is said.
    if (row.name == "gt_mixed" || row.name == "gt_object_share" || row.name == "gt_direct_e" || row.name == "gt_indirect_e" ||
        row.name == "gt_multipath_m" || row.name == "gt_path_noise_m" || row.name == "gt_path_count" || row.name.starts_with("transient_"))
      continue;
    if (arrays.find(row.name) == nullptr) names += (names.empty() ? "" : ", ") + row.name;
  }
  return names.empty() ? "" : "\nnot in this file: " + names + "\n";
}

/// Whether the file has any array of these stages.
bool has_any(const results::Arrays& arrays, bool truth) {
  return std::any_of(results::array_table().begin(), results::array_table().end(), [&](const results::ArrayRow& row) {
    return (truth ? row.is_truth() && row.is_image() : row.from == "depth") && arrays.find(row.name) != nullptr;
  });
}

files::Json raw_json(const PixelChain& p) {
  files::Json list = files::Json::array();
  for (const ChainRawFrame& one : p.raw_frames) {
    files::Json json = files::Json::object();
    json.set("lit", one.lit)
        .set("modulation_frequency_hz", one.modulation_frequency_hz)
        .set("reference_phase_rad", one.reference_phase_rad);
    json.set("integration_time_s", one.integration_time_s)
        .set("signal_e", one.signal_e)
        .set("direct_e", one.direct_e)
        .set("indirect_e", one.indirect_e)
        .set("multipath_m", one.multipath_m)
        .set("path_noise_m", one.path_noise_m)
        .set("tap_a_e", one.tap_a_e)
        .set("tap_b_e", one.tap_b_e);
    list.push(std::move(json.set("difference_e", one.difference_e).set("raw_dn", one.code_dn)));
  }
  return list;
}

files::Json phases_json(const PixelChain& p) {
  files::Json list = files::Json::array();
  for (const ChainPhase& one : p.phases) {
    files::Json json = files::Json::object();
    json.set("modulation_frequency_hz", one.modulation_frequency_hz).set("amplitude_e", one.amplitude_e).set("noise_e", one.noise_e);
    json.set("measured_phase_rad", one.measured_turns * base::two_pi).set("calibrated_phase_rad", one.calibrated_turns * base::two_pi);
    list.push(std::move(json.set("half_wave_m", one.half_wave_m).set("cycles", one.cycles).set("half_path_m", one.half_path_m)));
  }
  return list;
}

files::Json unwrapping_json(const PixelChain& p) {
  constexpr std::size_t most = 8;
  files::Json list = files::Json::array();
  for (std::size_t i = 0; i < std::min(most, p.candidates.size()); ++i) {
    const UnwrapCandidate& one = p.candidates[i];
    files::Json json = files::Json::object();
    json.set("cycles", files::Json::list(one.cycles)).set("range_m", one.range_m);
    list.push(std::move(json.set("cost", one.cost_m2).set("chosen", one.chosen)));
  }
  const double ratio = p.candidates.size() < 2 ? std::nan("") : p.candidates[1].cost_m2 / p.candidates[0].cost_m2;
  return files::Json::object().set("candidates", std::move(list)).set("runner_up_ratio", ratio);
}

files::Json bounces_json(const PixelBounces& bounces) {
  if (!bounces.unknown.empty()) return {};
  files::Json list = files::Json::array();
  for (const BounceShare& one : bounces.shares) {
    files::Json json = files::Json::object();
    json.set("first", one.first).set("last", one.last).set("share", one.share);
    list.push(std::move(json.set("electrons_e", files::Json::list(one.electrons)).set("multipath_m", files::Json::list(one.multipath_m))));
  }
  return list;
}

}  // namespace

std::string pixel_text(const results::Arrays& arrays, const PixelChain& p, const PixelBounces& bounces) {
  std::string text = fmt::format("{}: pixel {}, {} of {} x {}\n\n", arrays.where(), p.u, p.v, arrays.width(), arrays.height());
  if (has_any(arrays, true))
    text += surface_text(p, run::object_name(arrays.meta(), p.object), arrays.find("gt_object_id") != nullptr) + "\n";
  text += raw_text(p) + "\n" + multipath_text(p, bounces) + phase_text(p) + unwrapping_text(p);
  if (has_any(arrays, false)) text += "\n" + depth_text(p, arrays);
  return text + missing_text(arrays);
}

files::Json pixel_json(const std::string& file, const files::Json& meta, const PixelChain& p, const PixelBounces& bounces) {
  files::Json truth = files::Json::object(), depth = files::Json::object();
  truth.set("object_id", p.object)
      .set("object", run::object_name(meta, p.object))
      .set("reflectivity", p.reflectivity)
      .set("range_m", p.true_range_m)
      .set("z_m", p.true_z_m);
  truth.set("position_m", files::Json::list(p.position_m)).set("normal", files::Json::list(p.normal)).set("incidence_rad", p.incidence_rad);
  truth.set("irradiance_w_m2", p.irradiance_w_m2).set("radiance_w_m2_sr", p.radiance_w_m2_sr).set("power_w", p.power_w);
  truth.set("object_share", p.object_share).set("mixed", p.mixed);
  depth.set("range_m", p.range_m).set("z_m", p.z_m).set("point_m", files::Json::list(p.point_m)).set("noise_m", p.noise_m);
  depth.set("amplitude_e", p.amplitude_e)
      .set("ambient_e", p.ambient_e)
      .set("confidence", p.confidence)
      .set("flags", files::Json::list(names_of_flags(static_cast<unsigned>(p.flags))));
  files::Json json = files::Json::object();
  json.set("file", file).set("pixel", files::Json::list(std::array{p.u, p.v})).set("truth", std::move(truth));
  json.set("raw_frames", raw_json(p)).set("bounces", bounces_json(bounces));
  if (!bounces.unknown.empty()) json.set("bounces_unknown", bounces.unknown);
  json.set("phases", phases_json(p));
  if (!p.candidates.empty()) json.set("unwrapping", unwrapping_json(p));
  return json.set("depth", std::move(depth));
}

}  // namespace tofray::app
