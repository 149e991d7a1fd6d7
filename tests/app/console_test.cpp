// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numeric>

#include "bench/bench.h"
#include "cli/progress.h"

namespace tofray::app {
namespace {

TEST(progress, fits_every_terminal) {
  for (const std::uint64_t total : {1ULL, 2ULL, 2000ULL, 1'000'000'000ULL}) {
    for (const double done : {0.004, 1.0, 2.0, 1999.0}) {
      if (done > static_cast<double>(total)) continue;
      for (int columns = 1; columns <= 300; ++columns) {
        const std::string line = progress_line(done, total, "frames", 3700.4, columns);
        EXPECT_LT(static_cast<int>(line.size()), columns) << line;
      }
    }
  }
}

TEST(progress, leaves_out_the_bar_first_then_rate_time_and_words) {
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 80), "[############............] 50/100 frames  5/s  10 s left");
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 39), "[###...] 50/100 frames  5/s  10 s left");
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 38), "50/100 frames  5/s  10 s left");
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 26), "50/100 frames  10 s left");
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 14), "50/100 frames");
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 7), "50/100");
  EXPECT_EQ(progress_line(50, 100, "frames", 10, 6), "");
}

TEST(progress, knows_of_the_part_of_a_step) {
  EXPECT_EQ(progress_line(1.5, 3, "frames", 30, 80), "[############............] 1/3 frames  0.05/s  30 s left");
  EXPECT_EQ(progress_line(0.25, 1, "frames", 30, 80), "[######..................] 25 %  1 min 30 s left");
  EXPECT_EQ(progress_line(0.999, 1, "frames", 30, 0), "99 %  0 s left");
  EXPECT_EQ(progress_line(0.25, 1, "frames", 30, 5), "25 %");
}

TEST(bench, stages_take_no_negative_time_and_add_up) {
  // The run to the end of power was by chance faster than the one to the end of trace.
  const std::vector<double> spent = stage_times({2, 1.5, 6, 7});
  EXPECT_EQ(spent, (std::vector<double>{2, 0, 4, 1}));
  EXPECT_EQ(std::accumulate(spent.begin(), spent.end(), 0.0), 7);
}

}  // namespace
}  // namespace tofray::app
