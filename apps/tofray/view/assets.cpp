// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/assets.h"

#include "files/sha256.h"

extern "C" {
// assets.S, or where there is no page, assets_none.cpp.
extern const char* const tofray_view_names[];
extern const char* const tofray_view_begins[];
extern const char* const tofray_view_ends[];
extern const unsigned tofray_view_count;
}

namespace tofray::view {

namespace {

std::string_view type_of(std::string_view name) {
  constexpr std::pair<std::string_view, std::string_view> types[] = {{".html", "text/html; charset=utf-8"},
                                                                     {".js", "text/javascript; charset=utf-8"},
                                                                     {".css", "text/css; charset=utf-8"},
                                                                     {".svg", "image/svg+xml"},
                                                                     {".png", "image/png"},
                                                                     {".json", "application/json"},
                                                                     {".woff2", "font/woff2"},
                                                                     {".txt", "text/plain; charset=utf-8"}};
  for (const auto& [end, type] : types)
    if (name.ends_with(end)) return type;
  return "application/octet-stream";
}

}  // namespace

const std::vector<Asset>& assets() {
  static const std::vector<Asset> all = [] {
    std::vector<Asset> out;
    for (unsigned i = 0; i < tofray_view_count; ++i) {
      const std::string_view name = tofray_view_names[i];  // "/main.js"
      const char* const begin = tofray_view_begins[i];
      out.push_back({name == "/index.html" ? std::string_view("/") : name,
                     type_of(name),
                     {begin, static_cast<std::size_t>(tofray_view_ends[i] - begin)}});
    }
    return out;
  }();
  return all;
}

const Asset* find_asset(std::string_view target) {
  for (const Asset& one : assets())
    if (target == one.target) return &one;
  return nullptr;
}

std::string assets_sha256() {
  std::vector<std::string_view> parts;
  for (const Asset& one : assets()) {
    for (const std::string_view part : {one.target, std::string_view("\0", 1), one.bytes}) parts.push_back(part);
  }
  return files::sha256_hex(parts);
}

}  // namespace tofray::view
