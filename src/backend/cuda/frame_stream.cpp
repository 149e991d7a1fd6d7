// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/frame_stream.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "pipeline/pass/list.h"

namespace tofray::backend::gpu {

namespace {

constexpr std::size_t align(std::size_t bytes) { return (bytes + 255) / 256 * 256; }

/// The input's arrays, packed.
pipeline::Input packed(Packer& packer, const pipeline::Setup& setup, const pipeline::Input& from) {
  const std::size_t pixels = static_cast<std::size_t>(setup.lens.width) * static_cast<std::size_t>(setup.lens.height);
  const std::size_t once = pixels * static_cast<std::size_t>(from.moments), lights = static_cast<std::size_t>(setup.scene.lights);
  const std::size_t by_light = once * lights, paths = static_cast<std::size_t>(from.light.paths);
  const std::size_t of_lights = once * static_cast<std::size_t>(from.light.lights);
  const std::size_t phasors =
      2 * of_lights * static_cast<std::size_t>(setup.phasors.modulations) * static_cast<std::size_t>(from.light.orders);
  const std::size_t raw = pixels * static_cast<std::size_t>(setup.sensor.raw_frames);
  pipeline::Input to = from;
  to.surface = {packer.put(from.surface.z, once),          packer.put(from.surface.normal, 3 * once),
                packer.put(from.surface.diffuse, once),    packer.put(from.surface.specular, once),
                packer.put(from.surface.exponent, once),   packer.put(from.surface.object, once),
                packer.put(from.surface.shadow, by_light), packer.put(from.surface.sun_shadow, once)};
  to.light.power = packer.put(from.light.power, from.light.phasor != nullptr ? of_lights : once * paths);
  to.light.path_length = packer.put(from.light.path_length, once * paths);
  to.light.light_of_path = packer.put(from.light.light_of_path, paths);
  to.light.phasor = packer.put(from.light.phasor, phasors);
  to.light.ambient_rate = packer.put(from.light.ambient_rate, once);
  to.recording = {packer.put(from.recording.raw, raw), packer.put(from.recording.tap_a, raw), packer.put(from.recording.tap_b, raw)};
  return to;
}

/// What of the scene has to be derived for each frame.
scene::Derive derive_for(Own own) { return own == Own::scene ? scene::Derive::all : scene::Derive::moving; }
bool derives(Own own, const scene::SceneView& scene) { return own == Own::scene || (own == Own::moving && scene.moments > 0); }

/// Gives what is derived for a frame its places from `base` on. @return bytes
std::size_t place_derived(scene::SceneView& scene, Own own, unsigned char* base) {
  std::size_t used = 0;
  if (!derives(own, scene)) return used;
  scene::each_derived(scene, derive_for(own), [&](auto*& array, std::size_t count) {
    array = base == nullptr ? nullptr : reinterpret_cast<std::remove_reference_t<decltype(array)>>(base + used);
    used += align(count * sizeof *array);
  });
  return used;
}
std::size_t derived_bytes(scene::SceneView scene, Own own) { return place_derived(scene, own, nullptr); }

/// What is the frame's own goes to `packer`: of the sensor, which drifts, and the times at which what moves is seen. The scene's shapes stay.
/// @param derived  where what is derived of the scene will be
/// @param to       what is the same for all frames; it gets the frame's own pointers
void pack_own(const Resident& resident, Own own, const pipeline::Setup& from, Packer& packer, unsigned char* derived, pipeline::Setup& to) {
  to.scene = resident.setup.scene;
  if (own == Own::number) return;
  pack_raw_frames(packer, from, to.sensor);
  pack_exposures(packer, resident.modulations, from.decoder, to.decoder);
  if (!derives(own, from.scene)) return;
  to.scene.camera = from.scene.camera;
  pack_motion(packer, from.scene, to.scene);
  (void)place_derived(to.scene, own, derived);
}

/// Bytes that go to the GPU for it.
std::size_t own_bytes(const Resident& resident, Own own, const pipeline::Setup& from) {
  Packer measure;
  pipeline::Setup to = from;
  pack_own(resident, own, from, measure, nullptr, to);
  return align(measure.used());
}

}  // namespace

FrameStream::FrameStream(const Device& device, int block_size)
    : device_(device), block_size_(block_size), stream_(device.stream()), begin_(device.event()), end_(device.event()) {}

FrameStream::~FrameStream() {
  if (submitted_) (void)device_.runtime().synchronize(stream_.get());  // memory must not go while the GPU works in it
}

/// The frame's arguments as the device sees them, with the scene that stays there.
void FrameStream::write_arguments(const pipeline::Setup& setup, FrameArguments& out) const {
  out = {};
  out.setup = resident_->setup;
  out.setup.last_stage = setup.last_stage, out.setup.culling = setup.culling;
  out.setup.power = setup.power;
  const camera::SensorView& maps = resident_->setup.sensor;
  out.setup.sensor = setup.sensor;
  out.setup.sensor.gain = maps.gain, out.setup.sensor.offset = maps.offset, out.setup.sensor.delay = maps.delay;
  out.setup.sensor.frame = maps.frame, out.setup.sensor.read = maps.read;
  out.job = job_;
  out.job.index_low = out.job.index_high = 0;  // frames have their numbers beside
}

void FrameStream::reserve_input(std::size_t bytes) {
  if (bytes <= input_bytes_) return;
  graph_ = {}, input_bytes_ = 0;
  staged_ = {}, input_ = {};
  staged_ = device_.allocate_pinned(bytes), input_ = device_.allocate(bytes);
  input_bytes_ = bytes;
}

void FrameStream::reserve_output() {
  const std::size_t bytes = std::max<std::size_t>(static_cast<std::size_t>(capacity_) * slab_.bytes(), 1);
  if (bytes <= output_bytes_) return;
  graph_ = {}, output_bytes_ = 0;
  received_ = {}, output_ = {};
  received_ = device_.allocate_pinned(bytes), output_ = device_.allocate(bytes);
  output_bytes_ = bytes;
}

void FrameStream::reserve_light(std::size_t bytes) {
  if (bytes <= light_bytes_) return;
  light_bytes_ = 0, light_ = {}, light_of_ = {};
  light_ = device_.allocate(bytes);
  light_bytes_ = bytes;
}

void FrameStream::reserve_derived(std::size_t bytes) {
  if (bytes <= derived_bytes_) return;
  derived_bytes_ = 0, derived_ = {};
  derived_ = device_.allocate(bytes);
  derived_bytes_ = bytes;
}

std::size_t FrameStream::input_bytes(const Resident& resident, const pipeline::Setup& first, const pipeline::Job& job, Own own) {
  if (own == Own::number) return sizeof(FrameNumber);
  flow::LightImage image;
  return sizeof(FrameNumber) + sizeof(FrameArguments) + own_bytes(resident, own, first) + derived_bytes(first.scene, own) +
         place_light(first, job.out, nullptr, nullptr, image);
}

void FrameStream::begin(const Resident& resident, const pipeline::Setup& first, const pipeline::Job& job, Own own, int capacity,
                        const pipeline::Input* input) {
  device_.use();
  wait();
  resident_ = &resident;
  job_ = job;
  own_ = own, capacity_ = capacity, derives_ = derives(own, first.scene);
  slab_ = Slab(first, job.out, pipeline::scratch_floats(first, job.filter));
  const auto frames = static_cast<std::size_t>(capacity);
  arguments_at_ = align(frames * sizeof(FrameNumber));
  room_from_ = arguments_at_ + (own != Own::number ? align(frames * sizeof(FrameArguments)) : 0);
  const std::size_t owned = own != Own::number ? frames * own_bytes(resident, own, first) : 0;
  Packer given;
  if (input != nullptr) (void)packed(given, first, *input);
  reserve_input(room_from_ + owned + align(given.used()));
  reserve_derived(frames * derived_bytes(first.scene, own));
  flow::LightImage image;
  light_stride_ = place_light(first, job.out, input, nullptr, image);
  reserve_light(light_stride_ * (own == Own::number ? 1 : frames));
  light_origin_ = own == Own::number && light_stride_ > 0 ? light_origin(first, job.out, input) : LightOrigin{};
  place_light(first, job.out, input, light_memory(), common_light_);
  own_lights_.assign(own == Own::number ? 0 : frames, {});
  for (std::size_t i = 0; i < own_lights_.size(); ++i)
    place_light(first, job.out, input, light_memory() + i * light_stride_, own_lights_[i]);
  numbers_.clear();
  used_ = room_from_;
  given_ = {};
  if (input == nullptr) return;
  Packer packer(staged() + used_, input_memory() + used_);
  given_ = packed(packer, first, *input);
  used_ += align(packer.used());
}

bool FrameStream::add(const pipeline::Setup& setup, std::uint64_t index) {
  if (frames() == capacity_) return false;
  if (own_ != Own::number) {
    Packer packer(staged() + used_, input_memory() + used_);
    auto& arguments = reinterpret_cast<FrameArguments*>(staged() + arguments_at_)[frames()];
    write_arguments(setup, arguments);
    auto* const derived =
        static_cast<unsigned char*>(derived_.get()) + static_cast<std::size_t>(frames()) * derived_bytes(setup.scene, own_);
    pack_own(*resident_, own_, setup, packer, derived, arguments.setup);
    used_ += align(packer.used());
  }
  if (frames() == 0) write_arguments(setup, common_);  // where frames have their own, only what is the same for all is read of these
  numbers_.push_back({static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32)});
  return true;
}

void FrameStream::start(const Launch& launch) const {
  const Status status = device_.runtime().launch(launch, stream_.get());
  if (status != 0) device_.check(status, (std::string("starting the kernel ") + pipeline::name_of(launch.pass)).c_str());
}

/// Copies in, runs the kernels.
void FrameStream::launch_all() {
  Runtime& runtime = device_.runtime();
  Launch launch{pipeline::pass<pipeline::FromRays>, block_size_, &common_, {}, given_};
  launch.batch.numbers = reinterpret_cast<const FrameNumber*>(input_memory());
  launch.batch.own = own_ != Own::number ? reinterpret_cast<const FrameArguments*>(input_memory() + arguments_at_) : nullptr;
  launch.batch.stride = static_cast<std::int64_t>(slab_.bytes());
  launch.batch.frames = frames();
  launch.batch.derive = derive_for(own_);
  device_.check(runtime.copy(input_memory(), staged(), used_, Way::to_device, stream_.get()), "copying a frame's settings to the GPU");
  if (derives_ && given_.entry == Stage::trace) {
    launch.pass = pipeline::pass<pipeline::DeriveScene>;
    start(launch);
  }
  const bool known = light_is_known();
  if (!known) light_of_ = {};  // until all of it is there
  const pipeline::Input collected = pipeline::from_light_image(common_.job.light);
  pipeline::each_step(common_.setup, common_.job, given_.entry, known, [&](const pipeline::Step& step) {
    FrameArguments common = common_;
    take_step(step, common);
    launch.pass = step.pass, launch.batch.step = step, launch.common = &common;
    launch.input = step.part == pipeline::Part::collect ? collected : given_;
    // Frames that differ by their number alone share their light.
    launch.batch.frames = pipeline::gathers(step.part) && own_ == Own::number ? 1 : frames();
    start(launch);
  });
}

/// A step's own arguments, on the host as kernels set them on the device, whose lenses the host cannot read.
void FrameStream::take_step(const pipeline::Step& step, FrameArguments& arguments) const {
  if (own_ != Own::number) return;
  const camera::SubpixelView there = arguments.setup.subpixel;
  arguments.setup.subpixel.lens = resident_->sample_lenses.data(), arguments.setup.subpixel.share = resident_->shares.data();
  pipeline::take_step(step, arguments.setup, arguments.job);
  arguments.setup.subpixel = there;
}

/// Tells the frames where their arrays are, and copies what the host knows to where the GPU will fetch it.
void FrameStream::place(void* base) {
  std::memcpy(staged(), numbers_.data(), numbers_.size() * sizeof(FrameNumber));
  common_.job.out = slab_.view(base), common_.job.scratch = slab_.scratch(base), common_.job.light = common_light_;
  for (int i = 0; i < frames() && own_ != Own::number; ++i) {
    void* const at = static_cast<unsigned char*>(base) + static_cast<std::size_t>(i) * slab_.bytes();
    auto* own = reinterpret_cast<FrameArguments*>(staged() + arguments_at_) + i;
    own->job.out = slab_.view(at), own->job.scratch = slab_.scratch(at), own->job.light = own_lights_[static_cast<std::size_t>(i)];
  }
}

/// Results to where the host sees them; there may be none.
void FrameStream::copy_out(const void* base, std::size_t bytes, const char* doing) {
  if (bytes > 0) device_.check(device_.runtime().copy(received_.get(), base, bytes, Way::to_host, stream_.get()), doing);
}

void FrameStream::submit(void* output) {
  device_.use();
  Runtime& runtime = device_.runtime();
  if (output == nullptr) reserve_output();
  void* const base = output != nullptr ? output : output_.get();
  place(base);
  submitted_ = timed_ = true;
  device_.check(runtime.record(begin_.get(), stream_.get()), "starting the clock");
  launch_all();
  light_of_ = light_origin_;
  device_.check(runtime.record(end_.get(), stream_.get()), "stopping the clock");
  if (output != nullptr) return;
  copy_out(base, static_cast<std::size_t>(frames()) * slab_.bytes(), "copying frames to the host");
}

void FrameStream::submit_graph() {
  device_.use();
  reserve_output();
  place(output_.get());
  submitted_ = true, timed_ = false;
  // Arguments of a frame's own are copied by the graph; common ones are part of it.
  const bool same = graph_.get() != nullptr && captured_own_ == own_ && captured_slab_ == slab_ && captured_used_ == used_ &&
                    captured_given_ == given_ && captured_known_ == light_is_known() && (own_ != Own::number || captured_ == common_);
  if (!same) capture();
  device_.check(device_.runtime().launch_graph(graph_.get(), stream_.get()), "launching a graph");
  light_of_ = light_origin_;
}

void FrameStream::capture() {
  Runtime& runtime = device_.runtime();
  const bool known = light_is_known();
  void* graph = nullptr;
  device_.check(runtime.begin_capture(stream_.get()), "beginning a graph");
  try {
    launch_all();
    copy_out(output_.get(), slab_.shown_bytes(), "copying a frame to the host");
  } catch (...) {
    // While a stream keeps what it is asked for, nothing can be given back.
    (void)runtime.end_capture(stream_.get(), graph);
    graph_ = Graph(runtime, graph);
    throw;
  }
  const Status made = runtime.end_capture(stream_.get(), graph);
  graph_ = Graph(runtime, graph);
  device_.check(made, "making a graph");
  captured_ = common_, captured_used_ = used_, captured_own_ = own_, captured_slab_ = slab_, captured_given_ = given_;
  captured_known_ = known;
}

void FrameStream::wait() {
  if (!submitted_) return;
  submitted_ = false;
  device_.check(device_.runtime().synchronize(stream_.get()), "computing frames");
}

double FrameStream::seconds() const {
  if (!timed_) return 0;
  float milliseconds = 0;
  device_.check(device_.runtime().elapsed(begin_.get(), end_.get(), milliseconds), "reading the clock");
  return 1e-3 * static_cast<double>(milliseconds);
}

}  // namespace tofray::backend::gpu
