// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <type_traits>
#include <utility>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/first_frame.h"
#include "files/atomic_file.h"
#include "files/data_limits.h"
#include "pictures/terminal_picture.h"
#include "results/file_arrays.h"
#include "results/raw_file.h"
#include "run/frame_files.h"
#include "run/input_kind.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

/// What a picture is made of.
struct Shown {
  Frame frame;
  std::string caption;
};

/// Takes the arrays of a picture out of a file.
class ShownReader {
 public:
  explicit ShownReader(const results::Arrays& arrays) : arrays_(arrays) {}

  /// z, amplitude and error.
  Frame depth() {
    Frame frame;
    Depth& depth = frame.depth;
    take("z_m", depth.z_m), take("amplitude_e", depth.amplitude_e), take("flags", depth.flags);
    const bool truth = arrays_.find("gt_z_m") != nullptr;
    if (truth) take("gt_z_m", frame.truth.z_m);
    if (!truth) take("noise_m", depth.noise_m);
    refuse_faults();
    depth.width = static_cast<int>(width_), depth.height = static_cast<int>(height_);
    exposures(frame.raw);
    if (arrays_.find("gt_multipath_m") != nullptr && !frame.raw.lit.empty()) take("gt_multipath_m", frame.truth.multipath_m, true);
    refuse_faults();
    return frame;
  }

 private:
  /// An array [height, width], or [phase, height, width], of the size that the first one has.
  template <class T>
  void take(const char* name, std::vector<T>& values, bool by_phase = false) {
    const files::NpyArray* array = arrays_.find(name);
    if (array == nullptr) {
      missing_.emplace_back(name);
      return;
    }
    const files::NpyShape& shape = array->shape;
    if (width_ == 0 && shape.size() == 2) height_ = shape[0], width_ = shape[1];
    const files::NpyShape expected = by_phase ? files::NpyShape{arrays_.phases(), height_, width_} : files::NpyShape{height_, width_};
    const bool sensible = width_ > 0 && height_ > 0 && width_ <= files::max_image_side && height_ <= files::max_image_side;
    if (shape != expected || !sensible || array->type.kind != files::npy_type_of<T>().kind)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: error: array \"{}\" is no image of the picture's kind\n  got {} of {}, expected {} of {}",
                              base::printable(arrays_.where()), name, array->type.name(), files::shape_text(shape),
                              files::npy_type_of<T>().name(), width_ > 0 ? files::shape_text(expected) : "(height, width)"));
    values.resize(array->count());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if constexpr (std::is_integral_v<T>)
        values[i] = static_cast<T>(results::flag_bits(array->number(i)));  // the flags, of any size
      else
        values[i] = static_cast<T>(array->number(i));
    }
  }

  /// Which raw frames are lit, and at which modulation frequency; nothing where the file does not say it of each.
  void exposures(Raw& raw) const {
    const files::NpyArray *lit = arrays_.find("lit"), *frequency = arrays_.find("modulation_frequency_hz");
    for (const files::NpyArray* one : {lit, frequency})
      if (one == nullptr || one->type.kind == 'U' || one->shape != files::NpyShape{arrays_.phases()}) return;
    for (std::size_t k = 0; k < arrays_.phases(); ++k) {
      raw.lit.push_back(lit->number(k) != 0 ? 1 : 0);
      raw.modulation_frequency_hz.push_back(frequency->number(k));
    }
  }

  void refuse_faults() const {
    if (missing_.empty()) return;
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: the file has no {}\n  the picture is made of z_m, amplitude_e, flags, and gt_z_m or "
                            "noise_m; `tofray process` makes depth of raw frames, and --raw shows these",
                            base::printable(arrays_.where()), base::listed(missing_, "and")));
  }

  const results::Arrays& arrays_;
  std::vector<std::string> missing_;
  std::size_t width_ = 0, height_ = 0;
};

std::string text_in(const files::Json* from, const char* key) {
  const files::Json* found = from == nullptr ? nullptr : from->find(key);
  return found != nullptr && found->is_string() ? *found->string() : "";
}

/// The caption that `render` gave the frame; the file's name where `meta` says nothing.
std::string caption_of_file(const results::Arrays& arrays) {
  const std::string stem = std::filesystem::path(arrays.where()).stem().native();
  const files::Json& meta = arrays.meta();
  const files::Json* camera = meta.find("camera");
  const std::string scene = text_in(meta.find("scene"), "name"), name = text_in(camera, "name");
  if (scene.empty() || name.empty()) return stem;
  double index = 0;
  const files::Json* frame = meta.find("frame");
  if (frame == nullptr || !frame->number(index) || !(index >= 0 && index < 1e15)) index = 0;
  return run::caption_of(scene, name, text_in(camera->find("mode"), "name"), static_cast<std::uint64_t>(index), stem.starts_with("frame_"));
}

Shown shown_of_file(const std::string& path, const Options& options) {
  run::refuse_missing(path);
  if (path.ends_with(".npy"))
    throw Error(ErrorKind::bad_input,
                base::printable(path) + ": error: a single array is no frame\n  expected a .npz file, such as frame.npz");
  if (!options.set.empty() || options.seed || options.noise || !options.mode.empty())
    throw Error(
        ErrorKind::bad_input,
        base::printable(path) +
            ": error: this file is finished, its settings cannot be changed\n  expected a scene with --set, --mode, --seed and --noise");
  const results::Arrays arrays = results::read_arrays(path);
  Shown out{{}, caption_of_file(arrays)};
  if (options.raw)
    out.frame.raw = results::read_raw_npz(path);
  else
    out.frame = ShownReader(arrays).depth();
  return out;
}

Shown shown_of_scene(const std::string& scene, const Options& options) {
  const run::Loaded in = run::load(input_request(scene, options));
  say(texts(in.remarks));
  SimulatorOptions wanted = simulator_options(options);
  if (options.raw)
    wanted.arrays = {"raw"};
  else
    wanted.arrays = {"z_m", "amplitude_e", "noise_m", "flags", "gt_z_m", "gt_multipath_m"};
  return {first_frame(in, wanted), run::caption_of(in.scene.name, in.camera.name, in.camera.mode.name, 0, false)};
}

/// Without -o the terminal shows z: what is of a picture in a file has no use there.
void refuse_of_files(const Options& options) {
  const std::pair<const char*, bool> of_files[] = {{"--raw", options.raw},
                                                   {"--theme", options.theme != pictures::Theme::dark},
                                                   {"--scale", options.scale != 1},
                                                   {"--json", options.json}};
  for (const auto& [name, given] : of_files)
    if (given)
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} is of a picture in a file\n  expected -o with it, as in -o slide.svg", name));
}

void show_in_terminal(const Shown& shown) {
  const auto colors = stdout_has_colors() ? pictures::TerminalColors::full : pictures::TerminalColors::none;
  print_picture(pictures::terminal_picture(shown.frame.depth, std::min(terminal_columns(), 100), colors) + "\n");
  print(shown.caption + "\n");
}

}  // namespace

int run_preview(const Options& options) {
  if (options.output.empty()) refuse_of_files(options);
  const NameChoice chosen = run::frame_or_scene(options.words[0], "preview");
  say(run::note_of(chosen));
  const Shown shown = results::holds_arrays(chosen.name) ? shown_of_file(chosen.name, options) : shown_of_scene(chosen.name, options);
  if (options.output.empty()) return show_in_terminal(shown), 0;
  const pictures::Style style{options.theme, options.scale, *pictures::format_of(options.output)};
  const Frame& frame = shown.frame;
  const std::string picture = options.raw ? pictures::raw_picture(frame.raw, style)
                                          : pictures::preview_picture(frame.depth, frame.truth, frame.raw, shown.caption, style);
  files::write_file_atomically(options.output, picture);
  if (options.json)
    print(files::json_text(files::Json::object().set("file", options.output).set("bytes", picture.size()), 2) + "\n");
  else
    Talk(options.quiet)(fmt::format("open {}\n", base::printable(options.output)));
  return 0;
}

}  // namespace tofray::app
