// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>

#include "backend/cuda/arguments.h"

/// What the backend needs of CUDA's runtime, and nothing else: tests put a stand-in there that works in the host's memory.
namespace tofray::backend::gpu {

/// What a call returns: 0 where it went well, else a number that the runtime can explain.
using Status = int;

/// Why a call failed, as far as it makes a difference to the user.
enum class Cause { no_driver, old_driver, no_device, busy, no_memory, no_code, other };

struct DeviceInfo {
  std::string name;               ///< "NVIDIA H200"
  int major = 0, minor = 0;       ///< compute capability
  int processors = 0;             ///< streaming multiprocessors
  int threads_per_processor = 0;  ///< that one of them can hold
  std::size_t memory_bytes = 0;
  std::string bus_id;  ///< "0000:3b:00.0": its place, the same in every library that counts GPUs in an order of its own
};

/// One kernel over all pixels of `batch.frames` frames.
struct Launch {
  Pass pass;
  int block_size;
  const FrameArguments* common;  ///< host memory: goes along as kernel argument
  Batch batch;
  pipeline::Input input;  ///< device memory
};

enum class Way { to_device, to_host };

class Runtime {
 public:
  virtual ~Runtime() = default;
  /// The runtime's words for a status.
  virtual std::string text(Status status) = 0;
  virtual Cause cause(Status status) = 0;
  /// "13.0": of the driver, and of CUDA that this program was built with.
  virtual std::string driver_version() = 0;
  virtual std::string runtime_version() = 0;

  virtual Status count_devices(int& count) = 0;
  virtual Status describe(int device, DeviceInfo& info) = 0;
  /// Further calls of this thread are for this device.
  virtual Status use(int device) = 0;
  /// Whether this build has code that the device runs.
  virtual Status find_code() = 0;
  /// How many threads of a kernel one multiprocessor holds at once.
  virtual Status occupancy(Pass pass, int block_size, int& threads) = 0;

  virtual Status allocate(std::size_t bytes, void*& memory) = 0;
  virtual Status allocate_pinned(std::size_t bytes, void*& memory) = 0;
  virtual Status create_stream(void*& stream) = 0;
  virtual Status create_event(void*& event) = 0;

  virtual Status copy(void* to, const void* from, std::size_t bytes, Way way, void* stream) = 0;
  virtual Status launch(const Launch& what, void* stream) = 0;
  virtual Status record(void* event, void* stream) = 0;
  virtual Status synchronize(void* stream) = 0;
  virtual Status elapsed(void* from, void* to, float& milliseconds) = 0;

  /// Begins to record: what is asked of the stream from here on is kept and not done.
  virtual Status begin_capture(void* stream) = 0;
  /// Ends the record. @param graph  what was recorded, to be launched
  virtual Status end_capture(void* stream, void*& graph) = 0;
  virtual Status launch_graph(void* graph, void* stream) = 0;

  // Giving back never fails: after a fault there is nothing left to be done about another one.
  virtual void release(void* memory) = 0;
  virtual void release_pinned(void* memory) = 0;
  virtual void destroy_stream(void* stream) = 0;
  virtual void destroy_event(void* event) = 0;
  virtual void destroy_graph(void* graph) = 0;
};

/// CUDA's own: part_linked.cpp calls it, or load_part() finds it. (The only name that the object of the device code shows.)
extern "C" Runtime* tofray_cuda_runtime();

/// The runtime that backends are made with: CUDA's, or the one that a test has put there. Null where there is none.
Runtime* runtime();
/// For tests only. @return what was there before
Runtime* replace_runtime(Runtime* stand_in);

}  // namespace tofray::backend::gpu
