// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "backend/cpu/kernel.h"
#include "backend/cpu/sets.h"
#include "backend/engine.h"
#include "backend/light_memory.h"

/// Runs the pipeline on the processor: threads over tiles, lanes within.
namespace tofray::backend {

/// @throws Error (device) where the processor, or this build, cannot run the instruction set; (bad_input) for an unknown TOFRAY_ISA
Isa choose_isa(Isa wanted);
/// "scalar", "scalar_fma", "avx2", "avx512", "neon".
std::string isa_name(Isa isa);
/// The processor has it, whether this build has its kernel or not.
bool processor_has(Isa isa);
/// The processor has it, and this build has its kernel.
bool can_run(Isa isa);

/// How many pieces a step has: tiles of pixels, bands of rows, or raw frames.
int pieces_of(const pipeline::Step& step, const pipeline::Setup& setup);

class Cpu final : public Engine {
 public:
  /// @param threads   0: one per core
  /// @param progress  null: not asked for
  Cpu(Isa isa, int threads, FrameProgress* progress = nullptr);
  ~Cpu() override;

  /// @throws Error (limit) where the system refuses that many threads
  void load(const pipeline::Setup& setup) override;
  void run(const pipeline::Setup& setup, const pipeline::Job& job, Own own, const pipeline::Input* input) override;
  void run(Batch& batch) override;
  [[nodiscard]] std::unique_ptr<KeptFrames> keep(Batch&, std::unique_ptr<KeptFrames>) override { return nullptr; }
  /// From the scene on; the light of stages 1 and 2 stays in memory of whoever asks.
  void run_kept(const pipeline::Setup& setup, const pipeline::Job& job, std::vector<unsigned char>& light);
  /// Out of light that stayed; the truth of these stages is in the frame already. Several may read it at once.
  void run_from(const pipeline::Setup& setup, const pipeline::Job& job, const std::vector<unsigned char>& light);
  [[nodiscard]] bool derives() const override { return false; }
  void describe(RanOn& out) const override;
  /// Calls `piece(i)` for 0 <= i < count on its threads, in any order, and waits; once `load` has been called.
  void for_each(int count, const std::function<void(int)>& piece);

 private:
  struct Threads;
  struct Light {
    unsigned char* memory;
    bool known, kept;
  };
  void run_steps(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input, const Light& light);
  void run_step(const pipeline::Step& step, const Work& work);
  /// Steps that add samples within the pixels to the light image and, where nothing comes between, what collects its light, tile by tile: a
  /// tile reads and writes its own pixels alone, and what it adds to, at each time of each raw frame, stays in the caches from one to the next.
  void run_by_tiles(const std::vector<pipeline::Step>& steps, const pipeline::Setup& setup, const pipeline::Job& job,
                    const pipeline::Input& collected);
  [[nodiscard]] bool stopped() const { return progress_ != nullptr && progress_->stop; }

  Isa isa_;
  int threads_;
  Kernel kernel_;
  std::unique_ptr<Threads> pool_;
  std::vector<unsigned char> light_;  ///< memory of the light image
  LightOrigin light_of_;              ///< what it shows
  FrameProgress* progress_;
  std::atomic<bool> gave_up_ = false;  ///< steps of the frame were left out
};

}  // namespace tofray::backend
