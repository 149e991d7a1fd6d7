// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "files/npy.h"

/// The arrays of frame.npz: those of a frame (tofray/frame_arrays.h) and what goes with them into the file. (`meta`, a text, is always
/// there.)
namespace tofray::results {

struct ArrayRow {
  std::string name;
  files::NpyType type;
  std::string shape;  ///< "[phase, height, width]"; "[]": one number
  std::string unit;   ///< "W/(m2 sr)"; "1": none
  std::string from;   ///< what it comes from: a stage of the pipeline, or "scene", "camera"
  std::string what;   ///< one sentence
  [[nodiscard]] bool is_truth() const { return name.starts_with("gt_") || name.starts_with("transient_"); }
  /// One value or more for each pixel.
  [[nodiscard]] bool is_image() const { return shape.find("width") != std::string::npos; }
};

/// In the order of the file.
const std::vector<ArrayRow>& array_table();
/// The row of that name, or none.
const ArrayRow* find_array(std::string_view name);

/// "there is no array raww; did you mean raw?"; empty where a name or a pattern fits one.
std::string why_no_array(const std::string& word);

/// docs/reference/arrays.md.
std::string array_reference();

/// Which arrays a file gets. What comes along whatever is chosen, a few numbers by raw frame and of the camera, is what `process` and
/// `inspect` need to understand the others.
class ArrayChoice {
 public:
  /// All of them.
  ArrayChoice() = default;
  /// @param words  names, or patterns in which * stands for any letters, between commas: "raw,z_m,gt_*"
  /// @throws Error (bad_input) for a word that fits no array, with the nearest name
  explicit ArrayChoice(const std::string& words);

  [[nodiscard]] bool has(const ArrayRow& row) const;
  [[nodiscard]] bool is_all() const { return all_; }
  /// Arrays that were asked for by their own name.
  [[nodiscard]] const std::vector<std::string>& named() const { return named_; }
  /// Whether any of the ground truth is in it.
  [[nodiscard]] bool has_truth() const;

 private:
  bool all_ = true;
  std::vector<std::string> names_, named_;
};

}  // namespace tofray::results
