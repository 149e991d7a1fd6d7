// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>

#include "arrays.h"
#include "device_frames.h"
#include "frames.h"
#include "interrupt.h"
#include "meshes.h"
#include "own_arrays.h"

namespace tofray::python {

namespace {

/// Memory that nobody looks at any more: a frame's 5 MB cost more to fetch anew from the system than to fill, and so do a GPU's.
template <class T>
class Pool {
 public:
  explicit Pool(std::size_t most) : most_(most) {}

  /// One that comes back here, if the pool is still there, when nobody holds it any more.
  static std::shared_ptr<T> take(const std::shared_ptr<Pool>& pool) {
    std::unique_ptr<T> one;
    {
      const std::lock_guard lock(pool->mutex_);
      if (!pool->free_.empty()) one = std::move(pool->free_.back()), pool->free_.pop_back();
    }
    if (one == nullptr) one = std::make_unique<T>();
    return {one.release(), [weak = std::weak_ptr<Pool>(pool)](T* gone) {
              std::unique_ptr<T> back(gone);
              const std::shared_ptr<Pool> there = weak.lock();
              if (there == nullptr) return;
              const std::lock_guard lock(there->mutex_);
              if (there->free_.size() < there->most_) there->free_.push_back(std::move(back));
            }};
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
  std::size_t most_;
};

class HeldSimulator {
 public:
  HeldSimulator(const Scene& scene, const Camera& camera, SimulatorOptions options) : frame_rate_(camera.mode.frame_rate_hz) {
    options.progress = &progress_;
    simulator_ = std::make_unique<Simulator>(scene, camera, options);
    // What a stage before the last leaves alone has to be zero: only in a new frame it is.
    recycles_ = options.last_stage == Stage::depth;
    last_stage_ = options.last_stage;
  }

  /// A frame that goes back to the pool when its last array is gone.
  std::shared_ptr<Frame> new_frame() { return recycles_ ? Pool<Frame>::take(frames_) : std::make_shared<Frame>(); }
  std::shared_ptr<DeviceFrames> new_device_frames() { return Pool<DeviceFrames>::take(device_frames_); }

  /// Runs `compute` without the interpreter's lock, one thread at a time. Nothing is held while Python handles a signal.
  template <class Compute>
  void run(const Compute& compute) {
    refuse_child();
    if (owner_.load() == std::this_thread::get_id())
      throw Error(ErrorKind::bad_input,
                  "Simulator: error: a function that it calls asks it for a frame\n  expected a Simulator of its own there");
    for (;;) {
      bool stopped = false, asked = false;
      pending_callback_fault().reset();
      try {
        const std::unique_lock<std::timed_mutex> turn = wait_for_turn();
        progress_.stop.store(false), asked_to_stop_.store(false);
        // Only now: Ctrl-C of one who waits is not for the frame of another.
        const StopOnInterrupt watch(progress_);
        const py::gil_scoped_release free;
        const Owned owned(owner_);
        compute(*simulator_);
        stopped = progress_.stop.load(), asked = asked_to_stop_.load();
      } catch (...) {
        raise_callback_fault();
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        throw;
      }
      if (!stopped) return;
      // The frame means nothing. Ctrl-C raises, or Python's handler took it for something else and the frame is computed once more.
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (asked) raise_stopped();
    }
  }

  /// The raw frames' times as of frame 0, and when its ground truth holds: a batch's frames do not say theirs.
  const Frame& exposures() {
    if (exposures_.raw.phases == 0) {
      Frame first;
      run([&](Simulator& simulator) { simulator.frame(0, first); });
#define TOFRAY_EXPOSURE(name, part, member, ...) exposures_.part.member = first.part.member;
      TOFRAY_EXPOSURE_ARRAYS(TOFRAY_EXPOSURE)
#undef TOFRAY_EXPOSURE
      exposures_.truth.time_s = first.truth.time_s;
      exposures_.raw.phases = first.raw.phases;
    }
    return exposures_;
  }

  void stop() {
    if (owner_.load() == std::thread::id()) return;
    asked_to_stop_.store(true);
    progress_.stop.store(true);
  }

  [[nodiscard]] py::tuple progress() const { return py::make_tuple(progress_.done.load(), progress_.total.load()); }
  [[nodiscard]] RanOn ran_on() const { return simulator_->ran_on(); }
  [[nodiscard]] std::vector<PlanStep> plan() {
    std::vector<PlanStep> steps;
    run([&](Simulator& simulator) { steps = simulator.plan(); });
    return steps;
  }
  [[nodiscard]] double frame_rate() const { return frame_rate_; }
  [[nodiscard]] Stage last_stage() const { return last_stage_; }

 private:
  struct Owned {
    explicit Owned(std::atomic<std::thread::id>& which) : owner(which) { owner.store(std::this_thread::get_id()); }
    ~Owned() { owner.store({}); }
    Owned(const Owned&) = delete;
    Owned& operator=(const Owned&) = delete;
    std::atomic<std::thread::id>& owner;
  };

  /// Waits for whoever computes. A signal meanwhile is Python's at once.
  std::unique_lock<std::timed_mutex> wait_for_turn() {
    constexpr std::chrono::milliseconds between_signals{50};
    std::unique_lock<std::timed_mutex> turn(mutex_, std::defer_lock);
    for (;;) {
      {
        const py::gil_scoped_release free;
        if (turn.try_lock_for(between_signals)) break;
      }
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return turn;
  }

  [[noreturn]] static void raise_stopped() {
    const py::object stopped = py::module_::import("tofray._errors").attr("Stopped");
    PyErr_SetString(stopped.ptr(), "Simulator: error: stop() ended the frame");
    throw py::error_already_set();
  }

  /// fork() copies one thread alone: those that would compute are not there.
  void refuse_child() const {
    if (getpid() != made_by_)
      throw Error(
          ErrorKind::bad_input,
          "Simulator: error: this process was forked off the one that made it\n  expected a Simulator made here: scenes and cameras may "
          "come along, simulators cannot");
  }

  FrameProgress progress_;
  double frame_rate_;
  std::unique_ptr<Simulator> simulator_;
  std::shared_ptr<Pool<Frame>> frames_ = std::make_shared<Pool<Frame>>(2);
  std::shared_ptr<Pool<DeviceFrames>> device_frames_ = std::make_shared<Pool<DeviceFrames>>(1);
  std::timed_mutex mutex_;
  std::atomic<std::thread::id> owner_{};
  std::atomic<bool> asked_to_stop_{false};
  bool recycles_ = true;
  Stage last_stage_ = Stage::depth;
  Frame exposures_;  ///< what is not an image of frame 0; looked at with the interpreter's lock
  pid_t made_by_ = getpid();
};

/// Copies what a batch's frame lies in, since it is gone when the next one is computed.
std::shared_ptr<Frame> copied(const FrameArrays& from, const Raw& exposures) {
  auto out = std::make_shared<Frame>();
  out->index = from.index;
  const auto pixels = static_cast<std::size_t>(from.width) * static_cast<std::size_t>(from.height);
  const auto phases = static_cast<std::size_t>(from.phases), bins = static_cast<std::size_t>(from.bins),
             modulations = static_cast<std::size_t>(from.modulations);
  const std::size_t sizes[] = {pixels,        2 * pixels, 3 * pixels, phases * pixels, 2 * phases * pixels, modulations * pixels,
                               bins * pixels, phases};
#define TOFRAY_COPY(name, part, member, element, shape, ...) \
  if (from.name != nullptr) out->part.member.assign(from.name, from.name + sizes[static_cast<int>(ArrayShape::shape)]);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_COPY)
#undef TOFRAY_COPY
#define TOFRAY_SIZES(part) out->part.width = from.width, out->part.height = from.height;
  TOFRAY_SIZES(raw)
  TOFRAY_SIZES(depth)
#undef TOFRAY_SIZES
#define TOFRAY_IS_THERE(name, ...) || from.name != nullptr
  if (false TOFRAY_TRUTH_ARRAYS(TOFRAY_IS_THERE))
    out->truth.width = from.width, out->truth.height = from.height, out->truth.phases = from.phases, out->truth.bins = from.bins;
#undef TOFRAY_IS_THERE
  out->raw.phases = from.phases, out->depth.modulations = from.modulations;
#define TOFRAY_EXPOSURE(name, part, member, ...) out->part.member = exposures.member;
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_EXPOSURE)
#undef TOFRAY_EXPOSURE
  return out;
}

py::object memory_of(std::shared_ptr<Frame> frame) { return py::cast(FrameMemory{std::move(frame)}); }

/// The frame as a function of what takes the scene's place: None, or a tofray.Geometry, PixelLight or Transient.
py::object frame_of(HeldSimulator& self, const py::object& index, const py::object& own) {
  const std::uint64_t i = from_natural(index, {nullptr, "index"});
  std::shared_ptr<Frame> into = self.new_frame();
  // What is given of a stage is known, however early the last one is.
  const auto compute = [&](Stage given, const auto&... seen) {
    self.run([&](Simulator& simulator) { simulator.frame(i, seen..., *into); });
    leave_out_after(std::max(self.last_stage(), given), *into);
  };
  if (own.is_none()) {
    compute(Stage::trace);
  } else {
    into = std::make_shared<Frame>();
    if (py::isinstance(own, model_class("Geometry")))
      compute(Stage::trace, geometry_from_python(own));
    else if (py::isinstance(own, model_class("PixelLight")))
      compute(Stage::power, light_from_python(own));
    else if (py::isinstance(own, model_class("Transient")))
      compute(Stage::power, transient_from_python(own));
    else
      refuse({nullptr, "own"}, own, "a tofray.Geometry, PixelLight or Transient");
  }
  return memory_of(std::move(into));
}

/// A request as it was when its frame was computed.
struct HeldRequest {
  FrameRequest request;
};

/// @return the frame, and the request
py::tuple frame_of_request(HeldSimulator& self, const py::object& wanted) {
  HeldRequest held;
  from_python(wanted, held.request, {nullptr, "request"});
  const std::shared_ptr<Frame> into = self.new_frame();
  self.run([&](Simulator& simulator) { simulator.frame(held.request, *into); });
  leave_out_after(self.last_stage(), *into);
  return py::make_tuple(memory_of(into), py::cast(std::move(held)));
}

/// Frames with seeds and poses of their own; of a GPU several are on their way at once.
py::list frames_of(HeldSimulator& self, const py::object& wanted) {
  std::vector<FrameRequest> requests;
  from_python(wanted, requests, {nullptr, "requests"});
  if (self.ran_on().backend == "cpu") {
    py::list out;
    for (const FrameRequest& request : requests) {
      const std::shared_ptr<Frame> into = self.new_frame();
      self.run([&](Simulator& simulator) { simulator.frame(request, *into); });
      leave_out_after(self.last_stage(), *into);
      out.append(memory_of(into));
    }
    return out;
  }
  std::vector<std::shared_ptr<Frame>> frames;
  const Frame first = self.exposures();
  const double rate = self.frame_rate();
  self.run([&](Simulator& simulator) {
    frames.clear();
    simulator.frames(requests, [&](const FrameArrays& arrays) {
      std::shared_ptr<Frame> one = copied(arrays, first.raw);
      const double start = requests[frames.size()].start_time_s.value_or(static_cast<double>(arrays.index) / rate);
      for (double& time : one->raw.start_time_s) time += start;
      one->truth.time_s = one->truth.width > 0 ? first.truth.time_s + start : 0;
      frames.push_back(std::move(one));
    });
  });
  py::list out;
  for (auto& frame : frames) out.append(memory_of(std::move(frame)));
  return out;
}

/// Frames that stay in a GPU's memory.
DeviceBatch frames_on_device_of(HeldSimulator& self, const py::object& wanted) {
  std::vector<FrameRequest> requests;
  from_python(wanted, requests, {nullptr, "requests"});
  if (requests.empty()) throw Error(ErrorKind::bad_input, "frames_on_device: error: got no frame\n  expected 1 or more");
  const std::shared_ptr<DeviceFrames> into = self.new_device_frames();
  self.run([&](Simulator& simulator) { simulator.frames_on_device(requests, *into); });
  return {into};
}

std::unique_ptr<HeldSimulator> make_simulator(const py::object& scene, const py::object& camera, const py::dict& words) {
  const SimulatorOptions options = options_from_python(words);
  Scene one;
  from_python(scene, one, {nullptr, "scene"});
  Camera seen_by;
  from_python(camera, seen_by, {nullptr, "camera"});
  try {  // which asks meshes that move how they look
    const py::gil_scoped_release free;
    return std::make_unique<HeldSimulator>(one, seen_by, options);
  } catch (const Error&) {
    raise_callback_fault();
    throw;
  }
}

py::object process_raw(const py::object& raw, const py::object& camera, const py::dict& words) {
  if (!py::isinstance(raw, model_class("Raw"))) refuse({nullptr, "raw"}, raw, "a tofray.Raw");
  SimulatorOptions options = options_from_python(words);
  const Raw taken = raw_from_python(raw);
  Camera one;
  from_python(camera, one, {nullptr, "camera"});
  FrameProgress progress;
  options.progress = &progress;
  auto out = std::make_shared<Frame>();
  RanOn ran_on;
  do {  // once more where Python's handler took Ctrl-C for something else: what was computed so far means nothing
    progress.stop.store(false);
    {
      const StopOnInterrupt watch(progress);
      const py::gil_scoped_release free;
      out->depth = process(taken, one, options, &ran_on);
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  } while (progress.stop.load());
  return py::make_tuple(memory_of(std::move(out)), to_python(ran_on));
}

py::object placed_scene_of(const py::object& scene, const py::object& camera, const py::object& request) {
  Scene one;
  Camera by;
  FrameRequest wanted;
  if (py::isinstance<HeldRequest>(request))
    wanted = request.cast<const HeldRequest&>().request;
  else
    from_python(request, wanted, {nullptr, "request"});
  from_python(scene, one, {nullptr, "scene"});
  from_python(camera, by, {nullptr, "camera"});
  return to_python(placed_scene(one, by, wanted));
}

py::array exposure_times_of(const py::object& camera, double start_s) {
  Camera one;
  from_python(camera, one, {nullptr, "camera"});
  const std::vector<double> times = exposure_times(one, start_s);
  return py::array_t<double>(static_cast<py::ssize_t>(times.size()), times.data());
}

py::array pixel_rays_of(const py::object& camera) {
  Camera one;
  from_python(camera, one, {nullptr, "camera"});
  const ImageSize size = image_size(one);
  auto* const rays = new std::vector<float>(pixel_rays(one));
  const py::capsule keeper(rays, [](void* at) { delete static_cast<std::vector<float>*>(at); });
  return view<float>(rays->data(), {size.height, size.width, 2}, keeper, true);
}

/// @param frame  None: rays are traced anew
py::object scene_report_of(const py::object& scene, const py::object& camera, const py::object& frame) {
  Scene seen;
  Camera by;
  from_python(scene, seen, {nullptr, "scene"});
  from_python(camera, by, {nullptr, "camera"});
  const std::shared_ptr<Frame> is = frame.is_none() ? nullptr : frame_from_python(frame);
  SceneReport out;
  {
    const py::gil_scoped_release free;
    out = is == nullptr ? scene_report(seen, by) : scene_report(seen, by, is->truth);
  }
  return to_python(out);
}

py::object object_places_of(const py::object& scene, double time_s) {
  Scene of;
  from_python(scene, of, {nullptr, "scene"});
  return to_python(object_places(of, time_s));
}

py::object camera_report_of(const py::object& camera, const py::object& question) {
  Camera of;
  CameraQuestion asked;
  from_python(camera, of, {nullptr, "camera"});
  from_python(question, asked, {nullptr, "question"});
  CameraReport out;
  {
    const py::gil_scoped_release free;
    out = camera_report(of, asked);
  }
  return to_python(out);
}

py::object invalid_pixels_of(const py::object& frame, const py::object& camera, bool wrong_cycles) {
  Camera by;
  from_python(camera, by, {nullptr, "camera"});
  const std::shared_ptr<Frame> is = frame_from_python(frame);
  InvalidPixels out;
  {
    const py::gil_scoped_release free;
    out = invalid_pixels(*is, by, wrong_cycles);
  }
  return to_python(out);
}

}  // namespace

SimulatorOptions options_from_python(const py::dict& words) {
  SimulatorOptions options;
  for (const auto& entry : words) {
    const py::handle value = entry.second;  // clang 14 takes no structured binding into a lambda
    const std::string word = from_text(entry.first, {nullptr, "option"});
    bool known = false;
    std::string all;
    each_member(options, [&](std::string_view name, auto& member) {
      if (name == "progress") return;  // Simulator.progress in Python
      all += (all.empty() ? "" : ", ") + std::string(name);
      if (name != word) return;
      known = true;
      from_python(value, member, Place{nullptr, word});
    });
    if (!known) throw Error(ErrorKind::bad_input, "Simulator: error: there is no option " + word + "\n  expected some of " + all);
  }
  return options;
}

void bind_simulator(py::module_& module) {
  py::class_<HeldRequest>(module, "HeldRequest");
  py::class_<HeldSimulator>(module, "Simulator")
      .def(py::init(&make_simulator))
      .def("frame", &frame_of)
      .def("frame_of_request", &frame_of_request)
      .def("frames", &frames_of)
      .def("frames_on_device", &frames_on_device_of)
      .def("stop", &HeldSimulator::stop)
      .def("progress", &HeldSimulator::progress)
      .def("ran_on", [](const HeldSimulator& self) { return to_python(self.ran_on()); })
      .def("plan", [](HeldSimulator& self) { return to_python(self.plan()); });
  module.def("process", &process_raw);
  module.def("placed_scene", &placed_scene_of);
  module.def("exposure_times", &exposure_times_of);
  module.def("pixel_rays", &pixel_rays_of);
  module.def("camera_report", &camera_report_of);
  module.def("full_sun", [] { return to_python(full_sun()); });
  module.def("scene_report", &scene_report_of);
  module.def("object_places", &object_places_of);
  module.def("invalid_pixels", &invalid_pixels_of);
}

}  // namespace tofray::python
