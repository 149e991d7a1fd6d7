// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <set>

#include "base/text.h"
#include "base/version.h"
#include "commands.h"
#include "console.h"
#include "frame_writer.h"
#include "input_kind.h"
#include "progress.h"
#include "recall.h"
#include "results.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

void refuse_other_settings(const Options& now) {
  if (!now.words.empty() || !now.set.empty() || !now.mode.empty() || now.seed || now.noise || now.exposure_samples || now.subpixel ||
      now.emit || !now.arrays.empty() || now.compress || now.scale != 1 || now.frames || now.first_frame != 0)
    throw Error(ErrorKind::bad_input,
                "error: --from makes the same bytes again and takes no other scene and no other settings\n"
                "  with it there may be -o, --threads, --backend, --device, --json and --quiet");
}

void say_other_version(const results::Manifest& manifest, Remarks& remarks) {
  if (manifest.tofray_version != base::version())
    remarks.tell(fmt::format("warning: tofray {} wrote this manifest, this is {}\n  the bytes may differ\n", manifest.tofray_version,
                             base::version()));
}

/// The files whose bytes are not those of the manifest.
std::vector<std::string> changed_files(const results::Manifest& before, const files::OutputFolder& folder) {
  std::set<std::pair<std::string, std::string>> written;
  for (const files::FileRecord& file : folder.files()) written.emplace(file.name, file.sha256);
  std::vector<std::string> changed;
  for (const files::FileRecord& old : before.files)
    if (!written.contains({old.name, old.sha256})) changed.push_back(old.name);
  return changed;
}

/// Drawn for people, with the letters that the machine has: on another one it may have other bytes. What it shows is in other files, too.
bool is_figure(const std::string& name) { return name.ends_with(".png") && (name.starts_with("preview") || name.starts_with("raw")); }

/// Whether a run made the files that its manifest lists; says what it did not make.
bool made_again(const Options& options, const results::Manifest& before, const files::OutputFolder& folder, Remarks& remarks) {
  const std::vector<std::string> changed = changed_files(before, folder);
  if (changed.empty()) return true;
  if (std::all_of(changed.begin(), changed.end(), is_figure)) {
    remarks.tell(fmt::format("note: {} {} letters of other fonts than {} lists; all else has the same bytes\n",
                             base::listed(changed, "and"), changed.size() == 1 ? "has" : "have", options.from));
    return true;
  }
  say(fmt::format("error: {} of {} files are not the bytes that {} lists: {}\n  it was written by tofray {} on {} ({})\n", changed.size(),
                  before.files.size(), options.from, base::listed(changed, "and"), before.tofray_version, before.cpu_model, before.isa));
  return false;
}

std::string suffix_of(std::uint64_t index, std::uint64_t last) {
  const std::size_t digits = std::max<std::size_t>(4, fmt::formatted_size("{}", last));
  return fmt::format("_{:0{}}", index, digits);
}

/// The kinds of files that a run writes: unless told, all for one frame, npz for many.
std::vector<std::string> kinds_of(const Options& options, std::uint64_t frames) {
  return options.emit ? *options.emit : frames > 1 ? std::vector<std::string>{"npz"} : std::vector<std::string>{"npz", "png", "ply"};
}

struct Rendered {
  Validity last;                  ///< of the last frame
  std::uint64_t frames = 0;       ///< how many are complete
  std::uint64_t all_invalid = 0;  ///< frames without any valid pixel
  std::vector<SceneFinding> odd;  ///< about the scene in the first frame
  std::size_t beyond_png = 0;     ///< pixels whose z depth.png cannot hold
  double light = 0, lost = 0;     ///< of all histograms by path length, and what lies beyond their bins
};

void add_lost(const Truth& truth, Rendered& out) {
  double lost = 0;
  for (const float light : truth.transient_lost_e_per_s) lost += static_cast<double>(light);
  out.lost += lost, out.light += lost;
  for (const float light : truth.transient_e_per_s) out.light += static_cast<double>(light);
}

/// The scene as its frames need it: without histograms where no file shows them.
Scene needed(const Scene& scene, const FrameFiles& what) {
  Scene out = scene;
  if (!what.need_transient()) out.transport.transient = {};
  return out;
}

/// @param now   how far the frame under way is
/// @param stop  gives the frame under way up; none: a signal ends the process at once
void render_frames(Simulator& simulator, const Options& options, const FrameFiles& what, files::OutputFolder& folder, Stopwatch& stopwatch,
                   FrameProgress& now, const StopRequest* stop, Rendered& out) {
  const std::uint64_t frames = options.frames.value_or(1), first = options.first_frame;
  // One frame has no number, unless it was asked for by number.
  const bool numbered = options.frames.has_value() || first > 0;
  Progress progress(frames, "frames", options.quiet, &now);
  FrameWriter writer(folder, what, frames);
  for (std::uint64_t i = first; i < first + frames; ++i) {
    Frame& frame = writer.next();
    stopwatch.lap("write");
    simulator.frame(i, frame);
    stopwatch.lap("simulate");
    if (stop != nullptr && stop->signal() != 0) break;
    // Of the last frame alone it is worth the time to know wrong cycles.
    out.last = validity(frame, what.inputs.camera, i + 1 == first + frames);
    if (out.last.pixels.valid == 0) ++out.all_invalid;
    if (i == first) out.odd = findings_of(scene_report(what.inputs.scene, what.inputs.camera, frame.truth), what.inputs);
    add_lost(frame.truth, out);
    out.beyond_png += pictures::beyond_depth_png(frame.depth);
    writer.write(numbered ? suffix_of(i, first + frames - 1) : "");
    ++out.frames;
    progress.step();
  }
  writer.finish();
  stopwatch.lap("write");
}

void warn_of_lost(const Rendered& out, Remarks& remarks) {
  if (!(out.lost > 0)) return;
  remarks.tell(
      fmt::format("warning: {:.3g} % of the light took paths that are shorter or longer than all bins of transient_e_per_s\n"
                  "  transient_lost_e_per_s has it; transport.transient.first, bins and width say which lengths there are\n",
                  100 * out.lost / out.light));
}

void warn_of_invalid(const Rendered& out, Remarks& remarks) {
  if (out.all_invalid == 0) return;
  remarks.tell(fmt::format("warning: no pixel has a valid depth in {} of {} frame{}\n  in the last frame: {}\n", out.all_invalid,
                           out.frames, out.frames == 1 ? "" : "s", out.last.reasons));
}

/// What lies there after an interruption, and how to make the rest with the same names and kinds of files.
void say_interrupted(const Options& options, const files::OutputFolder& folder, std::uint64_t done) {
  const std::uint64_t frames = *options.frames, next = options.first_frame + done;
  const std::string all = fmt::format("interrupted: {} of {} frames are complete", done, frames);
  const std::string listed = fmt::format(", {} lists them\n", (folder.path() / "manifest.json").native());
  std::string kinds;
  for (const std::string& kind : kinds_of(options, frames)) kinds += (kinds.empty() ? " --emit " : ",") + kind;
  say(all + listed +
      fmt::format("  the others: the same command with --first-frame {} --frames {}{}\n", next, frames - done,
                  kinds_of(options, frames - done) == kinds_of(options, frames) ? "" : kinds));
}

}  // namespace

int run_render(const Options& typed) {
  Stopwatch stopwatch;
  results::Manifest before;
  Remarks remarks;
  if (!typed.from.empty()) {
    before = results::read_manifest(typed.from);
    refuse_other_settings(typed);
    say_other_version(before, remarks);
  }
  const Options options = typed.from.empty() ? typed : recalled(typed, before);
  const NameChoice chosen = typed.from.empty() ? choose_scene(options.words[0]) : NameChoice();
  remarks.tell(note_of(chosen));
  const Inputs in = typed.from.empty() ? load_inputs(chosen.name, options) : inputs_of(before, options);
  remarks.tell(warnings(in));
  const std::uint64_t frames = options.frames.value_or(1);
  SimulatorOptions wanted = simulator_options(options);
  const FrameFiles what(options, kinds_of(options, frames), in, wanted);
  wanted.arrays = what.needed_arrays();
  FrameProgress now;
  wanted.progress = &now;
  Simulator simulator(needed(in.scene, what), in.camera, wanted);
  say_fallback(options, simulator.ran_on(), remarks);
  files::OutputFolder folder(options.output.empty() ? in.scene.name : options.output);
  EarlierFiles left(folder.path());
  stopwatch.lap("prepare");

  Rendered out;
  std::optional<StopRequest> stop;
  if (frames > 1) stop.emplace(&now.stop);
  render_frames(simulator, options, what, folder, stopwatch, now, stop ? &*stop : nullptr, out);
  if (out.frames == 0) {
    say("interrupted before the first frame was complete\n");
    return 128 + stop->signal();
  }
  const RanOn machine = simulator.ran_on();
  const bool interrupted = out.frames < frames;
  write_manifest(folder, options, in.files, machine, stopwatch, left, remarks, interrupted ? std::optional(out.frames) : std::nullopt);
  remarks.tell(out.odd, out.last.few());
  warn_of_invalid(out, remarks);
  warn_of_lost(out, remarks);
  warn_of_depth_png(what, out.beyond_png, remarks);
  if (interrupted) say_interrupted(options, folder, out.frames);
  const bool stopped = stop && stop->signal() != 0;
  const bool same = typed.from.empty() || stopped || made_again(typed, before, folder, remarks);
  if (options.json)
    print(files::json_text(summary_json(folder, out.last, out.frames, machine, stopwatch, remarks).set("interrupted", interrupted), 2) +
          "\n");
  else
    Talk(options.quiet)(summary_text(folder, out.last, out.frames, machine, stopwatch));
  return stopped ? 128 + stop->signal() : same ? 0 : 1;
}

}  // namespace tofray::app
