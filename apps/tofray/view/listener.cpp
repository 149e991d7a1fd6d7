// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/listener.h"

#include <fmt/core.h>

#include "cli/console.h"
#include "tofray/error.h"

namespace tofray::view {

namespace {

std::string address_text(const std::string& host) { return host.empty() || host == "localhost" ? "127.0.0.1" : host; }

/// Listens at these addresses, on the same port. @return nothing where the first one cannot be had
Listeners opened(net::io_context& io, const std::string& who, const std::vector<net::ip::address>& addresses, int port, error_code& error) {
  Listeners out;
  for (const net::ip::address& address : addresses) {
    auto one = std::make_shared<Listener>(io);
    const int at = out.empty() ? port : out.front()->port();
    const error_code failed = one->open({address, static_cast<std::uint16_t>(at)});
    if (failed && out.empty()) {
      error = failed;
      return {};
    }
    if (failed)
      app::say(fmt::format("warning: {} is not reached at {}: {}\n", who, address.to_string(), failed.message()));
    else
      out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

error_code Listener::open(const tcp::endpoint& at) {
  error_code error;
  acceptor_.open(at.protocol(), error);
  if (!error) acceptor_.set_option(net::socket_base::reuse_address(true), error);
  if (!error && at.address().is_v6()) acceptor_.set_option(net::ip::v6_only(true), error);
  if (!error) acceptor_.bind(at, error);
  if (!error) acceptor_.listen(net::socket_base::max_listen_connections, error);
  if (error) close();
  return error;
}

void Listener::accept(Take take) {
  take_ = std::move(take);
  next();
}

void Listener::next() {
  acceptor_.async_accept([self = shared_from_this()](error_code error, tcp::socket socket) {
    if (error == net::error::operation_aborted) return;
    if (error) return self->wait();
    error_code ignored;
    socket.set_option(tcp::no_delay(true), ignored);
    self->take_(std::move(socket));
    self->next();
  });
}

/// Where the process has no more files, a moment later it may.
void Listener::wait() {
  again_.expires_after(std::chrono::milliseconds(100));
  again_.async_wait([self = shared_from_this()](error_code error) {
    if (!error) self->next();
  });
}

void Listener::close() {
  error_code ignored;
  acceptor_.close(ignored);
  again_.cancel();
}

Listeners listening(net::io_context& io, const ListenAt& place) {
  std::vector<net::ip::address> addresses = {net::ip::address_v4::loopback(), net::ip::address_v6::loopback()};
  error_code error;
  if (!place.host.empty()) {
    addresses = {net::ip::make_address(address_text(place.host), error)};
    if (error)
      throw Error(
          ErrorKind::bad_input,
          fmt::format("error: --host {} is no address\n  expected one of this machine's, as in --host 0.0.0.0 or --host ::1", place.host));
  }
  const int first = place.port.value_or(place.usual.first), last = place.port ? first : first + place.usual.behind;
  for (int port = first; port <= last; ++port) {
    Listeners out = opened(io, place.who, addresses, port, error);
    if (!out.empty()) return out;
  }
  throw Error(ErrorKind::io,
              fmt::format("error: {} cannot listen on {} port {}: {}\n  expected a port that is free; without --port one is looked for",
                          place.who, addresses.front().to_string(), first, error.message()));
}

void run_sockets(net::io_context& io) {
  for (;;) {
    try {
      io.run();
      return;
    } catch (const std::exception& error) {
      app::say(fmt::format("warning: a connection is lost: {}\n", error.what()));
    }
  }
}

bool is_loopback(const std::string& host) { return net::ip::make_address(address_text(host)).is_loopback(); }

}  // namespace tofray::view
