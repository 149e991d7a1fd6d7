// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cstring>
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
#include "input_kind.h"
#include "results.h"
#include "results/meta.h"
#include "results/meta_camera.h"
#include "results/raw_file.h"
#include "results/transient_file.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

std::string meta_of(std::string_view bytes, const std::string& path) {
  const auto found = files::parse_npz(bytes, path, {"meta"});
  return found.empty() ? "" : found[0].array.text();
}

/// The profile that was named, or else the camera that the file itself describes.
Camera camera_for(const Options& options, const std::string& meta, const std::string& path, Remarks& remarks) {
  if (!options.camera.empty()) {
    const NameChoice chosen = choose_camera(options.camera);
    remarks.tell(note_of(chosen));
    return load_camera(chosen.name, {options.mode, camera_settings(options), {}});
  }
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
std::vector<files::NamedArray> arrays_to_keep(std::string_view bytes, const std::string& path, Remarks& remarks) {
  try {
    std::vector<files::NamedArray> arrays = files::parse_npz(bytes, path);
    std::erase_if(arrays, [](const files::NamedArray& one) { return !is_plain(one.name); });
    return arrays;
  } catch (const Error& error) {
    remarks.tell(fmt::format("warning: arrays besides the raw data are not kept:\n  {}\n", error.what()));
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

/// Values of one of the file's arrays that is an image of the depth's size; none where there is no such array of one of the kinds.
template <class T>
std::vector<T> image_of(const std::vector<files::NamedArray>& arrays, const char* name, const char* kinds, const Depth& depth) {
  const files::NpyArray* array = find(arrays, name);
  const files::NpyShape image = {static_cast<std::size_t>(depth.height), static_cast<std::size_t>(depth.width)};
  std::vector<T> values;
  if (array == nullptr || array->shape != image || std::strchr(kinds, array->type.kind) == nullptr) return values;
  for (std::size_t i = 0; i < array->count(); ++i) values.push_back(static_cast<T>(array->number(i)));
  return values;
}

/// What the file knows of the truth: z, for the error map of preview.png; range and object, which say which depths are whole cycles off.
/// The whole ground truth is among the arrays that are kept.
Truth truth_of(const std::vector<files::NamedArray>& arrays, const Depth& depth) {
  Truth truth;
  truth.z_m = image_of<float>(arrays, "gt_z_m", "f", depth);
  truth.range_m = image_of<float>(arrays, "gt_range_m", "f", depth);
  truth.object_id = image_of<std::int32_t>(arrays, "gt_object_id", "iu", depth);
  if (!truth.range_m.empty() || truth.z_m.empty()) return truth;
  for (std::size_t i = 0; i < truth.z_m.size(); ++i) truth.range_m.push_back(truth.z_m[i] * (depth.range_m[i] / depth.z_m[i]));  // one ray
  return truth;
}

/// The file that is processed, and what it says of its camera.
struct Source {
  std::string path, bytes, meta;
};

/// @param role  of the file, for the manifest
Inputs inputs_of(const Options& options, const Source& from, const char* role, Remarks& remarks) {
  Inputs in;
  in.scene.name = std::filesystem::path(from.path).stem().native();
  in.camera = camera_for(options, from.meta, from.path, remarks);
  in.files.push_back({role, from.path, {}});
  if (!options.camera.empty() && !in.camera.source.starts_with("<"))
    in.files.push_back({"profile", in.camera.source, files::read_text(in.camera.source)});
  if (!from.path.ends_with(".npy")) in.kept = arrays_to_keep(from.bytes, from.path, remarks);
  in.pose = pose_of(in.kept);
  if (const auto bins = results::transient_of_meta(from.meta, from.path)) in.scene.transport.transient = *bins;  // of what is kept
  remarks.tell(
      in.camera.illumination.empty()
          ? "warning: the camera has no light source: camera.illumination is []\n  no light comes back: what depth there is, is noise\n"
          : "");
  return in;
}

/// Files, manifest and summary of a frame that is done.
int write_results(const Options& options, const Inputs& in, const FrameFiles& what, const Frame& frame, const RanOn& machine,
                  Stopwatch& stopwatch, Remarks& remarks) {
  say_fallback(options, machine, remarks);
  stopwatch.lap("process");
  if (const std::vector<std::string> missing = results::missing_arrays(frame, what.npz); !missing.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: --arrays asks for {}, and there {}\n  {}, all else has to be in the file", in.files[0].name,
                            base::listed(missing, "and"), missing.size() == 1 ? "is none" : "are none",
                            options.transient.empty() ? "depth is computed" : "raw frames and depth are computed"));

  files::OutputFolder folder(options.output.empty() ? in.scene.name + "-depth" : options.output);
  EarlierFiles left(folder.path());
  write_frame(folder, what, frame);
  stopwatch.lap("write");
  write_manifest(folder, options, in.files, machine, stopwatch, left, remarks);
  const Validity pixels = validity(frame, in.camera);
  warn_of_depth_png(what, pictures::beyond_depth_png(frame.depth), remarks);
  if (pixels.pixels.valid == 0) remarks.tell(fmt::format("warning: no pixel has a valid depth: {}\n", pixels.reasons));
  if (options.json)
    print(files::json_text(summary_json(folder, pixels, 1, machine, stopwatch, remarks), 2) + "\n");
  else
    Talk(options.quiet)(summary_text(folder, pixels, 1, machine, stopwatch));
  return 0;
}

/// Raw frames to depth.
int process_raw(const Options& options) {
  if (options.first_m || options.width_m || options.per_factor || options.seed || options.noise)
    throw Error(ErrorKind::bad_input,
                "error: --first, --width, --factor, --seed and --noise go with --transient\n  raw frames have their noise already");
  Stopwatch stopwatch;
  refuse_missing(options.words[0]);
  Source from{options.words[0], files::read_bytes(options.words[0], files::max_data_file_bytes), ""};
  from.meta = meta_of(from.bytes, from.path);
  Remarks remarks;
  const Inputs in = inputs_of(options, from, "raw", remarks);
  Frame frame;
  frame.raw = results::parse_raw_npz(from.bytes, from.path);
  if (frame.raw.start_time_s.empty())
    frame.raw.start_time_s = camera::raw_frame_starts_s(frame.raw.integration_time_s, in.camera.readout_time_s);
  SimulatorOptions wanted = simulator_options(options);
  if (!from.meta.empty() && results::is_noise_free(files::parse_json(from.meta, from.path + ": meta"))) {
    wanted.noise = Noise::off;
    if (!frame.raw.tap_a.empty()) frame.raw.raw.clear();
  }
  const FrameFiles what(options, {"npz", "png", "ply"}, in, wanted);
  stopwatch.lap("prepare");
  RanOn machine;
  frame.depth = process(frame.raw, in.camera, wanted, &machine);
  frame.truth = truth_of(in.kept, frame.depth);
  return write_results(options, in, what, frame, machine, stopwatch, remarks);
}

/// Light by path length to raw frames and depth.
int process_transient(const Options& options) {
  if (!options.words.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: --transient takes the place of {}\n  expected one file, of light or of raw frames",
                            base::in_quotes(options.words[0])));
  Stopwatch stopwatch;
  Source from{options.transient, files::read_bytes(options.transient, files::max_data_file_bytes), ""};
  if (!from.path.ends_with(".npy")) from.meta = meta_of(from.bytes, from.path);
  Remarks remarks;
  Inputs in = inputs_of(options, from, "transient", remarks);
  SimulatorOptions wanted = simulator_options(options);
  wanted.truth = false;  // what the file has of it is kept
  const Transient light =
      results::parse_transient(from.bytes, from.path, in.camera, {options.first_m, options.width_m, options.per_factor.value_or(1)});
  in.scene.transport.transient = {light.bins, light.first_m, light.bin_width_m};
  const FrameFiles what(options, {"npz", "png", "ply"}, in, wanted);
  Simulator simulator({}, in.camera, wanted);
  stopwatch.lap("prepare");
  Frame frame = simulator.frame(0, light);
  frame.truth = truth_of(in.kept, frame.depth);
  return write_results(options, in, what, frame, simulator.ran_on(), stopwatch, remarks);
}

}  // namespace

int run_process(const Options& options) { return options.transient.empty() ? process_raw(options) : process_transient(options); }

}  // namespace tofray::app
