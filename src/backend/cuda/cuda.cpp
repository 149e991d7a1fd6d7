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
    : device_(gpu::open_device(device)), block_size_(check_block_size(block_size)), host_(host), all_(device >= 0) {}

void Cuda::load(const pipeline::Setup& setup) {
  loaded_.clear();
  loaded_.emplace_back(device_, block_size_, setup);
}

void Cuda::run(const pipeline::Setup& setup, const pipeline::Job& job, Own own, const pipeline::Input* input) {
  gpu::LoadedDevice& gpu = loaded_.front();
  gpu::FrameStream& stream = gpu.stream(0);
  stream.begin(gpu.resident(), setup, job, own, 1, input);
  stream.add(setup, job.index_low | static_cast<std::uint64_t>(job.index_high) << 32);
  stream.submit_graph();
  stream.wait();
  const std::vector<Slab::Piece> pieces = stream.slab().pieces(stream.received(0), job.out);
  host_.for_each(copiers, [&](int share) {
    for (std::size_t i = static_cast<std::size_t>(share); i < pieces.size(); i += copiers)
      std::memcpy(pieces[i].to, pieces[i].from, pieces[i].bytes);
  });
}

void Cuda::describe(RanOn& out) const {
  out.backend = "cuda", out.device = device_.info().name, out.block_size = block_size_, out.occupancy = loaded_.front().occupancy();
}

}  // namespace tofray::backend
