// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

/// Names within a set's folder: plan.json, shards/000/000012.tar with 000012.json beside it, work/ for what is under way, log/ for who computed what.
namespace tofray::shards {

/// "000000123", or "000000123-02" of a sample with several views.
std::string sample_key(std::uint64_t sample, std::uint64_t view, std::uint64_t views);

/// "000012", at least six digits.
std::string shard_name(std::uint64_t shard);
/// "shards/000": a thousand shards lie in a folder.
std::string shard_folder(std::uint64_t shard);
/// "shards/000/000012.tar".
std::string tar_name(std::uint64_t shard);
/// "shards/000/000012.json".
std::string record_name(std::uint64_t shard);

}  // namespace tofray::shards
