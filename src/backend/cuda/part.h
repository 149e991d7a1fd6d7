// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "backend/cuda/runtime.h"

/// Where the code for GPUs is: linked in, in a library of its own that is looked for when it is first wanted (TOFRAY_CUDA_APART, for
/// packages), or nowhere.
namespace tofray::backend::gpu {

struct Part {
  Runtime* runtime = nullptr;
  std::string lack;           ///< why there is none, one line
  bool is_installed = false;  ///< a file is there, so that who put it there will want to know the reason
};

/// The part with device code of this build. (part_linked.cpp, part_apart.cpp or part_none.cpp)
Part find_part();

/// The library's name, and its two functions: the runtime, and whose it is.
inline constexpr const char* part_file = "libtofray_cuda.so";
inline constexpr const char* part_runtime = "tofray_cuda_runtime";
inline constexpr const char* part_identity = "tofray_cuda_identity";

/// The first file of that name in `folders`, which stays loaded. Its classes are those of our headers, so it has to be of the very same sources.
/// @param identity  what its tofray_cuda_identity() has to return: "0.2.0 (sources 1f0c35ab)"
Part load_part(const std::vector<std::filesystem::path>& folders, const std::string& identity);

/// Where packages have it: beside the library or program that this function is in, in the lib beside bin, in a wheel's folder of its own.
std::vector<std::filesystem::path> part_folders();

}  // namespace tofray::backend::gpu
