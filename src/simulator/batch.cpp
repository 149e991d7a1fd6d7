// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Many frames: on the processor one by one, on GPUs several on their way while the host fills and empties others.
#include <algorithm>
#include <deque>
#include <limits>
#include <string>
#include <utility>

#include "simulator/frame_memory.h"
#include "simulator/impl.h"
#include "tofray/error.h"

namespace tofray {

using backend::gpu::FrameStream;
using backend::gpu::Own;

namespace {

/// One is filled, one computes, one is emptied.
constexpr std::uint64_t streams_per_gpu = 3;
/// Frames of one launch: a limit of CUDA's grids, with room.
constexpr std::uint64_t most_frames = 32'768;

}  // namespace

void Simulator::Impl::frames_one_by_one(backend::Engine& engine, std::uint64_t from, std::uint64_t count, const Request& request,
                                        const Take& take) {
  simulator::prepare(scratch, camera, options, scene.transport);
  const backend::gpu::Slab shown(setup, simulator::view_of(scratch, options.last_stage), false);  // leaves out what is not computed
  std::vector<unsigned char> memory(shown.bytes());
  job.tap_stores = pipeline::TapStores::some;  // each frame lies where the one before was
  for (std::uint64_t i = from; i < count; ++i) {
    const FrameRequest wanted = request(i);
    set_frame(wanted);
    const flow::FrameView view = shown.view(memory.data());
    job.out = view;
    if (!engine.derives()) frozen_scene.derive();
    engine.run(setup, job);
    if (options.progress != nullptr && options.progress->stop) return;  // the frame is no frame
    take(simulator::arrays_of(view, camera, setup.transient.bins, wanted.index, -1));
  }
}

Own Simulator::Impl::own_of(std::uint64_t from, std::uint64_t count, const Request& request) const {
  Own own = frozen_scene.moves() || setup.sensor.drifts != 0 ? Own::moving : Own::number;
  for (std::uint64_t i = from; i < from + count; ++i) {
    const FrameRequest wanted = request(i);
    if (wanted.pose && !placed.camera) return Own::scene;
    if (wanted.seed || wanted.start_time_s) own = Own::moving;
  }
  return own;
}

/// Gives a stream up to `count` frames from number `from` on.
/// @return how many it took
std::uint64_t Simulator::Impl::fill(FrameStream& stream, const backend::Cuda& gpu, std::uint64_t from, std::uint64_t count,
                                    const Request& request) {
  const Own own = own_of(from, count, request);
  for (std::uint64_t i = 0; i < count; ++i) {
    const FrameRequest wanted = request(from + i);
    if (i == 0 || own != Own::number) set_frame(wanted);
    if (i == 0) {
      const std::uint64_t room =
          own == Own::number ? count
                             : std::max<std::uint64_t>(1, options.batch_bytes / FrameStream::input_bytes(gpu.resident(), setup, job, own));
      stream.begin(gpu.resident(), setup, job, own, static_cast<int>(std::min(count, room)));
    }
    if (!stream.add(setup, wanted.index)) return i;
  }
  return count;
}

void Simulator::Impl::frames_on_gpus(std::uint64_t count, const Request& request, const Take& take, std::uint64_t& taken) {
  struct Flight {
    FrameStream* stream;
    std::uint64_t from, frames;
  };
  const auto& gpus = engines.gpus();
  simulator::prepare(scratch, camera, options, scene.transport);
  job.out = simulator::view_of(scratch, options.last_stage);
  const std::size_t frame_bytes =
      std::max<std::size_t>(1, backend::gpu::Slab(setup, job.out, pipeline::scratch_floats(setup, job.filter)).bytes());
  const std::uint64_t chunk = std::clamp<std::uint64_t>(options.batch_bytes / frame_bytes, 1, most_frames),
                      streams = streams_per_gpu * gpus.size();
  std::deque<Flight> flights;
  for (std::uint64_t next = 0, started = 0; taken < count;) {
    if (next < count && flights.size() < streams) {
      backend::Cuda& gpu = *gpus[started % gpus.size()];
      FrameStream& stream = gpu.frame_stream(1 + started / gpus.size() % streams_per_gpu);
      const std::uint64_t frames = fill(stream, gpu, next, std::min(chunk, count - next), request);
      stream.submit();
      flights.push_back({&stream, next, frames});
      next += frames, ++started;
      continue;
    }
    const Flight done = flights.front();
    flights.pop_front();
    done.stream->wait();
    for (std::uint64_t i = 0; i < done.frames; ++i) {
      const flow::FrameView view = done.stream->slab().view(done.stream->received(static_cast<int>(i)));
      take(simulator::arrays_of(view, camera, setup.transient.bins, request(done.from + i).index, -1));
      ++taken;
    }
  }
}

/// A frame of a GPU with a seed or pose of its own: a batch of one, whose stream takes them along.
void Simulator::Impl::frame_by_batch(const FrameRequest& request, Frame& into) {
  std::uint64_t taken = 0;
  const auto take = [&](const FrameArrays& from) {
#define TOFRAY_COPY(name, part, member, ...) \
  if (from.name != nullptr) std::copy_n(from.name, into.part.member.size(), into.part.member.begin());
    TOFRAY_IMAGE_ARRAYS(TOFRAY_COPY)
#undef TOFRAY_COPY
  };
  frames_on_gpus(
      1, [&](std::uint64_t) { return request; }, take, taken);
}

/// Where a frame depends on those before, one follows the other.
void Simulator::Impl::frames_over_time(std::uint64_t count, const Request& request, const Take& take) {
  for (std::uint64_t i = 0; i < count; ++i) check_over_time(request(i));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t index = request(i).index;
    frame_uncut({index, {}, {}}, nullptr, scratch);
    if (stopped()) return;  // the frame is no frame
    take(simulator::arrays_of(simulator::view_of(scratch, options.last_stage), camera, setup.transient.bins, index, -1));
  }
}

void Simulator::Impl::frames(std::uint64_t count, const Request& request, const Take& take) {
  if (!border.any()) {
    frames_uncut(count, request, take);
    return;
  }
  frames_uncut(count, request, [&](const FrameArrays& from) {
    flow::FrameView view{};
#define TOFRAY_SHOWN(name, part, member, element, ...) view.name = const_cast<element*>(from.name);  // only read
    TOFRAY_IMAGE_ARRAYS(TOFRAY_SHOWN)
#undef TOFRAY_SHOWN
    cut(view, whole);
    take(simulator::arrays_of(simulator::view_of(whole, options.last_stage), region_camera, setup.transient.bins, from.index, -1));
  });
}

void Simulator::Impl::frames_uncut(std::uint64_t count, const Request& request, const Take& take) {
  if (needs_earlier() != nullptr) {
    frames_over_time(count, request, take);
    return;
  }
  std::uint64_t taken = 0;
  engines.run([&](backend::Engine& engine) {
    if (engines.gpus().empty()) {
      frames_one_by_one(engine, taken, count, request, take);
    } else {
      engines.open_other_gpus([&]() -> const pipeline::Setup& {
        set_frame({0, {}, {}});
        frozen_scene.derive();
        return setup;
      });
      frames_on_gpus(count, request, take, taken);
    }
  });
}

void Simulator::Impl::frames_on_device(std::uint64_t count, const Request& request, DeviceFrames::Impl& into) {
  if (const char* const why = needs_earlier(); why != nullptr)
    throw Error(ErrorKind::bad_input, "error: " + std::string(why) + ", and frames that stay on the GPU are computed side by side");
  if (border.any())
    throw Error(ErrorKind::bad_input,
                "error: frames that stay on the GPU are not cut\n  a region (readout.region) gets scattered light, shared "
                "charge and what wells spill from pixels that are not read; read the whole sensor, or take the frames on the host");
  const auto& gpus = engines.gpus();
  const std::string reason = engines.ran_on().fallback_reason;
  if (gpus.empty()) throw backend::gpu::Fault(reason.empty() ? "the processor computes" : reason, false);
  simulator::prepare(scratch, camera, options, scene.transport);
  job.out = simulator::view_of(scratch, options.last_stage);
  backend::Cuda& gpu = *gpus[0];
  into.indices.clear();
  into.seconds = 0;
  into.slab = backend::gpu::Slab(setup, job.out, pipeline::scratch_floats(setup, job.filter));
  into.camera = camera;
  if (count > std::numeric_limits<std::size_t>::max() / std::max<std::size_t>(1, into.slab.bytes()))
    throw backend::gpu::Fault("its memory is too small for " + std::to_string(count) + " frames", true);
  const std::size_t bytes = into.slab.bytes() * count;
  if (into.memory_bytes < bytes || !into.device || into.device->number() != gpu.device().number()) {
    into.memory_bytes = 0;
    into.memory = {};
    into.device = std::make_unique<backend::gpu::Device>(gpu.device());
    into.memory = into.device->allocate(bytes);
    into.memory_bytes = bytes;
  }
  FrameStream& stream = gpu.frame_stream(1);
  for (std::uint64_t next = 0; next < count;) {
    const std::uint64_t frames = fill(stream, gpu, next, std::min(most_frames, count - next), request);
    stream.submit(static_cast<unsigned char*>(into.memory.get()) + next * into.slab.bytes());
    for (std::uint64_t i = 0; i < frames; ++i) into.indices.push_back(request(next + i).index);
    next += frames;
    stream.wait();
    into.seconds += stream.seconds();
  }
}

DeviceFrames::DeviceFrames() : impl_(std::make_unique<Impl>()) {}
DeviceFrames::~DeviceFrames() = default;
DeviceFrames::DeviceFrames(DeviceFrames&&) noexcept = default;
DeviceFrames& DeviceFrames::operator=(DeviceFrames&&) noexcept = default;
std::uint64_t DeviceFrames::size() const { return impl_->indices.size(); }
double DeviceFrames::seconds() const { return impl_->seconds; }
FrameArrays DeviceFrames::operator[](std::uint64_t i) const {
  void* const at = static_cast<unsigned char*>(impl_->memory.get()) + i * impl_->slab.bytes();
  return simulator::arrays_of(impl_->slab.view(at), impl_->camera, impl_->slab.size().bins, impl_->indices[i], impl_->device->number());
}

}  // namespace tofray
