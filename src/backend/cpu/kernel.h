// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

#include "pipeline/enter.h"
#include "pipeline/setup.h"

/// What one instruction set's object exports: the pipeline over a piece of a frame.
namespace tofray::backend {

enum class Pass : int {
  pixels,       ///< one tile, from rays to depth
  input,        ///< one tile, from what came from elsewhere to depth
  flying,       ///< one band of rows
  filter,       ///< one band of rows
  settle,       ///< one band of rows
};

struct Work {
  const pipeline::Setup* setup;
  const pipeline::Job* job;
  const pipeline::Input* input;
};

/// Does piece number `index` of a pass. With a null `work`: returns the bytes of scratch memory that a worker needs for `index` raw frames
/// (0: nothing moves); otherwise 0. `scratch` is aligned to 64 bytes.
using Kernel = std::size_t (*)(const Work* work, Pass pass, int index, void* scratch);

extern "C" {
std::size_t tofray_kernel_scalar(const Work*, Pass, int, void*);
std::size_t tofray_kernel_scalar_fma(const Work*, Pass, int, void*);
std::size_t tofray_kernel_avx2(const Work*, Pass, int, void*);
std::size_t tofray_kernel_avx512(const Work*, Pass, int, void*);
}

}  // namespace tofray::backend
