// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "messages/type_hash.h"

#include <fmt/core.h>

#include <map>
#include <sstream>

#include "files/sha256.h"
#include "tofray/messages.h"

namespace tofray::messages {

namespace {

// Numbers of type_description_interfaces/msg/FieldType; arrays and sequences add to them.
constexpr int nested_id = 1, array_offset = 48, sequence_offset = 144;
const std::map<std::string, int, std::less<>>& plain_ids() {
  static const std::map<std::string, int, std::less<>> all = {{"int8", 2},   {"uint8", 3}, {"int16", 4},  {"uint16", 5},   {"int32", 6},
                                                              {"uint32", 7}, {"int64", 8}, {"uint64", 9}, {"float32", 10}, {"float64", 11},
                                                              {"bool", 15},  {"byte", 16}, {"string", 17}};
  return all;
}

/// "std_msgs/Header" or, within std_msgs, "Header": "std_msgs/msg/Header".
std::string full_name(const std::string& type, const std::string& package) {
  const std::size_t slash = type.find('/');
  if (slash == std::string::npos) return package + "/msg/" + type;
  return type.substr(0, slash) + "/msg/" + type.substr(slash + 1);
}

std::string member_json(const std::string& type, const std::string& name, const std::string& package) {
  const std::size_t bracket = type.find('[');
  const std::string base = type.substr(0, bracket), size = bracket == std::string::npos ? "" : type.substr(bracket + 1);
  const bool sequence = size == "]", array = !size.empty() && !sequence;
  const auto plain = plain_ids().find(base);
  const int id = (plain != plain_ids().end() ? plain->second : nested_id) + (sequence ? sequence_offset : array ? array_offset : 0);
  return fmt::format(R"({{"name": "{}", "type": {{"type_id": {}, "capacity": {}, "string_capacity": 0, "nested_type_name": "{}"}}}})", name,
                     id, array ? std::stoi(size) : 0, plain != plain_ids().end() ? "" : full_name(base, package));
}

/// @param members  a line each: "uint8 OK=0", which is no member, or "float64 w 1"
std::string type_json(const std::string& full, const std::string& members) {
  const std::string package = full.substr(0, full.find('/'));
  std::istringstream lines(members);
  std::string fields;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string type, name;
    if (!(words >> type >> name) || name.find('=') != std::string::npos) continue;
    fields += (fields.empty() ? "" : ", ") + member_json(type, name, package);
  }
  return fmt::format(R"({{"type_name": "{}", "fields": [{}]}})", full, fields);
}

}  // namespace

std::string type_description_json(std::string_view type) {
  std::istringstream lines(message_definition(type));
  std::string own;
  std::map<std::string, std::string> within;
  std::string* members = &own;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("MSG: "))
      members = &within[full_name(line.substr(5), "")];
    else if (!line.starts_with("="))
      *members += line + "\n";
  }
  std::string others;
  for (const auto& [name, text] : within) others += (others.empty() ? "" : ", ") + type_json(name, text);
  return fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})", type_json(std::string(type), own), others);
}

std::string type_hash(std::string_view type) { return "RIHS01_" + files::sha256_hex(type_description_json(type)); }

}  // namespace tofray::messages
