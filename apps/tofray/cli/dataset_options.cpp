// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/option_values.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/units.h"

namespace tofray::app {

namespace {

void take_part(Options& o, const std::string& value) {
  const std::size_t slash = value.find('/');
  const std::string expected = "which part of how many, as in 0/4, the first, to 3/4, the last";
  if (slash == std::string::npos) refuse("--part", value, expected);
  constexpr std::uint64_t most = 1'000'000'000;
  o.shards.parts = whole("--part", value.substr(slash + 1), 1, most, expected);
  o.shards.part =
      whole("--part", value.substr(0, slash), 0, o.shards.parts - 1, fmt::format("0 to {} of {}", o.shards.parts - 1, o.shards.parts));
}

void take_shards(Options& o, const std::string& value) {
  constexpr std::uint64_t most = 1'000'000'000, most_of_range = 1'000'000;
  const std::string expected = "numbers and ranges between commas, as in 3,7-9";
  for (std::size_t from = 0; from <= value.size();) {
    const std::size_t end = std::min(value.find(',', from), value.size());
    const std::string word = value.substr(from, end - from);
    const std::size_t dash = word.find('-');
    const std::uint64_t first = whole("--shards", word.substr(0, dash), 0, most, expected);
    const std::uint64_t last =
        dash == std::string::npos ? first : whole("--shards", word.substr(dash + 1), first, first + most_of_range, expected);
    for (std::uint64_t shard = first; shard <= last; ++shard) o.shards.list.push_back(shard);
    from = end + 1;
  }
}

void take_share(Options& o, const std::string& value) {
  const base::Quantity share = base::parse_quantity(value, base::Dimension::fraction);
  const bool number = share.status == base::Quantity::Status::good || share.status == base::Quantity::Status::bare;
  if (!number || !(share.value >= 0 && share.value <= 1)) refuse("--recompute", value, "a share of the samples, as in 1% or 0.01");
  o.shards.recompute = share.value;
}

void take_sbatch(Options& o, const std::string& value) {
  if (!value.starts_with("-") || std::any_of(value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }))
    refuse("--sbatch", value, "an option of sbatch in one word, as in --sbatch=--time=2:00:00");
  o.shards.sbatch.push_back(value);
}

void take_engine(Options& o, const std::string& value) {
  if (value != "slurm" && value != "kubernetes" && value != "aws-batch") refuse("--engine", value, "slurm, kubernetes or aws-batch");
  o.shards.engine = value;
}

}  // namespace

std::vector<OptionSpec> dataset_specs() {
  constexpr std::uint64_t most = 1'000'000'000;
  return {
      {"--output", 'o', "PATH", "plan: folder for the set; scene: file; preview: .png, .svg or .pdf",
       [](Options& o, const std::string& v) { o.output = v; }, "<files>", false, "dataset"},
      {"--pilot", 0, "N", "plan: samples that are computed, to see how large and how slow they are (8)",
       [](Options& o, const std::string& v) { o.shards.pilot = whole("--pilot", v, 1, most, "a whole number of 1 to 1000000000"); }},
      {"--shard-samples", 0, "N", "plan: samples in a shard (64 MiB to 1 GiB of them, and no more than 10 minutes of a core)",
       [](Options& o, const std::string& v) {
         o.shards.samples = whole("--shard-samples", v, 1, most, "a whole number of 1 to 1000000000");
       }},
      {"--part", 0, "K/N", "run, verify: part K of N, from 0 on: the shards whose number divided by N leaves K (0/1)", take_part},
      {"--shards", 0, "LIST", "run, verify: these shards alone: 3,7-9", take_shards},
      {"--recompute", 0, "SHARE", "verify: compute so many of the samples again and compare: 0.1% (none)", take_share},
      {"--tasks", 0, "N", "submit: jobs of the array (100, or one for each shard)",
       [](Options& o, const std::string& v) { o.shards.tasks = whole("--tasks", v, 1, most, "a whole number of 1 to 1000000000"); }},
      {"--sbatch", 0, "OPTION", "submit: an option of sbatch, such as --time=2:00:00 or --partition=long; as often as you like",
       take_sbatch},
      {"--engine", 0, "NAME", "submit: slurm; with --print kubernetes or aws-batch (slurm)", take_engine, "slurm kubernetes aws-batch"},
      {"--print", 0, nullptr, "submit: print the script, submit nothing",
       [](Options& o, const std::string&) { o.shards.print_only = true; }},
      {"--partial", 0, nullptr, "merge: of the shards that are there", [](Options& o, const std::string&) { o.shards.partial = true; }},
  };
}

}  // namespace tofray::app
