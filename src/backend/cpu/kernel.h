// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "pipeline/external_input.h"
#include "pipeline/pass/list.h"

/// What one instruction set's object exports: the pipeline over a piece of a frame.
namespace tofray::backend {

using pipeline::Pass;

struct Work {
  const pipeline::Setup* setup;
  const pipeline::Job* job;
  const pipeline::Input* input;
  std::int32_t item;  ///< which kernel of the lens
};

/// Does piece number `index` of a pass: a tile of pixels, a band of rows, or the lines of a raw frame; `scratch` is aligned to 64 bytes. @return 0;
/// where `scratch` is null, the bytes of it that a worker needs for the work's scene, and nothing is done.
using Kernel = std::size_t (*)(const Work* work, Pass pass, int index, void* scratch);

extern "C" {
std::size_t tofray_kernel_scalar(const Work*, Pass, int, void*);
std::size_t tofray_kernel_scalar_fma(const Work*, Pass, int, void*);
std::size_t tofray_kernel_avx2(const Work*, Pass, int, void*);
std::size_t tofray_kernel_avx512(const Work*, Pass, int, void*);
std::size_t tofray_kernel_neon(const Work*, Pass, int, void*);
}

}  // namespace tofray::backend
