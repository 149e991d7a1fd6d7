// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/option_values.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/units.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

void take_region(Options& o, const std::string& value) {
  std::vector<int> numbers(4);
  if (!numbers_of(value, numbers) || numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 1 || numbers[3] < 1)
    refuse("--region", value, "column,row,width,height in pixels counted from 0, as in --region 92,66,40,40");
  o.region = {numbers[0], numbers[1], numbers[2], numbers[3]};
}

void take_intrinsics(Options& o, const std::string& value) {
  std::vector<double> numbers(4);
  if (!numbers_of(value, numbers) || !(numbers[0] > 0) || !(numbers[1] > 0) || !std::isfinite(numbers[2] + numbers[3]))
    refuse("--intrinsics", value, "fx,fy,cx,cy in pixels, as in --intrinsics 211.5,212.25,112.75,84.5");
  o.intrinsics = {numbers[0], numbers[1], numbers[2], numbers[3]};
}

void take_unit(Options& o, const std::string& value) { o.unit_m = length_of("--unit", value, 1e-9, 1e3, "1mm"); }

void take_limit(Options& o, const std::string& value) {
  for (const std::string& part : split(value, ',')) {
    const std::size_t equals = part.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == part.size())
      refuse("--limit", part, "NAME=VALUE, as in --limit bias=5mm,sigma=10mm");
    o.limits.emplace_back(part.substr(0, equals), part.substr(equals + 1));
  }
}

void take_preset(Options& o, const std::string& value) {
  std::vector<std::string> names;
  for (const QualityPreset& one : quality_presets()) names.push_back(one.name);
  if (std::find(names.begin(), names.end(), value) == names.end()) refuse("--as", value, base::listed(names));
  o.like = value;
}

void take_quantity(Options& o, const std::string& value) {
  if (value != "z" && value != "range") refuse("--quantity", value, "z (along the optical axis) or range (along the pixel's ray)");
  o.quantity = value;
}

void take_shift(Options& o, const std::string& value) {
  if (value != "none" && value != "fit") refuse("--shift", value, "none, or fit: the median difference is taken off A");
  o.fit_shift = value == "fit";
}

void take_comparison_file(Options& o, const std::string& value) {
  if (!value.ends_with(".csv") && !value.ends_with(".json") && !pictures::format_of(value))
    refuse("-o", value, "a name that ends in .png, .svg, .pdf, .csv or .json, as in -o map.png");
  o.output = value;
}

}  // namespace

std::vector<OptionSpec> measuring_specs() {
  return {
      {"--region", 0, "U,V,W,H", "only W x H pixels from column U, row V on (the whole image)", take_region},
      {"--as", 0, "MAKER", "region, frames and target as a maker measures: realsense, basler, vzense, azure, adtf3175", take_preset,
       "realsense basler vzense azure adtf3175"},
      {"--truth", 0, "LENGTH", "true z of the wall on the optical axis (what the file's ground truth says)",
       [](Options& o, const std::string& v) { o.truth_m = length_of("--truth", v, 1e-3, 1e5); }},
      {"--unit", 0, "LENGTH", "length of a file's 1 (1mm of .png, 1m of others)", take_unit},
      {"--intrinsics", 0, "FX,FY,CX,CY", "pinhole in pixels, for points of an image of z alone", take_intrinsics},
      {"--limit", 0, "NAME=VALUE", "exit code 1 where the number of that name is beyond: bias=5mm,p95=2cm; as often as you like",
       take_limit},
      {"--quantity", 0, "NAME", "z or range (z)", take_quantity, "z range"},
      {"--shift", 0, "KIND", "none; fit: the median difference is taken off A first (none)", take_shift, "none fit"},
      {"--distance", 0, "LENGTHS", "bounds of the classes by distance: 0.5m,1m,2m or 0.5m:4.5m:9 (eight classes)",
       [](Options& o, const std::string& v) { add_distances("--distance", o, v); }, "", false, "compare"},
      {"--output", 'o', "FILE", "file to write: .csv or .json; without it a table on stdout", take_budget_file, "<files>", false,
       "quality"},
      {"--output", 'o', "FILE", "file to write: map and histogram as .png, .svg or .pdf, or .csv or .json", take_comparison_file, "<files>",
       false, "compare"},
  };
}

}  // namespace tofray::app
