// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "yaml/tree.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "base/text.h"

namespace tofray::yaml {

const Node* Node::find(std::string_view key) const {
  if (kind != Kind::map) return nullptr;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (keys[i].text == key) return &items[i];
  return nullptr;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

std::string describe(const Node& node) {
  switch (node.kind) {
    case Node::Kind::null: return "nothing";
    case Node::Kind::scalar: return base::in_quotes(node.text);
    case Node::Kind::list: return node.items.empty() ? "an empty list" : "a list of " + std::to_string(node.items.size());
    case Node::Kind::map: return node.items.empty() ? "an empty map" : "a map with " + base::in_quotes(node.keys[0].text);
  }
  return {};
}

namespace {

bool plain_is_safe(const std::string& text) {
  if (text.empty() || text.front() == ' ' || text.back() == ' ' || text.front() == '%' || text == "null" || text == "Null" ||
      text == "NULL")
    return false;
  if (text.starts_with("- ") || text == "-" || text.starts_with("--") || text.starts_with("..")) return false;
  return std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(" ._+-/%()").find(c) != std::string_view::npos;
  });
}

std::string json_quoted(const std::string& text) {
  constexpr char digits[] = "0123456789ABCDEF";
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') out += '\\';
    if (byte < 0x20 || byte == 0x7F)
      out += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace

std::string flow_text(const Node& node) {
  if (node.kind == Node::Kind::null) return "null";
  if (node.kind == Node::Kind::scalar) return !node.quoted && plain_is_safe(node.text) ? node.text : json_quoted(node.text);
  const bool map = node.kind == Node::Kind::map;
  std::string out = map ? "{" : "[";
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    if (i > 0) out += ", ";
    if (map) out += (plain_is_safe(node.keys[i].text) ? node.keys[i].text : json_quoted(node.keys[i].text)) + ": ";
    out += flow_text(node.items[i]);
  }
  return out + (map ? "}" : "]");
}

void set_place(Node& node, const base::Place& place) {
  node.place = place;
  for (auto& key : node.keys) key.place = place;
  for (auto& item : node.items) set_place(item, place);
}

namespace {

using Source = std::shared_ptr<const std::string>;

void rename_source(Node& node, const std::string& from, const Source& to) {
  const auto rename = [&](Source& source) {
    if (source && *source == from) source = to;
  };
  rename(node.place.source);
  for (auto& key : node.keys) rename(key.place.source);
  for (auto& item : node.items) rename_source(item, from, to);
}

}  // namespace

void rename_source(Node& node, const std::string& from, const std::string& to) {
  rename_source(node, from, std::make_shared<const std::string>(to));
}

}  // namespace tofray::yaml
