// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Linked into the module, this puts the stand-in in the place of CUDA's runtime for as long as the process lives.
#include "support/stand_in_cuda.h"

namespace {

// Never destroyed: simulators and arrays give back to it at the interpreter's very end.
[[maybe_unused]] const auto* const always = new tofray::test::WithStandIn();

}  // namespace

/// What was taken of it and not given back, for the tests.
extern "C" __attribute__((visibility("default"))) std::size_t tofray_stand_in_held() { return always->cuda.held(); }
