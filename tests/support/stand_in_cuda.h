// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "backend/cuda/runtime.h"

/// A CUDA runtime for machines without a GPU: the device's memory is the host's, and a kernel runs the same functions that nvcc compiles,
/// pixel by pixel. What is asked of a stream is done at once; what is captured is done when its graph is launched. Device memory is
/// filled with rubbish first, each call can be made to fail, and what is not given back is counted.
namespace tofray::test {

/// What a launch does on a GPU (support/stand_in_kernels.cpp).
void run_on_host(const backend::gpu::Launch& what, const backend::gpu::FrameArguments& common);

class StandInCuda final : public backend::gpu::Runtime {
 public:
  using Status = backend::gpu::Status;
  using Cause = backend::gpu::Cause;
  static constexpr Status failed = 999;
  static constexpr std::size_t memory_bytes = 1u << 30;

  // what a test may change
  int devices = 1;
  Cause failure = Cause::other;  ///< what a failing call means
  std::uint64_t fail_at = 0;     ///< number of the call that fails, from 1 on; 0: none
  bool stays_broken = false;     ///< all calls after it fail, too
  // what a test may read
  std::uint64_t calls = 0;
  std::set<int> unusable;  ///< devices without code
  int graphs_made = 0, graphs_launched = 0;
  std::size_t pinned_bytes = 0;   ///< all that were ever taken
  pipeline::Pass occupancy_of{};  ///< last asked for
  std::map<int, int> frames_by_device, launches_by_block_size;

  /// What was taken and not given back.
  [[nodiscard]] std::size_t held() const { return memory_.size() + handles_.size(); }

  std::string text(Status status) override { return "standInError: number " + std::to_string(status); }
  Cause cause(Status) override { return failure; }
  std::string driver_version() override { return "11.8"; }
  std::string runtime_version() override { return "13.0"; }
  Status count_devices(int& count) override {
    if (fails()) return failed;
    count = devices;
    return 0;
  }
  Status describe(int device, backend::gpu::DeviceInfo& info) override {
    if (fails()) return failed;
    info = {"Stand-in " + std::to_string(device), 9, 0, 4, 2048, memory_bytes, "0000:3b:00." + std::to_string(device)};
    return 0;
  }
  Status use(int device) override {
    if (fails()) return failed;
    device_ = device;
    return 0;
  }
  Status find_code() override { return fails() || unusable.contains(device_) ? failed : 0; }
  Status occupancy(pipeline::Pass pass, int block_size, int& threads) override {
    if (fails()) return failed;
    occupancy_of = pass;
    threads = 1024 / block_size * block_size;
    return 0;
  }
  Status allocate(std::size_t bytes, void*& memory) override { return take_memory(bytes, memory, device_); }
  Status allocate_pinned(std::size_t bytes, void*& memory) override {
    pinned_bytes += bytes;
    return take_memory(bytes, memory, host);
  }
  Status create_stream(void*& stream) override { return take_handle(stream); }
  Status create_event(void*& event) override { return take_handle(event); }
  Status copy(void* to, const void* from, std::size_t bytes, backend::gpu::Way, void* stream) override {
    if (fails() || !here(stream) || !within(to, bytes) || !within(from, bytes)) return failed;
    return later([=] { std::memcpy(to, from, bytes); });
  }
  Status launch(const backend::gpu::Launch& what, void* stream) override {
    if (fails() || !here(stream) || !within(what.batch.numbers, 1) || !reaches_output(what)) return failed;
    frames_by_device[device_] += what.pass == pipeline::pass<pipeline::FromRays> ? what.batch.frames : 0;
    ++launches_by_block_size[what.block_size];
    const backend::gpu::FrameArguments common = *what.common;
    return later([what, common] { run_on_host(what, common); });
  }
  Status record(void* event, void* stream) override { return fails() || !here(event) || !here(stream) ? failed : 0; }
  Status synchronize(void*) override { return fails() ? failed : 0; }
  Status elapsed(void*, void*, float& milliseconds) override {
    milliseconds = 1;
    return fails() ? failed : 0;
  }
  Status begin_capture(void*) override {
    if (fails()) return failed;
    capturing_ = true;
    captured_.clear();
    return 0;
  }
  Status end_capture(void*, void*& graph) override {
    capturing_ = false;
    if (fails() || take_handle(graph) != 0) return failed;
    graphs_[graph] = captured_;
    ++graphs_made;
    return 0;
  }
  Status launch_graph(void* graph, void*) override {
    if (fails()) return failed;
    ++graphs_launched;
    for (const auto& step : graphs_.at(graph)) step();
    return 0;
  }
  void release(void* memory) override { give_back_memory(memory); }
  void release_pinned(void* memory) override { give_back_memory(memory); }
  void destroy_stream(void* stream) override { give_back_handle(stream); }
  void destroy_event(void* event) override { give_back_handle(event); }
  void destroy_graph(void* graph) override {
    graphs_.erase(graph);
    give_back_handle(graph);
  }

  ~StandInCuda() override {
    for (const auto& [memory, taken] : memory_) std::free(memory);
    for (const auto& [handle, device] : handles_) std::free(handle);
  }

 private:
  bool fails() {
    ++calls;
    return fail_at != 0 && (stays_broken ? calls >= fail_at : calls == fail_at);
  }
  static constexpr int host = -1;
  struct Taken {
    std::size_t bytes;
    int device;  ///< whose memory it is, or the host's
  };
  Status take_memory(std::size_t bytes, void*& memory, int device) {
    if (fails() || bytes > memory_bytes) return failed;
    memory = std::aligned_alloc(256, (bytes + 255) / 256 * 256 + 256);
    std::memset(memory, 0xa5, bytes);
    memory_[memory] = {bytes, device};
    return 0;
  }
  void give_back_memory(void* memory) {
    if (memory_.erase(memory) == 1) std::free(memory);
  }
  Status take_handle(void*& handle) {
    if (fails()) return failed;
    handles_[handle = std::malloc(1)] = device_;
    return 0;
  }
  void give_back_handle(void* handle) {
    if (handles_.erase(handle) == 1) std::free(handle);
  }
  /// Whether a stream or event is the current device's.
  [[nodiscard]] bool here(void* handle) const {
    const auto found = handles_.find(handle);
    return found != handles_.end() && found->second == device_;
  }
  /// Whether all of it lies in memory that was taken, of the host or of the current device.
  [[nodiscard]] bool within(const void* at, std::size_t bytes) const {
    auto next = memory_.upper_bound(const_cast<void*>(at));
    if (next == memory_.begin()) return false;
    --next;
    const Taken& taken = next->second;
    return (taken.device == host || taken.device == device_) &&
           static_cast<const char*>(at) + bytes <= static_cast<const char*>(next->first) + taken.bytes;
  }
  /// Whether the frames' arrays are where the kernel can write. (Arguments of their own may still be on their way.)
  [[nodiscard]] bool reaches_output(const backend::gpu::Launch& what) const {
    bool reached = true;
    flow::each_array(what.common->job.out,
                     [&](const auto* array, ArrayShape, Stage) { reached = reached && (array == nullptr || within(array, 1)); });
    return reached;
  }
  Status later(const std::function<void()>& step) {
    if (capturing_)
      captured_.push_back(step);
    else
      step();
    return 0;
  }

  std::map<void*, Taken> memory_;
  std::map<void*, int> handles_;
  std::map<void*, std::vector<std::function<void()>>> graphs_;
  std::vector<std::function<void()>> captured_;
  bool capturing_ = false;
  int device_ = 0;
};

/// The stand-in in the place of CUDA's runtime, for the length of a test.
class WithStandIn {
 public:
  WithStandIn() : before_(backend::gpu::replace_runtime(&cuda)) {}
  ~WithStandIn() { backend::gpu::replace_runtime(before_); }
  WithStandIn(const WithStandIn&) = delete;
  WithStandIn& operator=(const WithStandIn&) = delete;
  StandInCuda cuda;

 private:
  backend::gpu::Runtime* before_;
};

}  // namespace tofray::test
