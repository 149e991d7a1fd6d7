// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "files/json.h"
#include "files/npz.h"

namespace tofray::results {

/// The arrays of one file, by name, and what `meta` says about them.
class Arrays {
 public:
  /// @param where  the file, for messages
  Arrays(std::vector<files::NamedArray> arrays, std::string where);

  [[nodiscard]] const std::string& where() const { return where_; }
  [[nodiscard]] const std::vector<files::NamedArray>& all() const { return arrays_; }
  [[nodiscard]] const files::NpyArray* find(std::string_view name) const;
  /// Element i of an array as a number; NaN where there is no such array or element.
  [[nodiscard]] double at(std::string_view name, std::size_t i) const;
  /// `meta` as a document; null where there is none.
  [[nodiscard]] const files::Json& meta() const { return meta_; }
  [[nodiscard]] const std::string& meta_text() const { return meta_text_; }
  [[nodiscard]] std::string unit(const std::string& name) const;
  /// Columns and rows of the image and how many raw frames; 0 where no array says.
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t height() const { return height_; }
  [[nodiscard]] std::size_t phases() const { return phases_; }

 private:
  std::string where_;
  std::vector<files::NamedArray> arrays_;
  std::string meta_text_;
  files::Json meta_;
  std::size_t width_ = 0, height_ = 0, phases_ = 0;
};

/// Whether a file is called like one of arrays: .npz or .npy.
bool holds_arrays(const std::string& path);
/// The arrays of a .npz file, or that of a .npy file as "array". @throws Error as read_npz and read_npy
Arrays read_arrays(const std::string& path);

/// A pixel's flags out of the number that a file holds; 0 where it holds none.
unsigned flag_bits(double number);

}  // namespace tofray::results
