// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/convert.h"

#include <algorithm>
#include <filesystem>

#include "base/text.h"
#include "base/units.h"
#include "files/text_file.h"

namespace tofray::load {

using files::read_text;
using yaml::Value;

Vec3 vector(const Value& value) {
  if (!value || !value.good || value.items.size() != 3) return {0, 0, 0};
  return {value.items[0].number, value.items[1].number, value.items[2].number};
}

std::vector<double> numbers(const Value& list) {
  std::vector<double> out;
  for (const auto& item : list.items) out.push_back(item.number);
  return out;
}

std::vector<std::vector<double>> rows_of_numbers(std::string_view text, const std::string& path, base::Faults& faults) {
  std::vector<std::vector<double>> rows;
  const auto source = std::make_shared<const std::string>(path);
  int line_number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string_view line = text.substr(from, end - from);
    from = end + 1;
    ++line_number;
    std::vector<double> row;
    for (std::size_t i = 0; i < line.size() && line[i] != '#';) {
      if (line[i] == ' ' || line[i] == '\t' || line[i] == ',' || line[i] == ';' || line[i] == '\r') {
        ++i;
        continue;
      }
      const std::size_t stop = std::min(line.find_first_of(" \t,;\r#", i), line.size());
      const auto number = base::parse_quantity(line.substr(i, stop - i), base::Dimension::none);
      if (number.status != base::Quantity::Status::good && number.status != base::Quantity::Status::bare) {
        faults.add({source, line_number, static_cast<int>(i) + 1}, "not a number",
                   "got " + base::in_quotes(line.substr(i, stop - i)) + ", expected numbers with \",\" or blanks between them");
        return {};
      }
      row.push_back(number.value);
      i = stop;
    }
    if (!row.empty()) rows.push_back(std::move(row));
  }
  if (rows.empty()) faults.add(base::whole(path), "there are no numbers in it", "expected rows of numbers, one row a line");
  return rows;
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

}  // namespace tofray::load
