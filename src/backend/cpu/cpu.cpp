// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cpu/cpu.h"

#include <cstdlib>
#include <thread>

#include "backend/cpu/for_each_tile.h"
#include "tofray/error.h"

namespace tofray::backend {

namespace {

/// Null where this build has no kernel of the instruction set (CMake: TOFRAY_KERNELS).
Kernel kernel_of(Isa isa) {
  switch (isa) {
#if defined(TOFRAY_HAS_AVX512)
    case Isa::avx512: return tofray_kernel_avx512;
#endif
#if defined(TOFRAY_HAS_AVX2)
    case Isa::avx2: return tofray_kernel_avx2;
#endif
#if defined(TOFRAY_HAS_SCALAR_FMA)
    case Isa::scalar_fma: return tofray_kernel_scalar_fma;
#endif
    case Isa::scalar: return tofray_kernel_scalar;
    default: return nullptr;
  }
}

bool processor_has(Isa isa) {
  __builtin_cpu_init();
  const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  switch (isa) {
    case Isa::best:
    case Isa::scalar: return true;
    case Isa::scalar_fma:
    case Isa::avx2: return fma;
    case Isa::avx512:
      return fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
  }
  return false;
}

}  // namespace

bool can_run(Isa isa) { return isa == Isa::best || (kernel_of(isa) != nullptr && processor_has(isa)); }

std::string isa_name(Isa isa) {
  switch (isa) {
    case Isa::scalar: return "scalar";
    case Isa::scalar_fma: return "scalar_fma";
    case Isa::avx2: return "avx2";
    case Isa::avx512: return "avx512";
    case Isa::best: break;
  }
  return "best";
}

Isa choose_isa(Isa wanted) {
  const char* named = std::getenv("TOFRAY_ISA");
  if (wanted == Isa::best && named != nullptr && *named != '\0') {
    for (const Isa isa : {Isa::scalar, Isa::scalar_fma, Isa::avx2, Isa::avx512}) {
      if (named == isa_name(isa)) wanted = isa;
    }
    if (wanted == Isa::best) {
      throw Error(ErrorKind::bad_input,
                  "error: TOFRAY_ISA=" + std::string(named) + " is unknown\n  expected scalar, scalar_fma, avx2 or avx512");
    }
  }
  if (wanted == Isa::best) wanted = can_run(Isa::avx512) ? Isa::avx512 : can_run(Isa::avx2) ? Isa::avx2 : Isa::scalar;
  if (!can_run(wanted)) {
    const std::string who = processor_has(wanted) ? "this build of tofray" : "this processor";
    throw Error(ErrorKind::device,
                "error: " + who + " has no " + isa_name(wanted) + "\n  leave TOFRAY_ISA unset, or choose a lesser instruction set");
  }
  return wanted;
}

struct Cpu::Threads {
  TileRunner runner;
};

Cpu::Cpu(Isa isa, int threads)
    : isa_(choose_isa(isa)), threads_(threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))) {
  kernel_ = kernel_of(isa_);
}

Cpu::~Cpu() = default;

void Cpu::load(const pipeline::Setup& setup) {
  const Work work{&setup, nullptr, nullptr};
  pool_ = std::make_unique<Threads>(Threads{TileRunner(threads_, kernel_(&work, Pass::pixels, 0, nullptr))});
}

void Cpu::describe(RanOn& out) const { out.backend = "cpu", out.device = out.isa = isa_name(isa_), out.threads = threads_; }

void Cpu::run(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input) {
  const Work work{&setup, &job, input};
  const int tiles = pipeline::tile_count(setup.lens), bands = (setup.lens.height + pipeline::rows_per_band - 1) / pipeline::rows_per_band;
  pipeline::each_pass(setup, job, input != nullptr, [&](Pass pass) {
    pool_->runner.for_each_tile(pass == Pass::pixels || pass == Pass::input ? tiles : bands,
                                [&](int index, void* scratch) { kernel_(&work, pass, index, scratch); });
  });
}

}  // namespace tofray::backend
