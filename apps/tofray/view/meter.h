// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

/// Counts the frames of a WebSocket as they come in, by their heads alone: a message in endless pieces, even empty ones, and a flood of pings are no message that a
/// size could limit.
namespace tofray::view {

class FrameMeter {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr int most_pieces = 64;  ///< of one message
  static constexpr int most_frames_per_second =
      20'000;  ///< of all kinds; small frames are drawn and acknowledged thousands of times a second

  /// Takes the next bytes of the stream. @return false once there is too much of anything
  bool take(const void* bytes, std::size_t count, Clock::time_point now) {
    const auto* at = static_cast<const std::uint8_t*>(bytes);
    while (count > 0) {
      if (payload_ > 0) {
        const std::size_t part = payload_ < count ? static_cast<std::size_t>(payload_) : count;
        payload_ -= part, at += part, count -= part;
        continue;
      }
      head_[have_++] = *at++, --count;
      if (have_ == needed() && !headed(now)) return false;
    }
    return true;
  }

 private:
  /// Bytes of the head, as far as it is known.
  [[nodiscard]] std::size_t needed() const {
    if (have_ < 2) return 2;
    const unsigned length = head_[1] & 127u;
    return 2u + (length == 126 ? 2u : length == 127 ? 8u : 0u) + ((head_[1] & 128u) != 0 ? 4u : 0u);
  }

  bool headed(Clock::time_point now) {
    const unsigned length = head_[1] & 127u;
    payload_ = length < 126 ? length : 0;
    for (std::size_t i = 0; i < (length == 126 ? 2u : length == 127 ? 8u : 0u); ++i) payload_ = payload_ << 8 | head_[2 + i];
    have_ = 0;
    if ((head_[0] & 8u) == 0) pieces_ = (head_[0] & 128u) != 0 ? 0 : pieces_ + 1;
    if (now - second_ >= std::chrono::seconds(1)) second_ = now, frames_ = 0;
    return ++frames_ <= most_frames_per_second && pieces_ < most_pieces;
  }

  std::array<std::uint8_t, 14> head_{};
  std::size_t have_ = 0;
  std::uint64_t payload_ = 0;
  int pieces_ = 0, frames_ = 0;
  Clock::time_point second_{};
};

}  // namespace tofray::view
