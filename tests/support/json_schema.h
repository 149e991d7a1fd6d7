// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "yaml/tree.h"

/// What the Python package jsonschema, an implementation that is not ours, says of documents.
namespace tofray::test {

/// A tree as the JSON that an editor's YAML reader makes of it.
inline std::string json_of(const yaml::Node& node) {
  using Kind = yaml::Node::Kind;
  if (node.kind == Kind::null) return "null";
  if (node.kind == Kind::scalar) {
    const std::size_t start = node.text.find_first_not_of("-");
    const bool digits =
        start != std::string::npos && start <= 1 && node.text.find_first_not_of("0123456789.", start) == std::string::npos &&
        std::isdigit(static_cast<unsigned char>(node.text[start])) != 0 && std::isdigit(static_cast<unsigned char>(node.text.back())) != 0;
    if (!node.quoted && (digits || node.text == "true" || node.text == "false")) return node.text;
    std::string out = "\"";
    for (const char c : node.text) out += (c == '"' || c == '\\') ? std::string{'\\', c} : std::string(1, c);
    return out + "\"";
  }
  const bool map = node.kind == Kind::map;
  std::string out = map ? "{" : "[";
  for (std::size_t i = 0; i < node.items.size(); ++i)
    out += (i > 0 ? ", " : "") + (map ? "\"" + node.keys[i].text + "\": " : std::string()) + json_of(node.items[i]);
  return out + (map ? "}" : "]");
}

struct Documents {
  std::vector<std::pair<std::string, yaml::Node>> list;
  void add(const std::string& name, const yaml::Node& node) { list.emplace_back(name, node); }
};

/// "accepted NAME" or "refused NAME: why" of each document; empty where the package is missing.
inline std::vector<std::string> verdicts(const std::string& schema, const Documents& documents) {
  std::string folder = (std::filesystem::temp_directory_path() / "tofray_schema_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return {};
  std::ofstream(folder + "/schema.json") << schema;
  {
    std::ofstream out(folder + "/documents.jsonl");
    for (const auto& [name, node] : documents.list) out << "[\"" << name << "\", " << json_of(node) << "]\n";
  }
  const std::string command =
      "/usr/bin/python3 " TOFRAY_SOURCE_DIR "/tests/support/schema_check.py " + folder + " > " + folder + "/out 2> " + folder + "/err";
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

#define NEEDS_VERDICTS(lines)                          \
  if ((lines).empty() && !testing::Test::HasFailure()) \
  GTEST_SKIP() << "needs /usr/bin/python3 with the package jsonschema (python3-jsonschema)"

}  // namespace tofray::test
