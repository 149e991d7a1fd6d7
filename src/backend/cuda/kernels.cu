// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/kernels.h"

#include <cstddef>
#include <functional>

#include "backend/cuda/pixel.h"

namespace tofray::backend::gpu {

using pipeline::DeriveScene;
using pipeline::FromRays;

namespace {

/// The 32 threads that this one runs with.
struct DeviceWarp {
  int lane;
#if defined(__CUDA_ARCH__)
  /// Which of these forms can be met: a word of what each lane says of one.
  template <class Test>
  TOFRAY_INLINE std::uint32_t vote(const void*, Test test) const {
    return __ballot_sync(~0u, test(lane));
  }
  TOFRAY_INLINE bool any(bool mask) const { return __ballot_sync(~0u, mask) != 0; }
  TOFRAY_INLINE void unite(int, pipeline::Rectangle<float>& seen) const {
    seen.open = __any_sync(~0u, seen.open) != 0;
    for (int apart = warp_size / 2; apart > 0; apart /= 2) {
      seen.x_min = num::min(seen.x_min, __shfl_xor_sync(~0u, seen.x_min, apart));
      seen.x_max = num::max(seen.x_max, __shfl_xor_sync(~0u, seen.x_max, apart));
      seen.y_min = num::min(seen.y_min, __shfl_xor_sync(~0u, seen.y_min, apart));
      seen.y_max = num::max(seen.y_max, __shfl_xor_sync(~0u, seen.y_max, apart));
    }
  }
  TOFRAY_INLINE static int lowest_bit(std::uint32_t word) { return __ffs(static_cast<int>(word)) - 1; }
#else
  template <class Test>
  TOFRAY_INLINE std::uint32_t vote(const void*, Test) const {
    return 0;
  }
  TOFRAY_INLINE bool any(bool) const { return false; }
  TOFRAY_INLINE void unite(int, pipeline::Rectangle<float>&) const {}
  TOFRAY_INLINE static int lowest_bit(std::uint32_t) { return 0; }
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

/// The kernel for frames that have arguments of their own: each block takes its frame's into shared memory, with what the step has of its own.
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

/// A pass over the images of all frames. (Written out once, for arguments in shared memory, wherever they came from.)
template <class P>
__global__ void __launch_bounds__(P::most_threads)
    tofray_pass(const __grid_constant__ FrameArguments common, const Batch batch, const pipeline::Input input) {
  __shared__ FrameArguments mine;
  const bool owns = batch.own != nullptr;
  const int frame = static_cast<int>(blockIdx.y), index = static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
  copy_to_block(mine, owns ? batch.own[frame] : common);
  if (owns && threadIdx.x == 0) pipeline::take_image_step(batch.step, mine.job);
  __syncthreads();
  take_frame_of_block(batch.numbers[frame], owns ? 0 : frame * batch.stride, mine.job);
  run_unit<P>({mine.setup, mine.job, &input, batch.step.item}, index);
}

/// Forms and facets of each frame.
__global__ void __launch_bounds__(DeriveScene::most_threads) tofray_derive(const Batch batch) {
  run_derive(batch.own[blockIdx.y].setup, batch.derive, static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x));
}

/// Registers for all threads of a block: a kernel that may take more of them serves the smaller blocks.
constexpr int few_threads = 256;

template <class P>
unsigned threads_of(int block_size) {
  return static_cast<unsigned>(block_size < P::most_threads ? block_size : P::most_threads);
}

template <int threads>
cudaError_t launch_pixels(const Launch& what, cudaStream_t stream) {
  const auto warps = static_cast<unsigned>(what.block_size / warp_size),
             patches = static_cast<unsigned>(patch_count(what.common->setup.lens));
  const dim3 grid((patches + warps - 1) / warps, static_cast<unsigned>(what.batch.frames));
  if (what.batch.own != nullptr) {
    tofray_pixels_own<threads><<<grid, what.block_size, 0, stream>>>(what.batch);
  } else {
    tofray_pixels<threads><<<grid, what.block_size, 0, stream>>>(*what.common, what.batch);
  }
  return cudaGetLastError();
}

cudaError_t launch(FromRays, const Launch& what, cudaStream_t stream) {
  return what.block_size <= few_threads ? launch_pixels<few_threads>(what, stream) : launch_pixels<max_block_size>(what, stream);
}
cudaError_t launch(DeriveScene, const Launch& what, cudaStream_t stream) {
  const unsigned block = threads_of<DeriveScene>(what.block_size),
                 units = static_cast<unsigned>(scene::unit_count(what.common->setup.scene, what.batch.derive));
  tofray_derive<<<dim3((units + block - 1) / block, static_cast<unsigned>(what.batch.frames)), block, 0, stream>>>(what.batch);
  return cudaGetLastError();
}
template <class P>
cudaError_t launch(P, const Launch& what, cudaStream_t stream) {
  const unsigned block = threads_of<P>(what.block_size), units = static_cast<unsigned>(units_of<P>(what.common->setup));
  const dim3 grid((units + block - 1) / block, static_cast<unsigned>(what.batch.frames));
  tofray_pass<P><<<grid, block, 0, stream>>>(*what.common, what.batch, what.input);
  return cudaGetLastError();
}

/// The function that a launch of this block size runs.
const void* function_of(FromRays, int block_size) {
  return block_size <= few_threads ? reinterpret_cast<const void*>(&tofray_pixels<few_threads>)
                                   : reinterpret_cast<const void*>(&tofray_pixels<max_block_size>);
}
const void* function_of(DeriveScene, int) { return reinterpret_cast<const void*>(&tofray_derive); }
template <class P>
const void* function_of(P, int) {
  return reinterpret_cast<const void*>(&tofray_pass<P>);
}

template <class... P>
void each_function(const std::function<void(const void*)>& call, num::List<P...>) {
  (call(function_of(P{}, max_block_size)), ...);
  call(function_of(FromRays{}, few_threads));
  call(reinterpret_cast<const void*>(&tofray_pixels_own<few_threads>)),
      call(reinterpret_cast<const void*>(&tofray_pixels_own<max_block_size>));
}

}  // namespace

cudaError_t launch_kernel(const Launch& what, cudaStream_t stream) {
  cudaError_t status = cudaErrorInvalidValue;
  pipeline::with_pass(what.pass, [&](auto pass) { status = launch(pass, what, stream); });
  return status;
}

cudaError_t find_kernels() {
  cudaError_t status = cudaSuccess;
  each_function(
      [&](const void* kernel) {
        cudaFuncAttributes attributes;
        if (status == cudaSuccess) status = cudaFuncGetAttributes(&attributes, kernel);
      },
      pipeline::Passes{});
  return status;
}

int threads_of_block(Pass number, int block_size) {
  int threads = 0;
  pipeline::with_pass(number, [&](auto pass) { threads = static_cast<int>(threads_of<decltype(pass)>(block_size)); });
  return threads;
}

const void* kernel_function(Pass number, int block_size) {
  const void* kernel = nullptr;
  pipeline::with_pass(number, [&](auto pass) { kernel = function_of(pass, block_size); });
  return kernel;
}

}  // namespace tofray::backend::gpu
