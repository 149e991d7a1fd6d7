// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/bench_energy.h"
#include "cli/options.h"
#include "files/json.h"
#include "run/inputs.h"
#include "tofray/frame.h"

namespace tofray::app {

/// Where frames are written: each to the same place, which the caches may hold; or each to another, as who records many does, until far
/// more memory than caches hold has been gone through.
enum class Places { same, others };

/// One way to simulate a scene, and how long its frames took.
class Contender {
 public:
  Contender(const run::Loaded& in, const SimulatorOptions& options, Places places = Places::same);
  /// Simulates the next frame; `timed`: into the record.
  void step(bool timed);
  /// The given share of frames took no longer than this [ms].
  [[nodiscard]] double percentile_ms(double share) const;
  [[nodiscard]] double median_ms() const { return percentile_ms(0.5); }
  /// Pixels per second at the median.
  [[nodiscard]] double pixel_rate() const;
  /// Frame 0 and all that the options ask for of it.
  [[nodiscard]] const Frame& first_frame();
  [[nodiscard]] const Simulator& simulator() const { return simulator_; }
  /// Joules of further frames.
  [[nodiscard]] Energy energy();
  /// Row of `results`; its hash is that of frame 0's arrays, whatever was timed.
  [[nodiscard]] files::Json result();

 private:
  /// Median time of each stage [ms], from runs of their own that write to one place.
  [[nodiscard]] files::Json stage_ms();
  /// Median time of a frame [ms] that is written to another place than the one before.
  [[nodiscard]] files::Json other_places();
  /// Time until a simulator can compute [ms]: from nothing, and the median of another lens, whose rays are new, of another sensor behind
  /// the same lens, and of another scene before the same camera; its lights and meshes are those of this one.
  [[nodiscard]] files::Json set_up_ms() const;
  void step_into(Frame& place, bool timed);
  /// Lets go of what simulators before have left. @return the time
  static std::chrono::steady_clock::time_point begin();

  run::Loaded in_;
  std::string scene_;
  SimulatorOptions options_;
  double pixels_;
  std::chrono::steady_clock::time_point begun_ = begin();
  Simulator simulator_;
  double from_nothing_ms_;
  std::vector<Frame> frames_;  ///< as many as are written in turn
  std::uint64_t next_ = 0;
  std::vector<double> ms_;
};

/// Time of each stage out of the times up to the end of each [ms]. Of two runs the longer one may by chance have been the faster: a stage
/// that is shorter than such chance counts 0, never less, and the sum stays.
std::vector<double> stage_times(const std::vector<double>& upto);

/// Most memory that this process has had so far [bytes]: VmHWM.
std::uint64_t peak_bytes();

/// Options for timing: no ground truth.
SimulatorOptions bench_options(const Options& options);

/// Where the GPU sits that computes; empty where the processor does.
std::string gpu_bus_id(const Simulator& simulator, const SimulatorOptions& options);

/// SHA-256 over all arrays of raw data, depth and ground truth that there are.
std::string arrays_sha256(const Frame& frame);

/// Two contenders that differ in one thing.
struct Ratio {
  std::string name;  ///< "time of scalar_fma / avx512, 1 thread"
  double value = 0;
};

/// `tofray bench`. @return the exit code
int run_bench(const Options& options);

/// Frames per second of whole batches. @return the exit code
int run_batch_bench(const Options& options);

/// Runs pairs in turn, frame by frame (A B A B …), so that the machine's moods meet both alike.
/// @param results  a row for each contender
std::vector<Ratio> compare(const Options& options, const std::string& scene, files::Json& results);

}  // namespace tofray::app
