// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/options.h"
#include "tofray/scene.h"
#include "tofray/stages.h"
#include "tofray/version.h"

namespace tofray {

/// Where an object is: by how much it is shifted and turned, as its position and rotation say it.
struct Placement {
  Vec3 position{0, 0, 0};  ///< shift [m], as Object::position
  Rotation rotation{};     ///< about the object's own centre, as Object::rotation
};

/// An object of the scene that is placed from outside, in one frame: in place of its position, rotation, velocities and keyframes. What else
/// it does, as a mesh that changes its shape, goes on.
struct PlacedObject {
  /// Object::name, or its place in the scene as listings say it: "objects.2". A mesh whose file has several materials is one.
  std::string name;
  Placement start = {};                  ///< placement at the frame's start
  std::optional<Placement> end = {};     ///< where the next frame starts: it goes there evenly, and on as far again; none: it stands still
  std::vector<Keyframe> keyframes = {};  ///< placements in place of both, by the scene's time, ascending
};

/// Which frame. What is not set is the simulator's.
struct FrameRequest {
  std::uint64_t index = 0;  ///< chooses the noise; starts at index / frame_rate
  std::optional<std::uint64_t> seed = {};
  std::optional<Pose> pose = {};      ///< pose of the camera at the frame's start
  std::optional<Pose> pose_end = {};  ///< where the next frame starts: it goes there evenly, and on as far again; none: it stands still
  std::vector<CameraKeyframe> camera = {};  ///< poses in place of both poses, by the scene's time, ascending
  std::vector<PlacedObject> objects = {};   ///< those that are placed from outside; the others move as the scene says
  std::optional<double> start_time_s = {};  ///< -1e6…1e6: when it starts, in place of index / frame_rate
};

/// One step of how a frame is computed: a pass over all of its pixels, before the next one begins.
struct PlanStep {
  std::string name;         ///< name of the pass: "from_rays", "bounces", "range_filter" …
  std::string does;         ///< what it does, in a few words
  std::string part;         ///< "ground truth", "sample 2 of 9", "paths, step 1": what of it, where it is done in parts
  std::string over;         ///< "tiles", "bands of rows" or "raw frames": what a worker of the processor takes at once
  std::int64_t pieces = 0;  ///< number of pieces
};

/// Frames that stay in a GPU's memory.
class DeviceFrames {
 public:
  DeviceFrames();
  ~DeviceFrames();
  DeviceFrames(DeviceFrames&&) noexcept;
  DeviceFrames& operator=(DeviceFrames&&) noexcept;

  [[nodiscard]] std::uint64_t size() const;
  /// Pointers of the device's memory, good until the next use of this object.
  [[nodiscard]] FrameArrays operator[](std::uint64_t i) const;
  /// How long the device computed, by its own clock [s].
  [[nodiscard]] double seconds() const;

  struct Impl;

 private:
  friend class Simulator;
  std::unique_ptr<Impl> impl_;
};

/// Simulates frames of one scene seen by one camera. frame(i) depends on nothing but (scene, camera, options, i).
class Simulator {
 public:
  /// @throws Error (bad_input) for a number that is not finite or out of its range, and where scene, camera and options do not fit
  /// together; (limit) where they are beyond a limit; (device) where Backend::cuda is wanted and cannot be had
  Simulator(const Scene& scene, const Camera& camera, const SimulatorOptions& options = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;
  Simulator& operator=(Simulator&&) noexcept;

  /// Frame i starts at i / frame_rate. Where Decoding::temporal_frames is more than 1, so many frames less one are computed before it, but for
  /// those that were computed last.
  [[nodiscard]] Frame frame(std::uint64_t index);
  /// Frame `index`, into memory that the caller keeps: arrays of the right size are not allocated anew.
  void frame(std::uint64_t index, Frame& into);
  /// A frame with a seed of its own, or whose camera and objects are placed from outside: the bytes are those of placed_scene,
  /// at the request's time. The first request that places other objects than those before takes as long as a new simulator, and as much
  /// memory; the last four such sets stay. Then nothing is built anew: neither a mesh's hierarchy nor the camera.
  /// @throws Error (bad_input) for a pose that cannot be, an object that is not there or that two share the name of, and keyframes that do not
  /// rise in time; (limit) for too many keyframes
  void frame(const FrameRequest& request, Frame& into);

  /// Stages 2 to 4 of what another renderer saw. Of the scene only its ambient light counts, and the camera's pose for where the sun is.
  /// @throws Error (bad_input) for an array of another size than camera and sequence ask for, and for a value out of its range
  [[nodiscard]] Frame frame(std::uint64_t index, const Geometry& seen);
  void frame(std::uint64_t index, const Geometry& seen, Frame& into);
  /// Stages 3 and 4 of light that was computed elsewhere; nothing of the scene counts. Truth: power_w and signal_e, the rest is unknown.
  /// @throws Error (bad_input) as for a Geometry
  [[nodiscard]] Frame frame(std::uint64_t index, const PixelLight& light);
  void frame(std::uint64_t index, const PixelLight& light, Frame& into);
  /// Stages 3 and 4 of light by the length of its path, computed elsewhere. Truth: signal_e, the rest is unknown.
  /// @throws Error (bad_input) as for a Geometry, where there is no light source or no lit raw frame, and where light sources differ in waveform;
  /// (limit) for histograms that are too large
  [[nodiscard]] Frame frame(std::uint64_t index, const Transient& light);
  void frame(std::uint64_t index, const Transient& light, Frame& into);

  /// Many frames, in their order: `count` from `first` on, or one for each request. On GPUs several of them are on their way at once, in
  /// bounded memory; all GPUs take part unless SimulatorOptions::device names one.
  /// Ends with the last whole frame once FrameProgress::stop is set.
  /// @param take  is given each frame when it is done; the arrays are good until it returns
  /// @throws Error for a request that cannot be, as frame: before the first frame
  void frames(std::uint64_t first, std::uint64_t count, const std::function<void(const FrameArrays&)>& take);
  void frames(std::span<const FrameRequest> requests, const std::function<void(const FrameArrays&)>& take);
  /// Many frames as frames() makes them, left in the GPU's memory, which `into` holds and uses again where it is large enough.
  /// @throws Error (device) where the processor computes, or where the memory is too small for them; (bad_input) as frames(), and for requests
  /// that do not all place the same objects
  void frames_on_device(std::uint64_t first, std::uint64_t count, DeviceFrames& into);
  void frames_on_device(std::span<const FrameRequest> requests, DeviceFrames& into);

  /// What computes the frames.
  [[nodiscard]] RanOn ran_on() const;
  /// How the first frame of this scene is computed, step by step. (Of what stands still later ones keep the light.)
  [[nodiscard]] std::vector<PlanStep> plan();

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

/// The scene whose file would say what a request says of it: keyframes in place of what it places.
/// @param camera  whose frame rate says when frames start
/// @throws Error as Simulator::frame does for the request
Scene placed_scene(const Scene& scene, const Camera& camera, const FrameRequest& request);
/// When a frame looks at what moves: the middle of each raw frame's exposure [s], by which a renderer or a physics engine can be asked. With
/// SimulatorOptions::exposure_samples more than 1 it looks at other times, too; with auto_exposure the times are those of the mode.
/// @param start_s  when the frame starts: index / frame_rate, or FrameRequest::start_time_s
/// @throws Error as a Simulator's constructor does for this camera
std::vector<double> exposure_times(const Camera& camera, double start_s = 0);
/// Where the camera is at a time: camera to world, [4][4] row-major, last row 0 0 0 1.
std::array<double, 16> camera_pose(const Scene& scene, double time_s);
/// A pose as a matrix: camera to world, row by row.
/// @throws Error (bad_input) where it looks nowhere, or its quaternion is not of unit length to 1e-3
std::array<double, 16> pose_matrix(const Pose& pose);
/// The pose, by its quaternion, that has such a matrix: of a camera's optical frame, x right, y down, z forward.
/// @throws Error (bad_input) where the upper left 3 x 3 is no rotation to 1e-3, or the last row is not 0 0 0 1
Pose pose_from_matrix(const std::array<double, 16>& camera_to_world);

/// Decodes raw data, simulated or measured, into depth (theory 4). Needs `raw`, or `tap_a` and `tap_b`, and the arrays by
/// phase; the camera says the rest. Taps, where present, are taken unrounded only if `raw` is empty; a tap that holds no
/// number flags its pixel as saturated.
/// @param ran_on  where not null: gets to know what computed
Depth process(const Raw& raw, const Camera& camera, const SimulatorOptions& options = {}, RanOn* ran_on = nullptr);

}  // namespace tofray
