// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <span>

#include "tofray/options.h"

/// The instruction sets that there is code for on the processor that this is compiled for, beside plain scalar code
/// (cmake/TofrayKernels.cmake has them, with their options).
#if defined(__x86_64__)
#define TOFRAY_SETS(one) one(scalar_fma) one(avx2) one(avx512)
#elif defined(__aarch64__)
#define TOFRAY_SETS(one) one(neon)
#else
#define TOFRAY_SETS(one)
#endif

namespace tofray::backend {

/// All that have a name, on whatever processor.
inline constexpr std::array every_isa = {Isa::scalar, Isa::scalar_fma, Isa::avx2, Isa::avx512, Isa::neon};

#define TOFRAY_ONE_SET(set) , Isa::set
/// Of them those of this kind of processor, the widest last.
inline constexpr std::array isas_here = {Isa::scalar TOFRAY_SETS(TOFRAY_ONE_SET)};
#undef TOFRAY_ONE_SET
/// Of those all but plain scalar code, which they are held against.
inline constexpr std::span<const Isa> machine_isas = std::span(isas_here).subspan(1);

}  // namespace tofray::backend
