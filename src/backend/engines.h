// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>

#include "backend/cpu/cpu.h"
#include "backend/cuda/cuda.h"

namespace tofray::backend {

/// What computes: GPUs where they are wanted and can, else the processor; and the processor from there on where a GPU fails.
class Engines {
 public:
  /// @param setup  what does not change from frame to frame
  /// @throws Error (device) where a GPU has to be used and cannot
  Engines(const SimulatorOptions& options, const pipeline::Setup& setup);

  /// Calls work(engine), and again with the processor where a GPU failed.
  /// @throws Error (device) as above
  template <class Work>
  void run(const Work& work) {
    if (gpus_ != nullptr) {
      try {
        work(static_cast<Engine&>(*gpus_));
        return;
      } catch (const gpu::Fault& fault) {
        give_up(fault);
      }
    }
    work(static_cast<Engine&>(cpu_));
  }
  /// As Engine::keep.
  /// @throws Error (device) where the processor computes, with the reason
  [[nodiscard]] std::unique_ptr<KeptFrames> keep(Batch& batch, std::unique_ptr<KeptFrames> before);

  /// The processor, whatever else there is.
  [[nodiscard]] Cpu& cpu() { return cpu_; }
  [[nodiscard]] RanOn ran_on() const;

 private:
  void give_up(const gpu::Fault& fault);

  Backend wanted_;
  Cpu cpu_;
  std::unique_ptr<Cuda> gpus_;  ///< null: the processor computes
  std::string fallback_reason_;
};

}  // namespace tofray::backend
