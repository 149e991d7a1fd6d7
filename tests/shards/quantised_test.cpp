// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Arrays of floats that a set stores as whole numbers.
#include "shards/quantised.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "files/npy.h"
#include "files/npz.h"
#include "shards/layout.h"
#include "shards/record.h"
#include "shards/shard_tar.h"
#include "small_set.h"
#include "support/samples.h"

namespace tofray::test {
namespace {

using dataset::Quantised;
using out_test::error_of;

const std::string length = "gt_z_m";

files::NpyView view_of(const std::vector<float>& values) { return files::npy_view(length, {1, values.size()}, values); }

std::vector<double> codes_of(const std::vector<float>& values, const Quantised& as) {
  const files::NpyArray array = files::parse_npy(shards::quantised_npy(view_of(values), as, "here"), "memory");
  EXPECT_EQ(array.type, as.type);
  std::vector<double> out;
  for (std::size_t i = 0; i < array.count(); ++i) out.push_back(array.number(i));
  return out;
}

constexpr float none = std::numeric_limits<float>::quiet_NaN();

TEST(quantised, are_the_nearest_whole_numbers_and_of_two_the_even_one) {
  EXPECT_EQ(codes_of({0, 0.25F, 0.75F, 1.25F, 0.3F, 127, none}, {length, {'u', 1}, 0.5}), (std::vector<double>{0, 0, 2, 2, 1, 254, 255}));
  EXPECT_EQ(codes_of({-0.25F, -0.75F, 63.5F, -63.5F, none}, {length, {'i', 1}, 0.5}), (std::vector<double>{0, -2, 127, -127, -128}));
  EXPECT_EQ(codes_of({6.5534F, none}, {length, {'u', 2}, 1e-4}), (std::vector<double>{65534, 65535}));
  EXPECT_EQ(codes_of({-3.2767F, none}, {length, {'i', 2}, 1e-4}), (std::vector<double>{-32767, -32768}));
}

TEST(quantised, that_a_type_has_no_code_for_are_refused_with_their_pixel) {
  const std::string said = error_of([] {
                             shards::quantised_npy(view_of({1, 2, 7.25F}), {length, {'u', 2}, 1e-4}, "set.yaml, sample 3");
                           }).what();
  EXPECT_EQ(said,
            "set.yaml, sample 3: error: gt_z_m is 7.25 m at pixel 2,0, and uint16 in steps of 0.0001 holds 0 to 6.5534\n"
            "  expected a larger step or another type below `as`, or none for this array");
  for (const float value : {127.5F, -0.5F, std::numeric_limits<float>::infinity()})
    EXPECT_THROW(shards::quantised_npy(view_of({value}), {length, {'u', 1}, 0.5}, "x"), Error) << value;
  for (const float value : {64.0F, -64.0F, -std::numeric_limits<float>::infinity()})
    EXPECT_THROW(shards::quantised_npy(view_of({value}), {length, {'i', 1}, 0.5}, "x"), Error) << value;
}

std::string member_of(const SmallSet& set, const std::string& name) {
  const std::optional<shards::Record> record = shards::read_record(set.out(), 0);
  shards::ShardTar tar(set.out() / shards::tar_name(0));
  for (const shards::Record::Member& one : record->samples.at(1).members)
    if (one.name == name) return tar.read(one);
  ADD_FAILURE() << name;
  return {};
}

TEST(quantised, in_shards_are_the_values_to_half_a_step) {
  SetText plain, coarse;
  coarse.more = "as: {gt_z_m: {type: uint16, step: 0.1 mm}, z_m: {type: int16, step: 1 mm}}\n";
  const SmallSet exact(plain), set(coarse);
  exact.run(), set.run();
  const files::Json about = files::parse_json(member_of(set, "json"), "json");
  const std::vector<std::pair<std::string, double>> steps = {{"gt_z_m", 1e-4}, {"z_m", 1e-3}};
  for (const auto& [name, step] : steps) {
    const files::NpyArray values = files::parse_npy(member_of(exact, name + ".npy"), name),
                          codes = files::parse_npy(member_of(set, name + ".npy"), name);
    const files::Json* const said = about.find("arrays")->find(name);
    double told = 0;
    ASSERT_TRUE(said != nullptr && said->find("step")->number(told));
    EXPECT_EQ(told, step);
    EXPECT_EQ(*said->find("dtype")->string(), codes.type.name());
    EXPECT_EQ(values.shape, codes.shape);
    for (std::size_t i = 0; i < values.count(); ++i) {
      const double value = values.number(i), back = shards::stored_number(codes, i, said);
      if (std::isnan(value))
        EXPECT_TRUE(std::isnan(back)) << name << " " << i;
      else
        EXPECT_LE(std::abs(back - value), 0.5 * step * (1 + 1e-9)) << name << " " << i;
    }
  }
  EXPECT_TRUE(member_of(exact, "raw.npy") == member_of(set, "raw.npy"));
  merge_shards(set.out());
  EXPECT_TRUE(has(content(set.out() / "card.md"), "| `gt_z_m` | uint16 in steps of 0.0001 |"));
  EXPECT_TRUE(has(content(set.out() / "plan.json"), "\"no_value\": 65535"));
  EXPECT_TRUE(verify_shards({set.out(), {}, 1, 1}).faults.empty());
}

TEST(quantised, beyond_their_range_end_the_plan) {
  SetText text;
  text.more = "as: {gt_z_m: {type: uint16, step: 10 um}}\n";
  const std::string said = error_of([&] { const SmallSet set(text); }).what();
  EXPECT_TRUE(has(said, "and uint16 in steps of 1e-05 holds 0 to 0.65534\n")) << said;
}

TEST(quantised, that_make_no_sense_are_refused_with_their_line) {
  const auto refused = [](const std::string& more) {
    SetText text;
    text.more = more;
    return std::string(error_of([&] { const SmallSet set(text); }).what());
  };
  struct Case {
    const char *more, *said;
  };
  for (const Case& one : {Case{"arrays: [raww]\n", "set.yaml:6:10: error: there is no array \"raww\"; did you mean \"raw\"?\n"},
                          Case{"as: {gt_zz: {type: uint16, step: 1 mm}}\n", "set.yaml:6:6: error: there is no array \"gt_zz\""},
                          Case{"as: {raw: {type: uint8, step: 1}}\n", "set.yaml:6:6: error: raw is stored as it is\n"},
                          Case{"as: {gt_normal: {type: int8, step: 0.01}}\n", "set.yaml:6:6: error: gt_normal is not stored\n"},
                          Case{"as: {gt_z_m: {type: uint16, step: 0.1}}\n",
                               "error: this is no step of gt_z_m\n  got \"0.1\", expected more than 0, as in step: 0.001 m"},
                          Case{"as: {gt_z_m: {type: uint16, step: 1 ns}}\n", "error: this is no step of gt_z_m\n"},
                          Case{"as: {gt_z_m: {type: uint16, step: 0 m}}\n", "error: this is no step of gt_z_m\n"},
                          Case{"as: {gt_z_m: {type: uint32, step: 1 mm}}\n", "uint32"}}) {
    const std::string said = refused(one.more);
    EXPECT_TRUE(has(said, one.said)) << one.more << said;
  }
  SetText good;
  good.more = "arrays: [raw, gt_normal]\nas: {gt_normal: {type: int8, step: 0.01}}\n";
  EXPECT_NO_THROW(const SmallSet set(good));
}

}  // namespace
}  // namespace tofray::test
