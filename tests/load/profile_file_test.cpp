// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/profile_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tofray/error.h"

using namespace tofray;

namespace {

const ProfileNumber* number_of(const ProfileFile& file, const std::string& key) {
  const auto found = std::find_if(file.numbers.begin(), file.numbers.end(), [&](const ProfileNumber& one) { return one.key == key; });
  return found == file.numbers.end() ? nullptr : &*found;
}

/// What stands in the text where a key's value begins.
std::string at(const ProfileFile& file, const std::string& key, std::size_t length) {
  const auto found = std::find_if(file.places.begin(), file.places.end(), [&](const ProfilePlace& one) { return one.key == key; });
  if (found == file.places.end()) return "nowhere";
  std::size_t start = 0;
  for (int line = 1; line < found->line; ++line) start = file.text.find('\n', start) + 1;
  return file.text.substr(start + static_cast<std::size_t>(found->column) - 1, length);
}

}  // namespace

TEST(profile_file, has_the_numbers_in_force_with_their_units_and_ranges) {
  const ProfileFile file = profile_file("o3d303", {.mode = "under5m_low", .set = {{"pixel.read_noise", "99 e"}}});
  EXPECT_EQ(file.source, "<o3d303>");
  const ProfileNumber* power = number_of(file, "illumination.0.power");
  ASSERT_NE(power, nullptr);
  EXPECT_EQ(power->unit, "W");
  EXPECT_DOUBLE_EQ(power->value, 1.65);
  EXPECT_DOUBLE_EQ(power->low, 0);
  EXPECT_DOUBLE_EQ(power->high, 1e4);
  EXPECT_TRUE(power->assumed);
  ASSERT_NE(number_of(file, "pixel.read_noise"), nullptr);
  EXPECT_DOUBLE_EQ(number_of(file, "pixel.read_noise")->value, 99) << "what is set counts";
  ASSERT_NE(number_of(file, "adc.bits"), nullptr);
  EXPECT_TRUE(number_of(file, "adc.bits")->whole);
  EXPECT_NE(number_of(file, "pixel.column_noise"), nullptr) << "numbers that the profile leaves at their defaults are there, too";
  EXPECT_NE(number_of(file, "modes.under5m_low.sequence.0.modulation_frequency"), nullptr);
  EXPECT_EQ(number_of(file, "modes.upto30m_low.sequence.0.modulation_frequency"), nullptr) << "of another mode";
  EXPECT_EQ(number_of(file, "illumination.0.position"), nullptr) << "no single number";
}

TEST(profile_file, says_where_values_are_written) {
  const ProfileFile file = profile_file("o3d303");
  EXPECT_EQ(at(file, "illumination.0.power", 14), "{value: 1.65 W");
  EXPECT_EQ(at(file, "pixel.full_well", 8), "400000 e");
  EXPECT_EQ(at(file, "illumination.0.waveform.correlation", 7), "[0.4600");
  EXPECT_EQ(at(file, "modes.upto30m_low.sequence.1.modulation_frequency", 6), "25 MHz");
  EXPECT_EQ(at(file, "pixel.column_noise", 1), "nowhere");
}

TEST(profile_file, refuses_what_load_camera_refuses) {
  EXPECT_THROW((void)profile_file("o3d304"), Error);
  EXPECT_THROW((void)profile_file("o3d303", {.mode = "near"}), Error);
}
