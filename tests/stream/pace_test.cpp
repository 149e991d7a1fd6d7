// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// When frames are made, sent and dropped, by a clock of the test's own.
#include "stream/pace.h"

#include <gtest/gtest.h>

#include <string>

namespace tofray::stream {
namespace {

struct StandingClock : Clock {
  double time_s = 0;
  double now_s() override { return time_s; }
  void wait_until(double to_s) override { time_s = std::max(time_s, to_s); }
};

/// A camera whose frames take so long to make.
struct SlowEye : Eye {
  StandingClock& clock;
  double period, first_due, takes_s;
  std::vector<std::uint64_t> made, sent;
  std::vector<double> sent_at;
  std::atomic<bool>* stop = nullptr;
  std::uint64_t stop_after = 0;

  SlowEye(StandingClock& with, double every_s, double first_s, double takes)
      : clock(with), period(every_s), first_due(first_s), takes_s(takes) {}
  [[nodiscard]] double due_s(std::uint64_t frame) const override { return first_due + period * static_cast<double>(frame); }
  void make(std::uint64_t frame) override { made.push_back(frame), clock.time_s += takes_s; }
  void send() override {
    sent.push_back(made.back()), sent_at.push_back(clock.time_s);
    if (stop != nullptr && sent.size() == stop_after) *stop = true;
  }
};

const std::atomic<bool> go_on{false};

TEST(pace, sends_each_frame_when_it_is_due) {
  StandingClock clock;
  SlowEye eye(clock, 0.25, 0.5, 0.125);
  const std::vector<Account> told = run({&eye}, 4, clock, go_on);
  EXPECT_EQ(eye.sent, (std::vector<std::uint64_t>{0, 1, 2, 3}));
  EXPECT_EQ(eye.sent_at, (std::vector<double>{0.5, 0.75, 1, 1.25}));
  EXPECT_EQ(told.at(0).sent, 4u);
  EXPECT_EQ(told.at(0).dropped, 0u);
  EXPECT_EQ(told.at(0).lateness.largest_s(), 0);
}

TEST(pace, drops_frames_whose_time_has_passed_and_counts_them) {
  StandingClock clock;
  SlowEye eye(clock, 1, 0, 2.5);  // takes two and a half periods
  const std::vector<Account> told = run({&eye}, 10, clock, go_on);
  // Made from 0 to 2.5; then frame 2 is the one whose successor (3) is not due yet, from 2.5 to 5; then 5, and 7; at 10 all is over.
  EXPECT_EQ(eye.sent, (std::vector<std::uint64_t>{0, 2, 5, 7}));
  EXPECT_EQ(eye.made, eye.sent);
  EXPECT_EQ(told.at(0).sent, 4u);
  EXPECT_EQ(told.at(0).dropped, 6u);
  EXPECT_EQ(told.at(0).lateness.largest_s(), 3);  // frame 2 at 5, frame 7 at 10
}

TEST(pace, makes_the_next_frames_of_all_cameras_before_it_waits) {
  StandingClock clock;
  SlowEye left(clock, 1, 1, 0.25), right(clock, 1, 1, 0.25);
  const std::vector<Account> told = run({&left, &right}, 3, clock, go_on);
  EXPECT_EQ(left.sent_at, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(right.sent_at, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(told.at(1).lateness.largest_s(), 0);
}

TEST(pace, lets_cameras_have_rates_of_their_own) {
  StandingClock clock;
  SlowEye fast(clock, 0.25, 0.25, 0.0625), slow(clock, 1, 1, 0.0625);
  std::atomic<bool> stop{false};
  slow.stop = &stop, slow.stop_after = 2;
  const std::vector<Account> told = run({&fast, &slow}, 0, clock, stop);
  EXPECT_EQ(told.at(1).sent, 2u);
  EXPECT_GE(told.at(0).sent, 7u);
  EXPECT_LE(told.at(0).sent, 8u);
  EXPECT_EQ(told.at(0).dropped + told.at(1).dropped, 0u);
}

TEST(pace, ends_when_it_is_told_to) {
  StandingClock clock;
  SlowEye eye(clock, 1, 0, 0.5);
  std::atomic<bool> stop{false};
  eye.stop = &stop, eye.stop_after = 3;
  EXPECT_EQ(run({&eye}, 0, clock, stop).at(0).sent, 3u);
}

TEST(pace, tells_by_when_which_share_of_the_frames_was_sent) {
  Lateness late;
  EXPECT_EQ(late.quantile(0.5), 0);
  for (int i = 0; i < 100; ++i) late.add(1e-3 * i + 5e-5);  // 0.05, 1.05 … 99.05 ms
  EXPECT_NEAR(late.quantile(0.5), 0.04905, 1.01e-4);        // steps of 0.1 ms
  EXPECT_NEAR(late.quantile(0.99), 0.09805, 1.01e-4);
  EXPECT_NEAR(late.quantile(1), 0.09905, 1e-9);
  late.add(-1);
  late.add(7);
  EXPECT_EQ(late.largest_s(), 7);
}

}  // namespace
}  // namespace tofray::stream
