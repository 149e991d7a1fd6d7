// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/faults.h"

#include <algorithm>
#include <tuple>

#include "base/limits.h"
#include "base/text.h"

namespace tofray::base {

std::string to_string(const Place& place) {
  std::string out = place.source ? *place.source : std::string("(no file)");
  if (place.line > 0) out += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  return out;
}

Place whole(const std::string& source) { return {std::make_shared<const std::string>(source), 0, 0}; }

void Faults::add(const Place& place, const std::string& what, const std::string& more, ErrorKind kind) {
  std::string text = printable(to_string(place)) + ": error: " + printable(what);
  for (std::size_t from = 0; from < more.size();) {
    const std::size_t end = std::min(more.find('\n', from), more.size());
    text += "\n  " + more.substr(from, end - from);
    from = end + 1;
  }
  faults_.push_back({place, message(text), kind});
  if (faults_.size() >= static_cast<std::size_t>(limit::faults_counted.value)) raise();
}

std::string Faults::text() const {
  std::vector<const Fault*> sorted;
  for (const auto& fault : faults_) sorted.push_back(&fault);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Fault* a, const Fault* b) {
    const std::string none;
    const auto& source_a = a->place.source ? *a->place.source : none;
    const auto& source_b = b->place.source ? *b->place.source : none;
    return std::tie(source_a, a->place.line, a->place.column) < std::tie(source_b, b->place.line, b->place.column);
  });
  // What an alias repeats is one fault.
  sorted.erase(std::unique(sorted.begin(), sorted.end(), [](const Fault* a, const Fault* b) { return a->text == b->text; }), sorted.end());
  const auto most = static_cast<std::size_t>(limit::faults_shown.value);
  const std::size_t room = static_cast<std::size_t>(limit::message_bytes.value) - 100;  // for the last line
  std::string out;
  std::size_t shown = 0;
  for (; shown < std::min(sorted.size(), most); ++shown) {
    if (shown > 0 && out.size() + sorted[shown]->text.size() > room) break;
    out += (shown > 0 ? "\n" : "") + sorted[shown]->text;
  }
  const bool whole = faults_.size() < static_cast<std::size_t>(limit::faults_counted.value);
  if (shown < sorted.size() || !whole)
    out += "\nand " + std::to_string(sorted.size() - shown) + " more" + (whole ? "" : "; it was not read to its end");
  return out;
}

void Faults::raise() const {
  if (faults_.empty()) return;
  const bool limits_only = std::all_of(faults_.begin(), faults_.end(), [](const Fault& f) { return f.kind == ErrorKind::limit; });
  throw Error(limits_only ? ErrorKind::limit : ErrorKind::bad_input, text());
}

void fail(const Place& place, const std::string& what, const std::string& more, ErrorKind kind) {
  Faults one;
  one.add(place, what, more, kind);
  throw Error(kind, one.text());
}

void refuse(const std::string& message) { throw Error(ErrorKind::bad_input, "error: " + message); }

}  // namespace tofray::base

namespace tofray {

Error::Error(ErrorKind kind, const std::string& message) : std::runtime_error(base::message(message)), kind_(kind) {}

}  // namespace tofray
