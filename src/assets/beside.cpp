// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/beside.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "base/text.h"
#include "files/text_file.h"

namespace tofray::assets {

namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

/// The entry of a folder that differs from a name by the case of its letters alone; of several the first in the alphabet.
std::string in_other_case(const fs::path& folder, const std::string& name) {
  constexpr int enough = 10'000;
  const std::string wanted = lower(name);
  std::string out;
  std::error_code error;
  int looked_at = 0;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end && looked_at < enough;
       entry.increment(error), ++looked_at) {
    const std::string one = entry->path().filename().string();
    if (lower(one) == wanted && (out.empty() || one < out)) out = one;
  }
  return out;
}

/// A path below a folder with each part as the folders have it; empty where a part is none of theirs.
std::string as_folders_have_it(const std::string& folder, const std::string& path) {
  fs::path out;
  for (const fs::path& part : fs::path(path)) {
    if (part.is_absolute() || part == "..") return {};
    std::error_code ignored;
    const bool is_there = fs::exists(fs::path(folder) / out / part, ignored);
    const std::string name = is_there ? part.string() : in_other_case(fs::path(folder) / out, part.string());
    if (name.empty()) return {};
    out /= name;
  }
  return out.string();
}

std::string last_part(const std::string& path) { return path.substr(path.find_last_of("/:") + 1); }  // npos + 1 is 0

}  // namespace

namespace {

std::optional<Beside> looked_for(const mesh::Reference& reference, const std::string& folder, const std::string& root,
                                 const base::Limit& most) {
  std::string said = reference.file;
  std::replace(said.begin(), said.end(), '\\', '/');
  std::vector<std::string> names{said, last_part(said)};
  for (std::size_t i = 0; i < 2; ++i) names.push_back(as_folders_have_it(folder, names[i]));
  Beside out;
  for (const std::string& name : names) {
    if (name.empty()) continue;
    try {
      out.bytes = files::read_reference(name, folder, root, reference.place, out.found, most);
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::limit) throw;
      continue;
    }
    if (name != said) out.notice = "there is no " + base::in_quotes(said, 100) + ": " + base::in_quotes(name, 100) + " is read";
    return out;
  }
  return std::nullopt;
}

base::Content content_of(const std::string& bytes) {
  base::Content out;
  out.add(std::string_view(bytes));
  return out;
}

thread_local NamedReads* noting = nullptr;

}  // namespace

std::optional<Beside> read_beside(const mesh::Reference& reference, const std::string& folder, const std::string& root,
                                  const base::Limit& most) {
  std::optional<Beside> out = looked_for(reference, folder, root, most);
  NamedReads::note(true, reference.file, folder, root, most, out ? &out->bytes : nullptr, out ? out->found : "");
  return out;
}

bool NamedRead::is_unchanged() const {
  try {
    std::string now, where;
    if (beside) {
      const std::optional<Beside> read = looked_for({name, base::whole(name)}, folder, root, most);
      if (!read) return !bytes;
      now = read->bytes, where = read->found;
    } else {
      now = files::read_reference(name, folder, root, base::whole(name), where, most);
    }
    return bytes == content_of(now) && found == where;
  } catch (const Error&) {
    return false;
  }
}

NamedReads::NamedReads() : outer_(std::exchange(noting, this)) {}
NamedReads::~NamedReads() { noting = outer_; }

void NamedReads::note(bool beside, const std::string& name, const std::string& folder, const std::string& root, const base::Limit& most,
                      const std::string* bytes, const std::string& found) {
  if (noting == nullptr) return;
  noting->reads_.push_back({beside, name, folder, root, most, bytes == nullptr ? std::nullopt : std::optional(content_of(*bytes)), found});
}

}  // namespace tofray::assets
