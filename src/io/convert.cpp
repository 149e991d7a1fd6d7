// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/convert.h"

#include <filesystem>

#include "base/text.h"
#include "io/text_file.h"

namespace tofray::io {

Vec3 vector(const Value& value) {
  if (!value || !value.good || value.items.size() != 3) return {0, 0, 0};
  return {value.items[0].number, value.items[1].number, value.items[2].number};
}

std::vector<double> numbers(const Value& list) {
  std::vector<double> out;
  for (const auto& item : list.items) out.push_back(item.number);
  return out;
}

void table(const Value& map, const char* x_key, const char* y_key, base::Faults& faults, std::vector<double>& x, std::vector<double>& y) {
  if (!map.good) return;
  x = numbers(map[x_key]);
  y = numbers(map[y_key]);
  if (x.size() != y.size())
    faults.add(map[y_key].place(), std::string(y_key) + " is not as long as " + x_key,
               "got " + std::to_string(y.size()) + " and " + std::to_string(x.size()) + " elements, expected one for each");
  for (std::size_t i = 1; i < x.size(); ++i)
    if (!(x[i] > x[i - 1])) {
      faults.add(map[x_key].items[i].place(), std::string(x_key) + " does not ascend",
                 "got " + describe(*map[x_key].items[i].node) + " after " + describe(*map[x_key].items[i - 1].node));
      return;
    }
}

std::string read_named(const std::string& kind, const std::string& name, const std::vector<Builtin>& builtins) {
  std::error_code ignored;
  const bool bare_name = name.find_first_of("/.") == std::string::npos;
  if (!bare_name || std::filesystem::exists(name, ignored)) return read_text(name);
  std::vector<std::string> names;
  for (const auto& one : builtins) names.push_back(one.name);
  base::fail(base::whole(name.empty() ? "(no name)" : name), "no such " + kind + base::did_you_mean(name, names),
             "neither a built-in " + kind + " nor a file; built in: " + base::listed(names, "and"), ErrorKind::io);
}

}  // namespace tofray::io
