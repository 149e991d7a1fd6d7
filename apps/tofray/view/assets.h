// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// The files of the page, which the build puts into the program.
namespace tofray::view {

struct Asset {
  std::string_view target;  ///< "/main.js"; "/" for index.html
  std::string_view type;    ///< for Content-Type
  std::string_view bytes;
};

/// Empty where the build had no npm.
const std::vector<Asset>& assets();
const Asset* find_asset(std::string_view target);
/// SHA-256 of all of them: a page that finds another one loads itself anew.
std::string assets_sha256();

}  // namespace tofray::view
