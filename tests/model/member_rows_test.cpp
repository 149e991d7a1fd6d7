// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/member_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "model/tables.h"

namespace {

using namespace tofray;
using model::MemberRow;

std::vector<MemberRow> rows_of(const std::string& record, const std::string& member) {
  std::vector<MemberRow> out;
  for (const MemberRow& row : model::member_rows().rows)
    if (row.record == record && row.member == member) out.push_back(row);
  return out;
}

TEST(member_rows, have_unit_and_range_of_the_number) {
  const std::vector<MemberRow> rows = rows_of("Pixel", "full_well_e");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].key, "full_well");
  EXPECT_EQ(rows[0].doc, "full-well capacity of a tap");
  ASSERT_EQ(rows[0].numbers.size(), 1U);
  EXPECT_EQ(rows[0].numbers[0].unit, "e");
  EXPECT_EQ(rows[0].numbers[0].low, 1);
  EXPECT_EQ(rows[0].numbers[0].high, 1e30);
}

TEST(member_rows, of_lists_say_what_an_element_may_be) {
  EXPECT_EQ(rows_of("Scatter", "sigma_px").at(0).numbers.at(0).unit, "px");
  EXPECT_EQ(rows_of("Triangle", "vertices").at(0).numbers.at(0).unit, "m");
  EXPECT_EQ(rows_of("RawFrame", "reference_phase_rad").at(0).numbers.at(0).unit, "rad");
  EXPECT_TRUE(rows_of("Mode", "sequence").at(0).numbers.empty());
}

TEST(member_rows, of_curves_have_positions_and_values) {
  const MemberRow efficiency = rows_of("Pixel", "quantum_efficiency").at(0);
  ASSERT_EQ(efficiency.numbers.size(), 2U);
  EXPECT_EQ(efficiency.numbers[0].name, "wavelength");
  EXPECT_EQ(efficiency.numbers[0].unit, "m");
  EXPECT_EQ(efficiency.numbers[1].high, 1);
  EXPECT_EQ(rows_of("Ambient", "table_wavelength_m").at(0).numbers.at(0).unit, "m");
  EXPECT_EQ(rows_of("Ambient", "table_irradiance_w_per_m3").at(0).numbers.at(0).unit, "W/m3");
}

TEST(member_rows, say_for_which_kinds_they_are) {
  const std::vector<MemberRow> rows = rows_of("Material", "diffuse");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].tag, "brdf");
  EXPECT_EQ(rows[0].kinds, (std::vector<int>{static_cast<int>(Material::Brdf::lambert), static_cast<int>(Material::Brdf::oren_nayar)}));
  EXPECT_EQ(rows_of("RawFrame", "modulation_frequency_hz").at(0).tag, "lit");
  EXPECT_EQ(rows_of("Pixel", "prnu").at(0).tag, "");
}

/// Each struct's rows and the members without one are as many as it has members.
TEST(member_rows, are_of_all_members_of_scene_and_camera) {
  const model::MemberRows all = model::member_rows();
  std::set<std::string> members(all.without_row.begin(), all.without_row.end()), records;
  for (const MemberRow& row : all.rows) members.insert(row.record + "::" + row.member), records.insert(row.record);
  const auto count = [&](const std::string& record) {
    return std::count_if(members.begin(), members.end(), [&](const std::string& one) { return one.starts_with(record + "::"); });
  };
  for (const char* record : {"Scene", "Camera", "Pixel", "Mode", "RawFrame", "Transport", "Pose", "Cone", "FrequencyCalibration"})
    EXPECT_TRUE(records.contains(record)) << record;
  EXPECT_EQ(count("Pixel"), model::table_of<Pixel>().member_count);
  EXPECT_EQ(count("Mesh"), model::tables_of_shapes().back()().member_count);
  EXPECT_EQ(count("Scene"), model::table_of<Scene>().member_count);
}

}  // namespace
