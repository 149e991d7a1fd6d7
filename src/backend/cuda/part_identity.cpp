// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What libtofray_cuda.so says of itself to load_part().

extern "C" __attribute__((visibility("default"))) const char* tofray_cuda_identity() { return TOFRAY_PART_IDENTITY; }
