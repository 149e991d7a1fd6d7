// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/shards.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "base/parallel.h"
#include "base/text.h"
#include "cli/console.h"
#include "cli/progress.h"
#include "cli/remarks.h"
#include "files/json.h"
#include "tofray/error.h"
#include "tofray/shards.h"

namespace tofray::app {

namespace {

using files::Json;

std::string set_size_text(double bytes) {
  const char* units[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < std::size(units)) bytes /= 1000, ++unit;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string core_time_text(double seconds) {
  if (seconds < 120) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200) return fmt::format("{:.3g} minutes", seconds / 60);
  return fmt::format("{:.3g} hours", seconds / 3600);
}

/// "3, 7-9 and 12 more".
std::string ranges_text(const std::vector<std::uint64_t>& numbers) {
  std::string text;
  constexpr int most = 8;
  std::size_t i = 0;
  for (int told = 0; i < numbers.size() && told < most; ++told) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[i]);
    if (last > i) text += fmt::format("-{}", numbers[last]);
    i = last + 1;
  }
  return i < numbers.size() ? text + fmt::format(" and {} more", numbers.size() - i) : text;
}

std::string counted(std::uint64_t count, const char* what) { return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s"); }

std::string folder_of(const Options& options) { return base::printable(options.words[1]); }

ShardChoice choice_of(const Options& options) { return {options.shards.part, options.shards.parts, options.shards.list}; }

}  // namespace

int run_dataset_plan(const Options& options) {
  if (options.output.empty())
    throw Error(ErrorKind::bad_input,
                "error: a plan needs a folder\n  expected -o with it, as in `tofray dataset plan corners.yaml -o corners`");
  FrameProgress now;
  const StopRequest stop(&now.stop);
  PlanRequest request{options.words[1], options.output, options.shards.pilot, options.shards.samples, options.threads, &now};
  DatasetPlan plan;
  try {
    plan = plan_dataset(request);
  } catch (const Error&) {
    if (stop.signal() == 0) throw;
    say("interrupted: no plan is written\n");
    return 128 + stop.signal();
  }
  const double bytes = static_cast<double>(plan.sample_bytes) * static_cast<double>(plan.samples);
  const double core_seconds = plan.sample_seconds * static_cast<double>(plan.samples);
  Remarks remarks;
  if (plan.license.empty())
    remarks.tell("warning: the set says no licence\n  who is to use it has to know: license: CC-BY-4.0, or another SPDX name\n");
  const double valid = plan.pixels == 0 ? 1 : static_cast<double>(plan.valid) / static_cast<double>(plan.pixels);
  constexpr double few = 0.05;
  if (valid < few)
    remarks.tell(fmt::format(
        "warning: {:.1f} % of the pilot's pixels have a depth\n  `tofray dataset preview {} -o preview.png` shows the first samples\n",
        100 * valid, base::printable(options.words[1])));
  const char* found = plan.found == DatasetPlan::Found::nothing ? "new" : plan.found == DatasetPlan::Found::same ? "same" : "extended";
  if (options.json) {
    Json json = Json::object();
    json.set("found", found)
        .set("id", plan.id)
        .set("name", plan.name)
        .set("license", plan.license)
        .set("samples", plan.samples)
        .set("views", plan.views);
    json.set("shards", plan.shards)
        .set("shard_samples", plan.shard_samples)
        .set("arrays", Json::list(plan.arrays))
        .set("sample_bytes", plan.sample_bytes);
    json.set("bytes", bytes).set("sample_seconds", plan.sample_seconds).set("core_seconds", core_seconds).set("valid", valid);
    json.set("pilot", plan.pilot).set("least_valid", plan.least_valid).set("most_valid", plan.most_valid);
    json.set("peak_bytes", plan.peak_bytes);
    print(files::json_text(remarks.put(json), 2) + "\n");
    return 0;
  }
  std::string text = fmt::format("{}: {}{}, {} of {}\n", base::printable(plan.name), counted(plan.samples, "sample"),
                                 plan.views > 1 ? fmt::format(" of {} views", plan.views) : "", counted(plan.shards, "shard"),
                                 counted(plan.shard_samples, "sample"));
  text += fmt::format("  arrays   {}\n  size     {} ({} a sample)\n", base::listed(plan.arrays, "and"), set_size_text(bytes),
                      set_size_text(static_cast<double>(plan.sample_bytes)));
  if (plan.found == DatasetPlan::Found::nothing)
    text += fmt::format(
        "  time     {} of one core ({:.3g} ms a sample)\n  memory   {} at most, of this process\n"
        "  valid    {:.1f} % of the pixels of {} looked at ({:.0f} to {:.0f} %)\n",
        core_time_text(core_seconds), 1000 * plan.sample_seconds, set_size_text(static_cast<double>(plan.peak_bytes)), 100 * valid,
        counted(plan.pilot, "sample"), 100 * plan.least_valid, 100 * plan.most_valid);
  if (plan.found == DatasetPlan::Found::same) text += "  the same plan was there\n";
  if (plan.found == DatasetPlan::Found::fewer_samples) text += "  the plan that was there has more samples now\n";
  print(text);
  Talk(options.quiet)(fmt::format("next: tofray dataset run {}\n", base::printable(options.output)));
  return 0;
}

int run_dataset_run(const Options& options) {
  FrameProgress now;
  const StopRequest stop(&now.stop);
  std::optional<Progress> progress;
  std::uint64_t shown = 0;
  ShardWatch watch;
  watch.samples = [&](std::uint64_t done, std::uint64_t total) {
    if (!progress) progress.emplace(total, "samples", options.quiet || options.json);
    for (; shown < done; ++shown) progress->step();
  };
  watch.shard = [&](const ShardMade& made) {
    if (!options.json) return;
    Json json = Json::object();
    json.set("shard", made.shard)
        .set("samples", made.samples)
        .set("holes", made.holes)
        .set("bytes", made.bytes)
        .set("by_another", made.by_another);
    print(files::json_text(json) + "\n");
  };
  const ShardRunRequest request{options.words[1], choice_of(options), options.threads, &now};
  const ShardRunResult result = run_shards(request, watch);
  progress.reset();
  if (result.interrupted) {
    say(fmt::format("interrupted: {} more are complete; the same command makes the others\n", counted(result.made, "shard")));
    return 128 + stop.signal();
  }
  Talk(options.quiet ||
       options.json)(fmt::format("{} made, {} there before{}\n", counted(result.made, "shard"), result.there,
                                 result.holes > 0 ? fmt::format("; {} without a scene: holes", counted(result.holes, "sample")) : ""));
  if (result.too_many_holes)
    say(
        fmt::format("error: {} of {} samples have no scene, more than the set's `holes` allows\n  the records in {}/shards say why, "
                    "`tofray dataset scene` shows one\n",
                    result.holes, result.samples + result.holes, folder_of(options)));
  return result.too_many_holes ? 1 : 0;
}

int run_dataset_status(const Options& options) {
  const DatasetStatus status = dataset_status(options.words[1]);
  if (options.json) {
    Json json = Json::object();
    json.set("shards", status.shards)
        .set("complete", status.complete)
        .set("samples", status.samples)
        .set("missing", Json::list(status.missing));
    print(files::json_text(json.set("workers", status.workers).set("deadly", Json::list(status.deadly))) + "\n");
  } else {
    std::string text = fmt::format("{} of {} complete\n", status.complete, counted(status.shards, "shard"));
    if (!status.missing.empty()) text += fmt::format("  missing  {}\n", ranges_text(status.missing));
    if (status.workers > 0)
      text += fmt::format("  at work  {}, or killed\n", status.workers == 1 ? "1 process" : fmt::format("{} processes", status.workers));
    if (!status.deadly.empty())
      text +=
          fmt::format("  deadly   {}: three processes or more ended without a word while they computed it\n", ranges_text(status.deadly));
    print(text);
  }
  return status.complete == status.shards ? 0 : 1;
}

int run_dataset_verify(const Options& options) {
  FrameProgress now;
  const StopRequest stop(&now.stop);
  std::optional<Progress> progress;
  ShardWatch watch;
  watch.samples = [&](std::uint64_t, std::uint64_t total) {
    if (!progress) progress.emplace(total, "shards", options.quiet || options.json);
    progress->step();
  };
  const VerifyResult result = verify_shards({options.words[1], choice_of(options), options.shards.recompute, options.threads, &now}, watch);
  progress.reset();
  Json faults = Json::array();
  std::string text;
  for (const ShardFault& one : result.faults) {
    faults.push(Json::object().set("shard", one.shard).set("what", one.what).set("members", Json::list(one.members)));
    std::vector<std::string> first(one.members.begin(),
                                   one.members.begin() + std::min<std::ptrdiff_t>(4, static_cast<std::ptrdiff_t>(one.members.size())));
    if (first.size() < one.members.size()) first.push_back(fmt::format("{} more", one.members.size() - first.size()));
    text += fmt::format("shard {}: {}{}\n", one.shard, one.what, first.empty() ? "" : ": " + base::listed(first, "and"));
  }
  if (!result.faults.empty())
    text += fmt::format("{}: their records are set aside, `tofray dataset run {}` makes them again\n",
                        counted(result.faults.size(), "damaged shard"), folder_of(options));
  if (options.json) {
    Json json = Json::object();
    json.set("shards", result.shards)
        .set("missing", result.missing)
        .set("recomputed", result.recomputed)
        .set("interrupted", result.interrupted);
    print(files::json_text(json.set("faults", std::move(faults)), 2) + "\n");
  } else {
    text +=
        fmt::format("{} read{}{}\n", counted(result.shards, "shard"), result.missing > 0 ? fmt::format(", {} missing", result.missing) : "",
                    options.shards.recompute > 0 ? fmt::format(", {} computed again (each is, by a chance of {:.3g} %)",
                                                               counted(result.recomputed, "sample"), 100 * options.shards.recompute)
                                                 : "");
    print(text);
  }
  if (result.interrupted) return 128 + stop.signal();
  return result.faults.empty() && result.missing == 0 ? 0 : 1;
}

int run_dataset_merge(const Options& options) {
  const MergeResult result = merge_shards(options.words[1], options.shards.partial);
  const double valid = result.pixels == 0 ? 0 : static_cast<double>(result.valid) / static_cast<double>(result.pixels);
  if (options.json) {
    Json json = Json::object();
    json.set("shards", result.shards)
        .set("samples", result.samples)
        .set("holes", result.holes)
        .set("bytes", result.bytes)
        .set("valid", valid)
        .set("missed_laws", result.missed_laws);
    print(files::json_text(json.set("files", Json::list(result.files)), 2) + "\n");
    return result.missed_laws.empty() ? 0 : 1;
  }
  print(fmt::format("{} in {}, {}; {:.1f} % of their pixels are valid{}\n  wrote  {}\n", counted(result.samples, "sample"),
                    counted(result.shards, "shard"), set_size_text(static_cast<double>(result.bytes)), 100 * valid,
                    result.holes > 0 ? fmt::format("; {}", counted(result.holes, "hole")) : "", base::listed(result.files, "and")));
  if (result.missed_laws.empty()) return 0;
  say(fmt::format(
      "error: values miss the law that they are drawn by: {}\n  right samplers do that once in a million times: `tofray dataset verify {} "
      "--recompute 100%` and another `seed` tell chance from a fault\n",
      result.missed_laws, folder_of(options)));
  return 1;
}

}  // namespace tofray::app
