// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/faults.h"

/// YAML (and JSON, which is YAML) as a small tree of ours: every value knows where it stands.
namespace tofray::yaml {

struct Node {
  enum class Kind : unsigned char { null, scalar, list, map };
  struct Key {
    std::string text;
    base::Place place;
  };
  Kind kind = Kind::null;
  bool quoted = false;      ///< scalar written in quotes: never a boolean
  int height = 0;           ///< levels of lists and maps in it
  std::string text;         ///< scalar
  base::Place place;        ///< where the value starts
  std::vector<Key> keys;    ///< map: one for each of `items`
  std::vector<Node> items;  ///< list: its elements; map: its values

  /// The value of a map's key, or none.
  [[nodiscard]] const Node* find(std::string_view key) const;
  [[nodiscard]] Node* find(std::string_view key);
};

/// What a node is, for messages: `"80"`, "a list of 3", "a map", "nothing".
std::string describe(const Node& node);

/// Parses one YAML document. Refused, each with line and column: text that is not UTF-8, control characters, tags, merge keys, duplicate
/// keys, keys that are not plain text, further documents, deeper nesting and more values than base/limits.h allows. Anchors and aliases
/// are written out; each copy counts.
/// @param source   the file's name for messages
/// @throws Error   at the first such fault
Node parse_tree(std::string_view text, const std::string& source);

/// Parses a value of the command line: every place is the source as a whole.
Node parse_value(std::string_view text, const base::Place& place);

/// The node as YAML on one line, which parse_value() reads back.
std::string flow_text(const Node& node);

/// Sets every place in the tree.
void set_place(Node& node, const base::Place& place);
/// Calls what stands in a file of one name by another name; lines and columns stay.
void rename_source(Node& node, const std::string& from, const std::string& to);

}  // namespace tofray::yaml
