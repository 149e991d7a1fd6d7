// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/builtin.h"

#include <algorithm>

namespace tofray::load {

namespace {

// The first line's comment; SPDX lines are no description.
std::string description_of(std::string_view text) {
  while (text.starts_with("#")) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    line.remove_prefix(std::min(line.size(), line.find_first_not_of("# ")));
    if (!line.starts_with("SPDX") && !line.empty()) return std::string(line);
  }
  return {};
}

std::vector<Builtin> all_of(std::string_view folder) {
  std::vector<Builtin> all;
  for (std::size_t i = 0; i < embedded_count; ++i)
    if (embedded_files[i].folder == folder)
      all.push_back({embedded_files[i].stem, embedded_files[i].text, description_of(embedded_files[i].text)});
  return all;
}

}  // namespace

const std::vector<Builtin>& builtin_profiles() {
  static const std::vector<Builtin> all = all_of("profiles");
  return all;
}

const std::vector<Builtin>& builtin_scenes() {
  static const std::vector<Builtin> all = all_of("scenes");
  return all;
}

const Builtin* find_builtin(const std::vector<Builtin>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Builtin& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace tofray::load
