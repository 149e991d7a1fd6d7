// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dataset/scenes.h"
#include "dataset/stored.h"
#include "results/array_table.h"
#include "tofray/file_record.h"
#include "tofray/shards.h"

/// plan.json: all that decides the bytes of a set's samples.
namespace tofray::shards {

struct Plan {
  std::string id;                            ///< SHA-256 of all the rest but `samples`, `folder` and what is not read again
  std::string version;                       ///< of the tofray that made it
  std::string set_name, set_text;            ///< the set's file
  std::string folder;                        ///< that it lies in, from the plan's folder on
  std::vector<FileRecord> inputs;            ///< tables and files that values are drawn from, by name from `folder` on
  std::map<std::string, std::string> reads;  ///< what the pilot's samples read: SHA-256, of a mesh with the files that it names
  std::vector<std::string> arrays;
  std::uint64_t samples = 0, views = 1, shard_samples = 1;
  std::uint64_t sample_bytes = 0;
  std::string canary;

  [[nodiscard]] std::uint64_t shards() const { return (samples + shard_samples - 1) / shard_samples; }
  [[nodiscard]] std::uint64_t first_of(std::uint64_t shard) const { return shard * shard_samples; }
  [[nodiscard]] std::uint64_t count_of(std::uint64_t shard) const;
};

/// @param as  of its set, for readers: what is made follows from the set's text
std::string plan_text(const Plan& plan, const std::vector<dataset::Quantised>& as);
/// The id that a plan has to have. @param laws  SetFile::laws of its text
std::string id_of(const Plan& plan, const std::string& laws);
Plan parse_plan(std::string_view text, const std::string& where);
/// @throws Error (io) where there is none
Plan load_plan(const std::filesystem::path& folder);

/// The set of a plan, out of the text in it; tables and files are those beside the set's file.
/// @throws Error (bad_input) where one of them is another than at the plan, (io) where its folder is not there
std::unique_ptr<const dataset::Scenes> scenes_of(const Plan& plan, const std::filesystem::path& folder);

/// As the user sees it.
DatasetPlan shown(const Plan& plan, const dataset::Scenes& scenes);

/// Of the shards that are chosen, in order. @throws Error (bad_input) where there are none of these numbers
std::vector<std::uint64_t> chosen(const Plan& plan, const ShardChoice& which);

}  // namespace tofray::shards
