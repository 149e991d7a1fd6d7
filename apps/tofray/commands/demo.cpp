// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>

#include "base/readout.h"
#include "commands.h"
#include "console.h"
#include "pictures/terminal_picture.h"
#include "results.h"

namespace tofray::app {

namespace {

std::string told(const Validity& pixels, const Inputs& in, const Simulator& simulator, const files::OutputFolder& folder,
                 const Stopwatch& stopwatch) {
  const Sensor sensor = base::as_read_out(in.camera).sensor;
  std::string text = fmt::format("{} in mode {}: {} x {} pixels, {} raw frames, {} objects, depth as colour\n", in.camera.name,
                                 in.camera.mode.name, sensor.width, sensor.height, in.camera.mode.sequence.size(), in.scene.objects.size());
  text += depth_text(pixels, "");
  text += fmt::format("{} files in {}, {:.2f} s with {}\n", folder.files().size(), folder.path().native(), stopwatch.total(),
                      machine_text(simulator.ran_on()));
  const std::string npz = (folder.path() / "frame.npz").native();
  text += "\nNext:\n";
  if (std::any_of(folder.files().begin(), folder.files().end(), [](const files::FileRecord& file) { return file.name == "frame.npz"; }))
    text += fmt::format("  tofray inspect {} --pixel 112,86      # how one pixel gets its depth\n", npz);
  text += "  tofray demo --set camera.illumination.0.power=\"0.02 W\"   # a tenth of the light\n";
  text += "  tofray list scenes                                       # more scenes; `tofray render` takes your own\n";
  return text + picture_to_open(folder);
}

}  // namespace

int run_demo(const Options& options) {
  Stopwatch stopwatch;
  Inputs in = load_inputs("demo", options);
  Remarks remarks;
  remarks.tell(warnings(in));
  SimulatorOptions wanted = simulator_options(options);
  const FrameFiles what(options, {"npz", "png", "ply"}, in, wanted);
  wanted.arrays = what.needed_arrays();
  Simulator simulator(in.scene, in.camera, wanted);
  say_fallback(options, simulator.ran_on(), remarks);
  files::OutputFolder folder(options.output.empty() ? "tofray-demo" : options.output);
  EarlierFiles left(folder.path());
  stopwatch.lap("prepare");
  const Frame frame = simulator.frame(0);
  stopwatch.lap("simulate");
  write_frame(folder, what, frame);
  stopwatch.lap("write");
  const RanOn machine = simulator.ran_on();
  write_manifest(folder, options, in.files, machine, stopwatch, left, remarks);
  const Validity pixels = validity(frame, in.camera);
  remarks.tell(scene_report(in.scene, in.camera, frame.truth).findings, pixels.few());
  if (options.json) {
    print(files::json_text(summary_json(folder, pixels, 1, machine, stopwatch, remarks), 2) + "\n");
  } else {
    const auto colors = stdout_has_colors() ? pictures::TerminalColors::full : pictures::TerminalColors::none;
    if (!options.quiet) print_picture(pictures::terminal_picture(frame.depth, std::min(terminal_columns(), 100), colors) + "\n");
    if (!options.quiet) print(told(pixels, in, simulator, folder, stopwatch));
  }
  return 0;
}

}  // namespace tofray::app
