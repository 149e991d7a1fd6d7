# SPDX-FileCopyrightText: 2026 The tofray authors
# SPDX-License-Identifier: Apache-2.0

# The instruction sets that kernels are compiled for, by the processor, and their options: for the kernels themselves and for the tests
# that compile pieces of them in the same way. `scalar` runs everywhere and is what all others are compared with. (src/backend/cpu/sets.h
# has the same names for C++.)
set(tofray_all_kernels scalar)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")
  list(APPEND tofray_all_kernels scalar_fma avx2 avx512)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64|ARM64)$")
  list(APPEND tofray_all_kernels neon)
endif()
set(tofray_options_scalar "")
set(tofray_options_scalar_fma -mavx2 -mfma)
set(tofray_options_avx2 -mavx2 -mfma)
set(tofray_options_avx512 -mavx512f -mavx512bw -mavx512dq -mavx512vl -mavx2 -mfma -mprefer-vector-width=512)
set(tofray_options_neon "")   # part of every 64-bit ARM
