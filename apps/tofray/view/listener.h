// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "view/beast.h"

namespace tofray::view {

/// Takes connections at one address.
class Listener : public std::enable_shared_from_this<Listener> {
 public:
  using Take = std::function<void(tcp::socket&&)>;

  explicit Listener(net::io_context& io) : acceptor_(io), again_(io) {}
  error_code open(const tcp::endpoint& at);
  /// From now on gives each connection away.
  void accept(Take take);
  [[nodiscard]] int port() const { return acceptor_.local_endpoint().port(); }
  void close();

 private:
  void next();
  void wait();

  tcp::acceptor acceptor_;
  net::steady_timer again_;
  Take take_;
};

using Listeners = std::vector<std::shared_ptr<Listener>>;

struct Ports {
  int first = 0, behind = 0;
};

/// Where a server is to listen.
struct ListenAt {
  std::string who;          ///< "the viewer", in errors
  std::string host;         ///< empty: this machine's own addresses alone
  std::optional<int> port;  ///< 0: any that is free; not given: one of `usual`
  Ports usual;
};

/// Listens at all addresses of a place, on one port.
/// @throws Error (bad_input) for a host that is no address, (io) where no port can be had
Listeners listening(net::io_context& io, const ListenAt& place);

/// Runs until it is stopped or has nothing more to do. Handlers may throw for a lack of memory: the connection that it happened to is gone then,
/// and no other.
void run_sockets(net::io_context& io);

/// @param host  as in ListenAt; one that listening() took
bool is_loopback(const std::string& host);

}  // namespace tofray::view
