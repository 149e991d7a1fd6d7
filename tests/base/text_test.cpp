// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/text.h"

#include <gtest/gtest.h>

#include "base/faults.h"
#include "base/limits.h"

namespace {

using namespace tofray;
using namespace tofray::base;

TEST(did_you_mean, finds_typos_swaps_case_and_words_cut_short) {
  const std::vector<std::string> known = {"integration_time", "modulation_frequency", "mode", "pose", "lens"};
  EXPECT_EQ(nearest("itegration_time", known), "integration_time");
  EXPECT_EQ(nearest("integartion_time", known), "integration_time");
  EXPECT_EQ(nearest("Integration-Time", known), "integration_time");
  EXPECT_EQ(nearest("modulation", known), "modulation_frequency");
  EXPECT_EQ(nearest("moed", known), "mode");
  EXPECT_EQ(nearest("zebra", known), "");
  EXPECT_EQ(nearest("", known), "");
  EXPECT_EQ(nearest("x", {}), "");
  EXPECT_EQ(did_you_mean("lans", known), "; did you mean \"lens\"?");
}

TEST(edit_distance, counts_inserts_deletes_replacements_and_swaps) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
  EXPECT_EQ(edit_distance("same", "same"), 0);
}

TEST(printable, shows_what_steers_a_terminal_and_what_is_no_utf8) {
  EXPECT_EQ(printable("m\xC2\xB2 \xE2\x82\xAC \xF0\x9F\x98\x80"), "m\xC2\xB2 \xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(printable("\x1b\x7f\t"), "\\x1b\\u007f\\x09");
  EXPECT_EQ(printable("\xff\xC3(\xE2\x82"), "\\xff\\xc3(\\xe2\\x82");
  EXPECT_EQ(printable("\xC0\x80\xED\xA0\x80"), "\\xc0\\x80\\xed\\xa0\\x80") << "overlong forms and surrogates are no characters";
  EXPECT_EQ(printable("\xC2\x80\xE2\x80\xAE\xE2\x80\xA8\xE2\x81\xA6"), "\\u0080\\u202e\\u2028\\u2066");
  EXPECT_EQ(printable(printable("\x1b\xff")), printable("\x1b\xff"));
  EXPECT_EQ(printable_lines("a\n\tb\r\n"), "a\n\tb\\x0d\n");
}

TEST(message, cuts_the_middle_of_a_long_line_and_the_end_of_a_long_text) {
  const auto line = static_cast<std::size_t>(limit::message_line_bytes.value), all = static_cast<std::size_t>(limit::message_bytes.value);
  EXPECT_EQ(message(std::string(line, 'a') + "\nb"), std::string(line, 'a') + "\nb");
  const std::string cut = message("begin" + std::string(line, 'a') + "end\nb");
  EXPECT_TRUE(cut.starts_with("begin") && cut.ends_with("end\nb")) << cut;
  EXPECT_LE(cut.size(), line + 2);
  std::string lines;
  while (lines.size() < 2 * all) lines += "a line\n";
  EXPECT_LE(message(lines).size(), all);
  EXPECT_TRUE(message(lines).ends_with("a line\n…"));
  EXPECT_EQ(std::string(Error(ErrorKind::io, "a\x1b\nb").what()), "a\\x1b\nb");
}

TEST(faults, end_the_reading_where_there_are_too_many) {
  Faults faults;
  for (int i = 1; i < limit::faults_counted.value; ++i) faults.add({nullptr, i, 1}, "x");
  EXPECT_THROW(faults.add({nullptr, 1, 1}, "y"), Error);
  EXPECT_TRUE(faults.text().ends_with("\nand 150 more; it was not read to its end"));
}

TEST(did_you_mean, gives_up_on_long_lists_of_long_names) {
  std::vector<std::string> known(10'000, std::string(90, 'a'));
  known.emplace_back(std::string(90, 'b') + "c");
  EXPECT_EQ(nearest(std::string(91, 'b'), known), "");
  known.insert(known.begin(), known.back());
  EXPECT_EQ(nearest(std::string(91, 'b'), known), known.front());
}

TEST(in_quotes, shows_control_characters_and_cuts_at_a_character) {
  EXPECT_EQ(in_quotes("a\x1b[31m\n"), "\"a\\x1b[31m\\x0a\"");
  EXPECT_EQ(in_quotes("\xC2\x9B"), "\"\\u009b\"");
  EXPECT_EQ(in_quotes("abcä", 4), "\"abc…\"");
}

TEST(number_text, is_short_and_reads_back) {
  EXPECT_EQ(number_text(0.0001), "0.0001");
  EXPECT_EQ(number_text(10000000), "10000000");
  EXPECT_EQ(number_text(1e30), "1e+30");
  EXPECT_EQ(number_text(0.1), "0.1");
}

TEST(faults, stand_in_the_order_of_the_file_each_once) {
  const auto source = std::make_shared<const std::string>("a.yaml");
  Faults faults;
  faults.add({source, 9, 1}, "third");
  faults.add({source, 2, 7}, "second", "got this\nmend that");
  faults.add({source, 2, 3}, "first");
  faults.add({source, 9, 1}, "third");
  EXPECT_EQ(faults.text(), "a.yaml:2:3: error: first\na.yaml:2:7: error: second\n  got this\n  mend that\na.yaml:9:1: error: third");
}

TEST(faults, show_control_characters_of_names) {
  Faults faults;
  faults.add(whole(std::string("--set a\0b", 9)), "no \x1b[31m", "got\r\nthat");
  EXPECT_EQ(faults.text(), "--set a\\x00b: error: no \\x1b[31m\n  got\\x0d\n  that");
}

TEST(faults, beyond_the_limit_are_counted) {
  Faults faults;
  for (int i = 1; i <= 53; ++i) faults.add({nullptr, i, 1}, "x");
  EXPECT_TRUE(faults.text().ends_with("\nand 3 more"));
  EXPECT_THROW(faults.raise(), Error);
}

TEST(faults, are_of_kind_limit_only_if_all_are) {
  Faults faults;
  faults.add({nullptr, 1, 1}, "x", {}, ErrorKind::limit);
  try {
    faults.raise();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::limit);
  }
  faults.add({nullptr, 2, 1}, "y");
  try {
    faults.raise();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::bad_input);
  }
}

}  // namespace
