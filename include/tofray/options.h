// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tofray/frame_arrays.h"

/// How frames are computed, and on what.
namespace tofray {

/// Whether frames are drawn by chance.
enum class Noise {
  off,    ///< expected values: no draw; wells and codes still clip, depth comes from the unrounded A−B
  exact,  ///< Poisson counts with read noise, each tap its own (the default)
};

/// Which machine code runs. All give the same bytes.
enum class Isa { best, scalar, scalar_fma, avx2, avx512, neon };

/// What computes the frames. Both give the same bytes.
enum class Backend {
  automatic,  ///< a GPU if there is one that can be used, else the processor
  cpu,
  cuda,  ///< a GPU, or an error that says why not
};

/// Progress of the processor within a frame: read and written from any thread.
struct FrameProgress {
  std::atomic<std::int64_t> done{0}, total{0};  ///< progress in rays, roughly; 0 of 0 before the first frame, and where a GPU computes
  std::atomic<bool> stop{false};                ///< set: the frame under way ends soon, and what it holds means nothing
};

/// How a Simulator computes: seed and noise, where it runs, and how much of the pipeline.
struct SimulatorOptions {
  std::uint64_t seed = 0;
  Noise noise = Noise::exact;
  int threads = 0;  ///< number of threads, at most 1024; 0: as many as the machine has cores
  Backend backend = Backend::automatic;
  int device = -1;     ///< number of the GPU, from 0 on; −1: the first one that can be used
  int block_size = 0;  ///< CUDA threads per block, a multiple of 32 up to 1024; 0: chosen
  std::size_t batch_bytes =
      64'000'000;       ///< host memory of one batch on its way from a GPU (or to it); there are three of them for each GPU
  Isa isa = Isa::best;  ///< best: the environment's TOFRAY_ISA, else what the CPU can do
  bool truth = true;    ///< fill Frame::truth
  /// Fill these arrays alone, by their names in files: {"raw", "gt_z_m"}. The others stay empty, but for those that these are made of, and
  /// no stage is run that none of them comes from. Left empty: all but those of ArrayWhen::asked.
  std::vector<std::string> arrays = {};
  Stage last_stage = Stage::depth;    ///< stop after this stage: arrays of later ones are left as they are (zero in a new frame)
  int exposure_samples = 1;           ///< 1…1000: times within each exposure at which what moves is seen, evenly spread: motion blur
  int subpixel = 1;                   ///< 1…16: samples of each pixel along its rows and columns; 1: its middle alone sees the scene
  bool culling = true;                ///< off: every pixel tests every object (slower, same bytes; for tests)
  FrameProgress* progress = nullptr;  ///< where not null: told how far a frame is; it must live as long as the simulator
};

/// What frames or depth were computed on.
struct RanOn {
  std::string backend;          ///< "cpu" or "cuda"
  std::string device;           ///< its name: of the GPU, or of the processor's instruction set
  std::string isa;              ///< instruction set of the processor: "scalar", "scalar_fma", "avx2", "avx512" or "neon"
  int threads = 0;              ///< threads of the processor
  int block_size = 0;           ///< threads per block of the kernel from ray to depth; 0 where the processor computed
  double occupancy = 0;         ///< share of the GPU that the kernel fills, 0 … 1 [1]
  std::string fallback_reason;  ///< why Backend::automatic took no GPU; empty where it did, or where the processor was asked for
};

}  // namespace tofray
