// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/requests.h"
#include "commands/results.h"
#include "pictures/terminal_picture.h"
#include "run/run.h"
#include "tofray/stages.h"

namespace tofray::app {

namespace {

std::string told(const RunResult& result, const run::Loaded& in) {
  const auto [width, height] = image_size(in.camera);
  std::string text = fmt::format("{} in mode {}: {} x {} pixels, {} raw frames, {} objects, depth as colour\n", in.camera.name,
                                 in.camera.mode.name, width, height, in.camera.mode.sequence.size(), in.scene.objects.size());
  text += depth_text(result.last, "");
  text += fmt::format("{} files in {}, {:.2f} s with {}\n", result.files.size(), result.folder.native(), total_time(result),
                      machine_text(result.ran_on));
  const std::string npz = (result.folder / "frame.npz").native();
  text += "\nNext:\n";
  if (std::any_of(result.files.begin(), result.files.end(), [](const FileRecord& file) { return file.name == "frame.npz"; }))
    text += fmt::format("  tofray inspect {} --pixel 112,86      # how one pixel gets its depth\n", npz);
  text += "  tofray demo --set camera.illumination.0.power=\"0.02 W\"   # a tenth of the light\n";
  text += "  tofray list scenes                                       # more scenes; `tofray render` takes your own\n";
  return text + picture_to_open(result);
}

}  // namespace

int run_demo(const Options& options) {
  run::Stopwatch stopwatch;
  RunRequest request = run_request("demo", options);
  if (request.folder.empty()) request.folder = "tofray-demo";
  const run::Loaded in = run::load(request.inputs);
  Remarks remarks;
  Depth depth;
  RunWatch watch;
  watch.remark = [&](const Remark& one) { remarks.tell({one}); };
  watch.started = [&](const RanOn& machine) { say_fallback(options, machine, remarks); };
  watch.frame_done = [&](const Frame& frame, std::uint64_t) { depth = frame.depth; };
  const RunResult result = run::perform(request, in, watch, stopwatch);
  if (options.json) {
    print(files::json_text(summary_json(result, remarks), 2) + "\n");
  } else {
    const auto colors = stdout_has_colors() ? pictures::TerminalColors::full : pictures::TerminalColors::none;
    if (!options.quiet) print_picture(pictures::terminal_picture(depth, std::min(terminal_columns(), 100), colors) + "\n");
    if (!options.quiet) print(told(result, in));
  }
  return 0;
}

}  // namespace tofray::app
