// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "backend/cuda/device.h"
#include "backend/cuda/pack.h"
#include "backend/engine.h"
#include "backend/light_memory.h"
#include "backend/slab.h"

namespace tofray::backend::gpu {

/// What does not change from frame to frame, on the device.
struct Resident {
  pipeline::Setup setup{};                      ///< pointers are the device's
  std::vector<camera::LensView> sample_lenses;  ///< of samples within pixels, for the host; their pointers are the device's
  std::vector<float> shares;
  std::vector<camera::DecodeModulation> modulations;  ///< of the decoder, likewise
  DeviceMemory memory;
};

/// A stream of work on a GPU with memory for some frames. While one stream computes, the host fills or empties another.
class FrameStream {
 public:
  FrameStream(const Device& device, int block_size);
  ~FrameStream();
  FrameStream(const FrameStream&) = delete;
  FrameStream& operator=(const FrameStream&) = delete;

  /// Bytes that each frame of a batch takes on the GPU beside its arrays.
  [[nodiscard]] static std::size_t input_bytes(const Resident& resident, const pipeline::Setup& first, const pipeline::Job& job, Own own);

  /// Starts a batch of up to `capacity` frames; waits until the last one is done.
  /// @param first  the first frame's setup (host pointers)
  void begin(const Resident& resident, const pipeline::Setup& first, const pipeline::Job& job, Own own, int capacity,
             const pipeline::Input* input = nullptr);
  /// Takes a frame on; what `setup` points to may change afterwards.
  /// @return false where there is no room: submit what there is, begin anew
  bool add(const pipeline::Setup& setup, std::uint64_t index);
  /// Hands all frames to the GPU and does not wait.
  /// @param output  device memory of slab().bytes() each; null: the stream's own, from where they go to host memory
  void submit(void* output = nullptr);
  /// Hands a single frame to the GPU as a graph, made anew only where arguments have changed.
  void submit_graph();
  void wait();

  [[nodiscard]] int frames() const { return static_cast<int>(numbers_.size()); }
  [[nodiscard]] const Slab& slab() const { return slab_; }
  /// Where frame i is in host memory, after wait().
  [[nodiscard]] void* received(int i) const {
    return static_cast<unsigned char*>(received_.get()) + static_cast<std::size_t>(i) * slab_.bytes();
  }
  /// Time that the device took from the first kernel to the last, after wait() [s].
  [[nodiscard]] double seconds() const;

 private:
  void reserve_input(std::size_t bytes);
  void reserve_derived(std::size_t bytes);
  void reserve_light(std::size_t bytes);
  void reserve_output();
  void take_step(const pipeline::Step& step, FrameArguments& arguments) const;
  void start(const Launch& launch) const;
  [[nodiscard]] bool light_is_known() const { return light_of_.known && light_of_ == light_origin_; }
  void write_arguments(const pipeline::Setup& setup, FrameArguments& out) const;
  void place(void* base);
  void launch_all();
  void capture();
  void copy_out(const void* base, std::size_t bytes, const char* doing);
  [[nodiscard]] unsigned char* staged() const { return static_cast<unsigned char*>(staged_.get()); }
  [[nodiscard]] unsigned char* light_memory() const { return static_cast<unsigned char*>(light_.get()); }
  [[nodiscard]] unsigned char* input_memory() const { return static_cast<unsigned char*>(input_.get()); }

  const Device& device_;
  int block_size_;
  Stream stream_;
  Event begin_, end_;
  DeviceMemory input_, output_, derived_, light_;
  PinnedMemory staged_, received_;
  std::size_t input_bytes_ = 0, output_bytes_ = 0, derived_bytes_ = 0, light_bytes_ = 0;
  LightOrigin light_of_;  ///< what the light image there shows
  Slab slab_;
  // the batch
  const Resident* resident_ = nullptr;
  pipeline::Job job_{};
  pipeline::Input given_{};  ///< in device memory; entry 0: from the scene on
  bool submitted_ = false, timed_ = false;
  Own own_ = Own::number;
  int capacity_ = 0;
  bool derives_ = false;
  std::size_t arguments_at_ = 0, room_from_ = 0, used_ = 0;
  std::vector<FrameNumber> numbers_;
  FrameArguments common_{};
  std::size_t light_stride_ = 0;  ///< bytes of a light image; 0: there is none
  flow::LightImage common_light_{};
  std::vector<flow::LightImage> own_lights_;  ///< [frame] where frames have arguments of their own
  LightOrigin light_origin_;                  ///< what the light image of this batch will show
  // the graph, and what it was made for
  Graph graph_;
  FrameArguments captured_{};
  pipeline::Input captured_given_{};
  bool captured_known_ = false;
  std::size_t captured_used_ = 0;
  Own captured_own_ = Own::number;
  Slab captured_slab_;
};

}  // namespace tofray::backend::gpu
