// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "foxglove/reader.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "cli/console.h"
#include "tofray/error.h"
#include "view/http_request.h"

namespace tofray::foxglove {

namespace {

namespace beast = view::beast;
namespace http = view::http;
namespace net = view::net;
namespace websocket = view::websocket;

constexpr int most_connections = 64;
constexpr std::uint32_t most_head = 16384;
constexpr std::size_t most_message = 65536, most_waiting_bytes = 10'000'000, most_told = 20;
constexpr auto head_time = std::chrono::seconds(5), idle_time = std::chrono::seconds(30);

/// Whoever opens the page of a foreign origin sees no reason there: the stream's own terminal has it, once for each.
void tell_of(const std::string& origin, std::set<std::string>& told) {
  if (told.size() >= most_told || !told.insert(origin).second) return;
  app::say(fmt::format("warning: a page of {0} asked for the stream and was refused\n  --allow-origin {0} lets it in\n",
                       base::in_quotes(origin)));
}

std::string name_of(const Subscription& one) { return fmt::format("subscription {} to channel {}", one.id, one.channel); }

}  // namespace

Reader::Reader(view::tcp::socket&& socket, std::shared_ptr<Reception> reception)
    : socket_(view::beast::tcp_stream(std::move(socket))), reception_(std::move(reception)), board_(reception_->board) {
  ++reception_->connections;
}

Reader::~Reader() { --reception_->connections; }

void Reader::greet() {
  if (reception_->connections > most_connections) return refuse({503, "64 connections are open: close one"});
  parser_.emplace();
  parser_->header_limit(most_head);
  parser_->body_limit(0);
  beast::get_lowest_layer(socket_).expires_after(head_time);
  http::async_read_header(beast::get_lowest_layer(socket_), buffer_, *parser_,
                          [self = shared_from_this()](error_code error, std::size_t) { self->judge(error); });
}

void Reader::judge(error_code error) {
  if (error == http::error::header_limit) return refuse({431, "the headers are too long"});
  if (error && error.category() == make_error_code(http::error::bad_value).category() && error != http::error::end_of_stream)
    return refuse({400, "this is no request of HTTP/1.1"});
  if (error) return;  // gone, or too slow
  std::vector<view::Header> headers;
  const view::Request request = view::request_of(parser_->get(), headers);
  view::Verdict verdict = view::judged_reader(request, reception_->admission);
  if (verdict.status == 101 && buffer_.size() > 0) verdict = {400, "nothing is sent before the WebSocket is open"};
  if (verdict.status == 403) tell_of(std::string(view::header_of(request, "Origin")), reception_->refused_origins);
  if (verdict.status != 101) return refuse(verdict);
  protocol_ = view::chosen_protocol(request, protocols);
  accept();
}

void Reader::refuse(const view::Verdict& verdict) {
  auto answer = std::make_shared<http::response<http::string_body>>(static_cast<http::status>(verdict.status), 11);
  answer->set(http::field::server, "tofray");
  answer->set(http::field::content_type, "text/plain; charset=utf-8");
  if (verdict.status == 426) answer->set(http::field::sec_websocket_version, "13"), answer->set(http::field::upgrade, "websocket");
  answer->body() = std::string(verdict.why) + "\n";
  answer->keep_alive(false);
  answer->prepare_payload();
  beast::get_lowest_layer(socket_).expires_after(head_time);
  http::async_write(beast::get_lowest_layer(socket_), *answer, [self = shared_from_this(), answer](error_code, std::size_t) {
    error_code ignored;
    beast::get_lowest_layer(self->socket_).socket().shutdown(view::tcp::socket::shutdown_send, ignored);
  });
}

void Reader::accept() {
  beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has times of its own
  websocket::stream_base::timeout times{};
  times.handshake_timeout = head_time, times.idle_timeout = idle_time, times.keep_alive_pings = true;
  socket_.set_option(times);
  socket_.set_option(websocket::stream_base::decorator([this](websocket::response_type& answer) {
    answer.set(http::field::server, "tofray");
    answer.set(http::field::sec_websocket_protocol, protocol_);
  }));
  socket_.read_message_max(most_message);
  socket_.auto_fragment(false);
  auto request = std::make_shared<http::request<http::empty_body>>(parser_->release());
  socket_.async_accept(*request, [self = shared_from_this(), request](error_code error) {
    if (error) return;
    self->join();
    self->read();
  });
}

void Reader::join() {
  const std::scoped_lock lock(board_.mutex);
  board_.readers.insert(shared_from_this());
  tell(server_info(board_.session));
  tell(advertisement(board_.channels));
  if (board_.time_ns >= 0) tell_time(board_.time_ns);
}

/// The last handler that holds it lets it go.
void Reader::leave() {
  const std::scoped_lock lock(board_.mutex);
  subscribed_.clear(), waiting_.clear();
  waiting_bytes_ = 0, writing_ = false;
  board_.readers.erase(shared_from_this());
  board_.changed.notify_all();
}

void Reader::close() {
  if (std::exchange(closing_, true)) return;
  socket_.async_close({websocket::close_code::going_away, "the stream has ended"},
                      [self = shared_from_this()](error_code) { self->leave(); });
}

void Reader::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->leave();
    const std::string text(static_cast<const char*>(self->buffer_.data().data()), self->buffer_.size());
    self->buffer_.consume(self->buffer_.size());
    self->took(self->socket_.got_text() ? text : R"({"op":"publish"})");
    self->read();
  });
}

void Reader::took(const std::string& text) {
  const std::scoped_lock lock(board_.mutex);
  try {
    const Asked asked = asked_by(text);
    if (const auto* wanted = std::get_if<Subscribe>(&asked)) subscribe(wanted->subscriptions);
    if (const auto* ended = std::get_if<Unsubscribe>(&asked)) unsubscribe(ended->subscriptions);
    if (const auto* other = std::get_if<Other>(&asked))
      tell(status(Level::warning, fmt::format("tofray streams, and does not know {}", base::in_quotes(other->op))));
  } catch (const Error& error) {
    tell(status(Level::error, error.what()));
  }
}

void Reader::subscribe(const std::vector<Subscription>& wanted) {
  for (const Subscription& one : wanted) add(one);
}

void Reader::add(const Subscription& wanted) {
  if (wanted.channel == 0 || wanted.channel > board_.channels.size())
    return tell(status(Level::error, name_of(wanted) + ": there is no such channel"));
  const bool used = std::any_of(subscribed_.begin(), subscribed_.end(), [&](const auto& one) { return one.second == wanted.id; });
  if (used || subscribed_.contains(wanted.channel))
    return tell(status(Level::warning, name_of(wanted) + ": the number is in use, or the channel is subscribed to already"));
  subscribed_[wanted.channel] = wanted.id;
  for (const Kept& one : board_.kept[wanted.channel - 1]) give(wanted.channel, one);
}

void Reader::unsubscribe(const std::vector<std::uint32_t>& ended) {
  for (const std::uint32_t id : ended)
    if (std::erase_if(subscribed_, [id](const auto& one) { return one.second == id; }) == 0)
      tell(status(Level::warning, fmt::format("there is no subscription {}", id)));
}

void Reader::tell(std::string text) { put({true, std::move(text), nullptr}); }

void Reader::tell_time(std::int64_t time_ns) { put({false, time_message(time_ns), nullptr}); }

bool Reader::give(std::uint32_t channel, const Kept& message) {
  const auto found = subscribed_.find(channel);
  if (found == subscribed_.end()) return true;
  const auto head = data_head(found->second, message.time_ns);
  return put({false, {head.data(), head.size()}, message.cdr});
}

/// @return false where so much waits already that this is left out
bool Reader::put(Item item) {
  if (waiting_bytes_ > most_waiting_bytes) return false;
  waiting_bytes_ += item.size();
  waiting_.push_back(std::move(item));
  if (!std::exchange(writing_, true)) net::post(socket_.get_executor(), [self = shared_from_this()] { self->pump(); });
  return true;
}

void Reader::pump() {
  {
    const std::scoped_lock lock(board_.mutex);
    waiting_bytes_ -= std::min(waiting_bytes_, item_.size());
    item_ = {};
    if (waiting_.empty() || closing_) {
      writing_ = false;
      board_.changed.notify_all();
      return;
    }
    item_ = std::move(waiting_.front());
    waiting_.pop_front();
  }
  socket_.text(item_.text);
  const std::array<net::const_buffer, 2> bytes = {net::buffer(item_.head), item_.body ? net::buffer(*item_.body) : net::const_buffer()};
  socket_.async_write(bytes, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->leave();
    self->pump();
  });
}

}  // namespace tofray::foxglove
