// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <link.h>

#include <system_error>

#include "backend/cuda/part.h"

namespace tofray::backend::gpu {

namespace {

namespace fs = std::filesystem;

template <class Function>
Function* function_of(void* library, const char* name) {
  return reinterpret_cast<Function*>(::dlsym(library, name));
}

/// A file that is there and cannot be taken.
Part refused(const fs::path& file, const std::string& why) { return {nullptr, "the code for GPUs, " + file.string() + ", " + why, true}; }

Part load(const fs::path& file, const std::string& identity) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* why = ::dlerror();
    return refused(file, std::string("cannot be loaded: ") + (why != nullptr ? why : "no reason is known"));
  }
  const auto identity_of = function_of<const char*()>(library, part_identity);
  const auto runtime_of = function_of<Runtime*()>(library, part_runtime);
  const std::string theirs = identity_of != nullptr && runtime_of != nullptr ? identity_of() : "";
  if (theirs == identity) return {runtime_of(), "", true};
  ::dlclose(library);
  if (theirs.empty()) return refused(file, "is none of tofray's");
  return refused(file, "is of tofray " + theirs + ", this is tofray " + identity + "; install both of one version");
}

/// The library or the program that holds this function.
fs::path own_file() {
  Dl_info info{};
  link_map* map = nullptr;
  // A library has its path here; the program has none, and stands in /proc.
  const bool known = ::dladdr1(reinterpret_cast<const void*>(&part_folders), &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0 &&
                     map != nullptr;
  const fs::path named = known && map->l_name != nullptr ? map->l_name : "";
  std::error_code failed;
  fs::path file = fs::canonical(named.empty() ? fs::path("/proc/self/exe") : named, failed);
  return failed ? fs::path() : file;
}

}  // namespace

Part load_part(const std::vector<fs::path>& folders, const std::string& identity) {
  for (const fs::path& folder : folders) {
    const fs::path file = (folder / part_file).lexically_normal();
    std::error_code failed;
    if (fs::exists(file, failed)) return load(file, identity);
  }
  return {nullptr,
          std::string("the part of tofray that has code for GPUs is not installed: the package tofray-cuda, whose ") + part_file +
              " belongs beside libtofray.so",
          false};
}

std::vector<fs::path> part_folders() {
  const fs::path file = own_file();
  if (file.empty()) return {};
  const fs::path here = file.parent_path();
  return {here,
          here / "../lib",
          here / "../lib" / TOFRAY_LIBRARY_ARCHITECTURE,
          here / "../lib64",
          here / "../tofray_cuda",
          here / "../../tofray_cuda"};
}

}  // namespace tofray::backend::gpu
