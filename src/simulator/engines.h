// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "backend/cpu/cpu.h"
#include "backend/cuda/cuda.h"

namespace tofray::simulator {

/// What computes: a GPU where one is wanted and can, else the processor; and the processor from there on where a GPU fails.
class Engines {
 public:
  /// @param setup  what does not change from frame to frame
  /// @throws Error (device) where a GPU has to be used and cannot
  Engines(const SimulatorOptions& options, const pipeline::Setup& setup);

  /// Calls work(engine), and again with the processor where a GPU failed.
  /// @throws Error (device) as above
  template <class Work>
  void run(const Work& work) {
    if (!gpus_.empty()) {
      try {
        work(static_cast<backend::Engine&>(*gpus_[0]));
        return;
      } catch (const backend::gpu::Fault& fault) {
        give_up(fault);
      }
    }
    work(static_cast<backend::Engine&>(cpu_));
  }

  /// The processor, whatever else there is.
  [[nodiscard]] backend::Cpu& cpu() { return cpu_; }
  /// GPUs that compute, the one of single frames first; empty: the processor does.
  [[nodiscard]] const std::vector<std::unique_ptr<backend::Cuda>>& gpus() const { return gpus_; }
  /// Opens the others, too, unless the options name one, or they are open.
  /// @param setup  called where it is needed
  void open_other_gpus(const std::function<const pipeline::Setup&()>& setup);

  [[nodiscard]] RanOn ran_on() const;

 private:
  void give_up(const backend::gpu::Fault& fault);

  SimulatorOptions options_;
  backend::Cpu cpu_;
  std::vector<std::unique_ptr<backend::Cuda>> gpus_;
  bool all_gpus_ = false;  ///< the other ones were looked for
  std::string fallback_reason_;
};

}  // namespace tofray::simulator
