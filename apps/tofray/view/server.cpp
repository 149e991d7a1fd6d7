// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/server.h"

#include <fmt/core.h>
#include <unistd.h>

#include <boost/asio/posix/stream_descriptor.hpp>

#include <csignal>
#include <cstdlib>
#include <memory>

#include "cli/console.h"
#include "tofray/error.h"
#include "view/assets.h"
#include "view/beast.h"
#include "view/client.h"
#include "view/http_request.h"
#include "view/hub.h"
#include "view/listener.h"
#include "view/secret.h"

namespace tofray::view {

namespace {

constexpr Ports usual_ports{7170, 20};
constexpr std::uint32_t most_head = 16384;
constexpr auto head_time = std::chrono::seconds(5), answer_time = std::chrono::seconds(30);

constexpr std::string_view no_page =
    "<!doctype html><meta charset=utf-8><title>tofray</title><p>This build has no page: ./dev view makes it.";

/// The page for files has no frames yet.
bool is_file(std::string_view target) { return target == "/" || (target != "/export.html" && find_asset(target) != nullptr); }

/// A connection that speaks HTTP: answers requests, one after the other, until one of them opens a WebSocket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket&& socket, Counted counted) : stream_(std::move(socket)), counted_(std::move(counted)) {}

  void read() {
    parser_.emplace();
    parser_->header_limit(most_head);
    parser_->body_limit(0);
    stream_.expires_after(head_time);
    http::async_read_header(stream_, buffer_, *parser_, [self = shared_from_this()](error_code error, std::size_t) { self->took(error); });
  }

  void refuse_for_want_of_room() { answer(false, {503, "64 connections are open: close one"}, false); }

 private:
  void took(error_code error) {
    if (error == http::error::header_limit) return answer(false, {431, "the headers are too long"}, false);
    if (error && error.category() == make_error_code(http::error::bad_value).category() && error != http::error::end_of_stream)
      return answer(false, {400, "this is no request of HTTP/1.1"}, false);
    if (error) return;  // gone, or too slow
    const auto& request = parser_->get();
    std::vector<Header> headers;
    const Request seen = request_of(request, headers);
    Verdict verdict = judged(seen, counted_.hub().admission(), is_file);
    if (verdict.status == 101 && buffer_.size() > 0) verdict = {400, "nothing is sent before the WebSocket is open"};
    if (verdict.status == 101) {
      std::make_shared<Client>(std::move(stream_), std::move(counted_))->accept(parser_->release());
      return;
    }
    const bool goes_on = verdict.status == 200 && request.keep_alive();
    answer(request.method() == http::verb::head, verdict, goes_on, std::string(seen.target));
  }

  void answer(bool head, const Verdict& verdict, bool goes_on, const std::string& target = {}) {
    const Asset* file = verdict.status == 200 ? find_asset(target) : nullptr;
    const bool is_empty_page = verdict.status == 200 && file == nullptr;
    const std::string text = std::string(verdict.why) + "\n";
    const std::string_view body = file != nullptr ? file->bytes : is_empty_page ? no_page : std::string_view(text);
    auto response = std::make_shared<http::response<http::string_body>>();
    response->version(11);
    response->result(static_cast<unsigned>(verdict.status));
    response->keep_alive(goes_on);
    set_headers(*response, verdict.status);
    response->set(http::field::content_type, file != nullptr ? std::string(file->type)
                                             : is_empty_page ? "text/html; charset=utf-8"
                                                             : "text/plain; charset=utf-8");
    response->content_length(body.size());
    if (!head) response->body() = body;
    stream_.expires_after(answer_time);
    auto serializer = std::make_shared<http::response_serializer<http::string_body>>(*response);
    const auto then = [self = shared_from_this(), response, serializer, goes_on](error_code error, std::size_t) {
      if (error) return;
      if (goes_on) return self->read();
      error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    };
    if (head)
      http::async_write_header(stream_, *serializer, then);
    else
      http::async_write(stream_, *serializer, then);
  }

  void set_headers(http::response<http::string_body>& response, int status) const {
    // The hub is gone to the WebSocket where there is one; nothing is answered then.
    const Admission& admission = counted_.hub().admission();
    response.set(http::field::server, "tofray");
    response.set(http::field::cache_control, "no-store");
    response.set("Content-Security-Policy", content_policy(admission.hosts, admission.embed));
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    response.set("Cross-Origin-Opener-Policy", "same-origin");
    response.set("Cross-Origin-Resource-Policy", "same-origin");
    if (!admission.embed) response.set("X-Frame-Options", "DENY");
    if (status == 405) response.set(http::field::allow, "GET, HEAD");
    if (status == 426) response.set(http::field::sec_websocket_version, "13"), response.set(http::field::upgrade, "websocket");
  }

  beast::tcp_stream stream_;
  Counted counted_;
  beast::flat_buffer buffer_{2 * most_head};
  std::optional<http::request_parser<http::empty_body>> parser_;
};

/// Waits until nothing more can come from standard input: whoever started the program has ended then, or closed it.
class EndOfInput {
 public:
  EndOfInput(net::io_context& io, std::function<void()> then) : input_(io), then_(std::move(then)) {}
  void wait() {
    error_code error;
    if (!input_.is_open()) input_.assign(::dup(STDIN_FILENO), error);
    if (error) return then_();  // a file, which has an end
    input_.async_read_some(net::buffer(some_), [this](error_code failed, std::size_t) {
      if (failed == net::error::operation_aborted) return;
      if (failed) return then_();
      wait();
    });
  }

 private:
  net::posix::stream_descriptor input_;
  std::function<void()> then_;
  char some_[256] = {};
};

/// Handles a signal, unless the shell told to ignore it, as nohup does.
void add_signal(net::signal_set& signals, int signal) {
  struct sigaction now {};
  if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) return;
  signals.add(signal);
}

void welcome(const std::shared_ptr<Hub>& hub, tcp::socket&& socket) {
  const bool full = hub->connections >= Hub::most_connections;
  const auto connection = std::make_shared<Connection>(std::move(socket), Counted(hub));
  if (full)
    connection->refuse_for_want_of_room();
  else
    connection->read();
}

}  // namespace

void serve(const ServerOptions& options, Session& session, const std::function<void(const Address&)>& told) {
  net::io_context io(1);
  const Listeners listeners = listening(io, {"the viewer", options.host, options.port, usual_ports});
  const int port = listeners.front()->port();
  Admission admission;
  std::vector<std::string> further = options.allowed_hosts;
  admission.hosts = hosts_of(port, further), admission.token = new_token(), admission.embed = options.embed;
  const std::string token = admission.token;
  const auto hub = std::make_shared<Hub>(io, session, options.rate, std::move(admission));
  for (const auto& one : listeners) one->accept([&hub](tcp::socket&& socket) { welcome(hub, std::move(socket)); });

  net::steady_timer last_moment(io);
  net::signal_set signals(io);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) add_signal(signals, signal);
  const auto end = [&] {
    session.stop();
    for (const auto& one : listeners) one->close();
    hub->close_all();
    // Pages have a moment to take their leave.
    last_moment.expires_after(std::chrono::milliseconds(300));
    last_moment.async_wait([&](error_code) { io.stop(); });
  };
  signals.async_wait([&](error_code error, int) {
    if (!error) end();
  });
  EndOfInput input(io, end);
  if (options.end_with_input) input.wait();

  session.start(*hub);
  const bool local = is_loopback(options.host);
  const std::string name =
      options.allowed_hosts.empty() || local ? fmt::format("127.0.0.1:{}", port) : hosts_of(port, {options.allowed_hosts.front()}).back();
  told({fmt::format("http://{}/#t={}", name, token), port, !local});
  run_sockets(io);
  session.stop();
  if (!session.ended(std::chrono::milliseconds(500))) std::_Exit(0);  // it reads a large file: nothing is lost
}

}  // namespace tofray::view
