// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "backend/cuda/cuda.h"

namespace tofray::test {

/// Skips a test where no GPU can be used, and says why; fails it there, if TOFRAY_EXPECT_GPU is set. For a fixture's SetUp.
inline void need_gpu() {
  const std::string reason = backend::why_no_cuda(-1).reason;
  if (reason.empty()) return;
  if (std::getenv("TOFRAY_EXPECT_GPU") != nullptr) FAIL() << "TOFRAY_EXPECT_GPU is set: " << reason;
  GTEST_SKIP() << "not compared with a GPU: " << reason;
}

}  // namespace tofray::test
