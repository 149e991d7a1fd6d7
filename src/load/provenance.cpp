// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/provenance.h"

namespace tofray::load {

using yaml::Node;

namespace {

bool looks_like_a_number(const std::string& text) {
  const std::size_t digit = text.find_first_of("0123456789");
  return digit != std::string::npos && text.find_first_not_of("+-.") == digit;
}

void walk(const Node& node, const std::string& path, bool inherited, std::vector<std::string>& out) {
  if (node.kind == Node::Kind::scalar && !inherited && looks_like_a_number(node.text))
    out.push_back(base::to_string(node.place) + ": " + path + " is " + node.text);
  const bool says = node.find("source") != nullptr || node.find("assumed") != nullptr;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const bool words = node.kind == Node::Kind::map && (node.keys[i].text == "source" || node.keys[i].text == "assumed" ||
                                                        node.keys[i].text == "note" || node.keys[i].text == "name");
    const std::string name = node.kind == Node::Kind::map ? node.keys[i].text : std::to_string(i);
    if (!words) walk(node.items[i], path.empty() ? name : path + "." + name, inherited || says, out);
  }
}

}  // namespace

std::vector<std::string> unsourced_numbers(const Node& profile) {
  std::vector<std::string> out;
  walk(profile, "", false, out);
  return out;
}

}  // namespace tofray::load
