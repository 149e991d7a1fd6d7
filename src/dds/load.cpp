// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dds/load.h"

#include <dlfcn.h>
#include <fmt/core.h>

#include <stdexcept>
#include <system_error>

#include "tofray/error.h"

namespace tofray::dds {

namespace {

namespace fs = std::filesystem;

template <class Function>
Function* function_in(void* library, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(library, name));
}

[[noreturn]] void refuse_library(const std::string& what, const std::string& way_out) {
  throw Error(ErrorKind::device, fmt::format("error: {}\n  {}", what, way_out));
}

/// The library, of the very same sources: its classes are those of our headers.
void* load_library(const fs::path& file) {
  void* const library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = ::dlerror();
    refuse_library(fmt::format("{} cannot be loaded: {}", file.native(), why != nullptr ? why : "no reason is known"),
                   "it needs Cyclone DDS (Debian: the package libddsc0debian, which comes with cyclonedds-dev)");
  }
  const auto identity = function_in<const char*()>(library, identity_function);
  const std::string theirs = identity != nullptr ? identity() : "";
  if (theirs != TOFRAY_DDS_IDENTITY)
    refuse_library(fmt::format("{} is {}, this is tofray {}", file.native(), theirs.empty() ? "none of tofray's" : "of tofray " + theirs,
                               TOFRAY_DDS_IDENTITY),
                   "install both of one version");
  return library;
}

/// Beside the program, in the lib beside its bin, and where a build has it.
std::vector<fs::path> usual_folders() {
  std::error_code failed;
  const fs::path here = fs::canonical("/proc/self/exe", failed).parent_path();
  return {here, here / "../lib", here / "../lib" / TOFRAY_LIBRARY_ARCHITECTURE, here / "../lib64", here / "../.."};
}

}  // namespace

std::unique_ptr<stream::Publisher> open_publisher(const Settings& settings) { return open_publisher(settings, usual_folders()); }

std::unique_ptr<stream::Publisher> open_publisher(const Settings& settings, const std::vector<fs::path>& folders) {
  for (const fs::path& folder : folders) {
    const fs::path file = (folder / library_file).lexically_normal();
    std::error_code failed;
    if (!fs::exists(file, failed)) continue;
    const auto open = function_in<stream::Publisher*(const Settings&)>(load_library(file), open_function);
    try {
      return std::unique_ptr<stream::Publisher>(open(settings));
    } catch (const std::runtime_error& error) {
      throw Error(ErrorKind::device, error.what());
    }
  }
  refuse_library(fmt::format("DDS is not here: {} is missing, the part of tofray that speaks it", library_file),
                 "install the package tofray-dds; in a build of your own: apt-get install cyclonedds-dev, and build again");
}

}  // namespace tofray::dds
