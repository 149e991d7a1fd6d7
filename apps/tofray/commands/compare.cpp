// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/compare.h"

#include <fmt/core.h>

#include <cmath>

#include "analysis/quality_metrics.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "commands/limits.h"
#include "files/atomic_file.h"
#include "files/json.h"
#include "pictures/difference_picture.h"
#include "run/input_kind.h"
#include "tofray/depth_file.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

constexpr std::string_view truth_end = ":truth";

/// One of the two: its depth, or its truth where that is all it has or what was asked for.
struct Side {
  std::string name;
  Depth depth;
};

Depth truth_of_file(const DepthFile& file) {
  if (file.truth.z_m.empty())
    throw Error(
        ErrorKind::bad_input,
        base::printable(file.file) +
            ": error: there is no ground truth in it\n  expected gt_z_m, which `tofray render` writes unless --arrays leaves it out, or "
            "another file to compare with");
  return depth_of(file.truth);
}

Side side_of(const std::string& word, const DepthFileOptions& how) {
  const bool truth = word.ends_with(truth_end);
  const std::string path = run::frame_in(truth ? word.substr(0, word.size() - truth_end.size()) : word, "compare");
  DepthFile file = load_depth(path, how);
  if (truth || file.depth.z_m.empty()) return {path + std::string(truth_end), truth_of_file(file)};
  return {path, std::move(file.depth)};
}

struct Compared {
  std::string a, b;
  Comparison comparison;
};

Compared compared(const Options& options) {
  const DepthFileOptions how{options.unit_m, options.intrinsics};
  CompareRequest request;
  request.region = options.region, request.range = options.quantity == "range", request.fit_shift = options.fit_shift,
  request.distances_m = options.at_m;
  const std::string& first = options.words[0];
  const Side a = side_of(first, how), b = side_of(options.words.size() > 1 ? options.words[1] : first + std::string(truth_end), how);
  return {a.name, b.name, compare(a.depth, b.depth, request)};
}

/// What limits can be said of, in the order of the tables.
std::vector<Measured> measured_of(const Comparison& of) {
  std::vector<Measured> out;
  const auto take = [&](const std::string& prefix, const Differences& from, const char* needs) {
    for (const analysis::DifferenceColumn& one : analysis::difference_columns())
      out.push_back({prefix + one.name, from.*(one.member), false, needs});
  };
  take("", of.all, "pixels with a depth in both"), take("flat_", of.flats, "flat pixels with a depth in both"),
      take("edge_", of.edges, "pixels at edges with a depth in both");
  const auto pixels = static_cast<double>(of.pixels);
  out.push_back({"both_percent", 100 * static_cast<double>(of.both) / pixels, true, ""});
  out.push_back({"only_a_percent", 100 * static_cast<double>(of.only_a) / pixels, false, ""});
  out.push_back({"only_b_percent", 100 * static_cast<double>(of.only_b) / pixels, false, ""});
  out.push_back({"shift_m", of.shift_m, false, ""});
  out.push_back({"chi2", of.chi2, false, "noise_m in A or B, and range_m in both"});
  out.push_back({"amplitude_correlation", of.amplitude_correlation, true, "amplitude_e in both"});
  return out;
}

std::string row_of(const std::string& name, const Differences& of) {
  const auto mm = [](double value) { return std::isnan(value) ? std::string("-") : fmt::format("{:.4g}", 1e3 * value); };
  return fmt::format("  {:<26} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", name, of.pixels, mm(of.bias_m), mm(of.median_m),
                     mm(of.sigma_m), mm(of.spread_m), mm(of.rmse_m), mm(of.p50_m), mm(of.p95_m), mm(of.p99_m));
}

std::string text_of(const Compared& of) {
  const Comparison& c = of.comparison;
  const auto share = [&](std::int64_t count) {
    return fmt::format("{} ({:.1f} %)", count, 100 * static_cast<double>(count) / static_cast<double>(c.pixels));
  };
  std::string text =
      fmt::format("A {}\nB {}\n{} of columns {} to {}, rows {} to {}: depth in both {}, only in A {}, only in B {}, in none {}\n", of.a,
                  of.b, c.range ? "range" : "z", c.region.u, c.region.u + c.region.width - 1, c.region.v, c.region.v + c.region.height - 1,
                  share(c.both), share(c.only_a), share(c.only_b), share(c.neither));
  if (c.shift_m != 0) text += fmt::format("taken off A: {:.4g} mm\n", 1e3 * c.shift_m);
  text += fmt::format("\n  {:<26} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "A - B, mm", "pixels", "bias", "median",
                      "sigma", "spread", "rmse", "p50", "p95", "p99");
  text += row_of("all", c.all) + row_of("flat", c.flats) + row_of("at edges", c.edges);
  for (const DifferencesAt& one : c.by_distance) text += row_of(fmt::format("{:.4g} to {:.4g} m", one.low_m, one.high_m), one.of);
  for (const DifferencesOfFlag& one : c.by_flag)
    if (one.of.pixels > 0) text += row_of(one.flag, one.of);
  for (const DifferencesOfFlag& one : c.by_flag)
    if (one.only_in_a + one.only_in_b > 0)
      text += fmt::format("  {:<26} only in A {}, only in B {}\n", one.flag, one.only_in_a, one.only_in_b);
  if (!std::isnan(c.chi2))
    text += fmt::format(
        "\nchi2 of noise_m {:.3f} +- {:.3f}, {} flat pixels without {} outliers: 1 where noise_m is the noise and there is no bias\n",
        c.chi2, c.chi2_error, c.chi2_pixels, c.chi2_outliers);
  if (!std::isnan(c.amplitude_correlation)) text += fmt::format("correlation of the amplitudes {:.4f}\n", c.amplitude_correlation);
  return text;
}

files::Json number_or_null(double value) { return std::isnan(value) ? files::Json() : files::Json(value); }

files::Json json_of(const Differences& of) {
  files::Json out = files::Json::object();
  out.set("pixels", of.pixels);
  for (const analysis::DifferenceColumn& one : analysis::difference_columns()) out.set(one.name, number_or_null(of.*(one.member)));
  return out;
}

std::string json_of(const Compared& of) {
  const Comparison& c = of.comparison;
  files::Json distances = files::Json::array(), flags = files::Json::array(), json = files::Json::object();
  for (const DifferencesAt& one : c.by_distance) distances.push(json_of(one.of).set("low_m", one.low_m).set("high_m", one.high_m));
  for (const DifferencesOfFlag& one : c.by_flag)
    flags.push(json_of(one.of).set("flag", one.flag).set("only_a", one.only_in_a).set("only_b", one.only_in_b));
  json.set("a", of.a)
      .set("b", of.b)
      .set("quantity", c.range ? "range" : "z")
      .set("region", files::Json::list(std::vector<int>{c.region.u, c.region.v, c.region.width, c.region.height}))
      .set("pixels", c.pixels)
      .set("both", c.both)
      .set("only_a", c.only_a)
      .set("only_b", c.only_b)
      .set("neither", c.neither)
      .set("shift_m", c.shift_m)
      .set("all", json_of(c.all))
      .set("flats", json_of(c.flats))
      .set("edges", json_of(c.edges))
      .set("by_distance", std::move(distances))
      .set("by_flag", std::move(flags))
      .set("chi2", number_or_null(c.chi2))
      .set("chi2_error", number_or_null(c.chi2_error))
      .set("chi2_pixels", c.chi2_pixels)
      .set("chi2_outliers", c.chi2_outliers)
      .set("amplitude_correlation", number_or_null(c.amplitude_correlation))
      .set("histogram", files::Json::object()
                            .set("low_m", c.histogram_low_m)
                            .set("step_m", c.histogram_step_m)
                            .set("pixels", files::Json::list(c.histogram)));
  return files::json_text(json, 2) + "\n";
}

std::string csv_of(const Comparison& c) {
  std::string text = "of,low_m,high_m,pixels";
  for (const analysis::DifferenceColumn& one : analysis::difference_columns()) text += fmt::format(",{}", one.name);
  text += "\n";
  const auto line = [&](const std::string& begin, const Differences& of) {
    text += fmt::format("{},{}", begin, of.pixels);
    for (const analysis::DifferenceColumn& one : analysis::difference_columns()) {
      const double value = of.*(one.member);
      text += "," + (std::isnan(value) ? std::string() : base::number_text(value));
    }
    text += "\n";
  };
  line("all,,", c.all), line("flat,,", c.flats), line("edge,,", c.edges);
  for (const DifferencesAt& one : c.by_distance)
    line("distance," + base::number_text(one.low_m) + "," + base::number_text(one.high_m), one.of);
  for (const DifferencesOfFlag& one : c.by_flag) line(one.flag + ",,", one.of);
  return text;
}

}  // namespace

int run_compare(const Options& options) {
  const Compared of = compared(options);
  const std::string beyond = beyond_limits(measured_of(of.comparison), options.limits);
  const std::string& file = options.output;
  if (file.ends_with(".json"))
    files::write_file_atomically(file, json_of(of));
  else if (file.ends_with(".csv"))
    files::write_file_atomically(file, csv_of(of.comparison));
  else if (!file.empty())
    files::write_file_atomically(
        file, pictures::difference_picture(of.comparison, fmt::format("A {}   B {}", base::printable(of.a), base::printable(of.b)),
                                           {options.theme, options.scale, *pictures::format_of(file)}));
  if (options.json)
    print(json_of(of));
  else if (options.csv)
    print(csv_of(of.comparison));
  else
    print(text_of(of));
  say(beyond);
  return beyond.empty() ? 0 : 1;
}

}  // namespace tofray::app
