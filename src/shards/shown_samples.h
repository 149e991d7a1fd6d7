// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "files/json.h"
#include "shards/record.h"

/// A few samples of a set, as people look at them.
namespace tofray::shards {

/// One view of a sample: what its JSON says, and its picture.
struct ShownSample {
  std::uint64_t sample = 0, view = 0, pixels = 0, valid = 0;
  files::Json about;
  std::string png;  ///< z_m in colours, gt_z_m where that is not stored; empty where neither is
};

/// Notes which samples to show while records go by: some spread evenly over the set, and those with the fewest valid pixels.
class ShownSamples {
 public:
  ShownSamples(const std::filesystem::path& folder, std::uint64_t rows) : folder_(folder), rows_(rows) {}
  void add(const Record& record, const Record::Sample& sample, std::uint64_t row);

  /// Reads them. @throws Error (io) where a tar is not there any more
  [[nodiscard]] std::vector<ShownSample> spread() const;
  /// Samples with the fewest valid pixels, the worst one first; of as many the lower number.
  [[nodiscard]] std::vector<ShownSample> worst() const;

 private:
  struct Place {
    std::uint64_t shard = 0;
    Record::Sample sample;
    [[nodiscard]] double share() const {
      return sample.pixels == 0 ? 0 : static_cast<double>(sample.valid) / static_cast<double>(sample.pixels);
    }
  };
  [[nodiscard]] std::vector<ShownSample> read(const std::vector<Place>& places) const;

  const std::filesystem::path& folder_;
  std::uint64_t rows_;
  std::vector<Place> spread_, worst_;
};

}  // namespace tofray::shards
