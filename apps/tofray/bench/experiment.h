// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "bench/bench_energy.h"
#include "cli/options.h"
#include "files/json.h"
#include "pictures/chart.h"

/// The block-size experiment: how much faster than one thread of sequential code a GPU is, over its threads per block; without a GPU the
/// same for vector code over the number of threads. This is what was measured; experiment.cpp measures.
namespace tofray::app {

/// One way to compute one stage of one scene.
struct Timing {
  std::string code;    ///< "scalar_fma", "avx512", "cuda"
  int threads = 0;     ///< of the processor; 0 on a GPU
  int block_size = 0;  ///< CUDA threads per block; 0 on the processor
  double ms_median = std::numeric_limits<double>::quiet_NaN();
  double ms_p10 = std::numeric_limits<double>::quiet_NaN();
  std::string sha256;               ///< of all that frame 0 gives
  std::optional<double> occupancy;  ///< share of the GPU's warps that can be resident, 0…1
  std::string fault;                ///< why it cannot run; empty where it ran
  std::optional<Energy> energy;     ///< where it was measured
  [[nodiscard]] bool ran() const { return fault.empty(); }
  /// What the experiment varies: threads per block, or threads.
  [[nodiscard]] int x() const { return block_size > 0 ? block_size : threads; }
};

/// All runs of one stage of one scene, measured in turn with the two that they are compared with.
struct Group {
  std::string scene;
  std::size_t objects = 0;
  std::string stage;  ///< "power": from the ray to power and with it; "all": the whole frame
  Timing scalar;      ///< sequential: one thread, one pixel at a time, hardware FMA where there is any
  Timing vector;      ///< our code for the processor, as many threads as asked for
  std::vector<Timing> runs;
};

struct Experiment {
  std::string backend;  ///< "cpu" or "cuda"
  std::string cpu, gpu, noise;
  std::uint64_t frames = 0;  ///< that each median is over
  int width = 0, height = 0, raw_frames = 0;
  std::vector<Group> groups;
};

/// How many times as fast as `base`; NaN where one of them did not run.
double speed_up(const Timing& base, const Timing& run);

/// Place of the fastest in group.runs; −1 where none ran.
int best_run(const Group& group);

/// The value that suits all scenes of a stage best.
struct Best {
  std::string stage;
  int x = 0;
  double speed_up = 0;  ///< geometric mean over the scenes, against sequential code
};
/// One for each stage for which some value ran in every scene.
std::vector<Best> best_of_stages(const Experiment& experiment);

/// "scene stage code x" of every run whose bytes are not those of sequential code.
std::vector<std::string> other_bytes(const Experiment& experiment);

std::string experiment_table(const Experiment& experiment);
files::Json experiment_json(const Experiment& experiment);
/// Speed-up over block size or threads, one curve for each scene and stage.
pictures::Chart experiment_chart(const Experiment& experiment);

/// Measures, prints table or JSON and writes both with the chart into a folder. @return the exit code
int run_experiment(const Options& typed);

}  // namespace tofray::app
