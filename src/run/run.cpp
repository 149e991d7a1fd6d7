// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/run.h"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "run/frame_files.h"
#include "run/frame_writer.h"
#include "run/manifest.h"
#include "run/mcap_sink.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

/// A number as wide as the last one's, of four digits at least.
std::string suffix_of(std::uint64_t index, std::uint64_t last) {
  const std::size_t digits = std::max<std::size_t>(4, fmt::formatted_size("{}", last));
  return fmt::format("_{:0{}}", index, digits);
}

/// What is counted while frames are computed.
struct Counts {
  std::uint64_t all_invalid = 0;  ///< frames without any valid pixel
  SceneReport first;              ///< of the first frame
  std::size_t beyond_png = 0;     ///< pixels whose z depth.png cannot hold
  double light = 0, lost = 0;     ///< of all histograms by path length, and what lies beyond their bins
};

void add_lost(const Truth& truth, Counts& out) {
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

std::vector<Remark> lost_remarks(const Counts& of) {
  if (!(of.lost > 0)) return {};
  return {{true, "",
           fmt::format("{:.3g} % of the light took paths that are shorter or longer than all bins of transient_e_per_s",
                       100 * of.lost / of.light),
           "transient_lost_e_per_s has it; transport.transient.first, bins and width say which lengths there are"}};
}

std::vector<Remark> invalid_remarks(const Counts& of, const RunResult& result) {
  if (of.all_invalid == 0) return {};
  return {{true, "",
           fmt::format("no pixel has a valid depth in {} of {} frame{}", of.all_invalid, result.frames, result.frames == 1 ? "" : "s"),
           "in the last frame: " + result.last.reasons}};
}

/// Tells and keeps.
void add(std::vector<Remark> more, const RunWatch& watch, RunResult& result) {
  for (Remark& one : more) {
    if (watch.remark) watch.remark(one);
    result.remarks.push_back(std::move(one));
  }
}

/// @param stop  ends the run with the last whole frame
Counts render_frames(Simulator& simulator, const RunRequest& request, const FrameFiles& what, files::OutputFolder& folder,
                     Stopwatch& stopwatch, const std::atomic<bool>& stop, const RunWatch& watch, RunResult& result) {
  const std::uint64_t frames = request.frames.value_or(1), first = request.first_frame;
  // One frame has no number, unless it was asked for by number.
  const bool numbered = request.frames.has_value() || first > 0;
  Counts out;
  std::optional<McapSink> film;
  if (what.emits("mcap")) film.emplace(folder, what, request);
  FrameWriter writer(folder, what, frames, film ? &*film : nullptr);
  for (std::uint64_t i = first; i < first + frames; ++i) {
    Frame& frame = writer.next();
    stopwatch.lap("write");
    simulator.frame(i, frame);
    stopwatch.lap("simulate");
    if (stop) break;
    // Of the last frame alone it is worth the time to know wrong cycles.
    result.last = validity(frame, what.inputs.camera, i + 1 == first + frames);
    if (result.last.pixels.valid == 0) ++out.all_invalid;
    if (i == first) out.first = scene_report(what.inputs.scene, what.inputs.camera, frame.truth);
    add_lost(frame.truth, out);
    out.beyond_png += pictures::beyond_depth_png(frame.depth);
    writer.write(numbered ? suffix_of(i, first + frames - 1) : "");
    ++result.frames;
    if (watch.frame_done) watch.frame_done(frame, result.frames);
  }
  writer.finish();
  if (film && result.frames > 0) folder.add(film->finish());
  stopwatch.lap("write");
  return out;
}

}  // namespace

std::vector<std::string> kinds_of(const FrameFileRequest& request, std::uint64_t frames) {
  return request.emit ? *request.emit : frames > 1 ? std::vector<std::string>{"npz"} : std::vector<std::string>{"npz", "png", "ply"};
}

void finish(const RunRequest& request, const std::vector<InputFile>& inputs, files::OutputFolder& folder, const EarlierFiles& left,
            const Stopwatch& stopwatch, RunResult& result) {
  results::Manifest manifest = manifest_of(request);
  manifest.inputs = inputs;
  manifest.backend = result.ran_on.backend;
  manifest.gpu = result.ran_on.backend == "cuda" ? result.ran_on.device : "";
  manifest.cpu_model = results::cpu_model();
  manifest.isa = result.ran_on.isa;
  manifest.threads = result.ran_on.threads;
  manifest.timings_s = result.timings_s = stopwatch.stages();
  manifest.files = folder.files();
  if (result.interrupted) manifest.interrupted_after_frames = result.frames;
  for (Remark& one : left.settle(folder, request.clean, manifest)) result.remarks.push_back(std::move(one));
  folder.write("manifest.json", results::manifest_text(manifest));
  result.folder = folder.path(), result.files = folder.files();
}

RunResult perform(const RunRequest& request, const Loaded& in, const RunWatch& watch, Stopwatch& stopwatch) {
  RunResult result;
  add(in.remarks, watch, result);
  const std::uint64_t frames = request.frames.value_or(1);
  if (frames < 1 || frames > most_frames || request.first_frame > most_frames)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: a run of {} frames from number {} on was asked for\n  expected 1 to {} frames, from 0 to {} on", frames,
                            request.first_frame, most_frames, most_frames));
  SimulatorOptions wanted = request.simulator;
  const FrameFiles what(request.files, kinds_of(request.files, frames), in, wanted);
  wanted.arrays = what.needed_arrays();
  FrameProgress own;
  wanted.progress = watch.progress != nullptr ? watch.progress : &own;
  Simulator simulator(needed(in.scene, what), in.camera, wanted);
  if (watch.started) watch.started(simulator.ran_on());
  files::OutputFolder folder(request.folder.empty() ? std::filesystem::path(in.scene.name) : request.folder);
  const EarlierFiles left(folder.path());
  stopwatch.lap("prepare");
  const Counts counts = render_frames(simulator, request, what, folder, stopwatch, wanted.progress->stop, watch, result);
  result.ran_on = simulator.ran_on();
  result.interrupted = result.frames < frames;
  result.folder = folder.path();
  if (result.frames == 0) return result;
  const std::size_t told = result.remarks.size();
  finish(request, in.files, folder, left, stopwatch, result);
  std::vector<Remark> of_folder(result.remarks.begin() + static_cast<std::ptrdiff_t>(told), result.remarks.end());
  result.remarks.resize(told);
  add(std::move(of_folder), watch, result);
  add(findings_of(counts.first, in.told_size, result.last.few()), watch, result);
  add(invalid_remarks(counts, result), watch, result);
  add(lost_remarks(counts), watch, result);
  add(depth_png_remarks(what, counts.beyond_png), watch, result);
  return result;
}

}  // namespace tofray::run

namespace tofray {

RunResult render(const RunRequest& request, const RunWatch& watch) {
  run::Stopwatch stopwatch;
  return run::perform(request, run::load(request.inputs), watch, stopwatch);
}

}  // namespace tofray
