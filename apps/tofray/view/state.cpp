// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/state.h"

#include <algorithm>

#include "base/readout.h"
#include "load/builtin.h"
#include "requests.h"
#include "results/meta.h"
#include "tofray/load.h"

namespace tofray::view {

namespace {

using files::Json;

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=:,+@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

State first_state(const app::Options& options) {
  State state;
  state.options = options;
  if (state.options.words.empty()) state.options.words.emplace_back("demo");
  std::string& scene = state.options.words[0];
  if (load::find_builtin(load::builtin_scenes(), scene) == nullptr && load::find_builtin(load::builtin_profiles(), scene) != nullptr) {
    // The mode that the scene names is of another camera.
    const Camera camera = load_camera(scene);
    state.options.set.insert(state.options.set.begin(), {{"camera.profile", scene}, {"camera.mode", camera.mode.name}});
    scene = "demo";
  }
  state.in = run::load(app::input_request(scene, state.options));
  return state;
}

State changed(const State& before, const Edit& edit) {
  State state;
  state.options = before.options;
  state.generation = before.generation + 1, state.frame = before.frame, state.playing = before.playing;
  auto& set = state.options.set;
  if (edit.key.empty()) {
    state.options.seed = edit.seed;
  } else {
    const auto same = [&](const auto& one) { return one.first == edit.key; };
    const auto found = std::find_if(set.rbegin(), set.rend(), same);
    if (!edit.text)
      std::erase_if(set, same);
    else if (found != set.rend())
      found->second = *edit.text;
    else
      set.emplace_back(edit.key, *edit.text);
  }
  state.in = run::load(app::input_request(state.options.words[0], state.options));
  return state;
}

std::string command_of(const State& state) {
  const app::Options& o = state.options;
  std::string out = "tofray render " + quoted(o.words[0]);
  if (!o.root.empty()) out += " --root " + quoted(o.root);
  if (!o.mode.empty()) out += " --mode " + quoted(o.mode);
  if (o.seed) out += " --seed " + std::to_string(*o.seed);
  if (o.noise) out += std::string(" --noise ") + results::noise_name(*o.noise);
  if (o.exposure_samples) out += " --exposure-samples " + std::to_string(*o.exposure_samples);
  if (o.subpixel) out += " --subpixel " + std::to_string(*o.subpixel);
  for (const auto& [key, value] : o.set) out += " --set " + quoted(key + "=" + value);
  if (!state.playing && state.frame > 0) out += " --first-frame " + std::to_string(state.frame);
  return out;
}

void put_camera(Json& json, const State& state) {
  const Camera& camera = state.in.camera;
  const Sensor sensor = base::as_read_out(camera).sensor;
  json.set("scene", state.in.scene.name).set("camera", camera.name).set("mode", camera.mode.name);
  json.set("width", sensor.width).set("height", sensor.height).set("phases", camera.mode.sequence.size());
  json.set("frame_rate_hz", camera.mode.frame_rate_hz);
}

std::string state_text(const State& state) {
  Json overrides = Json::array();
  for (const auto& [key, value] : state.options.set) overrides.push(Json::array().push(key).push(value));
  Json json = Json::object();
  json.set("type", "state").set("generation", state.generation).set("playing", state.playing).set("frame", state.frame);
  json.set("overrides", std::move(overrides)).set("seed", state.options.seed.value_or(0)).set("command", command_of(state));
  put_camera(json, state);
  return files::json_text(json);
}

std::string fault_text(std::optional<std::uint64_t> id, const std::string& text) {
  const std::size_t end = std::min(text.find('\n'), text.size()), more = text.find_first_not_of(" \n", end);
  return fault_text(id, text.substr(0, end), more == std::string::npos ? "" : text.substr(more));
}

std::string fault_text(std::optional<std::uint64_t> id, const std::string& text, const std::string& more) {
  Json json = Json::object();
  json.set("type", "fault");
  if (id)
    json.set("id", *id);
  else
    json.set("id", nullptr);
  json.set("text", text);
  return files::json_text(json.set("more", more));
}

}  // namespace tofray::view
