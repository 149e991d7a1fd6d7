// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "base/text.h"
#include "cli/console.h"
#include "cli/options.h"
#include "results/file_arrays.h"
#include "run/input_kind.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

namespace fs = std::filesystem;

/// What became of one array from A to B.
struct ArrayDiff {
  std::string name, unit;
  std::string other;  ///< where values cannot be compared: why
  std::size_t values = 0, differ = 0;
  double largest = 0;           ///< difference of two finite values
  std::size_t not_numbers = 0;  ///< of those that differ: NaN or infinite in A or B
  [[nodiscard]] bool same() const { return other.empty() && differ == 0; }
};

struct FileDiff {
  std::string a, b;
  std::vector<ArrayDiff> arrays;
  [[nodiscard]] bool same() const {
    return std::all_of(arrays.begin(), arrays.end(), [](const ArrayDiff& one) { return one.same(); });
  }
};

struct Diff {
  std::vector<FileDiff> files;
  std::vector<std::string> only_in_a, only_in_b;  ///< names of files
  [[nodiscard]] bool same() const {
    return only_in_a.empty() && only_in_b.empty() &&
           std::all_of(files.begin(), files.end(), [](const FileDiff& one) { return one.same(); });
  }
};

/// NaN is the same as NaN, and 0 as −0.
void compare_values(const files::NpyArray& a, const files::NpyArray& b, ArrayDiff& diff) {
  const auto size = static_cast<std::size_t>(a.type.size);
  for (std::size_t i = 0; i < diff.values; ++i) {
    if (a.bytes.compare(i * size, size, b.bytes, i * size, size) == 0) continue;
    const double x = a.number(i), y = b.number(i);
    if (a.type.kind == 'f' && (x == y || (std::isnan(x) && std::isnan(y)))) continue;
    ++diff.differ;
    if (std::isfinite(x) && std::isfinite(y))
      diff.largest = std::max(diff.largest, std::abs(x - y));
    else
      ++diff.not_numbers;
  }
}

ArrayDiff diff_of(const std::string& name, const files::NpyArray& a, const files::NpyArray& b) {
  ArrayDiff diff{name, {}, {}, a.count(), 0, 0, 0};
  const bool texts = a.type.kind == 'U' && b.type.kind == 'U';
  if (texts && a.bytes != b.bytes)
    diff.other = "another text";
  else if (a.type != b.type && !texts)
    diff.other = fmt::format("{}, then {}", a.type.name(), b.type.name());
  else if (a.shape != b.shape)
    diff.other = fmt::format("{}, then {}", files::shape_text(a.shape), files::shape_text(b.shape));
  else if (!texts)
    compare_values(a, b, diff);
  return diff;
}

FileDiff diff_of_files(const std::string& a, const std::string& b) {
  const results::Arrays before = results::read_arrays(a), after = results::read_arrays(b);
  FileDiff diff{a, b, {}};
  for (const files::NamedArray& one : before.all()) {
    const files::NpyArray* there = after.find(one.name);
    diff.arrays.push_back(there != nullptr ? diff_of(one.name, one.array, *there)
                                           : ArrayDiff{one.name, {}, "only in the first", 0, 0, 0, 0});
    diff.arrays.back().unit = before.unit(one.name);
  }
  for (const files::NamedArray& one : after.all()) {
    if (before.find(one.name) == nullptr) diff.arrays.push_back({one.name, after.unit(one.name), "only in the second", 0, 0, 0, 0});
  }
  return diff;
}

/// Files of arrays by name, one after the other.
Diff diff_of_folders(const std::string& a, const std::string& b) {
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  const std::vector<std::string> here = run::names_in(a, {".npz", ".npy"}, all), there = run::names_in(b, {".npz", ".npy"}, all);
  if (here.empty() && there.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: there are no arrays in this folder, and none in {}\n  expected .npz or .npy files",
                            base::printable(a), base::printable(b)));
  Diff diff;
  std::set_difference(here.begin(), here.end(), there.begin(), there.end(), std::back_inserter(diff.only_in_a));
  std::set_difference(there.begin(), there.end(), here.begin(), here.end(), std::back_inserter(diff.only_in_b));
  for (const std::string& name : here) {
    if (std::binary_search(there.begin(), there.end(), name))
      diff.files.push_back(diff_of_files((fs::path(a) / name).native(), (fs::path(b) / name).native()));
  }
  return diff;
}

Diff diff_of(const std::string& a, const std::string& b) {
  if (run::is_folder(a) && run::is_folder(b)) return diff_of_folders(a, b);
  return {{diff_of_files(run::frame_in(a, "diff"), run::frame_in(b, "diff"))}, {}, {}};
}

std::string text_of(const ArrayDiff& one) {
  if (!one.other.empty()) return one.other;
  if (one.differ == 0) return "same";
  std::string text = fmt::format("{} of {} differ", one.differ, one.values);
  if (one.differ > one.not_numbers)
    text += fmt::format(", by up to {:.6g}{}", one.largest, one.unit.empty() || one.unit == "1" ? "" : " " + one.unit);
  if (one.not_numbers > 0) text += fmt::format(", {} of them NaN or infinite in one of the two", one.not_numbers);
  return text;
}

std::string text_of(const Diff& diff) {
  std::string text;
  for (const FileDiff& file : diff.files) {
    text += fmt::format("{}, {}: {}\n", file.a, file.b, file.same() ? "same" : "different");
    for (const ArrayDiff& one : file.arrays) text += fmt::format("  {:<24} {}\n", one.name, text_of(one));
  }
  for (const std::string& name : diff.only_in_a) text += fmt::format("{}: only in the first folder\n", name);
  for (const std::string& name : diff.only_in_b) text += fmt::format("{}: only in the second folder\n", name);
  return text;
}

files::Json json_of(const FileDiff& file) {
  files::Json arrays = files::Json::array();
  for (const ArrayDiff& one : file.arrays) {
    files::Json json = files::Json::object().set("name", one.name).set("same", one.same());
    if (!one.other.empty())
      json.set("other", one.other);
    else
      json.set("values", one.values)
          .set("differ", one.differ)
          .set("largest_difference", one.largest)
          .set("not_finite", one.not_numbers)
          .set("unit", one.unit);
    arrays.push(std::move(json));
  }
  return files::Json::object().set("a", file.a).set("b", file.b).set("same", file.same()).set("arrays", std::move(arrays));
}

files::Json json_of(const Diff& diff) {
  files::Json files = files::Json::array();
  for (const FileDiff& file : diff.files) files.push(json_of(file));
  return files::Json::object()
      .set("same", diff.same())
      .set("files", std::move(files))
      .set("only_in_a", files::Json::list(diff.only_in_a))
      .set("only_in_b", files::Json::list(diff.only_in_b));
}

}  // namespace

int run_diff(const Options& options) {
  const Diff diff = diff_of(options.words[0], options.words[1]);
  print(options.json ? files::json_text(json_of(diff), 2) + "\n" : text_of(diff));
  return diff.same() ? 0 : 1;
}

}  // namespace tofray::app
