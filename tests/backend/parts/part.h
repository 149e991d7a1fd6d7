// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "support/stand_in_cuda.h"

/// In the place of libtofray_cuda.so: a runtime that launches nothing.
namespace tofray::test {
void run_on_host(const backend::gpu::Launch&, const backend::gpu::FrameArguments&) {}
}  // namespace tofray::test

extern "C" tofray::backend::gpu::Runtime* tofray_cuda_runtime() {
  static tofray::test::StandInCuda stand_in;
  return &stand_in;
}
