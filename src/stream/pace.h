// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

/// Frames of cameras in real time: each is made ahead and sent when it is due.
namespace tofray::stream {

/// What tells the time and waits [s since the stream began]: the machine's, or a test's.
class Clock {
 public:
  virtual ~Clock() = default;
  virtual double now_s() = 0;
  /// Returns at that time, or before.
  virtual void wait_until(double time_s) = 0;
};

/// A camera, as its stream sees it. Frames are counted from 0 on.
class Eye {
 public:
  virtual ~Eye() = default;
  [[nodiscard]] virtual double due_s(std::uint64_t frame) const = 0;  ///< when a frame is to be sent
  /// Simulates a frame and makes its messages.
  virtual void make(std::uint64_t frame) = 0;
  /// Sends what was made last.
  virtual void send() = 0;
};

/// How much later than due frames were sent: counts of 0.1 ms up to one second, which take no memory with time.
class Lateness {
 public:
  void add(double late_s);
  /// The least time [s] that this share of the frames was sent within; 0 of none.
  [[nodiscard]] double quantile(double share) const;
  [[nodiscard]] double largest_s() const { return largest_s_; }

 private:
  static constexpr double step_s_ = 1e-4;
  std::array<std::uint64_t, 10001> counts_{};
  std::uint64_t all_ = 0;
  double largest_s_ = 0;
};

/// How the stream of a camera went.
struct Account {
  std::uint64_t sent = 0;
  std::uint64_t dropped = 0;  ///< frames that were never made, because their time had passed
  Lateness lateness;
};

/// Streams until each camera had so many frames (0: without end), sent or dropped, or until `stop` is set.
///
/// The frame that is due first is sent first; before that the next frames of all cameras are made, in the order in which they are due. A
/// frame whose successor is due already is dropped before it is made. What was made is sent, however late: a machine that is too slow for a
/// camera sends fewer frames, and its newest.
std::vector<Account> run(const std::vector<Eye*>& eyes, std::uint64_t frames, Clock& clock, const std::atomic<bool>& stop);

}  // namespace tofray::stream
