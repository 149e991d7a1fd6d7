// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/export.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/base64.h"
#include "cli/requests.h"
#include "files/deflate.h"
#include "results/array_table.h"
#include "tofray/error.h"
#include "view/answer_arrays.h"
#include "view/assets.h"
#include "view/greeting.h"
#include "view/scene_3d.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

using files::Json;

constexpr std::string_view place_of_data = "<!--tofray-data-->";
constexpr std::size_t most_page_bytes = 200'000'000, most_saved_text = 900'000;

/// JSON within an element of HTML: no character ends it.
std::string within_html(const std::string& json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) c == '<' ? out += "\\u003c" : out += c;
  return out;
}

std::string block(const char* attributes, std::string_view bytes) {
  return fmt::format("<script type=\"application/octet-stream\" {}>{}</script>\n", attributes, base::base64(files::zlib_stream(bytes)));
}

const Asset& page() {
  const Asset* found = find_asset("/export.html");
  if (found == nullptr)
    throw Error(ErrorKind::device,
                "error: this tofray was built without the viewer's page: npm was not there\n"
                "  ./dev view installs nodejs and npm, builds again and opens it");
  if (found->bytes.find(place_of_data) == std::string_view::npos) throw Error(ErrorKind::bug, "error: the page has no place for frames");
  return *found;
}

/// The arrays that go into the file: unless told, those of all panes and of the raw frames, but not the taps, which are large.
std::vector<std::uint16_t> arrays_of(const Scales& scales, const std::string& words) {
  const std::optional<results::ArrayChoice> chosen = words.empty() ? std::nullopt : std::optional(results::ArrayChoice(words));
  std::vector<std::uint16_t> out;
  for (std::uint16_t i = 0; i < wire_arrays().size(); ++i) {
    const WireArray& one = wire_arrays()[i];
    const std::string_view name = one.name;
    const results::ArrayRow* row = results::find_array(std::string(name));
    const bool of_pane = std::any_of(scales.panes.begin(), scales.panes.end(), [&](const Pane& pane) { return name == pane.array; });
    const bool list = one.shape == ArrayShape::list;
    const bool wanted = !chosen ? of_pane || name == "raw" : row != nullptr && chosen->has(*row);
    const bool of_both =
        chosen && row == nullptr && chosen->has(*results::find_array("z_m")) && chosen->has(*results::find_array("gt_z_m"));
    if (wanted || list || of_both || name == "flags") out.push_back(i);
  }
  return out;
}

void refuse_large(std::size_t one_frame, const ExportRequest& request, std::size_t rest) {
  if (one_frame * request.frames + rest <= most_page_bytes) return;
  const std::size_t fit = rest < most_page_bytes ? (most_page_bytes - rest) / one_frame : 0;
  throw Error(
      ErrorKind::limit,
      fmt::format("error: {} frames of {:.1f} MB make a page of {:.0f} MB, and browsers open 200 MB well\n  expected {}fewer arrays, "
                  "as in --arrays z_m,flags",
                  request.frames, 1e-6 * static_cast<double>(one_frame), 1e-6 * static_cast<double>(one_frame * request.frames + rest),
                  fit > 0 ? fmt::format("--frames {} at most, or ", fit) : std::string()));
}

Json scales_json(const Scales& of) {
  Json out = Json::array();
  for (const auto& [array, scale] : of.ranges)
    if (!scale.is_null()) out.push(Json::object().set("array", array).set("scale", scale));
  return out;
}

/// What the page is told besides the frames, in the order in which it is written.
struct Contents {
  Json hello, numbers = Json::array(), scales = Json::array(), drawings = Json::array();
};

std::string text_of(const State& state, Contents contents) {
  Json json = Json::object();
  json.set("format", 1).set("hello", std::move(contents.hello)).set("frames", std::move(contents.numbers)).set("encoding", "deflate");
  json.set("scales", std::move(contents.scales)).set("live", shell_text(live_words(state)));
  if (!contents.drawings.items()->empty()) json.set("view3d", std::move(contents.drawings));
  const Saved file = state.recorded ? Saved() : saved(state);
  Json save = Json::object().set("type", "saved").set("id", 0).set("side", "a").set("name", file.name).set("text", file.text);
  save.set("command", file.command);
  if (file.text.empty() || file.text.size() > most_saved_text)
    json.set("saved", nullptr);
  else
    json.set("saved", std::move(save));
  std::string text = files::json_text(json);
  text.back() = ',';
  const bool controlled = !state.recorded || state.recorded->live();
  return text + "\"controls\":" + (controlled ? controls_text(state, {Query::Kind::controls, 0, Side::a}) : "null") + "}";
}

}  // namespace

std::string exported_page(const State& live, const ExportRequest& request) {
  const Asset& around = page();
  State state = live;
  state.generation = 1, state.playing = false, state.frame = request.first;
  SimulatorOptions wanted = app::simulator_options(state.options);
  wanted.progress = request.progress;
  std::optional<Simulator> simulator;
  if (!state.recorded) simulator.emplace(state.in.scene, state.in.camera, wanted);
  const bool drawable = why_not(state, "view3d").empty();
  if (state.recorded && request.first + request.frames > state.recorded->count())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: frames {} to {} were asked for, and there are those from 0 to {}\n  expected --first-frame and "
                            "--frames within these",
                            request.first, request.first + request.frames - 1, state.recorded->count() - 1));
  Contents contents;
  std::string blocks, drawn;
  std::vector<std::uint16_t> arrays;
  std::optional<Geometry> geometry;
  Frame frame;
  for (std::uint64_t i = 0; i < request.frames; ++i) {
    const std::uint64_t index = request.first + i;
    if (simulator)
      simulator->frame(index, frame);
    else
      frame = state.recorded->frame(index, state.in.camera, wanted);
    if (request.progress != nullptr && request.progress->stop) throw Error(ErrorKind::bad_input, "error: it was given up");
    const Scales scales = scales_of(frame);
    const SceneAt at{state.in.scene, state.in.camera, state.options.set, frame.truth.time_s};
    const double hz = state.in.camera.mode.frame_rate_hz, time_s = hz > 0 ? static_cast<double>(index) / hz : 0;
    if (i == 0) {
      arrays = arrays_of(scales, request.arrays);
      contents.hello = greeting(state, nullptr, scales, assets_sha256());
      if (drawable) geometry = geometry_of(at);
      if (drawable) drawn = block("id=\"tofray-static\"", drawing_bytes({2, 0, 1, 0, time_s, 0}, index, *geometry));
    }
    const std::string one =
        block("class=\"tofray-frame\"", encoded({0, 0, 1, static_cast<std::uint32_t>(i + 1), time_s, 0}, frame, arrays));
    if (i == 0) refuse_large(one.size(), request, around.bytes.size() + drawn.size());
    blocks += one;
    contents.numbers.push(index), contents.scales.push(scales_json(scales));
    if (request.done) request.done(i + 1);
    if (!drawable) continue;
    Json drawing = Json::object().set("type", "view3d").set("id", 0).set("side", "a").set("generation", 1).set("frame", index);
    drawing.set("static", i == 0);
    if (i == 0) drawing.set("arrays", Json::list(drawing_arrays));
    put_scene(drawing, at, *geometry);
    contents.drawings.push(std::move(drawing));
  }
  const std::string text = within_html(text_of(state, std::move(contents)));
  const std::size_t place = around.bytes.find(place_of_data);
  std::string out;
  out.reserve(around.bytes.size() + text.size() + drawn.size() + blocks.size() + 100);
  out.append(around.bytes.substr(0, place));
  out.append("<script type=\"application/json\" id=\"tofray-export\">").append(text).append("</script>\n").append(drawn).append(blocks);
  out.append(around.bytes.substr(place + place_of_data.size()));
  return out;
}

std::vector<std::string> export_words(const State& state, const ExportRequest& request, const std::string& file) {
  std::vector<std::string> out = live_words(state);
  const std::vector<std::string> more{
      "--export", file, "--first-frame", std::to_string(request.first), "--frames", std::to_string(request.frames)};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

}  // namespace tofray::view
