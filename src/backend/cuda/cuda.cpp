// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/cuda.h"

#include <cstring>

#include "backend/cuda/pixel.h"

namespace tofray::backend {

namespace {

constexpr int usual_block_size = 128;
/// Threads that take a frame to its place: more of them wait longer for each other than they copy.
constexpr int copiers = 4;

}  // namespace

std::vector<std::string> usable_gpus() {
  std::vector<std::string> out;
  for (int i = 0; i < gpu::count_devices(); ++i) {
    try {
      const gpu::DeviceInfo info = gpu::Device(i).info();
      out.push_back(std::to_string(i) + ": " + info.name + ", compute capability " + std::to_string(info.major) + "." +
                    std::to_string(info.minor) + ", " + std::to_string(info.memory_bytes / 1'000'000'000) + " GB");
    } catch (const gpu::Fault&) {
      continue;  // the first one's reason is told elsewhere
    }
  }
  return out;
}

int check_block_size(int wanted) {
  if (wanted == 0) return usual_block_size;
  if (wanted < gpu::warp_size || wanted > gpu::max_block_size || wanted % gpu::warp_size != 0) {
    throw Error(ErrorKind::bad_input,
                "error: the block size is " + std::to_string(wanted) + "\n  expected a multiple of 32 from 32 to 1024, or 0");
  }
  return wanted;
}

CudaLack why_no_cuda(int device) {
  try {
    return {"", true, gpu::open_device(device).info().name};
  } catch (const gpu::Fault& fault) {
    return {fault.reason(), fault.gpu_present(), ""};
  }
}

std::string cuda_bus_id(int device) { return gpu::open_device(device).info().bus_id; }

Cuda::Cuda(int device, int block_size, Cpu& host)
    : device_(gpu::open_device(device)), block_size_(check_block_size(block_size)), host_(host) {}

void Cuda::load(const pipeline::Setup& setup) {
  device_.use();
  const auto pack = [&](gpu::Packer& packer) {
    pipeline::Setup to = setup;
    resident_.sample_lenses = gpu::pack_lenses(packer, setup, to);
    resident_.modulations = gpu::pack_camera(packer, setup, to);
    gpu::pack_scene(packer, setup.scene, to.scene);
    return to;
  };
  resident_.shares.assign(setup.subpixel.share, setup.subpixel.share + (setup.subpixel.lens != nullptr ? setup.subpixel.count : 0));
  gpu::Packer measure;
  (void)pack(measure);
  const gpu::PinnedMemory staged = device_.allocate_pinned(measure.used());
  resident_.memory = device_.allocate(measure.used());
  gpu::Packer packer(staged.get(), resident_.memory.get());
  resident_.setup = pack(packer);
  const gpu::Stream stream = device_.stream();
  device_.check(device_.runtime().copy(resident_.memory.get(), staged.get(), packer.used(), gpu::Way::to_device, stream.get()),
                "copying the scene to the GPU");
  device_.check(device_.runtime().synchronize(stream.get()), "copying the scene to the GPU");
  const pipeline::Pass longest =
      pipeline::bounces(setup, Stage::trace) ? pipeline::pass<pipeline::Bounces> : pipeline::pass<pipeline::FromRays>;
  int threads = 0;
  device_.check(device_.runtime().occupancy(longest, block_size_, threads), "asking for the occupancy");
  occupancy_ = static_cast<double>(threads) / device_.info().threads_per_processor;
}

gpu::FrameStream& Cuda::frame_stream(std::size_t i) {
  device_.use();
  while (frame_streams_.size() <= i) frame_streams_.emplace_back(device_, block_size_);
  return frame_streams_[i];
}

void Cuda::run(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input) {
  gpu::FrameStream& first = frame_stream(0);
  first.begin(resident_, setup, job, setup.scene.moments > 0 || setup.sensor.drifts != 0 ? gpu::Own::moving : gpu::Own::number, 1, input);
  first.add(setup, job.index_low | static_cast<std::uint64_t>(job.index_high) << 32);
  first.submit_graph();
  first.wait();
  const std::vector<gpu::Slab::Piece> pieces = first.slab().pieces(first.received(0), job.out);
  host_.for_each(copiers, [&](int share) {
    for (std::size_t i = static_cast<std::size_t>(share); i < pieces.size(); i += copiers)
      std::memcpy(pieces[i].to, pieces[i].from, pieces[i].bytes);
  });
}

void Cuda::describe(RanOn& out) const {
  out.backend = "cuda", out.device = device_.info().name, out.block_size = block_size_, out.occupancy = occupancy_;
}

}  // namespace tofray::backend
