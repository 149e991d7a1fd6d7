// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/shared.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/content.h"
#include "base/parallel.h"

using namespace tofray::base;

namespace {

using Strings = Shared<int, std::string>;

/// Asks for a number's text, of so many bytes by its own account.
std::shared_ptr<const std::string> text(Strings& all, int number, int& made, std::size_t bytes = 100) {
  return all.get(
      number, [&] { return ++made, std::to_string(number); }, [bytes](const std::string&) { return bytes; });
}

}  // namespace

TEST(shared_results, are_made_once_as_long_as_somebody_has_them) {
  forget_kept();
  Strings all;
  int made = 0;
  const auto one = text(all, 7, made), same = text(all, 7, made), other = text(all, 8, made);
  EXPECT_EQ(*one, "7");
  EXPECT_EQ(one, same);
  EXPECT_EQ(*other, "8");
  EXPECT_EQ(made, 2);
  forget_kept();
  EXPECT_EQ(text(all, 7, made), one);
  EXPECT_EQ(made, 2);
}

TEST(shared_results, are_kept_for_the_next_who_asks_until_others_take_their_room) {
  forget_kept();
  Strings all;
  int made = 0;
  text(all, 0, made, kept_bytes / 4);
  text(all, 0, made, kept_bytes / 4);
  EXPECT_EQ(made, 1) << "nobody had it in between";
  for (int i = 1; i < 5; ++i) text(all, i, made, kept_bytes / 4);
  EXPECT_EQ(made, 5);
  text(all, 2, made, kept_bytes / 4);  // now the last used one
  EXPECT_EQ(made, 5);
  text(all, 0, made, kept_bytes / 4);
  EXPECT_EQ(made, 6) << "it was the oldest of five, and there is room for four";
  text(all, 2, made, kept_bytes / 4);
  EXPECT_EQ(made, 6) << "the oldest is 1 by now";
  forget_kept();
  text(all, 2, made);
  EXPECT_EQ(made, 7);
}

TEST(shared_results, larger_than_all_room_go_with_their_last_user_and_displace_none) {
  forget_kept();
  Strings all;
  int made = 0;
  text(all, 1, made);
  text(all, 2, made, kept_bytes + 1);
  text(all, 2, made, kept_bytes + 1);
  EXPECT_EQ(made, 3);
  text(all, 1, made);
  EXPECT_EQ(made, 3);
  forget_kept();
}

TEST(shared_results, that_cannot_be_made_are_tried_again) {
  Strings all;
  const auto fails = [&] {
    return all.get(
        1, []() -> std::string { throw std::runtime_error("no"); }, [](const auto&) { return 1U; });
  };
  EXPECT_THROW(fails(), std::runtime_error);
  int made = 0;
  EXPECT_EQ(*text(all, 1, made), "1");
}

TEST(shared_results, are_the_same_for_threads_that_ask_at_once) {
  forget_kept();
  Strings all;
  std::array<std::shared_ptr<const std::string>, 8> got;
  std::atomic<int> made = 0;
  in_parallel(static_cast<int>(got.size()), 8, [&](int i) {
    got[static_cast<std::size_t>(i)] = all.get(
        3, [&] { return ++made, std::string("three"); }, [](const std::string&) { return 100U; });
  });
  for (const auto& one : got) EXPECT_EQ(one, got[0]);
  EXPECT_GE(made, 1);
}

TEST(in_parallel, calls_each_unit_once_whatever_the_threads) {
  for (const int threads : {0, 1, 2, 7, 100}) {
    for (const int count : {0, 1, 5, 1000}) {
      std::vector<std::atomic<int>> calls(static_cast<std::size_t>(count));
      in_parallel(count, threads, [&](int i) { ++calls[static_cast<std::size_t>(i)]; });
      for (const auto& one : calls) ASSERT_EQ(one, 1) << threads << " threads, " << count << " units";
    }
  }
  std::vector<std::thread::id> one_thread;
  in_parallel(3, 1, [&](int) { one_thread.push_back(std::this_thread::get_id()); });
  EXPECT_EQ(one_thread, std::vector(3, std::this_thread::get_id()));
}

TEST(in_parallel, throws_what_a_unit_throws_when_all_have_ended) {
  for (const int threads : {1, 2, 7}) {
    std::atomic<int> inside = 0, begun = 0;
    const auto unit = [&](int i) {
      ++begun, ++inside;
      if (i == 40) --inside, throw std::bad_alloc();
      --inside;
    };
    EXPECT_THROW(in_parallel(100'000, threads, unit), std::bad_alloc) << threads << " threads";
    EXPECT_EQ(inside, 0);
    if (threads == 1) {
      EXPECT_EQ(begun, 41);
    }
  }
}

TEST(contents, differ_where_a_bit_a_length_or_a_place_differs) {
  const auto of = [](const std::vector<float>& a, const std::vector<float>& b) {
    Content out;
    out.add(a), out.add(b);
    return out;
  };
  std::vector<Content> seen = {of({}, {}),      of({0}, {}),    of({}, {0}),    of({0, 0}, {}), of({0}, {0}),
                               of({-0.0F}, {}), of({1, 2}, {}), of({2, 1}, {}), of({1}, {2})};
  std::vector<float> many(1000, 1);
  seen.push_back(of(many, {}));
  for (std::size_t i = 0; i < many.size(); i += 37) {
    auto changed = many;
    changed[i] = std::nextafter(1.0F, 2.0F);
    seen.push_back(of(changed, {}));
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(seen[i] == seen[j]) << i << " and " << j;
  EXPECT_TRUE(of(many, {1}) == of(many, {1}));
}
