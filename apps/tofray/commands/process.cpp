// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/text.h"
#include "camera/frozen_camera.h"
#include "commands.h"
#include "console.h"
#include "files/data_limits.h"
#include "files/json.h"
#include "files/npz.h"
#include "files/read_bytes.h"
#include "files/text_file.h"
#include "results.h"
#include "results/meta.h"
#include "results/meta_camera.h"
#include "results/raw_file.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

/// --set of a command that has no scene: keys of the camera, with or without "camera." before them.
load::Settings camera_settings(const Options& options) {
  load::Settings settings = options.set;
  for (auto& [key, value] : settings) {
    if (key.starts_with("camera.")) key.erase(0, 7);
  }
  return settings;
}

std::string meta_of(std::string_view bytes, const std::string& path) {
  const auto found = files::parse_npz(bytes, path, {"meta"});
  return found.empty() ? "" : found[0].array.text();
}

/// The profile that was named, or else the camera that the file itself describes.
Camera camera_for(const Options& options, const std::string& meta, const std::string& path) {
  if (!options.camera.empty()) return load_camera(options.camera, {options.mode, camera_settings(options), {}});
  if (meta.empty())
    throw Error(ErrorKind::bad_input,
                path + ": error: the file does not say which camera made it\n  name its profile, as in --camera mycam.yaml");
  if (!options.mode.empty())
    throw Error(ErrorKind::bad_input, "error: --mode goes with --camera\n  the file itself says how its raw frames were taken");
  return results::camera_of_meta(meta, path, camera_settings(options));
}

/// Names that a zip of ours can hold whatever wrote the file.
bool is_plain(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < 127 && c != '/' && c != '\\'; });
}

/// All arrays of the file: those that processing does not make are written again as they are (ground truth, the camera's pose, one's own
/// labels). Where one is of a kind that is not read, none are kept, and a warning says so.
std::vector<files::NamedArray> arrays_to_keep(std::string_view bytes, const std::string& path) {
  try {
    std::vector<files::NamedArray> arrays = files::parse_npz(bytes, path);
    std::erase_if(arrays, [](const files::NamedArray& one) { return !is_plain(one.name); });
    return arrays;
  } catch (const Error& error) {
    say(fmt::format("warning: arrays besides the raw data are not kept:\n  {}\n", error.what()));
    return {};
  }
}

const files::NpyArray* find(const std::vector<files::NamedArray>& arrays, const char* name) {
  for (const files::NamedArray& one : arrays) {
    if (one.name == name) return &one.array;
  }
  return nullptr;
}

std::optional<results::PoseMatrix> pose_of(const std::vector<files::NamedArray>& arrays) {
  const files::NpyArray* array = find(arrays, "camera_pose");
  if (array == nullptr || array->shape != files::NpyShape{4, 4} || array->type.kind != 'f') return {};
  results::PoseMatrix pose{};
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = array->number(i);
  return pose;
}

/// True z, for the error map of preview.png; the whole ground truth is among the arrays that are kept.
std::vector<float> true_z(const std::vector<files::NamedArray>& arrays, const Depth& depth) {
  const files::NpyArray* array = find(arrays, "gt_z_m");
  const files::NpyShape image = {static_cast<std::size_t>(depth.height), static_cast<std::size_t>(depth.width)};
  std::vector<float> z;
  if (array == nullptr || array->shape != image || array->type.kind != 'f') return z;
  for (std::size_t i = 0; i < array->count(); ++i) z.push_back(static_cast<float>(array->number(i)));
  return z;
}

}  // namespace

int run_process(const Options& options) {
  Stopwatch stopwatch;
  const std::string& path = options.words[0];
  const std::string bytes = files::read_bytes(path, files::max_data_file_bytes);
  Inputs in;
  const std::string meta = meta_of(bytes, path);
  in.scene.name = std::filesystem::path(path).stem().native();
  in.camera = camera_for(options, meta, path);
  in.files.push_back({"raw", path, {}});
  if (!options.camera.empty() && !in.camera.source.starts_with("<"))
    in.files.push_back({"profile", in.camera.source, files::read_text(in.camera.source)});
  Frame frame;
  frame.raw = results::parse_raw_npz(bytes, path);
  if (frame.raw.start_time_s.empty())
    frame.raw.start_time_s = camera::raw_frame_starts_s(frame.raw.integration_time_s, in.camera.readout_time_s);
  SimulatorOptions wanted = simulator_options(options);
  if (!meta.empty() && results::is_noise_free(files::parse_json(meta, path + ": meta"))) {
    wanted.noise = Noise::off;
    if (!frame.raw.tap_a.empty()) frame.raw.raw.clear();
  }
  in.kept = arrays_to_keep(bytes, path);
  in.pose = pose_of(in.kept);
  say(in.camera.illumination.empty() ? "warning: the camera has no light source: camera.illumination is []\n  every depth is invalid\n"
                                     : "");
  const FrameFiles what(options, {"npz", "png", "ply"}, in, wanted);
  stopwatch.lap("prepare");
  RanOn machine;
  frame.depth = process(frame.raw, in.camera, wanted, &machine);
  say_fallback(options, machine);
  frame.truth.z_m = true_z(in.kept, frame.depth);
  stopwatch.lap("process");
  if (const std::vector<std::string> missing = results::missing_arrays(frame, what.npz); !missing.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: --arrays asks for {}, and there {}\n  depth is computed, all else has to be in the file", path,
                            base::listed(missing, "and"), missing.size() == 1 ? "is none" : "are none"));

  files::OutputFolder folder(options.output.empty() ? in.scene.name + "-depth" : options.output);
  write_frame(folder, what, frame);
  stopwatch.lap("write");
  write_manifest(folder, options, in.files, machine, stopwatch);
  if (validity(frame.depth).valid == 0) say(fmt::format("warning: no pixel has a valid depth: {}\n", validity(frame.depth).reasons));
  if (options.json)
    print(files::json_text(summary_json(folder, frame.depth, 1, machine, stopwatch), 2) + "\n");
  else
    Talk(options.quiet)(summary_text(folder, frame.depth, 1, machine, stopwatch));
  return 0;
}

}  // namespace tofray::app
