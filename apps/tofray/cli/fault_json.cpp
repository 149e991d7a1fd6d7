// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/fault_json.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace tofray::app {

namespace {

struct Fault {
  std::string file, text, more;
  int line = 0, column = 0;
};

/// Takes ":12" off the end of a place. @return 0 where it does not end so
int take_number(std::string& place) {
  const std::size_t colon = place.rfind(':');
  if (colon == std::string::npos || colon + 1 == place.size()) return 0;
  int number = 0;
  const char* const end = place.data() + place.size();
  const auto read = std::from_chars(place.data() + colon + 1, end, number);
  if (read.ec != std::errc() || read.ptr != end || number <= 0) return 0;
  place.resize(colon);
  return number;
}

/// "file:line:column: error: what", "file: error: what", "error: what" or any other line.
Fault fault_of(const std::string& line) {
  Fault fault;
  constexpr std::string_view mark = "error: ";
  const std::size_t behind_place = line.find(": error: ");
  if (line.starts_with(mark)) {
    fault.text = line.substr(mark.size());
  } else if (behind_place == std::string::npos) {
    fault.text = line;
  } else {
    fault.text = line.substr(behind_place + 2 + mark.size());
    std::string place = line.substr(0, behind_place), whole = place;
    fault.column = take_number(place);
    fault.line = fault.column > 0 ? take_number(place) : 0;
    fault.file = fault.line > 0 ? place : whole;
    if (fault.line == 0) fault.column = 0;
  }
  return fault;
}

std::vector<Fault> faults_of(const std::string& text) {
  std::vector<Fault> faults;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string line = text.substr(from, end - from);
    from = end + 1;
    if (!line.starts_with("  ") || faults.empty())
      faults.push_back(fault_of(line));
    else
      faults.back().more += (faults.back().more.empty() ? "" : "\n") + line.substr(2);
  }
  return faults;
}

files::Json text_or_null(const std::string& text) { return text.empty() ? files::Json() : files::Json(text); }
files::Json number_or_null(int number) { return number > 0 ? files::Json(number) : files::Json(); }

}  // namespace

files::Json fault_json(const std::string& text, ErrorKind kind) {
  files::Json faults = files::Json::array();
  for (const Fault& one : faults_of(text))
    faults.push(files::Json::object()
                    .set("file", text_or_null(one.file))
                    .set("line", number_or_null(one.line))
                    .set("column", number_or_null(one.column))
                    .set("text", one.text)
                    .set("more", text_or_null(one.more)));
  return files::Json::object().set("good", false).set("exit_code", static_cast<int>(kind)).set("faults", std::move(faults));
}

}  // namespace tofray::app
