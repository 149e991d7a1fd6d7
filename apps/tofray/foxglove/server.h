// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stream/publisher.h"

namespace tofray::foxglove {

struct Settings {
  std::optional<int> port;                   ///< 0: any that is free; not given: 8765 or one of the 20 behind it
  std::string host;                          ///< empty: this machine's own addresses alone
  std::vector<std::string> allowed_hosts;    ///< further names that Host may have
  std::vector<std::string> allowed_origins;  ///< of pages elsewhere
  int history = 5;                           ///< how many messages of a topic are kept for who comes later
};

/// A server that takes readers from now on, in a thread of its own, until it is deleted.
struct Server {
  std::unique_ptr<stream::Publisher> publisher;
  std::string url;      ///< "ws://localhost:8765"
  bool on_all = false;  ///< reached from other machines
};

/// @throws Error (bad_input) for a host that is no address, (io) where the address cannot be had
Server open_server(const Settings& settings);

}  // namespace tofray::foxglove
