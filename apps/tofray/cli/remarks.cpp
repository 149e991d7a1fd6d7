// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/remarks.h"

#include <algorithm>

#include "cli/console.h"

namespace tofray::app {

namespace {

/// The text without its first `word`.
std::string without(std::string text, std::string_view word) { return text.erase(text.find(word), word.size()); }

}  // namespace

void Remarks::tell(const std::string& text) {
  say(text);
  std::string* last = nullptr;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::string line = text.substr(from, end - from);
    from = end + 1;
    if (line.starts_with(' ')) {
      if (last != nullptr) *last += "\n" + line.substr(line.find_first_not_of(' '));
      continue;
    }
    const std::size_t warning = line.find("warning: "), note = line.find("note: ");
    last = nullptr;
    if (warning != std::string::npos && warning < note)
      last = &warnings_.emplace_back(without(line, "warning: "));
    else if (note != std::string::npos)
      last = &notes_.emplace_back(without(line, "note: "));
  }
}

void Remarks::tell(const std::vector<Remark>& remarks) { tell(texts(remarks)); }

std::string texts(const std::vector<Remark>& remarks) {
  std::string out;
  for (const Remark& one : remarks) out += one.text();
  return out;
}

files::Json& Remarks::put(files::Json& json) const {
  return json.set("warnings", files::Json::list(warnings_)).set("notes", files::Json::list(notes_));
}

}  // namespace tofray::app
