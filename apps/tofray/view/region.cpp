// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/region.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/quality_metrics.h"
#include "analysis/samples.h"
#include "pictures/pictures.h"
#include "tofray/error.h"
#include "tofray/quality.h"

namespace tofray::view {

namespace {

using files::Json;

/// The unit that a name ends in.
const char* unit_of(std::string_view name) {
  for (const auto& [ending, unit] :
       {std::pair<std::string_view, const char*>{"_percent", "%"}, {"_rad", "rad"}, {"_px", "px"}, {"_m", "m"}, {"_e", "e"}})
    if (name.ends_with(ending)) return unit;
  return "1";
}

Json row_json(const std::string& name, double value, const std::string& definition, const char* needs) {
  Json out = Json::object();
  out.set("name", name).set("value", value).set("unit", unit_of(name)).set("definition", definition);
  if (std::isnan(value)) out.set("needs", needs);
  return out;
}

void check_region(const Depth& depth, const RegionQuestion& r) {
  if (r.u1 >= depth.width || r.v1 >= depth.height)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("error: the pixels {},{} to {},{} are no part of the image\n  expected columns of 0 to {} and rows of 0 to {}, the "
                    "smaller one first",
                    r.u0, r.v0, r.u1, r.v1, depth.width - 1, depth.height - 1));
}

}  // namespace

void put_region(Json& json, const Frame& frame, const RegionQuestion& r) {
  const Depth& depth = frame.depth;
  check_region(depth, r);
  const ImageRegion region{r.u0, r.v0, r.u1 - r.u0 + 1, r.v1 - r.v0 + 1};
  const std::vector<std::size_t> pixels = analysis::pixels_of(region, depth.width);
  std::vector<double> noise;
  std::size_t valid = 0;
  for (const std::size_t pixel : pixels)
    if (analysis::has_depth(depth, pixel)) ++valid, noise.push_back(depth.noise_m[pixel]);
  std::optional<Quality> measured;
  const bool known = !frame.truth.z_m.empty() && !frame.truth.range_m.empty() && !frame.truth.position_m.empty();
  const Depth truth = known ? depth_of(frame.truth) : Depth();
  if (valid > 0) measured = quality({depth}, {region, {}, 0}, known ? &truth : nullptr);
  Json rows = Json::array();
  for (const analysis::QualityMetric& one : analysis::quality_metrics()) {
    const bool fills = one.member == &Quality::fill_rate_percent;
    const double value = measured ? *measured.*(one.member) : fills ? 0 : analysis::unknown;
    rows.push(row_json(one.name, value, one.what, measured ? one.needs : "pixels with a depth"));
  }
  rows.push(row_json("noise_median_m", analysis::median_of(std::move(noise)),
                     "median of the valid pixels' noise_m, as the camera estimates it", "pixels with a depth"));
  for (const pictures::FlagRow& flag : pictures::flag_table()) {
    const auto set = std::count_if(pixels.begin(), pixels.end(), [&](std::size_t pixel) { return (depth.flags[pixel] & flag.bit) != 0; });
    rows.push(row_json(fmt::format("flag_{}_percent", flag.name), 100 * static_cast<double>(set) / static_cast<double>(pixels.size()),
                       fmt::format("pixels with the flag: {}", flag.what), ""));
  }
  json.set("region", Json::list(std::array{r.u0, r.v0, r.u1, r.v1})).set("pixels", pixels.size()).set("valid", valid);
  json.set("rows", std::move(rows));
}

}  // namespace tofray::view
