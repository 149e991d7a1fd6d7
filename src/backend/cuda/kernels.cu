// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/kernels.h"

#include <cstddef>

#include "backend/cuda/pixel.h"

namespace tofray::backend::gpu {

namespace {

/// The 32 threads that this one runs with.
struct DeviceWarp {
  int lane;
#if defined(__CUDA_ARCH__)
  /// Which of these forms can be met: a word of what each lane says of one.
  template <class Test>
  TOFRAY_FN std::uint32_t vote(const void*, Test test) const {
    return __ballot_sync(~0u, test(lane));
  }
  TOFRAY_FN bool any(bool mask) const { return __ballot_sync(~0u, mask) != 0; }
  TOFRAY_FN void unite(int, pipeline::Rectangle<float>& seen) const {
    seen.open = __any_sync(~0u, seen.open) != 0;
    for (int apart = warp_size / 2; apart > 0; apart /= 2) {
      seen.x_min = num::min(seen.x_min, __shfl_xor_sync(~0u, seen.x_min, apart));
      seen.x_max = num::max(seen.x_max, __shfl_xor_sync(~0u, seen.x_max, apart));
      seen.y_min = num::min(seen.y_min, __shfl_xor_sync(~0u, seen.y_min, apart));
      seen.y_max = num::max(seen.y_max, __shfl_xor_sync(~0u, seen.y_max, apart));
    }
  }
  TOFRAY_FN static int lowest_bit(std::uint32_t word) { return __ffs(static_cast<int>(word)) - 1; }
#else
  template <class Test>
  TOFRAY_FN std::uint32_t vote(const void*, Test) const {
    return 0;
  }
  TOFRAY_FN bool any(bool) const { return false; }
  TOFRAY_FN void unite(int, pipeline::Rectangle<float>&) const {}
  TOFRAY_FN static int lowest_bit(std::uint32_t) { return 0; }
#endif
};

/// The block copies what its threads share. (A copy of each thread's own would be in its local memory, and every array's place read there.)
template <class T>
__device__ void copy_to_block(T& to, const T& from) {
  static_assert(sizeof to % sizeof(uint2) == 0 && alignof(T) % sizeof(uint2) == 0);
  for (unsigned i = threadIdx.x; i < sizeof to / sizeof(uint2); i += blockDim.x)
    reinterpret_cast<uint2*>(&to)[i] = reinterpret_cast<const uint2*>(&from)[i];
  __syncthreads();
}

/// The block's threads make its job that of one frame.
__device__ void take_frame_of_block(const FrameNumber& number, std::int64_t bytes, Job& job) {
  for (unsigned worker = threadIdx.x; worker <= flow::array_count; worker += blockDim.x)
    take_frame(number, bytes, static_cast<int>(worker), job);
  __syncthreads();
}

/// Which patch this thread's warp has.
__device__ int patch_of_warp() { return static_cast<int>(blockIdx.x * (blockDim.x / warp_size) + threadIdx.x / warp_size); }

/// Ray to depth of frames that share their arguments, which lie in the constant bank: nothing moves in them.
template <int threads>
__global__ void __launch_bounds__(threads) tofray_pixels(const __grid_constant__ FrameArguments common, const Batch batch) {
  __shared__ Job job;
  const int frame = static_cast<int>(blockIdx.y);
  copy_to_block(job, common.job);
  take_frame_of_block(batch.numbers[frame], frame * batch.stride, job);
  const int patch = patch_of_warp();
  if (patch >= patch_count(common.setup.lens)) return;
  DeviceWarp warp{static_cast<int>(threadIdx.x % warp_size)};
  run_pixel<false>(common.setup, job, warp, patch, warp.lane);
}

/// The same where each frame has arguments of its own: each block takes its frame's into shared memory, with what the step has of its own.
template <int threads>
__global__ void __launch_bounds__(threads) tofray_pixels_own(const Batch batch) {
  __shared__ FrameArguments mine;
  const int frame = static_cast<int>(blockIdx.y);
  copy_to_block(mine, batch.own[frame]);
  if (threadIdx.x == 0 && batch.step.part != pipeline::Part::all) pipeline::take_step(batch.step, mine.setup, mine.job);
  __syncthreads();
  take_frame_of_block(batch.numbers[frame], 0, mine.job);
  const int patch = patch_of_warp();
  if (patch >= patch_count(mine.setup.lens)) return;
  DeviceWarp warp{static_cast<int>(threadIdx.x % warp_size)};
  run_pixel<true>(mine.setup, mine.job, warp, patch, warp.lane);
}

/// The largest block of a kernel.
template <Pass pass>
constexpr int most_threads = most_threads_of(pass);

/// A pass over the images of all frames. (Written out once, for arguments in shared memory, wherever they came from.)
template <Pass pass>
__global__ void __launch_bounds__(most_threads<pass>)
    tofray_pass(const __grid_constant__ FrameArguments common, const Batch batch, const pipeline::Input input) {
  __shared__ FrameArguments mine;
  const bool owns = batch.own != nullptr;
  const int frame = static_cast<int>(blockIdx.y), index = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  copy_to_block(mine, owns ? batch.own[frame] : common);
  if (owns && threadIdx.x == 0) pipeline::take_image_step(batch.step, mine.job);
  __syncthreads();
  take_frame_of_block(batch.numbers[frame], owns ? 0 : frame * batch.stride, mine.job);
  run_pass(pass, batch.step.item, mine.setup, mine.job, input, index);
}

/// Forms and facets of each frame.
__global__ void __launch_bounds__(most_threads<Pass::derive>) tofray_derive(const Batch batch) {
  run_derive(batch.own[blockIdx.y].setup, batch.derive, static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x));
}

/// Registers for all threads of a block: a kernel that may take more of them serves the smaller blocks.
constexpr int few_threads = 256;

template <int threads>
cudaError_t launch_pixels(const Launch& what, int patches, cudaStream_t stream) {
  const auto warps = static_cast<unsigned>(what.block_size / warp_size);
  const dim3 grid((static_cast<unsigned>(patches) + warps - 1) / warps, static_cast<unsigned>(what.batch.frames));
  if (what.batch.own != nullptr) {
    tofray_pixels_own<threads><<<grid, what.block_size, 0, stream>>>(what.batch);
  } else {
    tofray_pixels<threads><<<grid, what.block_size, 0, stream>>>(*what.common, what.batch);
  }
  return cudaGetLastError();
}

cudaError_t launch_derive(const Launch& what, cudaStream_t stream) {
  const auto block = static_cast<unsigned>(threads_of_block(Pass::derive, what.block_size)),
             units = static_cast<unsigned>(scene::unit_count(what.common->setup.scene, what.batch.derive));
  tofray_derive<<<dim3((units + block - 1) / block, static_cast<unsigned>(what.batch.frames)), block, 0, stream>>>(what.batch);
  return cudaGetLastError();
}

template <Pass pass>
cudaError_t launch_pass(const Launch& what, cudaStream_t stream) {
  const auto block = static_cast<unsigned>(threads_of_block(pass, what.block_size));
  const auto units = static_cast<unsigned>(units_of(pass, what.common->setup));
  const dim3 grid((units + block - 1) / block, static_cast<unsigned>(what.batch.frames));
  tofray_pass<pass><<<grid, block, 0, stream>>>(*what.common, what.batch, what.input);
  return cudaGetLastError();
}

}  // namespace

cudaError_t launch_kernel(const Launch& what, cudaStream_t stream) {
  const camera::LensView& lens = what.common->setup.lens;
  switch (what.pass) {
    case Pass::derive: return launch_derive(what, stream);
    case Pass::pixels:
      return what.block_size <= few_threads ? launch_pixels<few_threads>(what, patch_count(lens), stream)
                                            : launch_pixels<max_block_size>(what, patch_count(lens), stream);
    case Pass::lines: return launch_pass<Pass::lines>(what, stream);
    case Pass::input: return launch_pass<Pass::input>(what, stream);
    case Pass::bloom: return launch_pass<Pass::bloom>(what, stream);
    case Pass::flying: return launch_pass<Pass::flying>(what, stream);
    case Pass::filter: return launch_pass<Pass::filter>(what, stream);
    case Pass::settle: return launch_pass<Pass::settle>(what, stream);
    case Pass::bounces: return launch_pass<Pass::bounces>(what, stream);
    case Pass::path_error: return launch_pass<Pass::path_error>(what, stream);
    case Pass::path_noise: return launch_pass<Pass::path_noise>(what, stream);
    case Pass::smooth: return launch_pass<Pass::smooth>(what, stream);
    case Pass::sum: return launch_pass<Pass::sum>(what, stream);
    case Pass::transient: return launch_pass<Pass::transient>(what, stream);
    case Pass::scatter_rows: return launch_pass<Pass::scatter_rows>(what, stream);
    case Pass::scatter_columns: return launch_pass<Pass::scatter_columns>(what, stream);
  }
  return cudaErrorInvalidValue;
}

cudaError_t find_kernels() {
  cudaError_t status = cudaSuccess;
  const auto find = [&](auto* kernel) {
    cudaFuncAttributes attributes;
    if (status == cudaSuccess) status = cudaFuncGetAttributes(&attributes, reinterpret_cast<const void*>(kernel));
  };
  find(&tofray_pixels<few_threads>), find(&tofray_pixels<max_block_size>);
  find(&tofray_pixels_own<few_threads>), find(&tofray_pixels_own<max_block_size>);
  find(&tofray_derive);
  find(&tofray_pass<Pass::lines>), find(&tofray_pass<Pass::input>), find(&tofray_pass<Pass::bloom>), find(&tofray_pass<Pass::flying>);
  find(&tofray_pass<Pass::filter>), find(&tofray_pass<Pass::settle>);
  find(&tofray_pass<Pass::bounces>), find(&tofray_pass<Pass::sum>);
  find(&tofray_pass<Pass::path_error>), find(&tofray_pass<Pass::path_noise>), find(&tofray_pass<Pass::smooth>);
  find(&tofray_pass<Pass::transient>);
  find(&tofray_pass<Pass::scatter_rows>), find(&tofray_pass<Pass::scatter_columns>);
  return status;
}

const void* kernel_function(Pass pass, int block_size) {
  switch (pass) {
    case Pass::derive: return reinterpret_cast<const void*>(&tofray_derive);
    case Pass::pixels:
      return block_size <= few_threads ? reinterpret_cast<const void*>(&tofray_pixels<few_threads>)
                                       : reinterpret_cast<const void*>(&tofray_pixels<max_block_size>);
    case Pass::lines: return reinterpret_cast<const void*>(&tofray_pass<Pass::lines>);
    case Pass::input: return reinterpret_cast<const void*>(&tofray_pass<Pass::input>);
    case Pass::bloom: return reinterpret_cast<const void*>(&tofray_pass<Pass::bloom>);
    case Pass::flying: return reinterpret_cast<const void*>(&tofray_pass<Pass::flying>);
    case Pass::filter: return reinterpret_cast<const void*>(&tofray_pass<Pass::filter>);
    case Pass::bounces: return reinterpret_cast<const void*>(&tofray_pass<Pass::bounces>);
    case Pass::path_error: return reinterpret_cast<const void*>(&tofray_pass<Pass::path_error>);
    case Pass::path_noise: return reinterpret_cast<const void*>(&tofray_pass<Pass::path_noise>);
    case Pass::smooth: return reinterpret_cast<const void*>(&tofray_pass<Pass::smooth>);
    case Pass::sum: return reinterpret_cast<const void*>(&tofray_pass<Pass::sum>);
    case Pass::transient: return reinterpret_cast<const void*>(&tofray_pass<Pass::transient>);
    case Pass::scatter_rows: return reinterpret_cast<const void*>(&tofray_pass<Pass::scatter_rows>);
    case Pass::scatter_columns: return reinterpret_cast<const void*>(&tofray_pass<Pass::scatter_columns>);
    case Pass::settle: break;
  }
  return reinterpret_cast<const void*>(&tofray_pass<Pass::settle>);
}

}  // namespace tofray::backend::gpu
