// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "load/builtin.h"
#include "load/fields.h"
#include "load/load.h"
#include "support/json_schema.h"
#include "yaml/tree.h"

namespace {

using namespace tofray;
using test::Documents;
using test::verdicts;
using yaml::Node;

class schema : public testing::TestWithParam<const char*> {
 protected:
  const model::FileForm& form() const { return std::string(GetParam()) == "scene" ? model::scene_form() : model::camera_form(); }
};

TEST_P(schema, accepts_all_that_the_reader_accepts) {
  Documents documents;
  for (const auto& builtin : std::string(GetParam()) == "scene" ? load::builtin_scenes() : load::builtin_profiles())
    documents.add(builtin.name, yaml::parse_tree(builtin.text, builtin.name));
  for (std::size_t v = 0; v < test::sample_variants; ++v) documents.add("sample " + std::to_string(v), test::sample(form().root, v));
  const auto lines = verdicts(load::schema_json(GetParam()), documents);
  NEEDS_VERDICTS(lines);
  EXPECT_EQ(lines.size(), documents.list.size());
  for (const auto& line : lines) EXPECT_TRUE(line.starts_with("accepted ")) << line;
}

TEST_P(schema, refuses_wrong_types_of_every_field) {
  Documents documents;
  test::for_each_field(form(), [&](const Node& document, const test::Field& field) {
    for (const char* wrong : {"[[[]]]", "{zebra: 1}", "null"}) {
      Node changed = document;
      Node* here = &changed;
      for (const std::size_t step : field.steps) here = &here->items[step];
      *here = test::scalar(wrong);
      documents.add(field.name + " " + wrong, changed);
    }
  });
  const auto lines = verdicts(load::schema_json(GetParam()), documents);
  NEEDS_VERDICTS(lines);
  EXPECT_EQ(lines.size(), documents.list.size());
  EXPECT_GE(lines.size(), 100U);
  for (const auto& line : lines) EXPECT_TRUE(line.starts_with("refused ")) << line;
}

TEST(schema_of, another_kind_is_an_error_with_a_suggestion) {
  try {
    load::schema_json("scnee");
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean \"scene\"?"), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(of, schema, testing::Values("scene", "camera"), [](const auto& one) { return std::string(one.param); });

}  // namespace
