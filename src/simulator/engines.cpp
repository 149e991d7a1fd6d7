// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/engines.h"

#include <utility>

namespace tofray::simulator {

Engines::Engines(const SimulatorOptions& options, const pipeline::Setup& setup)
    : options_(options), cpu_(options.isa, options.threads, options.progress) {
  backend::check_block_size(options.block_size);
  cpu_.load(setup);
  if (options.backend == Backend::cpu) return;
  try {
    gpus_.push_back(std::make_unique<backend::Cuda>(options.device, options.block_size, cpu_));
    gpus_[0]->load(setup);
  } catch (const backend::gpu::Fault& fault) {
    give_up(fault);
  }
}

void Engines::give_up(const backend::gpu::Fault& fault) {
  if (options_.backend == Backend::cuda) throw fault;
  gpus_.clear();
  fallback_reason_ = fault.reason();
}

void Engines::open_other_gpus(const std::function<const pipeline::Setup&()>& setup_of) {
  if (options_.device >= 0 || std::exchange(all_gpus_, true)) return;
  const pipeline::Setup& setup = setup_of();
  for (int i = gpus_[0]->device().number() + 1; i < backend::gpu::count_devices(); ++i) {
    try {
      auto gpu = std::make_unique<backend::Cuda>(i, options_.block_size, cpu_);
      gpu->load(setup);
      gpus_.push_back(std::move(gpu));
    } catch (const backend::gpu::Fault&) {
      continue;  // another one that cannot be used is no reason to do without the first
    }
  }
}

RanOn Engines::ran_on() const {
  RanOn out;
  cpu_.describe(out);
  if (!gpus_.empty()) gpus_[0]->describe(out);
  out.fallback_reason = fallback_reason_;
  return out;
}

}  // namespace tofray::simulator
