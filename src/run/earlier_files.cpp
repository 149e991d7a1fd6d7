// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/earlier_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <system_error>

#include "base/text.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

namespace fs = std::filesystem;

constexpr const char* manifest_name = "manifest.json";

bool is_plain_file(const fs::path& path) {
  std::error_code ignored;
  return fs::symlink_status(path, ignored).type() == fs::file_type::regular;
}

/// A manifest may come from anybody: what it names has to lie in the folder itself.
bool is_in_folder(const std::string& name) {
  return !name.empty() && name != manifest_name && name != "." && name != ".." && name.find('/') == std::string::npos;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;
/// Options without those that say which frames of a run.
Pairs but_for_frames(Pairs options) {
  std::erase_if(options, [](const auto& one) { return one.first == "frames" || one.first == "first-frame"; });
  return options;
}
bool is_part(const results::Manifest& manifest) {
  return std::any_of(manifest.options.begin(), manifest.options.end(), [](const auto& one) { return one.first == "first-frame"; });
}
bool same_inputs(const results::Manifest& a, const results::Manifest& b) {
  return std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(), [](const auto& one, const auto& other) {
    return one.role == other.role && one.name == other.name && one.text == other.text && one.sha256 == other.sha256;
  });
}
bool parts_of_one_run(const results::Manifest& a, const results::Manifest& b) {
  return (is_part(a) || is_part(b)) && same_inputs(a, b) && a.set == b.set && a.seed == b.seed && a.tofray_version == b.tofray_version &&
         but_for_frames(a.options) == but_for_frames(b.options);
}

std::string names_of(const std::vector<FileRecord>& all) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < all.size() && i < most; ++i) names.push_back(all[i].name);
  if (all.size() > most) names.push_back(fmt::format("{} more", all.size() - most));
  return base::listed(names, "and");
}
std::string count_of(std::size_t count) { return fmt::format("{} file{}", count, count == 1 ? "" : "s"); }

}  // namespace

EarlierFiles::EarlierFiles(const fs::path& folder) {
  if (!is_plain_file(folder / manifest_name)) return;
  try {
    before_ = results::read_manifest((folder / manifest_name).native());
  } catch (const Error&) {
    // nobody knows whose files lie there
  }
}

std::vector<Remark> EarlierFiles::settle(const files::OutputFolder& folder, bool clean, results::Manifest& now) const {
  if (!before_) return {};
  std::set<std::string> known;
  for (const FileRecord& file : folder.files()) known.insert(file.name);
  std::vector<FileRecord> left, removed, changed;
  for (const auto* list : {&before_->files, &before_->earlier_files})
    for (const FileRecord& file : *list) {
      const fs::path path = folder.path() / file.name;
      if (!is_in_folder(file.name) || !is_plain_file(path) || !known.insert(file.name).second) continue;
      if (!clean || now.interrupted_after_frames) {
        left.push_back(file);
        continue;
      }
      std::error_code error;
      if (fs::file_size(path, error) != file.bytes || error || !fs::remove(path, error))
        changed.push_back(file);
      else
        removed.push_back(file);
    }
  now.earlier_files = left;
  now.earlier_files.insert(now.earlier_files.end(), changed.begin(), changed.end());
  const std::string where = folder.path().native();
  std::vector<Remark> out;
  if (!removed.empty())
    out.push_back(
        {false, "", fmt::format("{} of an earlier run removed from {}: {}", count_of(removed.size()), where, names_of(removed)), ""});
  if (!changed.empty())
    out.push_back({true, "",
                   fmt::format("{} of an earlier run stay{} in {}: {}", count_of(changed.size()), changed.size() == 1 ? "s" : "", where,
                               names_of(changed)),
                   "--clean removes what is as that run wrote it"});
  if (!left.empty() && !parts_of_one_run(*before_, now))
    out.push_back(
        {true, "",
         fmt::format("{} of an earlier run lie{} in {}: {}", count_of(left.size()), left.size() == 1 ? "s" : "", where, names_of(left)),
         "who reads the whole folder mixes two runs; --clean removes them"});
  return out;
}

}  // namespace tofray::run
