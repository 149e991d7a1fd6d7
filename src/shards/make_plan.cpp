// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <optional>

#include "base/in_order.h"
#include "base/text.h"
#include "base/version.h"
#include "files/atomic_file.h"
#include "files/text_file.h"
#include "shards/canary.h"
#include "shards/layout.h"
#include "shards/record.h"
#include "shards/sample.h"
#include "shards/summary.h"
#include "tofray/error.h"
#include "yaml/tree.h"

/// A plan made anew, or of one that is there.
namespace tofray::shards {

namespace {

namespace fs = std::filesystem;

/// The first key, in the order of the file, that two sets have otherwise: "scene.objects.1.sphere"; empty where they are the same.
std::string difference(const yaml::Node& a, const yaml::Node& b, const std::string& path) {
  const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
  if (a.kind != b.kind) return path;
  if (a.kind == yaml::Node::Kind::map) {
    for (std::size_t i = 0; i < a.items.size(); ++i) {
      if (path.empty() && a.keys[i].text == "samples") continue;
      const yaml::Node* other = b.find(a.keys[i].text);
      if (other == nullptr) return below(a.keys[i].text);
      if (const std::string found = difference(a.items[i], *other, below(a.keys[i].text)); !found.empty()) return found;
    }
    for (const yaml::Node::Key& key : b.keys)
      if (a.find(key.text) == nullptr) return below(key.text);
    return "";
  }
  if (a.kind == yaml::Node::Kind::list) {
    for (std::size_t i = 0; i < std::min(a.items.size(), b.items.size()); ++i)
      if (const std::string found = difference(a.items[i], b.items[i], below(std::to_string(i))); !found.empty()) return found;
    return a.items.size() == b.items.size() ? "" : path;
  }
  return a.text == b.text && a.quoted == b.quoted ? "" : path;
}

bool has_form(const yaml::Node& node, std::string_view form) {
  if (node.kind == yaml::Node::Kind::map && node.find(form) != nullptr) return true;
  return std::any_of(node.items.begin(), node.items.end(), [&](const yaml::Node& one) { return has_form(one, form); });
}

[[noreturn]] void refuse_other_plan(const fs::path& folder, const std::string& what, const std::string& more) {
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: error: the plan that is there differs: {}\n  {}", (folder / "plan.json").native(), what, more));
}

constexpr const char* other_folder = "a plan stays as it is, since shards are made of it; choose another folder with -o";

/// What a plan that is there means for the set: nothing to do, or more samples.
/// @return the plan as it is to be, which differs in its samples alone
Plan extended(const Plan& before, const dataset::Scenes& scenes, const PlanRequest& request) {
  const dataset::SetFile& set = scenes.set();
  const yaml::Node was = yaml::parse_tree(before.set_text, "plan"), now = yaml::parse_tree(set.text, "set");
  if (const std::string key = difference(was, now, ""); !key.empty() && key != "samples")
    refuse_other_plan(request.folder, fmt::format("{} of the set is another one now", key), other_folder);
  for (const FileRecord& one : scenes.fixed().inputs)
    if (std::none_of(before.inputs.begin(), before.inputs.end(),
                     [&](const FileRecord& old) { return old.name == one.name && old.sha256 == one.sha256; }))
      refuse_other_plan(request.folder, fmt::format("the file {} is another one now", base::in_quotes(one.name)), other_folder);
  if (before.version != base::version())
    refuse_other_plan(request.folder, fmt::format("tofray {} made it, this is {}", before.version, base::version()), other_folder);
  if (request.shard_samples != 0 && request.shard_samples != before.shard_samples)
    refuse_other_plan(request.folder, fmt::format("its shards have {} samples each", before.shard_samples), other_folder);
  if (set.samples < before.samples)
    refuse_other_plan(request.folder, fmt::format("it has {} samples, the set has {}", before.samples, set.samples),
                      "samples can be added to a plan, not taken away; choose another folder with -o");
  if (set.samples > before.samples)
    for (const yaml::Node* part : {&set.let, &set.scene, &set.set})
      if (has_form(*part, "even"))
        refuse_other_plan(request.folder, fmt::format("it has {} samples, the set has {}", before.samples, set.samples),
                          "a value by `even` is another one where there are more samples: choose another folder with -o, or `uniform`");
  Plan out = before;
  out.samples = set.samples, out.set_text = set.text;
  return out;
}

/// What was found by computing some samples.
struct Pilot {
  std::vector<std::string> arrays;
  std::uint64_t bytes = 0, pixels = 0, valid = 0, samples = 0;
  double seconds = 0, least_valid = 1, most_valid = 0;
  std::map<std::string, std::string> inputs;
};

/// Of this thread's work, whatever else the machine does.
double processor_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Most memory that this process has taken.
std::uint64_t peak_bytes() {
  rusage now{};
  ::getrusage(RUSAGE_SELF, &now);
  return static_cast<std::uint64_t>(now.ru_maxrss) * 1024;
}

Pilot fly(const dataset::Scenes& scenes, const PlanRequest& request) {
  const dataset::SetFile& set = scenes.set();
  const std::uint64_t count = std::clamp<std::uint64_t>(request.pilot, 1, set.samples);
  const SampleMaker maker(scenes, {}, request.progress);
  Pilot out;
  Statistics statistics;
  struct One {
    std::vector<MadeSample> views;
    double seconds = 0;
  };
  base::in_order<One>(
      count, request.threads,
      [&](std::uint64_t i) {
        const std::uint64_t sample = i * (set.samples / count);
        const double start = processor_s();
        One one;
        for (std::uint64_t view = 0; view < set.views; ++view) one.views.push_back(maker.make(sample, view));
        one.seconds = processor_s() - start;
        return one;
      },
      [&](std::uint64_t i, const One& one) {
        out.seconds += one.seconds;
        for (const MadeSample& view : one.views) {
          const std::vector<std::string> arrays = arrays_of(view);
          if (out.arrays.empty()) out.arrays = arrays;
          if (arrays != out.arrays)
            throw Error(ErrorKind::bad_input,
                        fmt::format("{}: error: its samples do not all have the same arrays\n  sample 0 has {}; sample {} has {}; expected "
                                    "`arrays` that all have",
                                    set.source, base::listed(out.arrays, "and"), i * (set.samples / count), base::listed(arrays, "and")));
          const double valid = static_cast<double>(view.statistics.valid) / static_cast<double>(view.statistics.pixels);
          out.least_valid = std::min(out.least_valid, valid), out.most_valid = std::max(out.most_valid, valid);
          out.bytes += tar_bytes(view), statistics.add(view.statistics), out.inputs.insert(view.inputs.begin(), view.inputs.end());
        }
      });
  out.bytes = (out.bytes + count - 1) / count, out.seconds /= static_cast<double>(count);
  out.pixels = statistics.pixels, out.valid = statistics.valid, out.samples = count;
  return out;
}

/// Draws the first samples, which costs little, and looks at each key's values together.
void refuse_missed_laws(const dataset::Scenes& scenes) {
  constexpr std::uint64_t most = 4000;
  const dataset::SetFile& set = scenes.set();
  dataset::Judgement draws;
  for (std::uint64_t row = 0; row < std::min(most, set.samples * set.views); ++row) scenes.judge(row / set.views, row % set.views, draws);
  if (const std::string missed = dataset::missed_laws(draws); !missed.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: values miss the law that they are drawn by: {}\n  {}", set.source, missed, law_advice));
}

/// 64 MiB to 1 GiB, and no more than 10 minutes of a core; one ten-thousandth of the set between these.
std::uint64_t shard_samples_of(const Pilot& pilot, std::uint64_t samples) {
  constexpr double most_seconds = 600, least_bytes = 0x1p26, most_bytes = 0x1p30;
  const double total = static_cast<double>(pilot.bytes) * static_cast<double>(samples);
  const double bytes = std::clamp(total / 10000, least_bytes, most_bytes);
  const double by_time = most_seconds / std::max(pilot.seconds, 1e-6), by_size = bytes / static_cast<double>(pilot.bytes);
  return static_cast<std::uint64_t>(std::clamp(std::min(by_time, by_size), 1.0, static_cast<double>(samples)));
}

/// Where the plan had a short last shard that is to be longer: its record goes, so that it is made again.
void free_last_shard(const fs::path& folder, const Plan& before, const Plan& now) {
  const std::uint64_t last = before.shards() - 1;
  std::error_code fault;
  if (before.count_of(last) != now.count_of(last)) fs::remove(folder / record_name(last), fault);
}

}  // namespace

DatasetPlan plan(const PlanRequest& request) {
  const dataset::Scenes scenes(files::read_text(request.set), request.set);
  const fs::path path = request.folder / "plan.json";
  std::error_code fault;
  if (fs::exists(path, fault)) {
    const Plan before = load_plan(request.folder), now = extended(before, scenes, request);
    DatasetPlan out = shown(now, scenes);
    out.found = now.samples == before.samples ? DatasetPlan::Found::same : DatasetPlan::Found::fewer_samples;
    if (out.found == DatasetPlan::Found::fewer_samples) {
      files::write_file_atomically(path, plan_text(now, scenes.set().as));
      free_last_shard(request.folder, before, now);
    }
    return out;
  }
  refuse_missed_laws(scenes);
  const Pilot pilot = fly(scenes, request);
  Plan made;
  made.version = base::version(), made.samples = scenes.set().samples, made.views = scenes.set().views;
  made.set_name = fs::path(request.set).filename().native(), made.set_text = scenes.set().text;
  made.folder = fs::proximate(fs::absolute(request.set).parent_path(), fs::absolute(request.folder)).native();
  made.arrays = pilot.arrays, made.sample_bytes = pilot.bytes, made.canary = canary_sha256();
  made.shard_samples = request.shard_samples != 0 ? std::min(request.shard_samples, made.samples) : shard_samples_of(pilot, made.samples);
  made.inputs = scenes.fixed().inputs;
  made.reads = pilot.inputs;
  made.id = id_of(made, scenes.set().laws);
  fs::create_directories(request.folder, fault);
  if (fault)
    throw Error(ErrorKind::io, fmt::format("{}: error: cannot make this folder: {}\n  choose another one with -o", request.folder.native(),
                                           fault.message()));
  files::write_file_atomically(path, plan_text(made, scenes.set().as));
  DatasetPlan out = shown(made, scenes);
  out.sample_seconds = pilot.seconds, out.pixels = pilot.pixels, out.valid = pilot.valid;
  out.pilot = pilot.samples, out.least_valid = pilot.least_valid, out.most_valid = pilot.most_valid;
  out.peak_bytes = peak_bytes();
  return out;
}

}  // namespace tofray::shards

namespace tofray {

DatasetPlan plan_dataset(const PlanRequest& request) { return shards::plan(request); }

}  // namespace tofray
