// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/control.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/text.h"
#include "files/json.h"
#include "tofray/error.h"
#include "view/fields.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

using files::Json;
using namespace fields;

constexpr std::size_t most_values = 10'000, most_key = 1000;
constexpr std::uint64_t most_frame = 1'000'000'000;
constexpr double least_rate = 0.01, most_rate = 1000;

std::uint16_t array_of(const Json& name) {
  if (!name.is_string()) throw Fault{"the name of an array is no text", ""};
  if (const auto found = find_wire_array(*name.string())) return *found;
  std::vector<std::string> known;
  for (const WireArray& one : wire_arrays()) known.emplace_back(one.name);
  throw Fault{"no array is called " + base::in_quotes(*name.string()) + base::did_you_mean(*name.string(), known),
              "`tofray list arrays` names them"};
}

Rate rate_of(const Json& json) {
  Rate out{Rate::Kind::number, 0};
  if (json.is_string()) {
    if (const auto named = parse_rate(*json.string())) return *named;
  } else if (json.number(out.hz) && out.hz >= least_rate && out.hz <= most_rate) {
    return out;
  }
  throw Fault{"\"rate\" is none of own, max, or a number of 0.01 to 1000", ""};
}

Want want_of(const Json& message) {
  Want out;
  const Json& arrays = member(message, "arrays");
  if (!arrays.is_array()) throw Fault{"\"arrays\" is no list", ""};
  for (const Json& one : *arrays.items()) out.arrays.push_back(array_of(one));
  std::sort(out.arrays.begin(), out.arrays.end());
  out.arrays.erase(std::unique(out.arrays.begin(), out.arrays.end()), out.arrays.end());
  if (const Json* rate = message.find("rate")) out.rate = rate_of(*rate);
  return out;
}

std::string key_of(const Json& message) {
  std::string key = text_of(message, "key");
  if (key.empty() || key.size() > most_key || key.find('=') != std::string::npos)
    throw Fault{base::in_quotes(key) + " is no key", "expected a key of --set, as in camera.lens.f_number"};
  return key;
}

Edit edit_of(const Json& message, Edit::Kind kind) {
  Edit out;
  out.kind = kind, out.id = id_of(message), out.side = side_of(message);
  out.key = key_of(message);
  if (kind == Edit::Kind::set) out.text = text_of(message, "text");
  return out;
}

Edit seed_of(const Json& message) {
  Edit out;
  out.kind = Edit::Kind::seed, out.id = id_of(message), out.side = side_of(message), out.seed = whole(message, "seed", UINT64_MAX);
  return out;
}

/// What sets a state as a whole: each key once.
Edit state_of(const Json& message, Edit::Kind kind) {
  Edit out;
  out.kind = kind, out.id = id_of(message);
  out.side = kind == Edit::Kind::open ? Side::b : side_of(message);
  if (message.find("seed") != nullptr) out.seed = whole(message, "seed", UINT64_MAX);
  const Json& overrides = member(message, "overrides");
  if (!overrides.is_array()) throw Fault{"\"overrides\" is no list", ""};
  for (const Json& one : *overrides.items()) {
    if (!one.is_object()) throw Fault{"one of \"overrides\" is no JSON object", R"(expected {"key": …, "text": …})"};
    out.overrides.emplace_back(key_of(one), text_of(one, "text"));
  }
  return out;
}

Edit other_of(const Json& message) {
  if (member(message, "overrides").is_null()) {
    Edit out;
    out.kind = Edit::Kind::close, out.id = id_of(message), out.side = Side::b;
    return out;
  }
  Edit out = state_of(message, Edit::Kind::open);
  if (message.find("scene") == nullptr) return out;
  out.scene = text_of(message, "scene");
  if (out.scene.empty() || out.scene.size() > most_key) throw Fault{base::in_quotes(out.scene) + " is no scene's name", ""};
  return out;
}

Acknowledge acknowledge_of(const Json& message) {
  Acknowledge out{static_cast<std::uint32_t>(whole(message, "sequence", UINT32_MAX)), Side::a};
  if (message.find("channel") != nullptr) out.side = whole(message, "channel", 1) == 1 ? Side::b : Side::a;
  return out;
}

PixelQuestion pixel_of(const Json& message) {
  return {id_of(message), static_cast<int>(whole(message, "u", most_pixel)), static_cast<int>(whole(message, "v", most_pixel)),
          side_of(message)};
}

WhyQuestion why_of(const Json& message) {
  constexpr int most_side = 64;
  WhyQuestion out;
  const Json* region = message.find("region");
  out.id = id_of(message), out.side = side_of(message), out.region = region != nullptr;
  if (region == nullptr) {
    const PixelQuestion pixel = pixel_of(message);
    out.u0 = out.u1 = pixel.u, out.v0 = out.v1 = pixel.v;
    return out;
  }
  if (message.find("u") != nullptr || message.find("v") != nullptr)
    throw Fault{"the message has a pixel and a region", "expected one of them"};
  const std::array<int, 4> corners = corners_of(*region);
  out.u0 = corners[0], out.v0 = corners[1], out.u1 = corners[2], out.v1 = corners[3];
  if (out.u1 - out.u0 >= most_side || out.v1 - out.v0 >= most_side)
    throw Fault{"\"region\" is of more than 64 x 64 pixels", "expected a smaller one"};
  return out;
}

Order order_of(const Json& message, Order::Kind kind) {
  constexpr std::uint64_t most_recorded = 10'000;
  Order out;
  out.kind = kind, out.id = id_of(message);
  if (kind == Order::Kind::stop) return out;
  out.side = side_of(message), out.first = whole(message, "first", most_frame), out.frames = whole(message, "frames", most_recorded);
  if (out.frames == 0) throw Fault{"no frame was asked for", "expected \"frames\" of 1 to 10000"};
  return out;
}

Control control_of(const Json& message) {
  const std::string type = text_of(message, "type");
  if (type == "want") return want_of(message);
  if (type == "visible") return Visible{truth_of(message, "visible")};
  if (type == "ack") return acknowledge_of(message);
  if (type == "play" || type == "pause") return Play{type == "play"};
  if (type == "seek") return Seek{whole(message, "frame", most_frame)};
  if (type == "pixel") return pixel_of(message);
  if (type == "why") return why_of(message);
  if (type == "fit") return Fit{text_of(message, "array")};
  if (type == "set" || type == "unset") return edit_of(message, type == "set" ? Edit::Kind::set : Edit::Kind::unset);
  if (type == "seed") return seed_of(message);
  if (type == "state") return state_of(message, Edit::Kind::state);
  if (type == "other") return other_of(message);
  if (type == "controls" || type == "save")
    return Query{type == "save" ? Query::Kind::save : Query::Kind::controls, id_of(message), side_of(message)};
  if (type == "record") return order_of(message, Order::Kind::record);
  if (type == "export") return order_of(message, Order::Kind::page);
  if (type == "record_stop") return order_of(message, Order::Kind::stop);
  if (auto inquiry = inquiry_of(type, message)) return std::move(*inquiry);
  throw Fault{"no message is of the type " + base::in_quotes(type),
              "expected ack, camera, controls, drag, export, fit, measure, other, pause, pixel, place, play, record, record_stop, region, "
              "restore, save, screenshot, seed, seek, set, state, temporal, unset, view3d, visible, want or why"};
}

}  // namespace

std::optional<Rate> parse_rate(std::string_view text) {
  if (text == "own") return Rate{Rate::Kind::own, 0};
  if (text == "max") return Rate{Rate::Kind::most, 0};
  Rate out{Rate::Kind::number, 0};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), out.hz);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size() || !(out.hz >= least_rate && out.hz <= most_rate)) return {};
  return out;
}

Control parse_control(std::string_view text) {
  Refused refused;
  try {
    const Json message = files::parse_json(text, "message", most_values);
    if (!message.is_object()) return Refused{{}, "the message is no JSON object", ""};
    std::uint64_t id = 0;
    if (const Json* named = message.find("id"); named != nullptr && named->unsigned_integer(id)) refused.id = id;
    return control_of(message);
  } catch (const Fault& fault) {
    refused.text = fault.text, refused.more = fault.more;
  } catch (const Error& error) {
    const std::string all = error.what();
    const std::size_t end = std::min(all.find('\n'), all.size());
    refused.text = all.substr(0, end);
    if (const std::size_t more = all.find_first_not_of(" \n", end); more != std::string::npos) refused.more = all.substr(more);
  }
  return refused;
}

}  // namespace tofray::view
