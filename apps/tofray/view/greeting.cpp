// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/greeting.h"

#include "base/version.h"
#include "view/wire.h"

namespace tofray::view {

using files::Json;

Scales scales_of(const Frame& frame) {
  Scales out{panes_of(frame), {}};
  for (const Pane& one : out.panes) out.ranges.emplace_back(one.array, *scale_json(frame, one.array));
  return out;
}

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
  return json;
}

}  // namespace tofray::view
