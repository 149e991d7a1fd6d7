// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/fields_finite.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "gltf/gltf_files.h"
#include "load/fields.h"
#include "load/load.h"
#include "support/samples.h"
#include "support/sanitizers.h"
#include "yaml/tree.h"

namespace {

using namespace tofray;
using model::ValueForm;
using test::Field;
using yaml::Node;

void load(const std::string& kind, const std::string& text) {
  if (kind == "scene") {
    EXPECT_TRUE(test::finite(load::scene_from_text(text, "f.yaml"))) << text;
  } else {
    EXPECT_TRUE(test::finite(load::camera_from_text(text, "f.yaml", ""))) << text;
  }
}

bool takes_any_word(const ValueForm& form) {
  return form.kind == ValueForm::Kind::text ||
         std::any_of(form.forms.begin(), form.forms.end(), [](const ValueForm& one) { return one.kind == ValueForm::Kind::text; });
}

std::vector<std::string> wrong_values(const ValueForm& form) {
  if (takes_any_word(form)) return {"[zebra]", "{zebra: 1}", "null", "''", "[[a]]", "{value: [1]}"};
  if (form.kind == ValueForm::Kind::boolean) return {"[zebra]", "{zebra: 1}", "null", "yes", "'true'", "1"};
  return {"[zebra]", "{zebra: 1}", "null", "zebra crossing", "true", "3 parsec"};
}

/// Which of all cases are tried: under sanitizers a fifth, which six wrong types and twelve values do not share.
constexpr int each = test::with_sanitizers ? 5 : 1;

class every_field : public testing::TestWithParam<const char*> {
 protected:
  // The files that the tables' examples name lie in the working folder.
  void SetUp() override {
    out_test::write_file(folder_.path() / "chair.glb", gltf_test::animated_file().glb());
    out_test::write_file(folder_.path() / "poses.csv", "0 0 0 0 0 0 0 1\n1 0.1 0 0 0 0 0 1\n");
    std::filesystem::current_path(folder_.path());
  }
  void TearDown() override { std::filesystem::current_path(before_); }
  const model::FileForm& form() const { return std::string(GetParam()) == "scene" ? model::scene_form() : model::camera_form(); }

 private:
  out_test::TemporaryFolder folder_;
  std::filesystem::path before_ = std::filesystem::current_path();
};

TEST_P(every_field, documents_made_from_the_tables_load) {
  for (std::size_t v = 0; v < test::sample_variants; ++v) {
    const std::string text = yaml::flow_text(test::sample(form().root, v));
    EXPECT_NO_THROW(load(GetParam(), text)) << text;
  }
}

TEST_P(every_field, refuses_six_wrong_types_and_names_the_field) {
  int cases = 0;
  std::set<std::string> names;
  test::for_each_field(form(), [&](const Node& document, const Field& field) {
    names.insert(field.name);
    for (const auto& value : wrong_values(*field.form)) {
      if (++cases % each != 0) continue;
      const std::string text = test::with(document, field, value);
      try {
        load(GetParam(), text);
        ADD_FAILURE() << field.name << ": " << value << " passed in " << text;
      } catch (const Error& e) {
        const std::string what = e.what();
        EXPECT_EQ(e.kind(), ErrorKind::bad_input) << what;
        EXPECT_TRUE(what.starts_with("f.yaml:1:")) << what;
        EXPECT_NE(what.find(": error: "), std::string::npos) << what;
        EXPECT_NE(what.find("\n  "), std::string::npos) << "no second line: " << what;
        EXPECT_TRUE(what.find(field.name) != std::string::npos || what.find("zebra") != std::string::npos)
            << field.name << " <- " << value << ": " << what;
      }
    }
  });
  EXPECT_GE(cases, 500);
  EXPECT_GE(names.size(), GetParam() == std::string("scene") ? 30U : 70U);
}

TEST_P(every_field, takes_no_unknown_neighbour_and_suggests_the_key) {
  const Node document = test::sample(form().root, 0);
  int suggested = 0;
  for (const Field& field : test::fields(form(), document)) {
    Node changed = document;
    Node* parent = &changed;
    for (std::size_t i = 0; i + 1 < field.steps.size(); ++i) parent = &parent->items[field.steps[i]];
    if (parent->kind != Node::Kind::map || field.name.size() < 4 || parent->keys[field.steps.back()].text != field.name) continue;
    if (field.name == "paper" || field.name == "MODE_9_5FPS_2000") continue;  // free names
    std::string& key = parent->keys[field.steps.back()].text;
    std::swap(key[1], key[2]);
    if (key == field.name) continue;
    try {
      load(GetParam(), yaml::flow_text(changed));
      ADD_FAILURE() << key << " passed";
    } catch (const Error& e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("unknown key \"" + key + "\""), std::string::npos) << what;
      EXPECT_NE(what.find("did you mean \"" + field.name + "\"?"), std::string::npos) << what;
      ++suggested;
    }
  }
  EXPECT_GE(suggested, 10);
}

TEST_P(every_field, numbers_are_refused_or_stay_finite) {
  const std::vector<std::string> values = {
      ".nan", ".inf", "-1", "0", "1e308", "1e-308", "-0", "-1e308", "99999999999999999999", "9223372036854775808", "4294967296", "1e-400"};
  int cases = 0, refused = 0;
  test::for_each_field(form(), [&](const Node& document, const Field& field) {
    if (field.form->kind != ValueForm::Kind::number && field.form->kind != ValueForm::Kind::integer) return;
    const std::string unit = base::parse_quantity(field.form->example, field.form->dimension).unit;
    for (const auto& value : values) {
      if (++cases % each != 0) continue;
      try {
        load(GetParam(), test::with(document, field, value + (unit.empty() ? "" : " " + unit)));
      } catch (const Error& e) {
        ++refused;
        EXPECT_TRUE(e.kind() == ErrorKind::bad_input || e.kind() == ErrorKind::limit) << e.what();
      }
    }
  });
  EXPECT_GE(cases, 1000);
  EXPECT_GE(refused * 2, cases / each);  // not finite, or far out of what is physical
}

INSTANTIATE_TEST_SUITE_P(of, every_field, testing::Values("scene", "camera"), [](const auto& one) { return std::string(one.param); });

}  // namespace
