// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/parts/part.h"

extern "C" const char* tofray_cuda_identity();
extern "C" const char* tofray_cuda_identity() { return "1.2.3 (sources 4567cdef)"; }
