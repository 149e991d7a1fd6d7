// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "backend/cpu/kernel.h"
#include "tofray/simulator.h"

/// Runs the pipeline on the processor: threads over tiles, lanes within.
namespace tofray::backend {

/// @throws Error (device) where the processor, or this build, cannot run the instruction set; (bad_input) for an unknown TOFRAY_ISA
Isa choose_isa(Isa wanted);
/// "scalar", "scalar_fma", "avx2", "avx512".
std::string isa_name(Isa isa);
/// The processor has it, and this build has its kernel.
bool can_run(Isa isa);

class Cpu {
 public:
  /// @param threads  0: one per core
  /// @param moves    something in the scene does
  Cpu(Isa isa, int threads, bool moves);
  ~Cpu();
  Cpu(const Cpu&) = delete;
  Cpu& operator=(const Cpu&) = delete;

  /// All passes of a frame. `input`: begin with this instead of the scene.
  void run(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input = nullptr);
  [[nodiscard]] Isa isa() const { return isa_; }
  [[nodiscard]] int threads() const { return threads_; }

 private:
  struct Threads;
  Isa isa_;
  int threads_;
  Kernel kernel_;
  std::unique_ptr<Threads> pool_;
};

}  // namespace tofray::backend
