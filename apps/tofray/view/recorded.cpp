// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/recorded.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <type_traits>
#include <utility>

#include "base/text.h"
#include "files/data_limits.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "results/meta_camera.h"
#include "run/input_kind.h"
#include "tofray/error.h"
#include "tofray/simulator.h"

namespace tofray::view {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t most_files = 100'000;

std::vector<std::string> files_of(const std::string& path) {
  if (!run::is_folder(path)) {
    run::refuse_missing(path);
    if (path.ends_with(".npy"))
      throw Error(ErrorKind::bad_input,
                  base::printable(path) + ": error: a single array is no frame\n  expected a .npz file, or a folder of such");
    return {path};
  }
  std::vector<std::string> out;
  for (const std::string& name : run::names_in(path, {".npz"}, most_files)) out.push_back((fs::path(path) / name).native());
  if (!out.empty()) return out;
  const std::vector<std::string> films = run::names_in(path, {".mcap"}, most_files);
  throw Error(ErrorKind::bad_input,
              base::printable(path) + ": error: the folder has no .npz files\n  " +
                  (films.empty() ? "`tofray render SCENE --frames 10` makes some"
                                 : fmt::format("`tofray view {}` plays the film", base::printable((fs::path(path) / films[0]).native()))));
}

/// Takes arrays out of a file into a frame; all images have one size.
class FrameReader {
 public:
  FrameReader(const results::Arrays& arrays, Frame& frame) : arrays_(arrays), frame_(frame) {}

  void read(bool raw, bool depth) {
    Frame& frame = frame_;
#define TOFRAY_READ(label, part, member, element, axes, stage, ...)                                       \
  if ((Stage::stage == Stage::raw && raw) || (Stage::stage == Stage::depth && depth) || is_truth(#label)) \
    take(#label, frame.part.member, ArrayShape::axes);
    TOFRAY_FRAME_ARRAYS(TOFRAY_READ)
#undef TOFRAY_READ
    const auto side = [](std::size_t of) { return static_cast<int>(of); };
    const auto has_raw = !frame.raw.raw.empty() || !frame.raw.tap_a.empty();
    if (raw && has_raw) frame.raw.width = side(width_), frame.raw.height = side(height_), frame.raw.phases = side(phases_);
    if (depth) frame.depth.width = side(width_), frame.depth.height = side(height_);
    frame.truth.width = side(width_), frame.truth.height = side(height_), frame.truth.phases = side(phases_);
  }

 private:
  static bool is_truth(std::string_view name) { return name.starts_with("gt_"); }

  template <class Values>
  void take(const char* name, Values& values, ArrayShape shape) {
    using T = typename Values::value_type;
    const files::NpyArray* array = arrays_.find(name);
    if (array == nullptr || shape == ArrayShape::bins) return;
    const files::NpyShape& s = array->shape;
    const std::size_t first = shape == ArrayShape::stack ? 1 : 0, axes = shape == ArrayShape::list ? 1 : shape == ArrayShape::image ? 2 : 3;
    const bool whole = std::is_integral_v<T> && std::string_view("iub").find(array->type.kind) != std::string_view::npos;
    bool good = s.size() == axes && (whole || (std::is_floating_point_v<T> && array->type.kind == 'f'));
    if (good && shape != ArrayShape::list) {
      if (width_ == 0) height_ = s[first], width_ = s[first + 1];
      good = s[first] == height_ && s[first + 1] == width_ && width_ > 0 && height_ > 0 && width_ <= files::max_image_side &&
             height_ <= files::max_image_side;
      if (shape == ArrayShape::pairs) good = good && s[2] == 2;
      if (shape == ArrayShape::vectors) good = good && s[2] == 3;
    }
    if (good && (shape == ArrayShape::stack || shape == ArrayShape::list)) {
      if (phases_ == 0) phases_ = s[0];
      good = s[0] == phases_ && phases_ > 0;
    }
    if (!good)
      throw Error(
          ErrorKind::bad_input,
          fmt::format("{}: error: array \"{}\" is not as tofray writes it\n  got {} of {}; expected {}, as all images of the file",
                      base::printable(arrays_.where()), name, array->type.name(), files::shape_text(s), files::npy_type_of<T>().name()));
    values.resize(array->count());
    if (array->type == files::npy_type_of<T>())
      std::copy_n(array->bytes.data(), array->bytes.size(), reinterpret_cast<char*>(values.data()));
    else
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<T>(array->number(i));
  }

  const results::Arrays& arrays_;
  Frame& frame_;
  std::size_t width_ = 0, height_ = 0, phases_ = 0;
};

bool has_raw_frames(const results::Arrays& arrays) {
  return arrays.find("raw") != nullptr || (arrays.find("tap_a") != nullptr && arrays.find("tap_b") != nullptr);
}

bool says_its_camera(const run::Recording& recording) {
  if (recording.meta.empty()) return false;
  const files::Json meta = files::parse_json(recording.meta, recording.path + ": meta");
  return meta.is_object() && meta.find("camera") != nullptr;
}

Overrides of_camera(Overrides set) {
  for (auto& [key, text] : set)
    if (key.starts_with("camera.")) key.erase(0, 7);
  return set;
}

}  // namespace

bool names_recorded(const std::string& word) {
  if (results::holds_arrays(word) || run::is_film(word)) return true;
  return run::is_folder(word) && load::find_builtin(load::builtin_scenes(), word) == nullptr &&
         load::find_builtin(load::builtin_profiles(), word) == nullptr;
}

Recorded::Recorded(std::string path, std::string camera, std::string mode, const Overrides& set)
    : path_(std::move(path)), camera_(std::move(camera)), mode_(std::move(mode)) {
  if (run::is_film(path_) && !run::is_folder(path_)) {
    run::refuse_missing(path_);
    film_ = std::make_unique<run::Film>(path_);
  } else {
    files_ = files_of(path_);
  }
  const Read first = read(0);
  has_raw_ = has_raw_frames(first.arrays);
  has_camera_ = !camera_.empty() || says_its_camera(first.recording);
  live_ = has_raw_ && has_camera_;
  if (!live_ && !set.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: these frames are finished, their settings cannot be changed\n  {}", base::printable(path_),
                            has_raw_ ? "where --camera names the profile of their camera, depth is computed of their raw frames"
                                     : "they have no raw frames, of which depth could be computed again"));
  const Frame frame = this->frame(0, loaded(set).camera, {});
  width_ = std::max({frame.raw.width, frame.depth.width, frame.truth.width});
  height_ = std::max({frame.raw.height, frame.depth.height, frame.truth.height});
  const Depth& depth = frame.depth;
  has_depth_ = !depth.z_m.empty() && !depth.range_m.empty() && !depth.points_m.empty() && !depth.noise_m.empty() && !depth.flags.empty();
  if (frame.raw.raw.empty() && frame.raw.tap_a.empty() && depth.z_m.empty() && frame.truth.z_m.empty())
    throw Error(ErrorKind::bad_input, base::printable(file(0)) +
                                          ": error: there is nothing to show in it\n  expected z_m, raw or others of `tofray list arrays`");
}

Recorded::Read Recorded::read(std::uint64_t index) const {
  run::Recording recording = film_ ? film_->frame(index) : run::read_recording(files_[index]);
  results::Arrays arrays(files::parse_npz(recording.bytes, recording.path), recording.path);
  return {std::move(recording), std::move(arrays)};
}

run::RecordingCamera Recorded::camera_with(const Overrides& set) const { return {camera_, mode_, of_camera(set)}; }

run::Loaded Recorded::loaded(const Overrides& set) const {
  run::Loaded in;
  if (has_camera_) {
    in = run::load_recording(read(0).recording, "raw", camera_with(set));
    in.kept.clear();
  } else {
    in.files.push_back({"raw", file(0), {}});
  }
  if (film_ && !film_->complete())
    in.remarks.push_back(
        {true, path_, "the film ends early: its writer was stopped, or it was cut", "all up to its last whole chunk is played"});
  fs::path name = fs::path(path_).lexically_normal();
  if (!name.has_filename()) name = name.parent_path();
  in.scene.name = run::is_folder(path_) ? name.filename().native() : name.stem().native();
  if (in.scene.name.empty() || in.scene.name == "." || in.scene.name == "..")
    in.scene.name = fs::absolute(name).lexically_normal().filename().native();
  return in;
}

void Recorded::refuse_other_size(const Frame& frame, const std::string& file) const {
  const int width = std::max({frame.raw.width, frame.depth.width, frame.truth.width});
  const int height = std::max({frame.raw.height, frame.depth.height, frame.truth.height});
  if (width_ > 0 && (width != width_ || height != height_))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: its images have {} x {} pixels, those of {} {} x {}\n  expected frames of one camera in a folder",
                            base::printable(file), width, height, base::printable(this->file(0)), width_, height_));
}

Frame Recorded::frame(std::uint64_t index, const Camera& camera, const SimulatorOptions& options) const {
  if (!last_ || last_->first != index) last_.emplace(index, std::make_shared<const Read>(read(index)));
  const Read& from = *last_->second;
  Frame frame;
  SimulatorOptions wanted = options;
  const bool computed = live_ && has_raw_frames(from.arrays);
  if (computed) frame = run::recorded_frame(from.recording, camera, wanted.noise);
  FrameReader(from.arrays, frame).read(!computed, !computed);
  refuse_other_size(frame, file(index));
  if (computed) frame.depth = process(frame.raw, camera, wanted);
  frame.index = index;
  return frame;
}

std::vector<load::Control> Recorded::controls(const Overrides& set) const {
  if (!live_) return {};
  std::string text, source = camera_;
  if (const load::Builtin* builtin = load::find_builtin(load::builtin_profiles(), camera_))
    text = builtin->text, source = "<" + camera_ + ">";
  else if (!camera_.empty())
    text = files::read_text(camera_);
  else
    text = results::profile_of_meta(read(0).recording.meta, file(0)), source = file(0);
  std::vector<load::Control> out = load::camera_controls_of(text, source, {mode_, of_camera(set), {}});
  std::erase_if(out, [](const load::Control& one) { return !one.key.starts_with("camera.decoding."); });
  return out;
}

std::vector<std::string> Recorded::command(std::uint64_t index, const Overrides& set) const {
  if (!live_) return {};
  std::vector<std::string> out{"tofray", "process", file(index)};
  if (film_) out.insert(out.end(), {"--first-frame", std::to_string(film_->index_of(index)), "--frames", "1"});
  if (!camera_.empty()) out.insert(out.end(), {"--camera", camera_});
  if (!mode_.empty()) out.insert(out.end(), {"--mode", mode_});
  for (const auto& [key, text] : set) out.insert(out.end(), {"--set", key + "=" + text});
  return out;
}

}  // namespace tofray::view
