// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/greeting.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "base/version.h"
#include "view/wire.h"

namespace tofray::view {

using files::Json;

Scales scales_of(const Frame& frame) {
  Scales out{panes_of(frame), {}};
  for (const Pane& one : out.panes) out.ranges.emplace_back(one.array, *scale_json(frame, one.array));
  return out;
}

namespace {

/// What files have and have not.
void put_files(Json& json, const State& state, const Scales& scales) {
  const Recorded& files = *state.recorded;
  json.set("source", Json::object().set("kind", "files").set("name", files.path()).set("raw", files.live())).set("frames", files.count());
  Json absent = Json::array(), reasons = Json::object();
  for (const Pane& one : all_panes()) {
    const std::string_view array = one.array;
    const auto same = [&](const Pane& pane) { return array == pane.array; };
    if (std::any_of(scales.panes.begin(), scales.panes.end(), same)) continue;
    const bool of_truth = array.starts_with("gt_") || array == "z_error_m";
    const std::string why = of_truth ? "The files have no ground truth for it" : fmt::format("The files have no {}", array);
    absent.push(Json::object().set("array", array).set("title", one.title).set("why", why));
  }
  for (const auto& [type, why] : cannot(state)) reasons.set(type, why);
  json.set("absent", std::move(absent)).set("cannot", std::move(reasons));
}

}  // namespace

Json greeting(const State& state, const State* other, const Scales& scales, const std::string& build) {
  Json arrays = Json::array(), panes = Json::array();
  for (const WireArray& one : wire_arrays()) {
    Json json = Json::object();
    json.set("name", one.name).set("unit", one.unit).set("what", one.what).set("dtype", one.type);
    arrays.push(std::move(json.set("shape", shape_name(one.shape))));
  }
  for (std::size_t i = 0; i < scales.panes.size(); ++i)
    panes.push(
        Json::object().set("array", scales.panes[i].array).set("title", scales.panes[i].title).set("scale", scales.ranges[i].second));
  Json json = Json::object();
  json.set("type", "hello").set("protocol", 2).set("version", base::version()).set("build", build);
  json.set("arrays", std::move(arrays)).set("panes", std::move(panes)).set("palettes", palettes_json());
  json.set("invalid", invalid_json()).set("invalid_color", invalid_color_json());
  put_state(json, state, other);
  if (state.recorded) put_files(json, state, scales);
  return json;
}

}  // namespace tofray::view
