// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "tofray/error.h"

namespace tofray::view {

/// Calls `work`; what it throws becomes a text.
template <class Work>
std::optional<std::string> fault_of(const Work& work) {
  try {
    work();
    return {};
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "error: out of memory";
  } catch (const std::exception& error) {
    return std::string("error: unexpected: ") + error.what();
  }
}

}  // namespace tofray::view
