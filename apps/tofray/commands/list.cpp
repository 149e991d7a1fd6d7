// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "assets/material_library.h"
#include "base/readout.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/requests.h"
#include "files/json.h"
#include "load/builtin.h"
#include "load/controls.h"
#include "load/load.h"
#include "load/reference.h"
#include "model/lines.h"
#include "model/tables.h"
#include "results/array_table.h"
#include "run/input_kind.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

files::Json list_scenes(std::string& text) {
  files::Json json = files::Json::array();
  for (const load::Builtin& one : load::builtin_scenes()) {
    const Scene scene = load_scene(one.name);
    json.push(files::Json::object().set("name", one.name).set("description", one.description).set("objects", scene.objects.size()));
    text += fmt::format("{:<18} {}\n", one.name, one.description);
  }
  return json;
}

files::Json mode_json(const Camera& camera) {
  std::vector<std::string> frequencies;
  files::Json unlike = files::Json::array();
  double before = 0;
  for (const RawFrame& k : camera.mode.sequence) {
    if (k.lit && k.modulation_frequency_hz != before) unlike.push(before = k.modulation_frequency_hz);
  }
  files::Json json = files::Json::object();
  json.set("name", camera.mode.name).set("frame_rate_hz", camera.mode.frame_rate_hz).set("raw_frames", camera.mode.sequence.size());
  return json.set("modulation_frequency_hz", std::move(unlike));
}

std::string mode_line(const Camera& camera) {
  std::string frequencies;
  double before = 0, longest = 0;
  for (const RawFrame& k : camera.mode.sequence) {
    if (!k.lit) continue;
    longest = std::max(longest, k.integration_time_s);
    if (k.modulation_frequency_hz == before) continue;
    before = k.modulation_frequency_hz;
    frequencies += fmt::format("{}{:g}", frequencies.empty() ? "" : ", ", 1e-6 * before);
  }
  return fmt::format("  {:<22} {:>4g} frames/s, {:>2} raw frames of up to {:g} us at {} MHz\n", camera.mode.name, camera.mode.frame_rate_hz,
                     camera.mode.sequence.size(), 1e6 * longest, frequencies);
}

files::Json list_cameras(std::string& text) {
  files::Json json = files::Json::array();
  for (const load::Builtin& one : load::builtin_profiles()) {
    const Camera camera = load_camera(one.name);
    const base::ImageExtent image = base::image_extent(camera);
    files::Json modes = files::Json::array();
    text += fmt::format("{:<18} {}\n", one.name, one.description);
    for (const std::string& name : camera.mode_names) {
      const Camera in_mode = load_camera(one.name, {name, {}, {}});
      modes.push(mode_json(in_mode));
      text += mode_line(in_mode);
    }
    json.push(files::Json::object()
                  .set("name", one.name)
                  .set("description", one.description)
                  .set("width", image.width)
                  .set("height", image.height)
                  .set("modes", std::move(modes)));
  }
  return json;
}

/// What a material's BRDF reads of it, in SI units by the name of its member.
files::Json material_json(const Material& material) {
  files::Json json = files::Json::object().set("name", material.name);
  for (const model::Row& row : model::table_of<Material>().rows) {
    if (!model::applies(row, &material)) continue;
    const model::Slot slot = model::slot_of(row, &material);
    if (const auto* choice = std::get_if<model::ChoiceSlot>(&slot))
      json.set(row.name(), row.form.names.at(static_cast<std::size_t>(choice->get(choice->at))));
    else if (double* const* number = std::get_if<double*>(&slot))
      json.set(row.name(), **number);
  }
  return json;
}

files::Json list_library(std::string& text) {
  text = assets::material_page();
  files::Json json = files::Json::array();
  for (const assets::LibraryMaterial& one : assets::material_library())
    json.push(material_json(one.material).set("what", one.what).set("source", one.source));
  return json;
}

files::Json list_materials_of(const std::string& scene_name, std::string& text) {
  files::Json json = files::Json::array();
  const NameChoice chosen = choose_scene(scene_name);
  say(run::note_of(chosen));
  for (const Material& one : load_scene(chosen.name).materials) {
    if (one.name.empty()) continue;
    text += fmt::format("{:<14} {}\n", one.name, assets::numbers_of(one));
    json.push(material_json(one));
  }
  return json;
}

files::Json list_keys(std::string& text) {
  text = load::reference_page();
  files::Json json = files::Json::array();
  for (const model::FileForm* file : {&model::camera_form(), &model::scene_form()})
    for (const model::Line& one : model::lines_of(*file))
      json.push(files::Json::object()
                    .set("file", file->kind)
                    .set("key", one.key)
                    .set("value", one.value)
                    .set("default", one.fallback)
                    .set("required", one.required)
                    .set("meaning", one.doc)
                    .set("member", one.member));
  return json;
}

files::Json list_arrays(std::string& text) {
  text = results::array_reference();
  files::Json json = files::Json::array();
  for (const results::ArrayRow& one : results::array_table())
    json.push(files::Json::object()
                  .set("name", one.name)
                  .set("dtype", one.type.name())
                  .set("shape", one.shape)
                  .set("unit", one.unit)
                  .set("from", one.from)
                  .set("what", one.what));
  return json;
}

/// One line a key: its value, or what it may be, and what it is.
std::string control_line(const load::Control& one) {
  std::string value = one.text.value_or(one.settable ? "–" : "not with other keys");
  constexpr std::size_t longest = 40;
  if (value.size() > longest) value = base::printable(value.substr(0, longest - 3)) + "...";
  return fmt::format("{:<52} {:<22} {}{}{}\n", one.key, base::printable(value), one.changed ? "(changed) " : "", one.what,
                     one.assumed ? "; assumed" : "");
}

/// @param name  of a scene, a file or a camera, which then looks at the demo
files::Json list_controls(const std::string& name, const Options& options, std::string& text) {
  Options wanted = options;
  NameChoice scene = choose_scene(name);
  if (load::find_builtin(load::builtin_scenes(), name) == nullptr && load::find_builtin(load::builtin_profiles(), name) != nullptr) {
    wanted.set = {{"camera.profile", name}, {"camera.mode", load_camera(name).mode.name}};
    scene = {"demo", {}};
  }
  say(run::note_of(scene));
  const run::Loaded in = run::load(input_request(scene.name, wanted));
  const std::string& kept = in.files[0].text;
  files::Json json = files::Json::array();
  for (const load::Control& one : load::controls_of(in.scene, kept.empty() ? load::builtin_scene_text(in.files[0].name) : kept, wanted.set,
                                                    {wanted.mode, {}, wanted.root})) {
    json.push(json_of(one));
    text += control_line(one);
  }
  return json;
}

}  // namespace

int run_list(const Options& options) {
  const std::string& what = options.words[0];
  const std::vector<std::string> kinds = {"cameras", "scenes", "materials", "keys", "controls", "arrays"};
  if (options.words.size() == 2 && what != "materials" && what != "controls")
    throw Error(ErrorKind::bad_input,
                fmt::format("error: unexpected {}\n  expected tofray list {}", base::in_quotes(options.words[1]), what));
  std::string text;
  files::Json json = files::Json::array();
  if (what == "scenes") {
    json = list_scenes(text);
  } else if (what == "cameras") {
    json = list_cameras(text);
  } else if (what == "keys") {
    json = list_keys(text);
  } else if (what == "controls") {
    json = list_controls(options.words.size() == 2 ? options.words[1] : "demo", options, text);
  } else if (what == "materials") {
    json = options.words.size() == 2 ? list_materials_of(options.words[1], text) : list_library(text);
  } else if (what == "arrays") {
    json = list_arrays(text);
  } else {
    throw Error(ErrorKind::bad_input, fmt::format("error: there is no list of {}{}\n  expected {}", base::in_quotes(what),
                                                  base::did_you_mean(what, kinds), base::listed(kinds)));
  }
  print(options.json ? files::json_text(files::Json::object().set(what, std::move(json)), 2) + "\n" : text);
  return 0;
}

}  // namespace tofray::app
