// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/client.h"

#include <algorithm>
#include <cmath>

namespace tofray::view {

namespace {

constexpr std::size_t most_message = 65536;
constexpr auto handshake_time = std::chrono::seconds(5), idle_time = std::chrono::seconds(30);

}  // namespace

Client::Client(beast::tcp_stream&& stream, Counted counted)
    : socket_(std::move(stream)),
      counted_(std::move(counted)),
      hub_(counted_.hub()),
      later_(socket_.get_executor()),
      rate_(hub_.usual_rate()) {
  beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has times of its own
  websocket::stream_base::timeout times{};
  times.handshake_timeout = handshake_time, times.idle_timeout = idle_time, times.keep_alive_pings = true;
  socket_.set_option(times);
  socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& answer) {
    answer.set(http::field::server, "tofray");
    answer.set(http::field::sec_websocket_protocol, "tofray.v1");
  }));
  socket_.read_message_max(most_message);
  socket_.auto_fragment(false);
  socket_.write_buffer_bytes(65536);
}

Client::~Client() {
  if (number_ != 0) hub_.leave(number_);
}

void Client::accept(http::request<http::empty_body> request) {
  auto kept = std::make_shared<http::request<http::empty_body>>(std::move(request));
  socket_.async_accept(*kept, [self = shared_from_this(), kept](error_code error) {
    if (error) return;
    self->number_ = self->hub_.join(*self);
    self->read();
  });
}

void Client::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error || self->closing_) return;  // the last one to hold it goes
    if (!self->socket_.got_text()) return self->close(websocket::close_code::unknown_data);
    const std::string text(static_cast<const char*>(self->buffer_.data().data()), self->buffer_.size());
    self->buffer_.consume(self->buffer_.size());
    self->hub_.took(*self, text);
    self->read();
  });
}

void Client::greet(std::string hello) {
  tell(std::make_shared<const std::string>(std::move(hello)));
  greeted_ = true;
  hub_.wanted(true);
}

/// Texts are never dropped: who does not take them is let go.
void Client::tell(std::shared_ptr<const std::string> text) {
  if (closing_) return;
  waiting_bytes_ += text->size();
  told_.push_back({std::move(text), {}});
  if (waiting_bytes_ > most_waiting_bytes) return close(websocket::close_code::policy_error);
  pump();
}

void Client::give(std::shared_ptr<const std::string> text, std::shared_ptr<const std::string> arrays, std::uint8_t kind) {
  if (closing_) return;
  std::erase_if(told_, [&](const Told& one) { return one.kind == kind; });
  tell(std::move(text));
  if (closing_) return;
  told_.push_back({std::move(arrays), kind});
  pump();
}

void Client::offer(const std::shared_ptr<const Published>& frame) {
  if (!looks()) return;
  Channel& channel = channels_[static_cast<std::size_t>(frame->side)];
  if (channel.pending) ++dropped_;
  channel.pending = frame, channel.offered = ++offered_;
  pump();
}

void Client::drop_pending() {
  for (Channel& one : channels_) one.pending.reset();
}

void Client::forget_other() { channels_[1] = Channel(); }

void Client::want(Want want) {
  const bool again = want.arrays != arrays_;
  arrays_ = std::move(want.arrays);
  if (want.rate) rate_ = *want.rate;
  if (again) drop_pending();
  for (Channel& one : channels_) one.next = {};
  hub_.wanted(again);
}

void Client::show(bool visible) {
  const bool again = visible && !visible_;
  visible_ = visible;
  if (!visible) drop_pending();
  hub_.wanted(again);
}

void Client::acknowledge(const Acknowledge& drawn) {
  auto& waiting = channels_[static_cast<std::size_t>(drawn.side)].unacknowledged;
  while (!waiting.empty() && waiting.front() <= drawn.sequence) waiting.pop_front();
  pump();
  hub_.wanted(false);
}

/// Sends what may be sent: what is told first, then the newest frames, if not more than two wait to be drawn and their time has come; of the two sides'
/// frames the one that was offered first, so that none comes behind a later one of the other side.
void Client::pump() {
  if (writing_ || closing_ || number_ == 0) return;
  if (!told_.empty()) {
    Told next = std::move(told_.front());
    told_.pop_front();
    return write(std::move(next.bytes), !next.kind);
  }
  Channel* first = &channels_[0];
  Channel* second = &channels_[1];
  if (second->pending && second->offered < first->offered) std::swap(first, second);
  if (!pump(*first) && !first->pending) pump(*second);
}

bool Client::pump(Channel& channel) {
  if (!channel.pending || !looks() || channel.unacknowledged.size() >= most_unacknowledged) return false;
  const Clock::time_point now = Clock::now();
  const double rate = hz();
  // A frame that comes a little early is of a clock that ticks as fast.
  const auto period = std::isfinite(rate) && rate > 0 ? std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate))
                                                      : Clock::duration::zero();
  if (!channel.pending->at_once && now + period / 10 < channel.next) {
    later_.expires_at(channel.next - period / 10);
    later_.async_wait([weak = weak_from_this()](error_code error) {
      if (const auto self = weak.lock(); self && !error) self->pump();
    });
    return false;
  }
  const auto frame = std::exchange(channel.pending, nullptr);
  bool sends = false;
  for (const auto& [arrays, bytes] : frame->messages) {
    if (arrays != arrays_) continue;
    channel.next = std::max(channel.next + period, now), channel.unacknowledged.push_back(frame->sequence), ++sent_;
    channel.seen = {frame->generation, frame->frame};
    write(bytes, false);
    sends = true;
    break;
  }
  hub_.wanted(false);
  return sends;
}

void Client::write(std::shared_ptr<const std::string> bytes, bool text) {
  writing_ = true;
  socket_.text(text);
  const net::const_buffer buffer(bytes->data(), bytes->size());
  socket_.async_write(buffer, [self = shared_from_this(), bytes, text](error_code error, std::size_t) {
    self->writing_ = false;
    if (text) self->waiting_bytes_ -= bytes->size();
    if (error) return;
    self->pump();
  });
}

void Client::close(websocket::close_code code) {
  if (std::exchange(closing_, true)) return;
  told_.clear(), drop_pending(), later_.cancel();
  socket_.async_close(code, [self = shared_from_this()](error_code) {});
  hub_.wanted(false);
}

}  // namespace tofray::view
