// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/profile_tables.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

#include "base/limits.h"
#include "base/text.h"
#include "files/text_file.h"
#include "load/load.h"
#include "tofray/error.h"
#include "yaml/settings.h"
#include "yaml/tree.h"

namespace tofray::run {

namespace {

using yaml::Node;

Node changed_profile(const InputFile& profile, const std::vector<Override>& overrides) {
  Node root = yaml::parse_tree(profile.text, profile.name);
  for (const Override& one : overrides) {
    const base::Place place = base::whole(one.where.empty() ? "camera." + one.key : one.where);
    yaml::set_key(root, one.key, yaml::parse_value(one.value, place), place);
  }
  return root;
}

/// Calls `visit` with each map that names a file, and the key under which the map stands.
template <class Visit>
void for_each_table(Node& node, const std::string& key, const Visit& visit) {
  if (node.kind == Node::Kind::map && node.find("file") != nullptr && node.find("file")->kind == Node::Kind::scalar) visit(node, key);
  for (std::size_t i = 0; i < node.items.size(); ++i)
    for_each_table(node.items[i], node.kind == Node::Kind::map ? node.keys[i].text : key, visit);
}

/// The lines of a table as lists of its numbers, untouched.
std::string rows_text(const std::string& text) {
  std::string rows;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::string row, word;
    for (const char c : text.substr(from, end - from) + "#") {
      const bool comment = c == '#', gap = comment || c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r';
      if (!gap) word += c;
      if (gap && !word.empty()) row += (row.empty() ? "" : ", ") + word, word.clear();
      if (comment) break;
    }
    if (!row.empty()) rows += (rows.empty() ? "[" : ", [") + row + "]";
    from = end + 1;
  }
  return "[" + rows + "]";
}

}  // namespace

std::vector<InputFile> profile_tables(const InputFile& profile, const std::string& folder, const std::vector<Override>& overrides) {
  std::vector<InputFile> tables;
  Node root = changed_profile(profile, overrides);
  for_each_table(root, "", [&](const Node& map, const std::string&) {
    const std::string& name = map.find("file")->text;
    std::string path;
    tables.push_back({"table", name, files::read_reference(name, folder, {}, map.place, path)});
  });
  return tables;
}

std::string profile_with_tables(const InputFile& profile, const std::vector<Override>& overrides, const std::vector<InputFile>& tables) {
  std::unordered_map<std::string_view, const InputFile*> known;
  for (const InputFile& one : tables)
    if (one.role == "table") known.emplace(one.name, &one);
  std::size_t bytes = 0;
  Node root = changed_profile(profile, overrides);
  for_each_table(root, "", [&](Node& map, const std::string& key) {
    const std::string name = map.find("file")->text;
    const auto table = known.find(name);
    if (table == known.end()) base::fail(map.place, "the manifest does not hold the table " + base::in_quotes(name));
    // The profile with all its tables is a file, too.
    bytes += table->second->text.size();
    if (bytes > static_cast<std::size_t>(base::limit::file_bytes.value))
      base::fail(map.place, "the profile's tables are too long", "at most " + std::to_string(base::limit::file_bytes.value) + " bytes",
                 ErrorKind::limit);
    // A pattern has rows; a correlation is one list, line after line.
    Node rows = yaml::parse_value(rows_text(table->second->text), base::whole(name));
    Node all = rows;
    if (key == "waveform") {
      all.items.clear();
      for (const Node& row : rows.items) all.items.insert(all.items.end(), row.items.begin(), row.items.end());
    }
    const auto at = static_cast<std::size_t>(map.find("file") - map.items.data());
    map.keys[at].text = key == "waveform" ? "correlation" : "samples";
    map.items[at] = std::move(all);
  });
  return yaml::flow_text(root);
}

}  // namespace tofray::run
