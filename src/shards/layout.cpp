// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/layout.h"

#include <fmt/core.h>

namespace tofray::shards {

std::string sample_key(std::uint64_t sample, std::uint64_t view, std::uint64_t views) {
  return views > 1 ? fmt::format("{:09}-{:02}", sample, view) : fmt::format("{:09}", sample);
}

std::string shard_name(std::uint64_t shard) { return fmt::format("{:06}", shard); }
std::string shard_folder(std::uint64_t shard) { return fmt::format("shards/{:03}", shard / 1000); }
std::string tar_name(std::uint64_t shard) { return shard_folder(shard) + "/" + shard_name(shard) + ".tar"; }
std::string record_name(std::uint64_t shard) { return shard_folder(shard) + "/" + shard_name(shard) + ".json"; }

}  // namespace tofray::shards
