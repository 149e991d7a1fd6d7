// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/state.h"

#include <algorithm>
#include <filesystem>

#include "base/readout.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/requests.h"
#include "files/sha256.h"
#include "load/builtin.h"
#include "load/controls.h"
#include "results/meta.h"
#include "tofray/error.h"
#include "tofray/load.h"

namespace tofray::view {

namespace {

using files::Json;

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=:,+@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

/// Camera and mode of that name in place of the scene's: the mode that the scene names is of another camera.
void use_camera(Overrides& set, const std::string& name) {
  set.insert(set.begin(), {{"camera.profile", name}, {"camera.mode", load_camera(name).mode.name}});
}

bool is_scene(const std::string& name) { return load::find_builtin(load::builtin_scenes(), name) != nullptr; }
bool is_profile(const std::string& name) { return load::find_builtin(load::builtin_profiles(), name) != nullptr; }

std::string_view scene_text(const State& state) {
  const auto& file = state.in.files.at(0);
  return file.text.empty() ? load::builtin_scene_text(file.name) : std::string_view(file.text);
}

using Words = std::vector<std::string>;

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

/// Of render and view: what is no key.
Words words_of(const State& state, const char* command, const std::string& scene) {
  const app::Options& o = state.options;
  Words out{"tofray", command, scene};
  if (!o.root.empty()) append(out, {"--root", o.root});
  if (o.seed) append(out, {"--seed", std::to_string(*o.seed)});
  if (o.noise) append(out, {"--noise", results::noise_name(*o.noise)});
  if (o.exposure_samples) append(out, {"--exposure-samples", std::to_string(*o.exposure_samples)});
  if (o.subpixel) append(out, {"--subpixel", std::to_string(*o.subpixel)});
  return out;
}

Words with_set(Words words, const Overrides& set) {
  for (const auto& [key, value] : set) append(words, {"--set", key + "=" + value});
  return words;
}

Words with_time(Words words, const State& state) {
  if (!state.playing && state.frame > 0) append(words, {"--first-frame", std::to_string(state.frame)});
  return words;
}

/// width, height, phases, frame_rate_hz, camera and mode of the camera.
void put_camera(Json& json, const State& state) {
  const Camera& camera = state.in.camera;
  const Sensor sensor = base::as_read_out(camera).sensor;
  json.set("scene", state.in.scene.name).set("camera", camera.name).set("mode", camera.mode.name);
  json.set("width", sensor.width).set("height", sensor.height).set("phases", camera.mode.sequence.size());
  json.set("frame_rate_hz", camera.mode.frame_rate_hz);
}

/// What each side has for itself.
void put_side(Json& json, const State& state) {
  Json overrides = Json::array();
  for (const auto& [key, text] : state.options.set) overrides.push(Json::object().set("key", key).set("text", text));
  json.set("overrides", std::move(overrides)).set("seed", state.options.seed.value_or(0)).set("command", command_of(state));
  json.set("generation", state.generation);
  put_camera(json, state);
}

}  // namespace

const char* name_of(Side side) { return side == Side::a ? "a" : "b"; }

State first_state(const app::Options& options) {
  State state;
  state.options = options;
  if (state.options.words.empty()) state.options.words.emplace_back("demo");
  std::string& scene = state.options.words[0];
  if (!is_scene(scene) && is_profile(scene)) {
    use_camera(state.options.set, scene);
    scene = "demo";
  }
  // One list says all: a key that is set later then counts more than --mode.
  if (!state.options.mode.empty()) state.options.set.emplace_back("camera.mode", std::exchange(state.options.mode, {}));
  state.in = run::load(app::input_request(scene, state.options));
  return state;
}

State changed(const State& before, const Edit& edit) {
  State state;
  state.options = before.options;
  state.generation = before.generation + 1, state.frame = before.frame, state.playing = before.playing;
  auto& set = state.options.set;
  const auto same = [&](const auto& one) { return one.first == edit.key; };
  switch (edit.kind) {
    case Edit::Kind::set: {
      const auto found = std::find_if(set.rbegin(), set.rend(), same);
      if (found != set.rend())
        found->second = edit.text;
      else
        set.emplace_back(edit.key, edit.text);
      break;
    }
    case Edit::Kind::unset: std::erase_if(set, same); break;
    case Edit::Kind::state: set = edit.overrides; [[fallthrough]];
    default:
      if (edit.seed) state.options.seed = edit.seed;
  }
  state.in = run::load(app::input_request(state.options.words[0], state.options));
  return state;
}

State opened(const State& like, const Edit& edit, std::uint32_t generation) {
  State state;
  state.options = like.options;
  state.generation = generation, state.frame = like.frame, state.playing = like.playing;
  state.options.set = edit.overrides;
  if (edit.seed) state.options.seed = edit.seed;
  if (is_scene(edit.scene)) {
    state.options.words[0] = edit.scene;
  } else if (is_profile(edit.scene)) {
    use_camera(state.options.set, edit.scene);
  } else if (!edit.scene.empty()) {
    std::vector<std::string> known;
    for (const auto* all : {&load::builtin_scenes(), &load::builtin_profiles()})
      for (const load::Builtin& one : *all) known.push_back(one.name);
    throw Error(ErrorKind::bad_input,
                "error: no built-in scene or camera is called " + base::in_quotes(edit.scene) + base::did_you_mean(edit.scene, known) +
                    "\n  `tofray list scenes` and `tofray list cameras` name them; a file cannot be opened from here");
  }
  state.in = run::load(app::input_request(state.options.words[0], state.options));
  return state;
}

std::string command_of(const State& state) {
  return shell_text(with_time(with_set(words_of(state, "render", state.options.words[0]), state.options.set), state));
}

std::vector<std::string> recording_words(const State& state, std::uint64_t first, std::uint64_t frames) {
  Words out = with_set(words_of(state, "render", state.options.words[0]), state.options.set);
  append(out, {"--first-frame", std::to_string(first), "--frames", std::to_string(frames)});
  return out;
}

std::vector<std::string> live_words(const State& state) {
  return with_set(words_of(state, "view", state.options.words[0]), state.options.set);
}

std::string shell_text(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& one : words) out += (out.empty() ? "" : " ") + shell_word(one);
  return out;
}

PictureState picture_state(const State& state, std::uint64_t frame) {
  const app::Options& o = state.options;
  PictureState out;
  const auto& file = state.in.files.at(0);
  out.version = base::version();
  out.scene = is_scene(o.words[0]) ? o.words[0] : std::filesystem::path(o.words[0]).filename().native();
  if (!file.text.empty()) out.scene_sha256 = files::sha256_hex(file.text);
  out.overrides = o.set, out.seed = o.seed.value_or(0), out.frame = frame;
  out.noise = results::noise_name(o.noise.value_or(Noise::exact));
  out.exposure_samples = o.exposure_samples.value_or(1), out.subpixel = o.subpixel.value_or(1);
  return out;
}

std::string live_command(const PictureState& state) {
  Words out{"tofray", "view", state.scene};
  if (state.seed != 0) append(out, {"--seed", std::to_string(state.seed)});
  if (state.noise != "exact") append(out, {"--noise", state.noise});
  if (state.exposure_samples != 1) append(out, {"--exposure-samples", std::to_string(state.exposure_samples)});
  if (state.subpixel != 1) append(out, {"--subpixel", std::to_string(state.subpixel)});
  return shell_text(with_set(out, state.overrides));
}

Saved saved(const State& state) {
  Saved out;
  out.name = state.in.scene.name + ".yaml";
  out.command = shell_text(with_time(words_of(state, "render", out.name), state));
  out.text = "# saved by tofray view: " + base::printable(command_of(state)) + "\n" +
             load::scene_yaml(scene_text(state), state.in.scene.source, state.options.set);
  return out;
}

void put_state(Json& json, const State& state, const State* other) {
  json.set("side", name_of(Side::a)).set("playing", state.playing).set("frame", state.frame);
  put_side(json, state);
  if (other == nullptr) {
    json.set("other", nullptr);
  } else {
    Json of_other = Json::object();
    put_side(of_other, *other);
    json.set("other", std::move(of_other));
  }
}

std::string state_text(const State& state, const State* other) {
  Json json = Json::object();
  json.set("type", "state");
  put_state(json, state, other);
  return files::json_text(json);
}

std::string controls_text(const State& state, const Query& query) {
  constexpr std::size_t most_bytes = 800'000;  // a page that takes 1 MB too slowly is let go
  std::string rows;
  std::size_t left_out = 0;
  for (const load::Control& one :
       load::controls_of(state.in.scene, scene_text(state), state.options.set, {state.options.mode, {}, state.options.root})) {
    const std::string row = left_out > 0 ? std::string() : files::json_text(load::json_of(one));
    if (left_out > 0 || rows.size() + row.size() > most_bytes)
      ++left_out;
    else
      rows += (rows.empty() ? "" : ",") + row;
  }
  Json json = Json::object();
  json.set("type", "controls").set("id", query.id).set("generation", state.generation).set("side", name_of(query.side));
  if (left_out > 0) json.set("left_out", left_out);
  std::string out = files::json_text(json);
  out.back() = ',';
  return out + "\"controls\":[" + rows + "]}";
}

std::string fault_text(std::optional<std::uint64_t> id, const std::string& text, const std::string& key) {
  const std::size_t end = std::min(text.find('\n'), text.size()), more = text.find_first_not_of(" \n", end);
  return fault_lines(id, text.substr(0, end), more == std::string::npos ? "" : text.substr(more), key);
}

std::string fault_lines(std::optional<std::uint64_t> id, const std::string& text, const std::string& more, const std::string& key) {
  Json json = Json::object();
  json.set("type", "fault");
  if (id)
    json.set("id", *id);
  else
    json.set("id", nullptr);
  if (!key.empty()) json.set("key", key);
  json.set("text", text);
  return files::json_text(json.set("more", more));
}

}  // namespace tofray::view
