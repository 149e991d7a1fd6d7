// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/state.h"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

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
  json.set("scene", state.in.scene.name).set("camera", camera.name).set("mode", camera.mode.name);
  if (state.recorded) {
    json.set("width", state.recorded->width()).set("height", state.recorded->height());
  } else {
    const base::ImageExtent sensor = base::image_extent(camera);
    json.set("width", sensor.width).set("height", sensor.height);
  }
  json.set("phases", camera.mode.sequence.size()).set("frame_rate_hz", camera.mode.frame_rate_hz);
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

std::string why_not(const State& state, std::string_view type) {
  if (!state.recorded) return {};
  const Recorded& files = *state.recorded;
  const auto is = [type](std::initializer_list<std::string_view> all) { return std::find(all.begin(), all.end(), type) != all.end(); };
  if (is({"record", "save"})) return "These frames are files already: " + base::printable(files.path());
  if (is({"seed", "why", "drag", "place", "camera", "temporal", "screenshot", "restore"}))
    return "These frames lie in files: no scene is known that could be simulated";
  if (is({"set", "unset", "state"}) && !files.live())
    return files.has_raw() ? "The files do not say which camera made their raw frames: `tofray view --camera PROFILE` does"
                           : "The files have no raw frames, of which depth could be computed again";
  if (type == "view3d" && !files.has_camera()) return "The files do not say which camera made them: `tofray view --camera PROFILE` does";
  if (is({"measure", "region"}) && !files.has_depth())
    return "The files do not have all arrays of depth: z_m, range_m, points_m, noise_m, flags";
  return {};
}

void refuse(const State& state, std::string_view type) {
  std::string why = why_not(state, type);
  if (why.empty()) return;
  why[0] = static_cast<char>(why[0] - 'A' + 'a');  // a sentence's first letter
  throw Error(ErrorKind::bad_input, "error: " + why + "\n  what else there is can be looked at");
}

std::vector<std::pair<const char*, std::string>> cannot(const State& state) {
  std::vector<std::pair<const char*, std::string>> out;
  for (const char* type : {"record", "save", "seed", "why", "drag", "place", "camera", "temporal", "screenshot", "restore", "set", "unset",
                           "state", "view3d", "measure", "region"})
    if (std::string why = why_not(state, type); !why.empty()) out.emplace_back(type, std::move(why));
  return out;
}

std::uint64_t frame_within(const State& state, std::uint64_t frame) {
  return state.recorded ? std::min(frame, state.recorded->count() - 1) : frame;
}

std::uint64_t frame_after(const State& state) {
  const std::uint64_t next = state.frame + 1;
  return state.recorded && next >= state.recorded->count() ? 0 : next;
}

namespace {

/// With the settings in force.
void load(State& state) {
  if (state.recorded)
    state.in = state.recorded->loaded(state.options.set);
  else
    state.in = run::load(app::input_request(state.options.words[0], state.options));
}

State recorded_state(const app::Options& options) {
  if (options.seed || options.noise || options.exposure_samples || options.subpixel || !options.root.empty())
    throw Error(ErrorKind::bad_input,
                base::printable(options.words[0]) +
                    ": error: these frames are finished: --seed, --noise, --exposure-samples, --subpixel and --root are of "
                    "scenes\n  --set changes how depth is computed of raw frames, as in --set camera.decoding.filter=median");
  State state;
  state.options = options;
  state.recorded = std::make_shared<const Recorded>(options.words[0], options.camera, options.mode, options.set);
  load(state);
  return state;
}

}  // namespace

State first_state(const app::Options& options) {
  if (!options.words.empty() && names_recorded(options.words[0])) return recorded_state(options);
  if (!options.camera.empty())
    throw Error(
        ErrorKind::bad_input,
        "error: --camera is of files with raw frames\n  for the camera of a scene: --set camera.profile=NAME, or `tofray view NAME`");
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

std::optional<State> state_beside(const app::Options& options) {
  if (options.view.beside.empty()) return {};
  app::Options of_b = options;
  of_b.words = {options.view.beside}, of_b.set.clear(), of_b.mode.clear(), of_b.camera.clear();
  return first_state(of_b);
}

State changed(const State& before, const Edit& edit) {
  static constexpr const char* types[] = {"set", "unset", "seed", "state", "other", "other"};
  const bool same_seed = edit.seed && *edit.seed == before.options.seed.value_or(0);
  if (!(same_seed && edit.kind == Edit::Kind::seed)) refuse(before, types[static_cast<std::size_t>(edit.kind)]);
  if (edit.seed && !same_seed) refuse(before, "seed");
  State state;
  state.options = before.options, state.recorded = before.recorded;
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
  load(state);
  return state;
}

State opened(const State& like, const Edit& edit, std::uint32_t generation) {
  State state;
  state.options = like.options, state.recorded = like.recorded;
  state.generation = generation, state.frame = like.frame, state.playing = like.playing;
  state.options.set = edit.overrides;
  if (edit.seed) state.options.seed = edit.seed;
  if (is_scene(edit.scene)) {
    state.options.words[0] = edit.scene, state.recorded = nullptr;
  } else if (is_profile(edit.scene) && !state.recorded) {
    use_camera(state.options.set, edit.scene);
  } else if (!edit.scene.empty()) {
    std::vector<std::string> known;
    for (const auto* all : {&load::builtin_scenes(), &load::builtin_profiles()})
      for (const load::Builtin& one : *all) known.push_back(one.name);
    throw Error(ErrorKind::bad_input,
                "error: no built-in scene or camera is called " + base::in_quotes(edit.scene) + base::did_you_mean(edit.scene, known) +
                    "\n  `tofray list scenes` and `tofray list cameras` name them; a file cannot be opened from here");
  }
  load(state);
  return state;
}

std::string command_of(const State& state) {
  if (state.recorded) return shell_text(state.recorded->command(state.frame, state.options.set));
  return shell_text(with_time(with_set(words_of(state, "render", state.options.words[0]), state.options.set), state));
}

std::vector<std::string> recording_words(const State& state, std::uint64_t first, std::uint64_t frames) {
  Words out = with_set(words_of(state, "render", state.options.words[0]), state.options.set);
  append(out, {"--first-frame", std::to_string(first), "--frames", std::to_string(frames)});
  return out;
}

std::vector<std::string> live_words(const State& state) {
  if (state.recorded) {
    Words out{"tofray", "view", state.options.words[0]};
    if (!state.options.camera.empty()) append(out, {"--camera", state.options.camera});
    if (!state.options.mode.empty()) append(out, {"--mode", state.options.mode});
    return with_set(out, state.options.set);
  }
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
  const auto controls = state.recorded ? state.recorded->controls(state.options.set)
                                       : load::controls_of(state.in.scene, scene_text(state), state.options.set,
                                                           {state.options.mode, {}, state.options.root});
  for (const load::Control& one : controls) {
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
