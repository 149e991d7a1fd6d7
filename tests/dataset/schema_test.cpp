// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The JSON Schema of sets, by an implementation that is not ours: it takes every set of the examples and of the docs, and refuses what is wrong
// in its kind.
#include "dataset/schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "dataset/set_file.h"
#include "support/json_schema.h"

namespace tofray::test {
namespace {

namespace fs = std::filesystem;

std::string whole(const fs::path& path) {
  std::stringstream out;
  out << std::ifstream(path).rdbuf();
  return out.str();
}

/// The sets that stand in a document as blocks of YAML.
void add_blocks(const fs::path& path, Documents& into) {
  const std::string text = whole(path);
  for (std::size_t at = 0; (at = text.find("```yaml\n", at)) != std::string::npos;) {
    const std::size_t from = at + 8, end = text.find("```", from);
    const std::string block = text.substr(from, end - from);
    if (block.find("\nsamples:") != std::string::npos)
      into.add(path.filename().string() + " at " + std::to_string(from), yaml::parse_tree(block, path.filename().string()));
    at = end + 3;
  }
}

TEST(schema_of_sets, accepts_every_set_of_the_examples_and_of_the_docs) {
  Documents documents;
  const fs::path source = TOFRAY_SOURCE_DIR;
  for (const char* name : {"corners", "tabletop", "rooms", "flying", "targets", "sunlit"})
    documents.add(name, yaml::parse_tree(whole(source / "examples" / name / (std::string(name) + ".yaml")), name));
  for (const auto& one : fs::directory_iterator(source / "docs"))
    if (one.path().extension() == ".md") add_blocks(one.path(), documents);
  EXPECT_GE(documents.list.size(), 12u);
  for (const auto& [name, node] : documents.list) EXPECT_NO_THROW((void)dataset::parse_set(yaml::flow_text(node), name)) << name;
  const auto lines = verdicts(dataset::schema_json(), documents);
  NEEDS_VERDICTS(lines);
  EXPECT_EQ(lines.size(), documents.list.size());
  for (const std::string& line : lines) EXPECT_TRUE(line.starts_with("accepted ")) << line;
}

/// A set whose parts may be replaced by others.
std::string set_with(const std::string& top, const std::string& let, const std::string& plane, const std::string& objects) {
  return "{name: a, " + top + ", let: {" + let +
         "}, scene: {camera: {profile: pico-flexx}, objects: [{plane: {name: wall, point: [0, 0, 1 m], " + plane + "}}" + objects + "]}}";
}

TEST(schema_of_sets, refuses_what_is_wrong_in_its_kind) {
  Documents right, wrong;
  const auto add = [](Documents& into, const std::string& text) {
    std::string name = text;
    std::erase_if(name, [](char c) { return c == '"' || c == '\\'; });
    into.add(name, yaml::parse_tree(text, "set"));
  };
  const auto plane = [](const std::string& more) { return set_with("samples: 4", "w: 1 m", more, ""); };
  for (const char* form :
       {"50 %", "{uniform: [1 %, 50 %]}", "{uniform: [1 %, 50 %], per: set}", "{log_uniform: [1 %, 50 %]}",
        "{normal: [1 %, 50 %], within: [0, 1]}", "{even: [1 %, 2 %]}", "{choice: [1 %, {uniform: [1 %, 2 %]}], weights: [1, 2]}",
        "{choice: {a: 1}}", "{grid: [1 %]}", "{grid: {from: 1 %, to: 2 %, n: 5}}", "\"= w / 2 m\""})
    add(right, plane(std::string("reflectivity: ") + form));
  for (const char* form : {"{unifrom: [1 %, 50 %]}", "{uniform: [1 %]}", "{uniform: 1 %}", "{uniform: [1 %, 2 %], per: frame_}",
                           "{uniform: [1 %, 2 %], even: [1 %, 2 %]}", "{uniform: [1 %, 2 %], within: [0, 1]}",
                           "{grid: {from: 1 %, to: 2 %}}", "{choice: []}", "{table: a.csv}", "fifty", "\"w / 2 m\"", "[1 %]"})
    add(wrong, plane(std::string("reflectivity: ") + form));
  add(right, plane("reflectivity: 50 %, normal: {cap: {around: [0, 0, -1], within: 20 deg}}"));
  add(wrong, plane("reflectivity: 50 %, normal: {cap: {around: [0, 0, -1]}}"));
  add(wrong, plane("reflectvity: 50 %"));
  const auto objects = [](const std::string& more) {
    return set_with("samples: 4", "w: {table: lamps.csv}", "reflectivity: 50 %", ", " + more);
  };
  add(right, objects("{scatter: {name: c, count: {integer: [1, 3]}, of: {sphere: {radius: 1 cm}}, surface: wall}}"));
  add(wrong, objects("{scatter: {name: c, of: {sphere: {radius: 1 cm}}}}"));
  add(wrong, objects("{scatter: {name: c, count: 1, of: {}, on: wall}}"));
  add(right, objects("{box: {min: [0, 0, 1 m], max: [1 m, 1 m, 2 m], reflectivity: 50 %, rotation: any}}"));
  add(wrong, objects("{box: {min: [0, 0, 1 m], max: [1 m, 1 m, 2 m], reflectivity: 50 %, rotation: some}}"));
  add(wrong, objects("{bowl: {}}"));
  for (const char* top : {"samples: 0", "samples: many", "sample: 4", "samples: 4, split: {by: colour}", "samples: 4, views: 1000",
                          "samples: 4, accept: [{seen: 1, valid: 50 %}]"})
    add(wrong, set_with(top, "w: 1 m", "reflectivity: 50 %", ""));
  add(right, set_with("samples: 4, split: {by: scene, test: 10 %}, accept: [{valid: 50 %}]", "w: {uniform: [1 m, 2 m]}",
                      "reflectivity: 50 %", ""));
  add(right, "{name: a, samples: 4, scene: {camera: {profile: pico-flexx, pose: {look: {at: ball, radius: [1 m, 2 m]}}}, objects: []}}");
  add(wrong, "{name: a, samples: 4, scene: {camera: {profile: pico-flexx, pose: {look: {at: ball}}}, objects: []}}");
  for (const auto& [documents, word] : {std::pair(&right, "accepted "), std::pair(&wrong, "refused ")}) {
    const auto lines = verdicts(dataset::schema_json(), *documents);
    NEEDS_VERDICTS(lines);
    EXPECT_EQ(lines.size(), documents->list.size());
    for (const std::string& line : lines) EXPECT_TRUE(line.starts_with(word)) << line;
  }
}

}  // namespace
}  // namespace tofray::test
