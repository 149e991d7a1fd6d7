// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "load/controls.h"
#include "load/trees.h"

namespace tofray::load {

namespace {

using yaml::flow_text;
using yaml::Node;

constexpr std::size_t widest_line = 130;

bool is_branch(const Node& node) { return (node.kind == Node::Kind::map || node.kind == Node::Kind::list) && !node.items.empty(); }

/// A value on one line where it fits there, but for the file's own sections.
bool on_one_line(const Node& node, std::size_t indent) {
  return !is_branch(node) || (indent > 0 && indent + flow_text(node).size() <= widest_line);
}

std::string key_text(const std::string& key) {
  Node word;
  word.kind = Node::Kind::scalar, word.text = key;
  return flow_text(word);
}

/// @param started  the first line's indentation is written already
void write(const Node& node, std::size_t indent, bool started, std::string& out) {
  const std::string margin(indent, ' ');
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    if (i > 0 || !started) out += margin;
    const bool map = node.kind == Node::Kind::map;
    out += map ? key_text(node.keys[i].text) + ":" : "-";
    if (on_one_line(item, indent + (map ? node.keys[i].text.size() : 0) + 2)) {
      out += " " + flow_text(item) + "\n";
    } else if (map) {
      out += "\n";
      write(item, indent + 2, false, out);
    } else {
      out += " ";
      write(item, indent + 2, true, out);
    }
  }
}

}  // namespace

std::string block_yaml(const yaml::Node& root) {
  std::string out;
  write(root, 0, false, out);
  return out;
}

std::string scene_yaml(std::string_view text, const std::string& source, const Settings& settings) {
  return block_yaml(scene_tree(text, source, settings));
}

}  // namespace tofray::load
