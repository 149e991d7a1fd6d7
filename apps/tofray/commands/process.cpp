// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/requests.h"
#include "commands/film_text.h"
#include "commands/results.h"
#include "results/transient_file.h"
#include "run/frame_files.h"
#include "run/input_kind.h"
#include "run/mcap_recording.h"
#include "run/recording.h"
#include "run/run.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

/// The profile that was named, or none.
run::RecordingCamera camera_for(const Options& options, Remarks& remarks) {
  if (options.camera.empty()) return {"", options.mode, camera_settings(options)};
  const NameChoice chosen = choose_camera(options.camera);
  remarks.tell(run::note_of(chosen));
  return {chosen.name, options.mode, camera_settings(options)};
}

/// Files, manifest and summary of a frame that is done.
int write_results(const Options& options, const run::Loaded& in, const run::FrameFiles& what, const Frame& frame, const RanOn& machine,
                  run::Stopwatch& stopwatch, Remarks& remarks) {
  say_fallback(options, machine, remarks);
  stopwatch.lap("process");
  if (const std::vector<std::string> missing = results::missing_arrays(frame, what.npz); !missing.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: --arrays asks for {}, and there {}\n  {}, all else has to be in the file", in.files[0].name,
                            base::listed(missing, "and"), missing.size() == 1 ? "is none" : "are none",
                            options.transient.empty() ? "depth is computed" : "raw frames and depth are computed"));

  files::OutputFolder folder(options.output.empty() ? in.scene.name + "-depth" : options.output);
  const run::EarlierFiles left(folder.path());
  run::write_frame(folder, what, frame);
  stopwatch.lap("write");
  RunResult result;
  result.frames = 1, result.ran_on = machine;
  run::finish(run_request("", options), in.files, folder, left, stopwatch, result);
  remarks.tell(result.remarks);
  result.last = validity(frame, in.camera);
  remarks.tell(run::depth_png_remarks(what, pictures::beyond_depth_png(frame.depth)));
  if (result.last.pixels.valid == 0) remarks.tell(fmt::format("warning: no pixel has a valid depth: {}\n", result.last.reasons));
  if (options.json)
    print(files::json_text(summary_json(result, remarks), 2) + "\n");
  else
    Talk(options.quiet)(summary_text(result));
  return 0;
}

/// Films are made by simulations.
void refuse_film(const Options& options) {
  if (options.emit && std::find(options.emit->begin(), options.emit->end(), "mcap") != options.emit->end())
    throw Error(ErrorKind::bad_input, "error: --emit mcap is of `tofray render`\n  expected npz, png, ply or several of them");
}

void refuse_transient_options(const Options& options) {
  if (options.first_m || options.width_m || options.per_factor || options.seed || options.noise)
    throw Error(ErrorKind::bad_input,
                "error: --first, --width, --factor, --seed and --noise go with --transient\n  raw frames have their noise already");
}

/// Raw frames to depth.
int process_raw(const Options& options) {
  refuse_transient_options(options);
  run::Stopwatch stopwatch;
  run::refuse_missing(options.words[0]);
  const run::Recording from = run::read_recording(options.words[0]);
  Remarks remarks;
  const run::Loaded in = run::load_recording(from, "raw", camera_for(options, remarks));
  remarks.tell(in.remarks);
  SimulatorOptions wanted = simulator_options(options);
  Frame frame = run::recorded_frame(from, in.camera, wanted.noise);
  const run::FrameFiles what(run_request("", options).files, {"npz", "png", "ply"}, in, wanted);
  stopwatch.lap("prepare");
  RanOn machine;
  frame.depth = process(frame.raw, in.camera, wanted, &machine);
  frame.truth = run::truth_of(in.kept, frame.depth);
  return write_results(options, in, what, frame, machine, stopwatch, remarks);
}

/// Frames of an MCAP file, into numbered files.
int process_film(const Options& options) {
  refuse_transient_options(options);
  run::Stopwatch stopwatch;
  const std::string& path = options.words[0];
  run::refuse_missing(path);
  const std::unique_ptr<mcap::Source> source = mcap::open_file(path);
  Remarks remarks;
  const run::RecordingCamera camera = camera_for(options, remarks);
  files::OutputFolder folder(options.output.empty() ? std::filesystem::path(path).stem().native() + "-depth" : options.output);
  const run::EarlierFiles left(folder.path());
  std::optional<run::Loaded> in;
  std::optional<run::FrameFiles> what;
  SimulatorOptions wanted = simulator_options(options);
  RunResult result;
  std::string memory;
  const std::uint64_t first = options.first_frame, end = options.frames ? first + *options.frames : UINT64_MAX;
  stopwatch.lap("prepare");
  const run::FilmRead read = run::read_film(*source, path, [&](std::uint64_t index, const run::Recording& from) {
    if (index < first) return true;
    if (index >= end) return false;
    if (!in) {
      in = run::load_recording(from, "raw", camera);
      in->kept.clear();  // of the first frame alone
      remarks.tell(in->remarks);
      (void)run::recorded_frame(from, in->camera, wanted.noise);
      what.emplace(run_request("", options).files, std::vector<std::string>{"npz"}, *in, wanted);
    }
    Frame frame = run::recorded_frame(from, in->camera, wanted.noise);
    frame.index = index;
    frame.depth = process(frame.raw, in->camera, wanted, &result.ran_on);
    stopwatch.lap("process");
    for (FileRecord& file : run::write_frame(folder, *what, fmt::format("_{:04}", index), frame, memory)) folder.add(std::move(file));
    stopwatch.lap("write");
    ++result.frames;
    result.last = validity(frame, in->camera);
    return true;
  });
  if (!in && read.frames == 0) run::refuse_film_without_raw(path);
  if (!in)
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: there are no raw frames of these numbers in it\n  it has {} frames",
                                                  base::printable(path), read.frames));
  if (!read.complete) remarks.tell(ends_early(path));
  say_fallback(options, result.ran_on, remarks);
  run::finish(run_request("", options), in->files, folder, left, stopwatch, result);
  remarks.tell(result.remarks);
  if (options.json)
    print(files::json_text(summary_json(result, remarks), 2) + "\n");
  else
    Talk(options.quiet)(summary_text(result));
  return 0;
}

/// Light by path length to raw frames and depth.
int process_transient(const Options& options) {
  if (!options.words.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("error: --transient takes the place of {}\n  expected one file, of light or of raw frames",
                            base::in_quotes(options.words[0])));
  run::Stopwatch stopwatch;
  const run::Recording from = run::read_recording(options.transient);
  Remarks remarks;
  run::Loaded in = run::load_recording(from, "transient", camera_for(options, remarks));
  remarks.tell(in.remarks);
  SimulatorOptions wanted = simulator_options(options);
  wanted.truth = false;  // what the file has of it is kept
  const Transient light =
      results::parse_transient(from.bytes, from.path, in.camera, {options.first_m, options.width_m, options.per_factor.value_or(1)});
  in.scene.transport.transient = {light.bins, light.first_m, light.bin_width_m};
  const run::FrameFiles what(run_request("", options).files, {"npz", "png", "ply"}, in, wanted);
  Simulator simulator({}, in.camera, wanted);
  stopwatch.lap("prepare");
  Frame frame = simulator.frame(0, light);
  frame.truth = run::truth_of(in.kept, frame.depth);
  return write_results(options, in, what, frame, simulator.ran_on(), stopwatch, remarks);
}

}  // namespace

int run_process(const Options& options) {
  refuse_film(options);
  if (options.transient.empty() && run::is_film(options.words[0])) return process_film(options);
  if (options.frames || options.first_frame != 0)
    throw Error(ErrorKind::bad_input, "error: --frames and --first-frame are of MCAP files\n  expected run.mcap, or neither of them");
  return options.transient.empty() ? process_raw(options) : process_transient(options);
}

}  // namespace tofray::app
