// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <set>

#include "shards/layout.h"
#include "shards/plan.h"
#include "shards/worker.h"

namespace tofray {

DatasetStatus dataset_status(const std::filesystem::path& folder) {
  const shards::Plan plan = shards::load_plan(folder);
  DatasetStatus out;
  out.shards = plan.shards(), out.samples = plan.samples;
  for (std::uint64_t first = 0; first < out.shards; first += 1000) {
    std::set<std::uint64_t> tars, records;
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder / shards::shard_folder(first), fault)) {
      const std::string name = entry.path().filename().native();
      std::uint64_t shard = 0;
      const auto read = std::from_chars(name.data(), name.data() + name.size(), shard);
      const std::string_view rest(read.ptr, static_cast<std::size_t>(name.data() + name.size() - read.ptr));
      if (read.ec == std::errc() && rest == ".tar") tars.insert(shard);
      if (read.ec == std::errc() && rest == ".json") records.insert(shard);
    }
    for (std::uint64_t shard = first; shard < std::min(first + 1000, out.shards); ++shard)
      if (tars.contains(shard) && records.contains(shard))
        ++out.complete;
      else
        out.missing.push_back(shard);
  }
  constexpr int deaths = 3;
  out.workers = shards::workers_at(folder), out.deadly = shards::deadly_samples(folder, deaths);
  return out;
}

}  // namespace tofray
