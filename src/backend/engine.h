// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>

#include "pipeline/setup.h"
#include "tofray/options.h"

namespace tofray::pipeline {
struct Input;
}

namespace tofray::backend {

/// What frames with the same scene and camera have for themselves.
enum class Own {
  number,  ///< their place in the random numbers
  moving,  ///< and the times at which what moves is seen, the sensor's state and seed
  scene,   ///< and the camera's pose
};

/// Frames that are wanted in order. Whoever wants them says what each is, and takes it; an engine computes them, one by one or several at once.
class Batch {
 public:
  /// @param setup_      see set()
  /// @param job_        likewise; which arrays of `out` are wanted, before the first frame: those that are not null
  /// @param most_bytes_ of memory that frames on their way may take
  Batch(const pipeline::Setup& setup_, pipeline::Job& job_, std::uint64_t count_, std::size_t most_bytes_)
      : setup(setup_), job(job_), count(count_), most_bytes(most_bytes_) {}
  virtual ~Batch() = default;
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  /// Puts frame i into `setup` and `job`, all but its arrays.
  /// @param derive  the scene's forms and facets, too, for an engine that does not derive them itself
  virtual void set(std::uint64_t i, bool derive) = 0;
  /// Puts into `setup` what does not change from frame to frame, for a GPU that joins.
  virtual void set_fixed() = 0;
  /// The number by which frame i draws its noise.
  [[nodiscard]] virtual std::uint64_t number_of(std::uint64_t i) const = 0;
  /// What these frames have for themselves.
  [[nodiscard]] virtual Own own(std::uint64_t from, std::uint64_t frames) const = 0;
  /// Takes frame i. Its arrays are overwritten afterwards.
  virtual void take(std::uint64_t i, const flow::FrameView& arrays) = 0;

  const pipeline::Setup& setup;
  pipeline::Job& job;
  const std::uint64_t count;
  const std::size_t most_bytes;
  std::uint64_t taken = 0;  ///< frames so far: an engine that takes over from one that failed goes on here
};

/// Frames that stayed where an engine computed them.
class KeptFrames {
 public:
  KeptFrames() = default;
  virtual ~KeptFrames() = default;
  KeptFrames(const KeptFrames&) = delete;
  KeptFrames& operator=(const KeptFrames&) = delete;

  /// Arrays of frame i, in memory of the device.
  [[nodiscard]] virtual flow::FrameView view(std::uint64_t i) const = 0;
  [[nodiscard]] virtual const flow::FrameSize& size() const = 0;
  /// Number of the device.
  [[nodiscard]] virtual int device() const = 0;
  /// Time that the device took [s].
  [[nodiscard]] virtual double seconds() const = 0;
};

/// Something that computes frames: the processor, or GPUs.
class Engine {
 public:
  Engine() = default;
  virtual ~Engine() = default;
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Takes what does not change from frame to frame.
  virtual void load(const pipeline::Setup& setup) = 0;
  /// All passes of a frame, with arrays in host memory.
  /// @param own    what it has for itself beside what was loaded
  /// @param input  begin with this instead of the scene; null: with the scene
  virtual void run(const pipeline::Setup& setup, const pipeline::Job& job, Own own, const pipeline::Input* input) = 0;
  /// Frames of a batch, from the first that is not taken on. It ends early where progress is told to stop.
  virtual void run(Batch& batch) = 0;
  /// All frames of a batch, which stay where they are computed.
  /// @param before  frames of an earlier batch, whose memory is used again; null: none
  /// @return null where frames can stay nowhere but in host memory
  [[nodiscard]] virtual std::unique_ptr<KeptFrames> keep(Batch& batch, std::unique_ptr<KeptFrames> before) = 0;
  /// Whether it derives forms and facets of the scene itself; if not, whoever calls has to.
  [[nodiscard]] virtual bool derives() const = 0;
  /// Says what it is in `out`.
  virtual void describe(RanOn& out) const = 0;
};

}  // namespace tofray::backend
