// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/carried_font.h"

#include <dlfcn.h>
#include <fontconfig/fontconfig.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "base/address_space.h"

namespace tofray::pictures {
namespace {

constexpr const char* font_file = "DejaVuSans.ttf";

/// The font beside the library that has this function; empty where there is none.
std::filesystem::path font_beside(const void* function) {
  Dl_info info{};
  if (::dladdr(function, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code failed;
  const std::filesystem::path font = std::filesystem::path(info.dli_fname).parent_path() / font_file;
  return std::filesystem::is_regular_file(font, failed) ? font : std::filesystem::path();
}

bool take_font() {
  base::require_address_space(base::library_bytes);  // fontconfig 2.15 (Debian 13) crashes where its configuration finds no memory
  if (std::getenv("FONTCONFIG_FILE") != nullptr || std::getenv("FONTCONFIG_PATH") != nullptr) return false;
  const std::filesystem::path font = font_beside(reinterpret_cast<const void*>(&FcInit));
  if (font.empty()) return false;
  FcConfig* config = FcConfigCreate();
  if (config == nullptr) return false;
  const bool taken =
      FcConfigAppFontAddFile(config, reinterpret_cast<const FcChar8*>(font.c_str())) == FcTrue && FcConfigSetCurrent(config) == FcTrue;
  FcConfigDestroy(config);  // our share of it
  return taken;
}

}  // namespace

void use_carried_font() { [[maybe_unused]] static const bool taken = take_font(); }

}  // namespace tofray::pictures
