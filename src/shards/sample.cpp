// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/sample.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/text.h"
#include "base/version.h"
#include "files/json.h"
#include "files/sha256.h"
#include "files/tar.h"
#include "files/text_file.h"
#include "load/load.h"
#include "load/trees.h"
#include "results/frame_file.h"
#include "run/profile_tables.h"
#include "shards/quantised.h"
#include "tofray/analysis.h"
#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

namespace tofray::shards {

namespace {

using files::Json;

constexpr std::string_view npy = ".npy";

Json numbers(const files::NpyView& view) {
  const files::NpyArray array{view.type, view.shape, std::string(view.bytes)};
  if (view.shape.empty()) return array.number(0);
  Json out = Json::array();
  for (std::size_t i = 0; i < array.count(); ++i) view.type.kind == 'b' ? out.push(array.number(i) != 0) : out.push(array.number(i));
  return out;
}

/// What was drawn: numbers in the unit of the set's file, all else as it stands in the scene.
Json drawn_json(const std::vector<Drawn>& drawn) {
  Json out = Json::object();
  for (const Drawn& one : drawn) {
    const bool number = one.form != "choice" && one.form != "grid" && one.form != "files" && one.form != "table" && one.form != "chance";
    out.set(one.path, Json::object().set("form", one.form).set("text", one.text).set(number ? "value" : "which", one.value));
  }
  return out;
}

/// Pixels that see an object, and the least rectangle around them: both corners inside.
struct Seen {
  std::uint64_t pixels = 0;
  int left = 0, top = 0, right = 0, bottom = 0;
  void add(int u, int v) {
    if (pixels++ == 0) left = right = u, top = bottom = v;
    left = std::min(left, u), right = std::max(right, u), top = std::min(top, v), bottom = std::max(bottom, v);
  }
};

std::vector<Seen> seen_of(const Truth& truth, std::size_t objects) {
  std::vector<Seen> out(objects);
  for (int v = 0, i = 0; v < truth.height; ++v)
    for (int u = 0; u < truth.width; ++u, ++i)
      if (const std::int32_t object = truth.object_id[static_cast<std::size_t>(i)]; object >= 0)
        out[static_cast<std::size_t>(object)].add(u, v);
  return out;
}

/// Of each object in the order of gt_object_id: where it is in the world when the truth holds, and in the image.
Json objects_json(const Scene& scene, const Truth& truth) {
  const std::vector<ObjectPlace> places = object_places(scene, truth.time_s);
  const std::vector<Seen> seen = seen_of(truth, places.size());
  Json out = Json::array();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const ObjectPlace& at = places[i];
    Json one = Json::object();
    one.set("name", at.name).set("class", at.class_name.empty() ? Json() : Json(at.class_name));
    one.set("position", Json::list(at.position)).set("rotation", Json::list(at.rotation));
    one.set("low", at.endless ? Json() : Json::list(at.low)).set("high", at.endless ? Json() : Json::list(at.high));
    one.set("pixels", seen[i].pixels);
    const std::array<int, 4> box{seen[i].left, seen[i].top, seen[i].right, seen[i].bottom};
    one.set("box_px", seen[i].pixels == 0 ? Json() : Json::list(box));
    out.push(std::move(one));
  }
  return out;
}

}  // namespace

SampleMaker::SampleMaker(const dataset::Scenes& scenes, std::vector<std::string> arrays, FrameProgress* progress)
    : scenes_(scenes), arrays_(std::move(arrays)), progress_(progress) {
  choice_ = dataset::choice_of(arrays_.empty() ? scenes.set().arrays : arrays_);
  for (const results::ArrayRow& row : results::array_table())
    if (row.is_image() &&
        (choice_.has(row) || row.name == "z_m" || row.name == "flags" || row.name == "gt_z_m" || row.name == "gt_object_id"))
      wanted_.push_back(row.name);
}

std::string SampleMaker::name_of(const std::string& path) const {
  const std::string folder = scenes_.set().folder + "/";
  if (path.starts_with(folder)) return path.substr(folder.size());
  return path.starts_with("./") ? path.substr(2) : path;
}

std::string SampleMaker::without_folder(const std::string& text) const {
  const std::string folder = scenes_.set().folder + "/";
  std::string out = text;
  for (std::size_t at = out.find(folder); at != std::string::npos; at = out.find(folder, at)) out.erase(at, folder.size());
  return out;
}

std::shared_ptr<const Camera> SampleMaker::camera_of(const Scene& scene) const {
  std::string key = scene.camera.profile + "\n" + scene.camera.mode;
  for (const Override& one : scene.camera.overrides) key += "\n" + one.key + "=" + one.value;
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = cameras_.find(key); known != cameras_.end()) return known->second;
  }
  auto made = std::make_shared<const Camera>(load_camera(scene));
  constexpr std::size_t most = 16;
  const std::lock_guard lock(mutex_);
  if (cameras_.size() >= most) cameras_.clear();
  return cameras_.emplace(std::move(key), std::move(made)).first->second;
}

void SampleMaker::add_inputs(const Scene& scene, const Camera& camera, std::map<std::string, std::string>& inputs) const {
  for (const Object& object : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&object.shape); mesh != nullptr && !mesh->sha256.empty())
      inputs[name_of(mesh->file)] = mesh->sha256;
  for (const SceneFile& one : scene.files) inputs[name_of(one.file)] = one.sha256;
  if (camera.source.starts_with("<")) return;  // a built-in profile
  const InputFile profile{"profile", camera.source, files::read_text(camera.source)};
  inputs[name_of(profile.name)] = files::sha256_hex(profile.text);
  for (const InputFile& table : run::profile_tables(profile, files::folder_of(profile.name), scene.camera.overrides))
    inputs[table.name] = files::sha256_hex(table.text);
}

MadeSample SampleMaker::make(std::uint64_t sample, std::uint64_t view) const {
  dataset::Scenes::Written written = scenes_.write(sample, view);
  const Scene scene = scenes_.read(written, sample, view);
  const bool classed = std::any_of(scene.objects.begin(), scene.objects.end(), [](const Object& one) { return !one.class_name.empty(); });
  if (classed && scene.classes.empty())
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: error: objects have classes, and the scene does not list them\n  expected classes: [chair, table, …] in the "
                    "set's scene, so that gt_class_id counts them alike in all samples",
                    scenes_.source(sample, view)));
  const std::shared_ptr<const Camera> of_scene = camera_of(scene);
  const Camera& camera = *of_scene;
  SimulatorOptions options;
  options.seed = scenes_.noise_seed(sample, view), options.threads = 1, options.arrays = wanted_, options.progress = progress_;
  options.backend = Backend::cpu;
  const Frame frame = Simulator(scene, camera, options).frame(0);
  if (progress_ != nullptr && progress_->stop) throw Error(ErrorKind::io, "error: interrupted");

  MadeSample out;
  out.view = view, out.draws = std::move(written.judged);
  out.statistics.add(frame);
  add_inputs(scene, camera, out.inputs);
  const results::FrameArrays all(frame, camera, camera_pose(scene, frame.truth.time_s), choice_);
  Json arrays = Json::object(), small = Json::object();
  for (const files::NpyView& one : all.views()) {
    const results::ArrayRow& row = *results::find_array(one.name);
    if (!row.is_image()) {
      small.set(one.name, numbers(one));
      continue;
    }
    Json about = Json::object();
    about.set("unit", row.unit);
    std::string bytes;
    if (const dataset::Quantised* as = quantised(scenes_.set(), one.name)) {
      bytes = quantised_npy(one, *as, scenes_.source(sample, view));
      put_type(about, *as);
    } else {
      bytes = files::npy_header(one.type, one.shape).append(one.bytes);
      about.set("dtype", one.type.name());
    }
    about.set("shape", Json::list(one.shape));
    arrays.set(one.name, std::move(about));
    out.members.push_back({one.name + std::string(npy), std::move(bytes)});
  }
  if (const std::vector<std::string> has = arrays_of(out); !arrays_.empty() && has != arrays_)
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: it has other arrays than the set's\n  got {}; expected {}",
                                                  scenes_.source(sample, view), base::listed(has, "and"), base::listed(arrays_, "and")));

  Json materials = Json::array();
  for (const Material& material : scene.materials) materials.push(material.name);
  Json json = Json::object();
  json.set("sample", sample)
      .set("view", view)
      .set("split", dataset::split_name(scenes_.split(sample)))
      .set("set", scenes_.set().name)
      .set("tofray", base::version())
      .set("seed", options.seed);
  json.set("camera", Json::object()
                         .set("profile", camera.name)
                         .set("mode", camera.mode.name)
                         .set("width", frame.depth.width)
                         .set("height", frame.depth.height));
  json.set("numbers", std::move(small)).set("arrays", std::move(arrays));
  json.set("objects", objects_json(scene, frame.truth)).set("classes", Json::list(scene.classes)).set("materials", std::move(materials));
  json.set("drawn", drawn_json(written.drawn)).set("scene", load::block_yaml(written.tree));
  out.members.push_back({"json", files::json_text(json) + "\n"});
  return out;
}

std::uint64_t tar_bytes(const MadeSample& sample) {
  std::uint64_t out = 0;
  for (const MadeSample::Member& one : sample.members) out += files::tar_block + one.bytes.size() + files::tar_padding(one.bytes.size());
  return out;
}

std::vector<std::string> arrays_of(const MadeSample& sample) {
  std::vector<std::string> out;
  for (const MadeSample::Member& one : sample.members)
    if (one.name.ends_with(npy)) out.push_back(one.name.substr(0, one.name.size() - npy.size()));
  return out;
}

}  // namespace tofray::shards
