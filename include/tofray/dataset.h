// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tofray/scene.h"

/// Data sets: a file that says what varies, of which each sample is a scene that anyone can make again. As load.h, of libtofray_files.
namespace tofray {

/// A value that was drawn for a sample.
struct Drawn {
  std::string path;  ///< path of the key, by the names of objects where they have names: "objects/ball/radius"
  std::string form;  ///< uniform, choice, …
  std::string text;  ///< the value as it stands in the scene; empty where the key is left out
  double value = 0;  ///< of a number in the unit of `text`; of a choice, grid, file or row which one it is, from 0; of a chance 0 or 1
};

/// A set whose samples are scenes. What is drawn for a value depends on the set's seed, the sample (or the view, the device, as its `per` says) and the path of its key
/// alone: the same in any order, on any machine, and whatever else is changed in the set's file.
///
/// A draw takes the 64 bits that Philox4x32-10 (Salmon et al. 2011) makes of the seed as key and the counter (sample's lower 32 bits; its upper 8, view, attempt;
/// the first 8 bytes of the path's SHA-256).
class Dataset {
 public:
  /// Reads a set's file, the tables and the names of the files that it draws from. @throws Error with line and column
  explicit Dataset(const std::string& file);

  [[nodiscard]] const std::string& name() const;
  [[nodiscard]] const std::string& license() const;  ///< SPDX name of the license; empty where the file says none
  [[nodiscard]] std::uint64_t samples() const;
  [[nodiscard]] std::uint64_t views() const;  ///< views of each sample
  /// Combinations of the set's grids; 1 where it has none. Sample i has the combination i modulo this.
  [[nodiscard]] std::uint64_t combinations() const;

  /// The scene of a sample as YAML: rendering it makes the sample's bytes. @throws Error with line and column of the set's file, (bad_input) for a sample or view that is not there
  [[nodiscard]] std::string scene_yaml(std::uint64_t sample, std::uint64_t view = 0) const;
  /// The scene of a sample, read. @throws Error as load_scene()
  [[nodiscard]] Scene scene(std::uint64_t sample, std::uint64_t view = 0) const;
  /// What was drawn for it, in the order of the file.
  [[nodiscard]] std::vector<Drawn> drawn(std::uint64_t sample, std::uint64_t view = 0) const;
  /// Seed of the noise of its frames (FrameRequest::seed, `--seed`): another one for each sample and view, so that no two have the same noise.
  [[nodiscard]] std::uint64_t noise_seed(std::uint64_t sample, std::uint64_t view = 0) const;
  /// "train", "validation" or "test": what the set's `split` makes of the sample's number, before anything else is drawn; "train" without `split`.
  [[nodiscard]] std::string split(std::uint64_t sample) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace tofray
