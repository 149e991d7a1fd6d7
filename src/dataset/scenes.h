// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "dataset/forms.h"
#include "dataset/set_file.h"
#include "tofray/dataset.h"
#include "tofray/scene.h"

namespace tofray::dataset {

/// A set, and the scenes of its samples.
class Scenes {
 public:
  /// @param source  the set's file, which messages name and beside which other files are looked for
  /// @throws Error with line and column
  Scenes(std::string_view text, const std::string& source);
  Scenes(const Scenes&) = delete;
  Scenes& operator=(const Scenes&) = delete;

  [[nodiscard]] const SetFile& set() const { return set_; }
  [[nodiscard]] const Fixed& fixed() const { return fixed_; }
  // As Dataset's.
  [[nodiscard]] std::string yaml(std::uint64_t sample, std::uint64_t view) const;
  [[nodiscard]] Scene scene(std::uint64_t sample, std::uint64_t view) const;
  [[nodiscard]] std::vector<Drawn> drawn(std::uint64_t sample, std::uint64_t view) const;
  [[nodiscard]] std::uint64_t noise_seed(std::uint64_t sample, std::uint64_t view) const;

  [[nodiscard]] Split split(std::uint64_t sample) const;
  /// Adds what was drawn for a view before anything was refused, by its place in its law: `accept` and places bend laws, samplers do not.
  void judge(std::uint64_t sample, std::uint64_t view, Judgement& into) const;

  /// A sample's scene, and what was drawn for it.
  struct Written {
    yaml::Node tree;  ///< each value stands where its form stands in the set's file
    std::vector<Drawn> drawn;
    Judgement judged;  ///< as judge() adds it; of a set that refuses nothing
  };
  [[nodiscard]] Written write(std::uint64_t sample, std::uint64_t view) const;
  /// The scene that was written. @throws Error with line and column
  [[nodiscard]] Scene read(const Written& written, std::uint64_t sample, std::uint64_t view) const;
  /// What messages call a sample's scene; its folder is the set's.
  [[nodiscard]] std::string source(std::uint64_t sample, std::uint64_t view) const;

 private:
  [[nodiscard]] Scene read(yaml::Node tree, std::uint64_t sample, std::uint64_t view) const;
  void refuse_unknown(std::uint64_t sample, std::uint64_t view) const;
  [[nodiscard]] Sample at(std::uint64_t sample, std::uint64_t view, std::uint32_t attempt = 0) const;
  [[nodiscard]] Written write_attempt(std::uint64_t sample, std::uint64_t view, std::uint32_t attempt) const;
  /// Which rule of `accept` an attempt breaks. @throws NoRoom
  [[nodiscard]] std::optional<std::size_t> broken_rule_of(std::uint64_t sample, std::uint64_t view, std::uint32_t attempt) const;
  /// The first attempt that the set's `accept` takes. @throws Error (bad_input) where it takes none
  [[nodiscard]] std::uint32_t accepted(std::uint64_t sample) const;
  SetFile set_;
  Fixed fixed_;  ///< points into the set
  mutable std::mutex mutex_;
  mutable std::map<std::uint64_t, std::uint32_t> accepted_;  ///< of the last samples; guarded by the mutex
};

}  // namespace tofray::dataset
