// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cpu/for_each_tile.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <vector>

using namespace tofray::backend;

// Every piece exactly once, each worker with scratch memory of its own, for more threads than cores and pieces as well.
TEST(for_each_tile, does_every_piece_once) {
  for (const int threads : {1, 2, 7, 64}) {
    TileRunner runner(threads, 1000);
    for (const int count : {0, 1, 3, 1000}) {
      std::vector<std::atomic<int>> done(static_cast<std::size_t>(count));
      std::atomic<int> clashes{0}, misaligned{0};
      runner.for_each_tile(count, [&](int index, void* scratch) {
        auto* word = static_cast<std::atomic<int>*>(scratch);
        misaligned += reinterpret_cast<std::uintptr_t>(scratch) % 64 != 0;
        word->store(index);
        for (int i = 0; i < 200; ++i) clashes += word->load() != index;
        ++done[static_cast<std::size_t>(index)];
      });
      for (const auto& d : done) ASSERT_EQ(d.load(), 1) << threads << " threads, " << count << " pieces";
      EXPECT_EQ(clashes.load(), 0);
      EXPECT_EQ(misaligned.load(), 0);
    }
  }
}

TEST(for_each_tile, lets_an_error_of_a_piece_surface) {
  for (const int threads : {1, 4}) {
    TileRunner runner(threads, 64);
    EXPECT_THROW(runner.for_each_tile(100,
                                      [](int index, void*) {
                                        if (index == 37) throw std::runtime_error("piece 37");
                                      }),
                 std::runtime_error);
    std::atomic<int> after{0};
    runner.for_each_tile(10, [&](int, void*) { ++after; });
    EXPECT_EQ(after.load(), 10) << "and goes on working";
  }
}
