// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Many frames on GPUs: several are on their way while the host fills and empties others.
#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "backend/cuda/cuda.h"

namespace tofray::backend {

namespace {

/// One is filled, one computes, one is emptied.
constexpr std::size_t streams_per_gpu = 3;
/// The first stream of batches; the one before has the graph of single frames.
constexpr std::size_t first_stream = 1;
/// Frames of one launch: a limit of CUDA's grids, with room.
constexpr std::uint64_t most_frames = 32'768;

Slab slab_of(const Batch& batch) { return {batch.setup, batch.job.out, pipeline::scratch_floats(batch.setup, batch.job.filter)}; }

/// Gives a stream up to `count` frames from number `from` on.
/// @return how many it took
std::uint64_t fill(gpu::FrameStream& stream, const gpu::Resident& resident, Batch& batch, std::uint64_t from, std::uint64_t count) {
  const Own own = batch.own(from, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i == 0 || own != Own::number) batch.set(from + i, false);
    if (i == 0) {
      const std::uint64_t room =
          own == Own::number
              ? count
              : std::max<std::uint64_t>(1, batch.most_bytes / gpu::FrameStream::input_bytes(resident, batch.setup, batch.job, own));
      stream.begin(resident, batch.setup, batch.job, own, static_cast<int>(std::min(count, room)));
    }
    if (!stream.add(batch.setup, batch.number_of(from + i))) return i;
  }
  return count;
}

/// Frames in the memory of one GPU.
class FramesOnDevice final : public KeptFrames {
 public:
  /// Takes frames, one after another.
  /// @throws gpu::Fault where the GPU's memory is too small for them
  void begin(const gpu::Device& device, const Slab& slab, std::uint64_t frames) {
    slab_ = slab, seconds_ = 0;
    if (frames > std::numeric_limits<std::size_t>::max() / std::max<std::size_t>(1, slab_.bytes()))
      throw gpu::Fault("its memory is too small for " + std::to_string(frames) + " frames", true);
    const std::size_t bytes = slab_.bytes() * frames;
    if (bytes_ >= bytes && device_ != nullptr && device_->number() == device.number()) return;
    bytes_ = 0, memory_ = {};
    device_ = std::make_unique<gpu::Device>(device);
    memory_ = device_->allocate(bytes);
    bytes_ = bytes;
  }
  void add_seconds(double seconds) { seconds_ += seconds; }
  [[nodiscard]] unsigned char* at(std::uint64_t i) const { return static_cast<unsigned char*>(memory_.get()) + i * slab_.bytes(); }

  [[nodiscard]] flow::FrameView view(std::uint64_t i) const override { return slab_.view(at(i)); }
  [[nodiscard]] const flow::FrameSize& size() const override { return slab_.size(); }
  [[nodiscard]] int device() const override { return device_->number(); }
  [[nodiscard]] double seconds() const override { return seconds_; }

 private:
  std::unique_ptr<gpu::Device> device_;
  gpu::DeviceMemory memory_;
  std::size_t bytes_ = 0;
  Slab slab_;
  double seconds_ = 0;
};

}  // namespace

void Cuda::open_others(Batch& batch) {
  if (std::exchange(all_, true)) return;
  batch.set_fixed();
  for (int i = device_.number() + 1; i < gpu::count_devices(); ++i) {
    try {
      loaded_.emplace_back(gpu::Device(i), block_size_, batch.setup);
    } catch (const gpu::Fault&) {
      continue;  // another one that cannot be used is no reason to do without the first
    }
  }
}

void Cuda::run(Batch& batch) {
  struct Flight {
    gpu::FrameStream* stream;
    std::uint64_t from, frames;
  };
  open_others(batch);
  const std::size_t frame_bytes = std::max<std::size_t>(1, slab_of(batch).bytes()), gpus = loaded_.size();
  const std::uint64_t chunk = std::clamp<std::uint64_t>(batch.most_bytes / frame_bytes, 1, most_frames);
  std::deque<Flight> flights;
  for (std::uint64_t next = batch.taken, started = 0; batch.taken < batch.count;) {
    if (next < batch.count && flights.size() < streams_per_gpu * gpus) {
      gpu::LoadedDevice& gpu = loaded_[started % gpus];
      gpu::FrameStream& stream = gpu.stream(first_stream + started / gpus % streams_per_gpu);
      const std::uint64_t frames = fill(stream, gpu.resident(), batch, next, std::min(chunk, batch.count - next));
      stream.submit();
      flights.push_back({&stream, next, frames});
      next += frames, ++started;
      continue;
    }
    const Flight done = flights.front();
    flights.pop_front();
    done.stream->wait();
    for (std::uint64_t i = 0; i < done.frames; ++i, ++batch.taken)
      batch.take(done.from + i, done.stream->slab().view(done.stream->received(static_cast<int>(i))));
  }
}

std::unique_ptr<KeptFrames> Cuda::keep(Batch& batch, std::unique_ptr<KeptFrames> before) {
  gpu::LoadedDevice& gpu = loaded_.front();
  std::unique_ptr<FramesOnDevice> out(dynamic_cast<FramesOnDevice*>(before.get()));
  if (out != nullptr)
    (void)before.release();
  else
    out = std::make_unique<FramesOnDevice>();
  out->begin(gpu.device(), slab_of(batch), batch.count);
  gpu::FrameStream& stream = gpu.stream(first_stream);
  for (std::uint64_t next = 0; next < batch.count;) {
    const std::uint64_t frames = fill(stream, gpu.resident(), batch, next, std::min(most_frames, batch.count - next));
    stream.submit(out->at(next));
    next += frames;
    stream.wait();
    out->add_seconds(stream.seconds());
  }
  return out;
}

}  // namespace tofray::backend
