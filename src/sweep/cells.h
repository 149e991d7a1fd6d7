// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "tofray/error.h"
#include "tofray/sweep.h"

/// The cells of a sweep: their keys, and which have light or raw frames in common.
namespace tofray::sweeps {

class Cells {
 public:
  /// @throws Error (limit, bad_input)
  explicit Cells(const SweepRequest& request);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::size_t place(std::uint64_t cell, std::size_t axis) const;
  /// Cells whose axes before a stage have the same values, as lists of cells; all cells are in one of them.
  [[nodiscard]] std::vector<std::vector<std::uint64_t>> alike(const std::vector<std::uint64_t>& of, Stage stage) const;
  [[nodiscard]] std::vector<std::uint64_t> all() const;
  /// A scene with all of a cell's values.
  [[nodiscard]] Inputs inputs(std::uint64_t cell) const;
  /// The camera of a cell, where light of a scene is kept: `first` is the inputs of a cell that is alike before Stage::raw.
  [[nodiscard]] Camera camera(std::uint64_t cell, const Inputs& first) const;
  /// "camera.pixel.read_noise=20 e, mode=A", for messages.
  [[nodiscard]] std::string name(std::uint64_t cell) const;
  /// The error, with the cell it was met in.
  [[nodiscard]] Error in_cell(const Error& error, std::uint64_t cell) const;

 private:
  [[nodiscard]] InputRequest request_of(std::uint64_t cell) const;
  /// Of a camera that varies, unless the mode is asked for; empty: what the scene says.
  [[nodiscard]] std::string first_mode(std::uint64_t cell) const;

  const SweepRequest& request_;
  std::uint64_t count_ = 1;
  std::vector<std::vector<std::string>> keys_;  ///< by axis: with what * means; empty: it depends on the cell
  bool late_are_plain_ = true;                  ///< keys that light does not depend on are numbers and switches of the camera
};

}  // namespace tofray::sweeps
