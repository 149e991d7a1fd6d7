// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "tofray/options.h"

/// Data sets in files: a plan, and shards of samples, which any number of processes and machines make together. As load.h, of libtofray_files.
///
/// The plan is the set; shards are what has been computed of it. A shard is a tar of plain .npy and .json files; a record beside it exists exactly when it is
/// complete, and nothing else is state: a process that is killed, or makes the same shard twice, leaves the same bytes.
namespace tofray {

/// What a set's plan is made of.
struct PlanRequest {
  std::string set;               ///< the set's file
  std::filesystem::path folder;  ///< folder for the plan and its shards
  std::uint64_t pilot = 8;       ///< samples that are computed, spread over the set, to see how large and how slow they are; at least 1
  /// Samples in a shard; 0: so many that a shard has 64 MiB to 1 GiB and takes one core at most 10 minutes, as the pilot was.
  std::uint64_t shard_samples = 0;
  int threads = 0;                    ///< 0: one per core
  FrameProgress* progress = nullptr;  ///< its `stop` ends the pilot with an Error
};

/// A set as plan.json holds it.
struct DatasetPlan {
  std::string id;  ///< SHA-256 of all that decides bytes of samples; not of how many there are
  std::string name, license;
  std::uint64_t samples = 0, views = 1, shard_samples = 0, shards = 0;
  std::vector<std::string> arrays;  ///< arrays of every sample
  std::uint64_t sample_bytes = 0;   ///< bytes of one sample with all its views in a shard: the pilot's mean
  /// What plan_dataset() found in the folder.
  enum class Found { nothing, same, fewer_samples } found = Found::nothing;
  // of the pilot; 0 where the same plan was there
  double sample_seconds = 0;               ///< seconds of one core per sample, mean
  std::uint64_t pixels = 0, valid = 0;     ///< pixels of all its frames, and those with depth
  std::uint64_t pilot = 0;                 ///< samples that it has
  double least_valid = 1, most_valid = 0;  ///< shares of one view's pixels
  std::uint64_t peak_bytes = 0;            ///< most memory that this process has taken, with as many threads as were asked for
};

/// Looks at the set, computes a pilot and writes plan.json. Where there is a plan already: the same one is left as it is, one with fewer samples is extended (shards
/// stay, but for a short last one).
/// @throws Error (bad_input) with the key that differs where the folder has another plan; with line and column of the set's file
DatasetPlan plan_dataset(const PlanRequest& request);

/// @throws Error (io, bad_input) where there is no plan.json, or none that this can read
DatasetPlan read_plan(const std::filesystem::path& folder);

/// Which shards of a plan: those whose number modulo `parts` is `part`, and of them the listed ones.
struct ShardChoice {
  std::uint64_t part = 0, parts = 1;
  std::vector<std::uint64_t> shards = {};  ///< empty: all
};

/// What a process is to make of a set.
struct ShardRunRequest {
  std::filesystem::path folder;
  ShardChoice which = {};
  int threads = 0;                    ///< samples at once; 0: one per core
  FrameProgress* progress = nullptr;  ///< its `stop` ends the run; complete shards stay
};

/// A shard that was made.
struct ShardMade {
  std::uint64_t shard = 0, samples = 0, holes = 0, bytes = 0;
  bool by_another = false;  ///< another process published the same bytes first
};

/// What it made.
struct ShardRunResult {
  std::uint64_t made = 0, there = 0, samples = 0,
                holes = 0;      ///< shards that were made and that were complete before; samples in those that were made
  bool too_many_holes = false;  ///< more than the set's `holes` allows
  bool interrupted = false;
};

/// Callbacks while shards are made or read. All of them may be left empty.
struct ShardWatch {
  std::function<void(std::uint64_t done, std::uint64_t total)> samples =
      {};  ///< of the shards that are to be made; of verify_shards(): shards
  std::function<void(const ShardMade&)> shard = {};
};

/// Makes the shards that are missing. Each process first renders a frame of many features and compares its SHA-256 with the plan's.
/// @throws Error (bad_input) where that differs, or a file of the set is another one than at the plan; (io)
ShardRunResult run_shards(const ShardRunRequest& request, const ShardWatch& watch = {});

/// How far a set is.
struct DatasetStatus {
  std::uint64_t shards = 0, complete = 0, samples = 0;  ///< as planned; shards that are there; samples as planned
  std::vector<std::uint64_t> missing;                   ///< shards
  std::uint64_t workers = 0;                            ///< folders of processes that are at work, or were killed
  /// Samples that at least three processes were computing when they ended without a word.
  std::vector<std::uint64_t> deadly;
};

/// By names of files alone. @throws Error as read_plan()
DatasetStatus dataset_status(const std::filesystem::path& folder);

/// Which shards are compared with their records, and how much of them is computed again.
struct VerifyRequest {
  std::filesystem::path folder;
  ShardChoice which = {};
  double recompute = 0;  ///< share of the samples that are computed again and compared, 0…1
  int threads = 0;
  FrameProgress* progress = nullptr;
};

/// What is wrong with a shard.
struct ShardFault {
  std::uint64_t shard = 0;
  std::string what;
  std::vector<std::string> members;  ///< members of the tar that are damaged or differ: "000000123.raw.npy"
};

/// What was found.
struct VerifyResult {
  std::uint64_t shards = 0, missing = 0, recomputed = 0;  ///< that were read; that are not there; samples
  std::vector<ShardFault> faults;
  bool interrupted = false;
};

/// Reads shards and compares them with their records. The record of one that is damaged is set aside (its name gets .damaged behind it): run_shards() makes it again.
/// @throws Error as read_plan()
VerifyResult verify_shards(const VerifyRequest& request, const ShardWatch& watch = {});

/// A set, summed up.
struct MergeResult {
  std::uint64_t shards = 0, samples = 0, holes = 0, bytes = 0;
  std::uint64_t pixels = 0, valid = 0;
  /// Keys whose values miss the law that they are drawn by (χ² that right draws exceed once in a million times), and by how much; empty where none does.
  std::string missed_laws;
  std::vector<std::string>
      files;  ///< that were written: SHA256SUMS, statistics.json, wids.json, card.md, croissant.json, preview.html, index/…
};

/// Sums up a set that is complete: index, statistics, SHA256SUMS and a list for the webdataset library. The same bytes whichever processes made the shards.
/// @param partial  of the shards that are there
/// @throws Error (bad_input) where shards are missing, or two of them read different files of one name
MergeResult merge_shards(const std::filesystem::path& folder, bool partial = false);

}  // namespace tofray
