// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>

#include "base/readout.h"
#include "files/data_limits.h"
#include "files/json.h"
#include "files/read_bytes.h"
#include "files/text_file.h"
#include "results/meta.h"
#include "results/meta_camera.h"
#include "results/raw_file.h"
#include "results/transient_file.h"
#include "tofray/error.h"
#include "tofray/load.h"

namespace tofray::run {

namespace {

/// The profile that was named, or else the camera that the file itself describes.
Camera camera_for(const RecordingCamera& named, const Recording& from) {
  if (!named.name.empty()) return load_camera(named.name, {named.mode, named.set, {}});
  if (from.meta.empty())
    throw Error(ErrorKind::bad_input,
                from.path + ": error: the file does not say which camera made it\n  name its profile, as in --camera mycam.yaml");
  if (!named.mode.empty())
    throw Error(ErrorKind::bad_input, "error: --mode goes with --camera\n  the file itself says how its raw frames were taken");
  return results::camera_of_meta(from.meta, from.path, named.set);
}

/// Names that a zip of ours can hold whatever wrote the file.
bool is_plain(const std::string& name) {
  return std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c < 127 && c != '/' && c != '\\'; });
}

/// All arrays of the file: those that processing does not make are written again as they are (ground truth, the camera's pose, one's own
/// labels). Where one is of a kind that is not read, none are kept, and a warning says so.
std::vector<files::NamedArray> arrays_to_keep(std::string_view bytes, const std::string& path, std::vector<Remark>& remarks) {
  try {
    std::vector<files::NamedArray> arrays = files::parse_npz(bytes, path);
    std::erase_if(arrays, [](const files::NamedArray& one) { return !is_plain(one.name); });
    return arrays;
  } catch (const Error& error) {
    remarks.push_back({true, "", "arrays besides the raw data are not kept:", error.what()});
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

}  // namespace

Recording read_recording(const std::string& path) {
  Recording out{path, files::read_bytes(path, files::max_data_file_bytes), ""};
  if (path.ends_with(".npy")) return out;
  const auto found = files::parse_npz(out.bytes, path, {"meta"});
  if (!found.empty()) out.meta = found[0].array.text();
  return out;
}

Loaded load_recording(const Recording& from, const char* role, const RecordingCamera& camera) {
  Loaded in;
  in.scene.name = std::filesystem::path(from.path).stem().native();
  in.camera = camera_for(camera, from);
  in.files.push_back({role, from.path, {}});
  if (!camera.name.empty() && !in.camera.source.starts_with("<"))
    in.files.push_back({"profile", in.camera.source, files::read_text(in.camera.source)});
  if (!from.path.ends_with(".npy")) in.kept = arrays_to_keep(from.bytes, from.path, in.remarks);
  in.pose = pose_of(in.kept);
  if (const auto bins = results::transient_of_meta(from.meta, from.path)) in.scene.transport.transient = *bins;  // of what is kept
  if (in.camera.illumination.empty())
    in.remarks.push_back(
        {true, "", "the camera has no light source: camera.illumination is []", "no light comes back: what depth there is, is noise"});
  return in;
}

Frame recorded_frame(const Recording& from, const Camera& camera, Noise& noise) {
  Frame frame;
  frame.raw = results::parse_raw_npz(from.bytes, from.path);
  if (frame.raw.start_time_s.empty())
    frame.raw.start_time_s = base::raw_frame_starts_s(frame.raw.integration_time_s, camera.readout_time_s);
  if (!from.meta.empty() && results::is_noise_free(files::parse_json(from.meta, from.path + ": meta"))) {
    noise = Noise::off;
    if (!frame.raw.tap_a.empty()) frame.raw.raw.clear();
  }
  return frame;
}

Truth truth_of(const std::vector<files::NamedArray>& arrays, const Depth& depth) {
  Truth truth;
  truth.z_m = image_of<float>(arrays, "gt_z_m", "f", depth);
  truth.range_m = image_of<float>(arrays, "gt_range_m", "f", depth);
  truth.object_id = image_of<std::int32_t>(arrays, "gt_object_id", "iu", depth);
  if (!truth.range_m.empty() || truth.z_m.empty()) return truth;
  for (std::size_t i = 0; i < truth.z_m.size(); ++i) truth.range_m.push_back(truth.z_m[i] * (depth.range_m[i] / depth.z_m[i]));  // one ray
  return truth;
}

}  // namespace tofray::run
