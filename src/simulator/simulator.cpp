// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/simulator.h"

#include <algorithm>

#include "base/calibration.h"
#include "base/constants.h"
#include "camera/light/emitters.h"
#include "camera/readout/image_camera.h"
#include "scene/ambient.h"
#include "simulator/check.h"
#include "simulator/filter.h"
#include "simulator/frame_memory.h"
#include "simulator/impl.h"
#include "simulator/input.h"
#include "tofray/error.h"

namespace tofray {

namespace {

std::vector<Vec3> positions(const camera::ImageCamera& camera) {
  std::vector<Vec3> out;
  for (const Illumination& light : camera.illumination) out.push_back(light.position);
  return out;
}

void set_ambient(const Scene& scene, const camera::ImageCamera& camera, camera::PowerView& power) {
  if (scene.ambient.spectrum == Ambient::Spectrum::none || scene.ambient.amount == 0) return;
  power.ambient = scene.ambient.direction ? camera::AmbientLight::directional : camera::AmbientLight::uniform;
  // E/π through the lens, as electrons: the kernel multiplies by reflectivity and vignetting.               [theory: ambient-light]
  const double rate = scene::band_electron_rate_factor(scene.ambient, camera.filter, camera.pixel.quantum_efficiency);
  if (!(rate <= 1e30)) {
    throw Error(ErrorKind::bad_input,
                "error: the ambient light is too strong: more than 1e30 e/s\n  check its amount, and the table of its spectrum");
  }
  power.ambient_rate = static_cast<float>(rate * static_cast<double>(power.watts_per_radiance) / base::pi);
}

const Transport no_transport;

/// A frame in memory of its own.
template <class... From>
Frame new_frame(Simulator& simulator, std::uint64_t index, const From&... from) {
  Frame out;
  simulator.frame(index, from..., out);
  return out;
}

/// The scene, once all are seen to be good.
const Scene& checked(const Scene& scene, const Camera& camera, const SimulatorOptions& options, bool with_border) {
  simulator::check(options);
  simulator::check(scene);
  simulator::check(camera);
  simulator::check_moving_views(scene, camera::with_emitters(camera), options);
  simulator::check_changing_triangles(scene, camera, options);
  const simulator::Border border = with_border ? simulator::border_of(camera) : simulator::Border{};
  const camera::ImageCamera image(simulator::with_border(camera, border));
  simulator::check_light_image(scene, image, options);
  simulator::check_transient(scene, image);
  return scene;
}

SimulatorOptions with_last_stage(const SimulatorOptions& wanted, const camera::ImageCamera& camera, const Scene& scene) {
  SimulatorOptions out = wanted;
  out.last_stage = simulator::last_stage_of(camera, wanted, scene.transport);
  return out;
}

}  // namespace

Simulator::Impl::Impl(const Scene& all, const Camera& given, const SimulatorOptions& wanted, bool with_border)
    : scene(checked(all, given, wanted, with_border)),
      border(with_border ? simulator::border_of(given) : simulator::Border{}),
      profile(simulator::with_border(given, border)),
      camera(camera::with_emitters(camera::ImageCamera(profile))),
      region_camera(simulator::without_border(profile, border)),
      options(with_last_stage(wanted, camera, scene)),
      frozen_camera(base::with_offsets(profile), wanted.noise != Noise::off, wanted.seed, wanted.subpixel, wanted.threads),
      frozen_scene(scene, positions(camera), static_cast<int>(camera.mode.sequence.size()) * options.exposure_samples,
                   scene.transport.bounces > 0, wanted.threads),
      setup(fixed_setup()),
      temporal(camera, options.last_stage),
      exposure(camera, options.last_stage),
      engines(options, setup) {
  simulator::set_filter(camera.decoding.filter, job);
  passes_scratch.resize(static_cast<std::size_t>(pipeline::scratch_floats(setup, job.filter)));
  job.scratch = passes_scratch.data();
}

pipeline::Setup Simulator::Impl::fixed_setup() {
  pipeline::Setup out{};
  out.lens = frozen_camera.lens();
  out.subpixel = frozen_camera.subpixel(), out.scatter = frozen_camera.scatter();
  out.lights = frozen_camera.lights().data();
  out.phasors = frozen_camera.phasors();
  out.power = frozen_camera.power();
  set_ambient(scene, camera, out.power);
  out.sensor = frozen_camera.sensor(0);
  out.decoder = frozen_camera.decoder();
  out.last_stage = options.last_stage;
  out.culling = options.culling;
  out.region = simulator::region_of(camera, border);
  const Transport& transport = scene.transport;
  out.bounces = {transport.bounces,
                 transport.samples,
                 1,
                 transport.smooth ? 1 : 0,
                 static_cast<float>(transport.path_noise_m),
                 num::round_keys(static_cast<std::uint32_t>(transport.seed), static_cast<std::uint32_t>(transport.seed >> 32))};
  while (pipeline::paths_after(out, out.bounces.rounds) <= transport.max_samples) ++out.bounces.rounds;
  const TransientBins& bins = transport.transient;
  out.transient = {bins.bins, static_cast<float>(bins.first_m), static_cast<float>(1 / bins.width_m)};
  set_scene(out);
  if (bins.bins > 0) simulator::check_one_waveform(out);
  return out;
}

scene::Times Simulator::Impl::times_from(double start) const {
  scene::Times out;
  const int samples = frozen_scene.moves() ? options.exposure_samples : 1;
  for (std::size_t k = 0; k < camera.mode.sequence.size(); ++k) {
    const double begin = start + frozen_camera.raw_frame_start_s()[k], exposed = camera.mode.sequence[k].integration_time_s;
    for (int i = 0; i < samples; ++i) out.moments.push_back(begin + (i + 0.5) / samples * exposed);
  }
  // That of the middle of the middle raw frame, as pipeline::moment_of has it.
  const auto middle = camera.mode.sequence.size() / 2 * static_cast<std::size_t>(samples) + static_cast<std::size_t>(samples / 2);
  out.truth = middle, out.period_s = 1 / camera.mode.frame_rate_hz;
  out.to_truth = simulator::asks_for(options, "gt_phase_flow_px");
  return out;
}

void Simulator::Impl::set_scene(pipeline::Setup& to) const {
  to.scene = frozen_scene.view();
  for (std::size_t k = 0; k < 3; ++k) to.power.sun_direction[k] = static_cast<float>(frozen_scene.toward_sun()[k]);
}

void Simulator::Impl::set_frame(const FrameRequest& request) {
  if (placed.any()) {
    const simulator::FrameSpan span = simulator::span_of(request, camera.mode.frame_rate_hz);
    simulator::place_objects(request, *handles, span, scene);
    if (placed.camera) simulator::place_camera(request, span, scene.camera);
    frozen_scene.forget_motion();
  }
  frozen_scene.look(placed.camera ? std::nullopt : request.pose, times_from(start_of(request)));
  set_scene(setup);
  set_sensor(request);
}

void Simulator::Impl::set_sensor(const FrameRequest& request) {
  setup.sensor = frozen_camera.sensor(start_of(request), request.index, request.seed);
  job.index_low = static_cast<std::uint32_t>(request.index), job.index_high = static_cast<std::uint32_t>(request.index >> 32);
}

void Simulator::Impl::frame(const FrameRequest& request, const pipeline::Input* input, Frame& into) {
  if (!border.any()) {
    frame_uncut(request, input, into);
    return;
  }
  frame_uncut(request, nullptr, whole);
  cut(whole, into);
}

void Simulator::Impl::cut(Frame& from, Frame& into) const {
  cut(simulator::view_of(from, options.last_stage), into);
  into.index = from.index, into.raw.start_time_s = from.raw.start_time_s, into.truth.time_s = from.truth.time_s;
  into.raw.integration_time_s = from.raw.integration_time_s;
}

void Simulator::Impl::cut(const flow::FrameView& from, Frame& into) const {
  simulator::prepare(into, region_camera, options, scene.transport);
  flow::FrameView to = simulator::view_of(into, options.last_stage);
  simulator::cut(from,
                 {std::int64_t{camera.sensor.width} * camera.sensor.height, static_cast<std::int64_t>(camera.mode.sequence.size()),
                  setup.transient.bins, setup.decoder.modulations},
                 camera.sensor.width, setup.region, to);
}

simulator::Placed Simulator::Impl::placed_by(const FrameRequest& request, const std::string& name) {
  simulator::check(request, name);
  if (request.objects.empty() && request.camera.empty() && !request.pose_end) return {};
  if (handles == nullptr) handles = std::make_unique<simulator::Handles>(scene);
  return simulator::placed_by(request, *handles, name);
}

Simulator::Impl& Simulator::Impl::for_placed(const simulator::Placed& what, const FrameRequest& first) {
  if (!what.any()) return *this;
  const auto known = std::find_if(of_placed.begin(), of_placed.end(), [&](const auto& one) { return one->placed == what; });
  if (known != of_placed.end()) {
    std::rotate(of_placed.begin(), known, known + 1);
    return *of_placed.front();
  }
  constexpr std::size_t most = 4;
  Scene moved = scene;
  const simulator::FrameSpan span = simulator::span_of(first, camera.mode.frame_rate_hz);
  simulator::place_objects(first, *handles, span, moved);
  if (what.camera) simulator::place_camera(first, span, moved.camera);
  auto fresh = std::make_unique<Impl>(moved, simulator::without_border(profile, border), options);
  fresh->handles = std::make_unique<simulator::Handles>(*handles), fresh->placed = what;
  if (of_placed.size() == most) of_placed.pop_back();
  of_placed.insert(of_placed.begin(), std::move(fresh));
  return *of_placed.front();
}

template <class Use>
void Simulator::Impl::each_placed(std::span<const FrameRequest> requests, const Use& use) {
  std::vector<simulator::Placed> what;
  for (std::size_t i = 0; i < requests.size(); ++i) what.push_back(placed_by(requests[i], "requests[" + std::to_string(i) + "]"));
  for (std::size_t i = 0, end = 0; i < requests.size() && !(i > 0 && stopped()); i = end) {
    while (end < requests.size() && what[end] == what[i]) ++end;
    use(for_placed(what[i], requests[i]), requests.subspan(i, end - i));
  }
}

Simulator::Impl& Simulator::Impl::for_own_arrays() {
  if (!border.any()) return *this;
  if (of_region == nullptr) of_region = std::make_unique<Impl>(scene, simulator::without_border(profile, border), options, false);
  return *of_region;
}

void Simulator::Impl::frame_uncut(const FrameRequest& request, const pipeline::Input* input, Frame& into) {
  const Transport& transport = input == nullptr ? scene.transport : no_transport;
  if (const char* const why = needs_earlier(); why != nullptr && input != nullptr)
    throw Error(ErrorKind::bad_input, "error: " + std::string(why) + "; frames of arrays in place of the scene have no earlier ones");
  check_over_time(request);
  find_exposures(request.index);
  if (exposure.on() && exposure.known() <= request.index) return;  // stopped on the way
  if (!temporal.on()) {
    compute(request, input, options, transport, into);
    return;
  }
  // Frame i is the same whatever was computed before it: what is not at hand of the frames before is computed once more.
  SimulatorOptions bare = options;
  bare.truth = false;
  const std::uint64_t index = request.index;
  for (std::uint64_t before = temporal.missing_from(index); before < index; ++before) {
    compute({before, {}, {}}, nullptr, bare, no_transport, earlier);
    if (stopped()) return;
    temporal.keep(before, job.out);
  }
  compute(request, nullptr, options, transport, into);
  if (stopped()) return;
  temporal.keep(index, job.out);
  temporal.settle(index, setup, job);
}

const char* Simulator::Impl::needs_earlier() const {
  if (temporal.on()) return "a mean over frames (decoding.temporal.frames) needs those before";
  if (exposure.on()) return "exposures that follow the light (auto_exposure.speed) need the frames before";
  return nullptr;
}

/// Frame i is the same whatever was computed before it: all begin with frame 0.
void Simulator::Impl::find_exposures(std::uint64_t index) {
  exposure.check(index);
  SimulatorOptions bare = options;
  bare.truth = false;
  while (exposure.on() && exposure.known() <= index && !stopped())
    compute({exposure.known() - 1, {}, {}}, nullptr, bare, no_transport, earlier);
}

void Simulator::Impl::set_exposures(std::uint64_t index) {
  const std::vector<double> times = exposure.times_of(index);
  frozen_camera.set_integration_times(times);
  for (std::size_t k = 0; k < times.size(); ++k) camera.mode.sequence[k].integration_time_s = times[k];
}

void Simulator::Impl::check_over_time(const FrameRequest& request) const {
  const char* const why = needs_earlier();
  if (why != nullptr && (request.seed || request.pose || request.start_time_s || placed.any()))
    throw Error(
        ErrorKind::bad_input,
        "error: " + std::string(why) +
            ", which a request of another seed, pose or time does not have\n  in the camera: "
            "decoding.temporal.frames 0 or 1, auto_exposure.speed 0; or the motion in the scene's keyframes, and frames by their index");
}

void Simulator::Impl::begin(const FrameRequest& request, const pipeline::Input* input, const SimulatorOptions& with,
                            const Transport& transport, Frame& into) {
  if (exposure.on()) set_exposures(request.index);
  into.index = request.index;
  simulator::prepare(into, camera, with, transport);
  const double start = start_of(request);
  into.raw.start_time_s.clear();
  for (const double after : frozen_camera.raw_frame_start_s()) into.raw.start_time_s.push_back(start + after);
  into.truth.time_s = times_from(start).truth_s();
  set_frame(request);
  if (input != nullptr) setup.scene.moments = 0;  // nothing of what moves need go to a GPU
  // What is given of the stage before the entry is known, however early the last one is.
  const Stage given = input == nullptr ? Stage::trace : static_cast<Stage>(static_cast<int>(input->entry) - 1);
  job.out = simulator::view_of(into, std::max(options.last_stage, given));
  const std::int64_t pixels = std::int64_t{camera.sensor.width} * camera.sensor.height,
                     phases = static_cast<std::int64_t>(camera.mode.sequence.size());
  job.tap_stores = simulator::tap_stores(job.out, written_before, camera.sensor.width, {pixels, phases, 0, 0});
  written_before = job.out.tap_a;
}

void Simulator::Impl::compute(const FrameRequest& request, const pipeline::Input* input, const SimulatorOptions& with,
                              const Transport& transport, Frame& into) {
  begin(request, input, with, transport, into);
  engines.run([&](backend::Engine& engine) {
    if ((request.seed || (request.pose && !placed.camera)) && !engines.gpus().empty()) {
      frame_by_batch(request, into);
      return;
    }
    if (!engine.derives()) frozen_scene.derive();
    engine.run(setup, job, input);
  });
  if (!exposure.on() || exposure.known() != request.index + 1 || stopped()) return;
  exposure.follow(setup.sensor, job.out, {camera.sensor.width, camera.sensor.height, setup.region});
}

Simulator::Simulator(const Scene& scene, const Camera& camera, const SimulatorOptions& options)
    : impl_(std::make_unique<Impl>(scene, camera, options)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator&&) noexcept = default;

void Simulator::frame(std::uint64_t index, Frame& into) { impl_->frame({index, {}, {}}, nullptr, into); }
void Simulator::frame(const FrameRequest& request, Frame& into) {
  impl_->for_placed(impl_->placed_by(request, "request"), request).frame(request, nullptr, into);
}
void Simulator::frame(std::uint64_t index, const Geometry& seen, Frame& into) {
  Impl& impl = impl_->for_own_arrays();
  const simulator::OwnInput own = simulator::input_of(seen, impl.camera);
  impl.frame({index, {}, {}}, &own.input, into);
}
void Simulator::frame(std::uint64_t index, const PixelLight& light, Frame& into) {
  Impl& impl = impl_->for_own_arrays();
  const simulator::OwnInput own = simulator::input_of(light, impl.camera);
  impl.frame({index, {}, {}}, &own.input, into);
}
void Simulator::frame(std::uint64_t index, const Transient& light, Frame& into) {
  Impl& impl = impl_->for_own_arrays();
  const simulator::OwnInput own = simulator::input_of(light, impl.camera, impl.setup);
  impl.frame({index, {}, {}}, &own.input, into);
}
Frame Simulator::frame(std::uint64_t index) { return new_frame(*this, index); }
Frame Simulator::frame(std::uint64_t index, const Geometry& seen) { return new_frame(*this, index, seen); }
Frame Simulator::frame(std::uint64_t index, const PixelLight& light) { return new_frame(*this, index, light); }
Frame Simulator::frame(std::uint64_t index, const Transient& light) { return new_frame(*this, index, light); }

void Simulator::frames(std::uint64_t first, std::uint64_t count, const std::function<void(const FrameArrays&)>& take) {
  impl_->frames(
      count,
      [first](std::uint64_t i) {
        return FrameRequest{first + i, {}, {}};
      },
      take);
}
void Simulator::frames(std::span<const FrameRequest> requests, const std::function<void(const FrameArrays&)>& take) {
  impl_->each_placed(requests, [&](Impl& impl, std::span<const FrameRequest> same) {
    impl.frames(
        same.size(), [same](std::uint64_t i) { return same[i]; }, take);
  });
}
void Simulator::frames_on_device(std::uint64_t first, std::uint64_t count, DeviceFrames& into) {
  impl_->frames_on_device(
      count,
      [first](std::uint64_t i) {
        return FrameRequest{first + i, {}, {}};
      },
      *into.impl_);
}
void Simulator::frames_on_device(std::span<const FrameRequest> requests, DeviceFrames& into) {
  Impl* impl = impl_.get();
  impl_->each_placed(requests, [&](Impl& one, std::span<const FrameRequest> same) {
    if (same.size() != requests.size())
      throw Error(
          ErrorKind::bad_input,
          "error: not all requests place the same objects, and frames that stay on the GPU are computed side by side\n  expected the "
          "same objects in each, and the camera's motion in all or in none; or ask for them apart");
    impl = &one;
  });
  impl->frames_on_device(
      requests.size(), [requests](std::uint64_t i) { return requests[i]; }, *into.impl_);
}

RanOn Simulator::ran_on() const { return impl_->engines.ran_on(); }

}  // namespace tofray
