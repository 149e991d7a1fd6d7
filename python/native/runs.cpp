// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "runs.h"

#include <optional>

#include "convert.h"
#include "films.h"
#include "frames.h"
#include "interrupt.h"
#include "simulator.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

template <class T>
void take_key(const py::dict& words, const char* name, T& into) {
  if (words.contains(name)) from_python(words[name], into, {nullptr, name});
}

InputRequest input_request(const py::dict& words) {
  InputRequest out;
  take_key(words, "scene", out.scene), take_key(words, "set", out.set), take_key(words, "mode", out.mode);
  take_key(words, "root", out.root), take_key(words, "manifest", out.manifest);
  return out;
}

/// @param words    what is asked for; with `manifest` that says it, and these come on top: folder, clean
/// @param options  of the simulator
RunRequest run_request(const py::dict& words, const py::dict& options) {
  const InputRequest inputs = input_request(words);
  RunRequest out;
  const SimulatorOptions simulator = options_from_python(options);
  if (inputs.manifest.empty()) {
    out.inputs = inputs, out.simulator = simulator;
    take_key(words, "frames", out.frames), take_key(words, "first_frame", out.first_frame);
    take_key(words, "emit", out.files.emit), take_key(words, "arrays", out.files.arrays), take_key(words, "compress", out.files.compress);
    take_key(words, "light_theme", out.files.light_theme), take_key(words, "scale", out.files.scale);
    if (words.contains("mcap")) take_film_words(words["mcap"].cast<py::dict>(), out.files.messages, out.files.compression);
  } else {
    out = request_of_manifest(inputs.manifest);
    out.inputs.root = inputs.root;
    out.simulator.threads = simulator.threads, out.simulator.backend = simulator.backend, out.simulator.device = simulator.device;
  }
  take_key(words, "folder", out.folder), take_key(words, "clean", out.clean), take_key(words, "command", out.command);
  return out;
}

/// @param each  called with how many frames are complete, after each; None: nothing is
py::object render_to(const py::dict& words, const py::dict& options, const py::object& each) {
  const RunRequest request = run_request(words, options);
  FrameProgress progress;
  std::optional<py::error_already_set> fault;
  RunWatch watch;
  watch.progress = &progress;
  if (!each.is_none())
    watch.frame_done = [&](const Frame&, std::uint64_t done) {
      const py::gil_scoped_acquire held;
      try {
        each(done);
      } catch (py::error_already_set& raised) {
        fault.emplace(raised);
        progress.stop = true;  // what is complete stays, and manifest.json lists it
      }
    };
  RunResult out;
  {
    const StopOnInterrupt interrupt(progress);
    const py::gil_scoped_release free;
    out = render(request, watch);
  }
  if (fault) throw *fault;
  if (progress.stop && PyErr_CheckSignals() != 0) throw py::error_already_set();
  return to_python(out);
}

py::object inputs_of(const py::dict& words) {
  const InputRequest request = input_request(words);
  Inputs out;
  {
    const py::gil_scoped_release free;
    out = load_inputs(request);
  }
  return to_python(out);
}

std::optional<Camera> camera_of(const py::object& camera) {
  std::optional<Camera> out;
  if (!camera.is_none()) from_python(camera, out.emplace(), {nullptr, "camera"});
  return out;
}

py::object chain_of(const py::object& frame, const py::object& camera, bool noise_free, int u, int v) {
  const std::shared_ptr<Frame> is = frame_from_python(frame);
  const std::optional<Camera> by = camera_of(camera);
  return to_python(pixel_chain(pixel_arrays(*is), by ? &*by : nullptr, noise_free, u, v));
}

py::object bounces_of(const py::object& frame, const py::object& scene, const py::object& camera, const py::dict& options, int u, int v) {
  const std::shared_ptr<Frame> is = frame_from_python(frame);
  Scene seen;
  Camera by;
  from_python(scene, seen, {nullptr, "scene"}), from_python(camera, by, {nullptr, "camera"});
  SimulatorOptions simulated = options_from_python(options);
  FrameProgress progress;
  simulated.progress = &progress;
  PixelBounces out;
  {
    const StopOnInterrupt interrupt(progress);
    const py::gil_scoped_release free;
    out = pixel_bounces(pixel_arrays(*is), is->index, seen, by, simulated, u, v);
  }
  if (progress.stop && PyErr_CheckSignals() != 0) throw py::error_already_set();
  return to_python(out);
}

py::object validity_of(const py::object& frame, const py::object& camera, bool wrong_cycles) {
  const std::shared_ptr<Frame> is = frame_from_python(frame);
  Camera by;
  from_python(camera, by, {nullptr, "camera"});
  Validity out;
  {
    const py::gil_scoped_release free;
    out = validity(*is, by, wrong_cycles);
  }
  return to_python(out);
}

}  // namespace

void bind_runs(py::module_& module) {
  module.def("render", &render_to);
  module.def("load_inputs", &inputs_of);
  module.def("pixel_chain", &chain_of);
  module.def("pixel_bounces", &bounces_of);
  module.def("validity", &validity_of);
}

}  // namespace tofray::python
