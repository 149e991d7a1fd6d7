// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "load/builtin.h"
#include "load/fields.h"
#include "load/load.h"
#include "yaml/tree.h"

namespace {

using namespace tofray;
using yaml::Node;

// A tree as the JSON that an editor's YAML reader makes of it.
std::string json(const Node& node) {
  if (node.kind == Node::Kind::null) return "null";
  if (node.kind == Node::Kind::scalar) {
    const std::size_t start = node.text.find_first_not_of("-");
    const bool digits =
        start != std::string::npos && start <= 1 && node.text.find_first_not_of("0123456789.", start) == std::string::npos &&
        std::isdigit(static_cast<unsigned char>(node.text[start])) != 0 && std::isdigit(static_cast<unsigned char>(node.text.back())) != 0;
    if (!node.quoted && (digits || node.text == "true" || node.text == "false")) return node.text;
    std::string out = "\"";
    for (const char c : node.text) out += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string(1, c);
    return out + "\"";
  }
  const bool map = node.kind == Node::Kind::map;
  std::string out = map ? "{" : "[";
  for (std::size_t i = 0; i < node.items.size(); ++i)
    out += (i > 0 ? ", " : "") + (map ? "\"" + node.keys[i].text + "\": " : std::string()) + json(node.items[i]);
  return out + (map ? "}" : "]");
}

struct Documents {
  std::vector<std::pair<std::string, Node>> list;
  void add(const std::string& name, const Node& node) { list.emplace_back(name, node); }
};

// What the Python package jsonschema, an implementation that is not ours, says of each document; empty where it is missing.
std::vector<std::string> verdicts(const std::string& kind, const Documents& documents) {
  std::string folder = (std::filesystem::temp_directory_path() / "tofray_schema_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return {};
  std::ofstream(folder + "/schema.json") << load::schema_json(kind);
  {
    std::ofstream out(folder + "/documents.jsonl");
    for (const auto& [name, node] : documents.list) out << "[\"" << name << "\", " << json(node) << "]\n";
  }
  const std::string command =
      "/usr/bin/python3 " TOFRAY_SOURCE_DIR "/tests/load/schema_check.py " + folder + " > " + folder + "/out 2> " + folder + "/err";
  const int status = std::system(command.c_str());
  std::vector<std::string> lines;
  std::ifstream in(folder + "/out");
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const bool missing = WIFEXITED(status) && (WEXITSTATUS(status) == 77 || WEXITSTATUS(status) == 127);
  if (!missing && status != 0) {
    std::stringstream err;
    err << std::ifstream(folder + "/err").rdbuf();
    ADD_FAILURE() << err.str();
  }
  std::filesystem::remove_all(folder);
  return missing ? std::vector<std::string>() : lines;
}

class schema : public testing::TestWithParam<const char*> {
 protected:
  const model::FileForm& form() const { return std::string(GetParam()) == "scene" ? model::scene_form() : model::camera_form(); }
};

TEST_P(schema, accepts_all_that_the_reader_accepts) {
  Documents documents;
  for (const auto& builtin : std::string(GetParam()) == "scene" ? load::builtin_scenes() : load::builtin_profiles())
    documents.add(builtin.name, yaml::parse_tree(builtin.text, builtin.name));
  for (std::size_t v = 0; v < test::sample_variants; ++v) documents.add("sample " + std::to_string(v), test::sample(form().root, v));
  const auto lines = verdicts(GetParam(), documents);
  if (lines.empty() && !testing::Test::HasFailure())
    GTEST_SKIP() << "needs /usr/bin/python3 with the package jsonschema (python3-jsonschema)";
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
  const auto lines = verdicts(GetParam(), documents);
  if (lines.empty() && !testing::Test::HasFailure())
    GTEST_SKIP() << "needs /usr/bin/python3 with the package jsonschema (python3-jsonschema)";
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
