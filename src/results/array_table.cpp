// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/array_table.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "tofray/error.h"
#include "tofray/flags.h"
#include "tofray/frame_arrays.h"

namespace tofray::results {

using files::npy_type_of;
using files::NpyType;

namespace {

const char* shape_of(ArrayShape shape) {
  switch (shape) {
    case ArrayShape::image: return "[height, width]";
    case ArrayShape::pairs: return "[height, width, 2]";
    case ArrayShape::vectors: return "[height, width, 3]";
    case ArrayShape::stack: return "[phase, height, width]";
    case ArrayShape::moved: return "[phase, height, width, 2]";
    case ArrayShape::by_frequency: return "[frequency, height, width]";
    case ArrayShape::bins: return "[bin, height, width]";
    case ArrayShape::list: return "[phase]";
  }
  return "";
}

const char* name_of(Stage stage) {
  switch (stage) {
    case Stage::trace: return "trace";
    case Stage::power: return "power";
    case Stage::raw: return "raw";
    case Stage::depth: return "depth";
  }
  return "";
}

std::vector<ArrayRow> make_table() {
  std::vector<ArrayRow> rows;
  const NpyType number = npy_type_of<double>();
#define TOFRAY_ROW(name, part, member, element, shape, stage, when, unit, what) \
  rows.push_back({#name, npy_type_of<element>(), shape_of(ArrayShape::shape), unit, name_of(Stage::stage), what});
  TOFRAY_RAW_ARRAYS(TOFRAY_ROW)
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_ROW)
  rows.back().type = npy_type_of<bool>();  // `lit`: a byte in memory, which has no arrays of bool
  TOFRAY_DEPTH_ARRAYS(TOFRAY_ROW)
  rows.push_back({"gt_time_s", number, "[]", "s", "trace", "time of the ground truth"});
  TOFRAY_TRUTH_ARRAYS(TOFRAY_ROW)
#undef TOFRAY_ROW
  rows.push_back({"camera_matrix", number, "[3, 3]", "px", "camera", "fx, 0, cx; 0, fy, cy; 0, 0, 1"});
  rows.push_back({"distortion", number, "[5]", "1", "camera",
                  "k1, k2, p1, p2, k3; of a rational lens [8], k4, k5, k6 behind them; of a fisheye [4], k1 to k4"});
  rows.push_back({"camera_pose", number, "[4, 4]", "m", "scene", "camera to world; the last row is 0, 0, 0, 1"});
  return rows;
}

/// Whether a name fits a pattern in which * stands for any letters, or none.
bool fits(std::string_view name, std::string_view pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return name == pattern;
  if (!name.starts_with(pattern.substr(0, star))) return false;
  for (std::size_t from = star; from <= name.size(); ++from) {
    if (fits(name.substr(from), pattern.substr(star + 1))) return true;
  }
  return false;
}

}  // namespace

const std::vector<ArrayRow>& array_table() {
  static const std::vector<ArrayRow> table = make_table();
  return table;
}

const ArrayRow* find_array(std::string_view name) {
  for (const ArrayRow& row : array_table()) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

std::string why_no_array(const std::string& word) {
  std::vector<std::string> known;
  for (const ArrayRow& row : array_table()) {
    if (fits(row.name, word)) return {};
    known.push_back(row.name);
  }
  return fmt::format("there is no array {}{}", base::in_quotes(word), base::did_you_mean(word, known));
}

ArrayChoice::ArrayChoice(const std::string& words) : all_(false) {
  for (std::size_t from = 0; from <= words.size();) {
    const std::size_t end = std::min(words.find(',', from), words.size());
    const std::string word = words.substr(from, end - from);
    const std::size_t before = names_.size();
    for (const ArrayRow& row : array_table())
      if (fits(row.name, word)) names_.push_back(row.name);
    if (names_.size() == before)
      throw Error(ErrorKind::bad_input, fmt::format("error: {}\n  expected names or patterns between commas, as in raw,z_m,gt_*; "
                                                    "`tofray list arrays` has them all",
                                                    why_no_array(word)));
    if (names_.size() == before + 1 && names_.back() == word) named_.push_back(word);
    from = end + 1;
  }
}

bool ArrayChoice::has(const ArrayRow& row) const {
  if (row.name == "gt_time_s") return has_truth();
  return all_ || !row.is_image() || std::find(names_.begin(), names_.end(), row.name) != names_.end();
}

bool ArrayChoice::has_truth() const {
  return all_ || std::any_of(names_.begin(), names_.end(), [](const std::string& name) { return find_array(name)->is_truth(); });
}

namespace {

std::string flag_reference() {
  std::string text =
      "\n## Bits of flags\n\nThe first reason in this order that is set explains why a pixel has no depth; `inspect`, legends and the "
      "viewer call it by its words.\n\n"
      "| bit | name | words | depth | what has happened | what helps |\n|---|---|---|---|---|---|\n";
#define TOFRAY_LINE(name, bit, invalid, letter, dark, light, words, what, advice) \
  text += fmt::format("| {} | `{}` | {} | {} | {} | {} |\n", bit, #name, words, (invalid) != 0 ? "none" : "stays", what, advice);
  TOFRAY_FLAGS(TOFRAY_LINE)
#undef TOFRAY_LINE
  return text;
}

}  // namespace

std::string array_reference() {
  std::string text =
      "<!-- SPDX-FileCopyrightText: 2026 The tofray authors -->\n"
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      "# Every array of frame.npz\n\n"
      "Written by `tofray list arrays` from the table that the code takes its arrays from. `tofray render --arrays raw,z_m,gt_*`\n"
      "chooses. What has no pixels (`[phase]`, `[3, 3]` …) is small and always there, and so is `meta`, a text (JSON): version, seed,\n"
      "noise, number of the frame, units, and the camera and the scene with all their numbers.\n\n"
      "Arrays are row-major; invalid values are NaN in floats and 0 in integers. Camera frame: x right, y down, z forward. What begins\n"
      "with `gt_` or `transient_` is ground truth at the middle of the middle raw frame. Words at the end of a line say when a frame has\n"
      "the array: with sub-pixel samples, with bounces, with transient histograms, or only where it is asked for by name. In C++ the same\n"
      "arrays are members of `Frame::raw`, `Frame::depth` and `Frame::truth` (there without `gt_`).\n\n"
      "| array | type | shape | unit | from | what it is |\n|---|---|---|---|---|---|\n";
  for (const ArrayRow& row : array_table())
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", row.name, row.type.name(), row.shape, row.unit, row.from, row.what);
  return text + flag_reference();
}

}  // namespace tofray::results
