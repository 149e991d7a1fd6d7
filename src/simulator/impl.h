// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "camera/frozen_camera.h"
#include "camera/readout/image_camera.h"
#include "scene/frozen_scene.h"
#include "simulator/border.h"
#include "simulator/engines.h"
#include "simulator/exposure_control.h"
#include "simulator/placed.h"
#include "simulator/temporal.h"
#include "tofray/simulator.h"

namespace tofray {

/// What a simulator holds: scene and camera, frozen, and what computes.
struct Simulator::Impl {
  using Request = std::function<FrameRequest(std::uint64_t)>;
  using Take = std::function<void(const FrameArrays&)>;

  Scene scene;
  simulator::Border border;           ///< what is computed beside the region that is read
  Camera profile;                     ///< as it was given, and with the border
  camera::ImageCamera camera;         ///< whose pixels are those that are computed, with the border
  camera::ImageCamera region_camera;  ///< whose pixels are those of frames
  SimulatorOptions options;
  camera::FrozenCamera frozen_camera;
  scene::FrozenScene frozen_scene;
  pipeline::Setup setup{};
  pipeline::Job job{};
  std::vector<float> passes_scratch;
  Frame scratch;  ///< of a batch on the processor, and the model of one on a GPU
  simulator::Temporal temporal;
  simulator::ExposureControl exposure;
  Frame earlier;                                 ///< one that a later one needs
  Frame whole;                                   ///< with the border, before it is cut
  std::unique_ptr<Impl> of_region;               ///< a simulator of the region alone, without a border, for arrays in place of the scene
  std::unique_ptr<simulator::Handles> handles;   ///< of the scene's objects, once a request asks
  simulator::Placed placed;                      ///< what moves in `scene` as each request says
  std::vector<std::unique_ptr<Impl>> of_placed;  ///< those for requests that place objects or move the camera; the last one asked is first
  simulator::Engines engines;
  const float* written_before = nullptr;  ///< Raw::tap_a of the frame before; its content is not read

  /// @param with_border  false: nothing beside the region that is read
  Impl(const Scene& scene, const Camera& profile, const SimulatorOptions& wanted, bool with_border = true);

  /// What requests place, of which all are good.
  /// @param name  of the request, in messages
  simulator::Placed placed_by(const FrameRequest& request, const std::string& name);
  /// What computes a request that places this.
  Impl& for_placed(const simulator::Placed& what, const FrameRequest& first);
  /// Calls use(impl, requests) for each run of requests that place the same.
  template <class Use>
  void each_placed(std::span<const FrameRequest> requests, const Use& use);
  /// What arrays of one's own are for.
  Impl& for_own_arrays();

  /// @param input  null: from the scene on
  void frame(const FrameRequest& request, const pipeline::Input* input, Frame& into);
  void frames(std::uint64_t count, const Request& request, const Take& take);
  void frames_on_device(std::uint64_t count, const Request& request, DeviceFrames::Impl& into);

  /// Times of a frame's raw frames: start of each, and the middle of its exposure [s].
  [[nodiscard]] double start_of(const FrameRequest& request) const {
    return simulator::span_of(request, camera.mode.frame_rate_hz).start_s;
  }
  /// Puts the scene as it was looked at last into a setup.
  void set_scene(pipeline::Setup& to) const;
  /// Why a frame depends on earlier ones; null: it stands by itself.
  [[nodiscard]] const char* needs_earlier() const;
  /// Puts scene and sensor of a frame into `setup` and `job`.
  void set_frame(const FrameRequest& request);
  /// Its sensor alone.
  void set_sensor(const FrameRequest& request);
  /// Gives a frame its sizes and all that is known before it is computed, and sets `setup` and `job` for it.
  void begin(const FrameRequest& request, const pipeline::Input* input, const SimulatorOptions& with, const Transport& transport,
             Frame& into);
  /// Gives `into` its sizes, and the region of the arrays.
  void cut(const flow::FrameView& from, Frame& into) const;
  /// Cuts the region out of a whole frame.
  void cut(Frame& from, Frame& into) const;
  [[nodiscard]] scene::Times times_from(double start) const;

 private:
  /// As frame and frames, with the border.
  void frame_uncut(const FrameRequest& request, const pipeline::Input* input, Frame& into);
  void frames_uncut(std::uint64_t count, const Request& request, const Take& take);
  /// A frame by itself.
  void compute(const FrameRequest& request, const pipeline::Input* input, const SimulatorOptions& with, const Transport& transport,
               Frame& into);
  /// Computes the frames before, as far as the exposures of this one are not known without them.
  void find_exposures(std::uint64_t index);
  void set_exposures(std::uint64_t index);
  /// @throws Error (bad_input) where a frame depends on earlier ones, and the request says another seed, pose or time than they
  void check_over_time(const FrameRequest& request) const;
  [[nodiscard]] bool stopped() const { return options.progress != nullptr && options.progress->stop; }
  void frame_by_batch(const FrameRequest& request, Frame& into);
  void frames_over_time(std::uint64_t count, const Request& request, const Take& take);
  /// What does not change from frame to frame.
  [[nodiscard]] pipeline::Setup fixed_setup();
  void frames_one_by_one(backend::Engine& engine, std::uint64_t from, std::uint64_t count, const Request& request, const Take& take);
  void frames_on_gpus(std::uint64_t count, const Request& request, const Take& take, std::uint64_t& taken);
  [[nodiscard]] backend::gpu::Own own_of(std::uint64_t from, std::uint64_t count, const Request& request) const;
  std::uint64_t fill(backend::gpu::FrameStream& stream, const backend::Cuda& gpu, std::uint64_t from, std::uint64_t count,
                     const Request& request);
};

/// Frames in the memory of one GPU.
struct DeviceFrames::Impl {
  std::unique_ptr<backend::gpu::Device> device;
  backend::gpu::DeviceMemory memory;
  std::size_t memory_bytes = 0;
  backend::gpu::Slab slab;
  camera::ImageCamera camera;
  std::vector<std::uint64_t> indices;
  double seconds = 0;
};

}  // namespace tofray
