// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/control.h"
#include "view/session.h"

namespace tofray::view {

struct ServerOptions {
  std::optional<int> port;                 ///< 0: any that is free; not given: 7170 or one of the 20 behind it
  std::string host;                        ///< empty: this machine's own addresses alone
  std::vector<std::string> allowed_hosts;  ///< further names that Host may have
  bool embed = false, end_with_input = false;
  Rate rate;  ///< of pages that do not say one
};

struct Address {
  std::string url;  ///< with the token behind "#"
  int port = 0;
  bool on_all = false;  ///< reached from other machines
};

/// Serves until a signal comes, within a second after it.
/// @param told  is given the address once, when connections are taken
/// @throws Error (io) where the address cannot be had
void serve(const ServerOptions& options, Session& session, const std::function<void(const Address&)>& told);

}  // namespace tofray::view
