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
    text += "\n  " + printable(more.substr(from, end - from));
    from = end + 1;
  }
  faults_.push_back({place, std::move(text), kind});
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
  std::string out;
  for (std::size_t i = 0; i < std::min(sorted.size(), most); ++i) out += (i > 0 ? "\n" : "") + sorted[i]->text;
  if (sorted.size() > most) out += "\nand " + std::to_string(sorted.size() - most) + " more";
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

}  // namespace tofray::base
