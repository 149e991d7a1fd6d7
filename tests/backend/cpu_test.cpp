// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cpu/cpu.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

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
