// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cpu/cpu.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <vector>

#include "backend/cpu/for_each_tile.h"
#include "tofray/error.h"

using namespace tofray;
using namespace tofray::backend;

namespace {

/// TOFRAY_ISA for the length of a test.
class Environment {
 public:
  explicit Environment(const char* value) {
    const char* now = std::getenv("TOFRAY_ISA");
    had_ = now != nullptr;
    if (had_) before_ = now;
    ::setenv("TOFRAY_ISA", value, 1);
  }
  ~Environment() { had_ ? ::setenv("TOFRAY_ISA", before_.c_str(), 1) : ::unsetenv("TOFRAY_ISA"); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  bool had_;
  std::string before_;
};

}  // namespace

TEST(choose_isa, takes_what_is_named) {
  for (const Isa isa : every_isa) {
    if (!can_run(isa)) {
      EXPECT_THROW((void)choose_isa(isa), Error) << isa_name(isa);
      continue;
    }
    EXPECT_EQ(choose_isa(isa), isa);
    const Environment named(isa_name(isa).c_str());
    EXPECT_EQ(choose_isa(Isa::best), isa);
    EXPECT_EQ(choose_isa(Isa::scalar), Isa::scalar) << "what the program asks for goes before the environment";
  }
}

TEST(choose_isa, best_is_the_widest_that_runs) {
  const Environment empty("");
  const Isa best = choose_isa(Isa::best);
  EXPECT_TRUE(can_run(best));
  EXPECT_EQ(best, can_run(Isa::avx512) ? Isa::avx512 : can_run(Isa::avx2) ? Isa::avx2 : can_run(Isa::neon) ? Isa::neon : Isa::scalar);
}

// What another kind of processor has is known by its name, and refused for that.
TEST(choose_isa, says_that_another_processor_s_set_is_not_this_one_s) {
#if defined(__aarch64__)
  const std::string other = "avx2";
#else
  const std::string other = "neon";
#endif
  const Environment named(other.c_str());
  try {
    (void)choose_isa(Isa::best);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::device);
    EXPECT_TRUE(std::string(error.what()).starts_with("error: this processor has no " + other + "\n")) << error.what();
  }
}

TEST(choose_isa, refuses_an_unknown_name) {
  const Environment wrong("avx1024");
  try {
    (void)choose_isa(Isa::best);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input);
    EXPECT_NE(std::string(error.what()).find("avx1024"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("avx512"), std::string::npos) << "says what is expected";
  }
}

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
