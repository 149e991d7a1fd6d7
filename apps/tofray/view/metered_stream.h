// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "view/beast.h"
#include "view/meter.h"

namespace tofray::view {

/// A TCP stream whose incoming bytes a FrameMeter sees; too much of anything is an error of reading.
class MeteredStream {
 public:
  using next_layer_type = beast::tcp_stream;
  using executor_type = next_layer_type::executor_type;

  explicit MeteredStream(beast::tcp_stream&& stream) : stream_(std::move(stream)) {}

  executor_type get_executor() noexcept { return stream_.get_executor(); }
  next_layer_type& next_layer() noexcept { return stream_; }
  [[nodiscard]] const next_layer_type& next_layer() const noexcept { return stream_; }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return net::async_initiate<Handler, void(error_code, std::size_t)>(
        [this](auto&& then, const Buffers& into) {
          stream_.async_read_some(into,
                                  [this, into, next = std::forward<decltype(then)>(then)](error_code error, std::size_t count) mutable {
                                    if (!error && !seen(into, count)) error = net::error::no_buffer_space;
                                    next(error, count);
                                  });
        },
        handler, buffers);
  }

  template <class Buffers, class Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    return stream_.async_write_some(buffers, std::forward<Handler>(handler));
  }

 private:
  template <class Buffers>
  bool seen(const Buffers& buffers, std::size_t count) {
    for (auto at = net::buffer_sequence_begin(buffers); at != net::buffer_sequence_end(buffers) && count > 0; ++at) {
      const net::const_buffer one = *at;
      const std::size_t part = one.size() < count ? one.size() : count;
      if (!meter_.take(one.data(), part, FrameMeter::Clock::now())) return false;
      count -= part;
    }
    return true;
  }

  beast::tcp_stream stream_;
  FrameMeter meter_;
};

// How Beast ends such a stream.
inline void teardown(beast::role_type role, MeteredStream& stream, error_code& error) {
  websocket::teardown(role, stream.next_layer().socket(), error);
}
template <class Handler>
void async_teardown(beast::role_type role, MeteredStream& stream, Handler&& handler) {
  websocket::async_teardown(role, stream.next_layer().socket(), std::forward<Handler>(handler));
}

}  // namespace tofray::view
