// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/engines.h"

#include <utility>

namespace tofray::backend {

Engines::Engines(const SimulatorOptions& options, const pipeline::Setup& setup)
    : wanted_(options.backend), cpu_(options.isa, options.threads, options.progress) {
  check_block_size(options.block_size);
  cpu_.load(setup);
  if (wanted_ == Backend::cpu) return;
  try {
    gpus_ = std::make_unique<Cuda>(options.device, options.block_size, cpu_);
    gpus_->load(setup);
  } catch (const gpu::Fault& fault) {
    give_up(fault);
  }
}

void Engines::give_up(const gpu::Fault& fault) {
  if (wanted_ == Backend::cuda) throw fault;
  gpus_.reset();
  fallback_reason_ = fault.reason();
}

std::unique_ptr<KeptFrames> Engines::keep(Batch& batch, std::unique_ptr<KeptFrames> before) {
  if (gpus_ == nullptr) throw gpu::Fault(fallback_reason_.empty() ? "the processor computes" : fallback_reason_, false);
  return gpus_->keep(batch, std::move(before));
}

RanOn Engines::ran_on() const {
  RanOn out;
  cpu_.describe(out);
  if (gpus_ != nullptr) gpus_->describe(out);
  out.fallback_reason = fallback_reason_;
  return out;
}

}  // namespace tofray::backend
