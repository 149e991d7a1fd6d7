// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "view/beast.h"
#include "view/request.h"

namespace tofray::view {

/// The head of a request that Beast has read. @param headers  is filled with what it refers to
inline Request request_of(const http::request<http::empty_body>& from, std::vector<Header>& headers) {
  const auto view = [](beast::string_view text) { return std::string_view(text.data(), text.size()); };
  for (const auto& one : from) headers.push_back({view(one.name_string()), view(one.value())});
  return {view(from.method_string()), view(from.target()), static_cast<int>(from.version()), headers};
}

}  // namespace tofray::view
