// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// CUDA's runtime behind our own interface: one call each.
#include <string>

#include "backend/cuda/kernels.h"

namespace tofray::backend::gpu {

namespace {

std::string version_text(int version) { return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10); }
cudaStream_t stream_of(void* stream) { return static_cast<cudaStream_t>(stream); }

/// What the runtime remembers of a failed call is forgotten: a later launch that asks for the last error must not be blamed for it.
Status told(cudaError_t status) {
  if (status != cudaSuccess) (void)cudaGetLastError();
  return status;
}

class CudaRuntime final : public Runtime {
 public:
  std::string text(Status status) override {
    const auto error = static_cast<cudaError_t>(status);
    return std::string(cudaGetErrorName(error)) + ": " + cudaGetErrorString(error);
  }
  Cause cause(Status status) override {
    switch (static_cast<cudaError_t>(status)) {
      case cudaErrorInsufficientDriver: return driver() == 0 ? Cause::no_driver : Cause::old_driver;
      case cudaErrorNoDevice: return Cause::no_device;
      case cudaErrorDevicesUnavailable: return Cause::busy;
      case cudaErrorMemoryAllocation: return Cause::no_memory;
      case cudaErrorNoKernelImageForDevice:
      case cudaErrorUnsupportedPtxVersion:
      case cudaErrorInvalidDeviceFunction: return Cause::no_code;
      default: return Cause::other;
    }
  }
  std::string driver_version() override { return version_text(driver()); }
  std::string runtime_version() override { return version_text(CUDART_VERSION); }

  Status count_devices(int& count) override { return told(cudaGetDeviceCount(&count)); }
  Status describe(int device, DeviceInfo& info) override {
    cudaDeviceProp p;
    char bus_id[32] = "";
    cudaError_t status = cudaGetDeviceProperties(&p, device);
    if (status == cudaSuccess) status = cudaDeviceGetPCIBusId(bus_id, sizeof bus_id, device);
    if (status == cudaSuccess)
      info = {p.name, p.major, p.minor, p.multiProcessorCount, p.maxThreadsPerMultiProcessor, p.totalGlobalMem, bus_id};
    return told(status);
  }
  Status use(int device) override { return told(cudaSetDevice(device)); }
  Status find_code() override { return told(find_kernels()); }
  Status occupancy(Pass pass, int block_size, int& threads) override {
    const int block = threads_of_block(pass, block_size);
    const Status status = told(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&threads, kernel_function(pass, block_size), block, 0));
    threads *= block;
    return status;
  }

  Status allocate(std::size_t bytes, void*& memory) override { return told(cudaMalloc(&memory, bytes)); }
  Status allocate_pinned(std::size_t bytes, void*& memory) override { return told(cudaHostAlloc(&memory, bytes, cudaHostAllocPortable)); }
  Status create_stream(void*& stream) override {
    return told(cudaStreamCreateWithFlags(reinterpret_cast<cudaStream_t*>(&stream), cudaStreamNonBlocking));
  }
  Status create_event(void*& event) override { return told(cudaEventCreate(reinterpret_cast<cudaEvent_t*>(&event))); }

  Status copy(void* to, const void* from, std::size_t bytes, Way way, void* stream) override {
    return told(
        cudaMemcpyAsync(to, from, bytes, way == Way::to_device ? cudaMemcpyHostToDevice : cudaMemcpyDeviceToHost, stream_of(stream)));
  }
  Status launch(const Launch& what, void* stream) override { return told(launch_kernel(what, stream_of(stream))); }
  Status record(void* event, void* stream) override { return told(cudaEventRecord(static_cast<cudaEvent_t>(event), stream_of(stream))); }
  Status synchronize(void* stream) override { return told(cudaStreamSynchronize(stream_of(stream))); }
  Status elapsed(void* from, void* to, float& milliseconds) override {
    return told(cudaEventElapsedTime(&milliseconds, static_cast<cudaEvent_t>(from), static_cast<cudaEvent_t>(to)));
  }

  Status begin_capture(void* stream) override { return told(cudaStreamBeginCapture(stream_of(stream), cudaStreamCaptureModeThreadLocal)); }
  Status end_capture(void* stream, void*& graph) override {
    cudaGraph_t captured = nullptr;
    cudaError_t status = cudaStreamEndCapture(stream_of(stream), &captured);
    cudaGraphExec_t executable = nullptr;
    if (status == cudaSuccess) status = cudaGraphInstantiate(&executable, captured, 0);
    if (captured != nullptr) (void)cudaGraphDestroy(captured);
    graph = executable;
    return told(status);
  }
  Status launch_graph(void* graph, void* stream) override {
    return told(cudaGraphLaunch(static_cast<cudaGraphExec_t>(graph), stream_of(stream)));
  }

  void release(void* memory) override { (void)cudaFree(memory); }
  void release_pinned(void* memory) override { (void)cudaFreeHost(memory); }
  void destroy_stream(void* stream) override { (void)cudaStreamDestroy(stream_of(stream)); }
  void destroy_event(void* event) override { (void)cudaEventDestroy(static_cast<cudaEvent_t>(event)); }
  void destroy_graph(void* graph) override { (void)cudaGraphExecDestroy(static_cast<cudaGraphExec_t>(graph)); }

 private:
  static int driver() {
    int version = 0;
    return cudaDriverGetVersion(&version) == cudaSuccess ? version : 0;
  }
};

}  // namespace

extern "C" Runtime* tofray_cuda_runtime() {
  static CudaRuntime all;
  return &all;
}

}  // namespace tofray::backend::gpu
