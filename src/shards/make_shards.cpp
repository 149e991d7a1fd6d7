// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "base/in_order.h"
#include "base/text.h"
#include "base/version.h"
#include "files/crc32.h"
#include "files/streamed_file.h"
#include "files/tar.h"
#include "shards/canary.h"
#include "shards/layout.h"
#include "shards/record.h"
#include "shards/sample.h"
#include "shards/worker.h"
#include "tofray/error.h"

/// The shards that are missing, one after the other, the samples of each on all threads.
namespace tofray::shards {

namespace {

namespace fs = std::filesystem;

/// All views of a sample, or why there are none.
struct SampleOrHole {
  std::vector<MadeSample> views;
  std::string why;
  dataset::Judgement draws;
};

void refuse_other_bytes(const Plan& plan) {
  const std::string now = canary_sha256();
  if (now == plan.canary && base::version() == plan.version) return;
  throw Error(ErrorKind::bad_input,
              fmt::format("error: this tofray makes other bytes than the one that made the plan\n  a frame that both computed has the "
                          "SHA-256 {} by this {}, and {} by "
                          "the plan's {}; expected the same version, built without -ffast-math, on a processor that works",
                          now, base::version(), plan.canary, plan.version));
}

class ShardMaker {
 public:
  ShardMaker(const ShardRunRequest& request, const ShardWatch& watch, const Plan& plan, const dataset::Scenes& scenes)
      : request_(request),
        watch_(watch),
        plan_(plan),
        scenes_(scenes),
        worker_(request.folder),
        maker_(scenes, plan.arrays, request.progress) {}

  /// @param total  samples of all shards that are to be made, for whoever watches
  ShardMade make(std::uint64_t shard, std::uint64_t total) {
    Record record;
    record.plan = plan_.id, record.shard = shard, record.first = plan_.first_of(shard), record.count = plan_.count_of(shard);
    const fs::path path = request_.folder / tar_name(shard);
    std::error_code fault;
    fs::create_directories(path.parent_path(), fault);
    if (fault)
      throw Error(ErrorKind::io, fmt::format("{}: error: cannot make this folder: {}", path.parent_path().native(), fault.message()));
    files::StreamedFile tar(path, worker_.folder());
    base::in_order<SampleOrHole>(
        record.count, request_.threads, [&](std::uint64_t i) { return sample(record.first + i); },
        [&](std::uint64_t i, const SampleOrHole& one) {
          put(record.first + i, one, tar, record);
          ++done_;
          if (watch_.samples) watch_.samples(done_, total);
        });
    tar.append(files::tar_end());
    record.bytes = tar.size(), record.sha256 = tar.finish();
    ShardMade out{shard, record.count - record.holes.size(), record.holes.size(), record.bytes};
    out.by_another = !publish(record, tar);
    return out;
  }

 private:
  SampleOrHole sample(std::uint64_t number) const {
    SampleOrHole out;
    worker_.begins(number);
    try {
      for (std::uint64_t view = 0; view < plan_.views; ++view) out.views.push_back(maker_.make(number, view));
    } catch (const Error& error) {
      // What is wrong with the scene is the same on every machine; all else ends the run.
      if (error.kind() != ErrorKind::bad_input || (request_.progress != nullptr && request_.progress->stop)) throw;
      out.views.clear();
      out.why = maker_.without_folder(error.what());
    }
    judge(number, out);
    worker_.ends(number);
    return out;
  }

  /// What was drawn is known from making the sample, unless the set refuses draws, or the sample became a hole.
  void judge(std::uint64_t number, SampleOrHole& of) const {
    for (std::uint64_t view = 0; view < plan_.views; ++view) {
      if (of.views.empty() || scenes_.set().tries()) {
        scenes_.judge(number, view, of.draws);
      } else {
        for (const auto& [path, counts] : of.views[view].draws) of.draws[path].add(counts);
      }
    }
  }

  void put(std::uint64_t number, const SampleOrHole& one, files::StreamedFile& tar, Record& record) const {
    for (const auto& [path, counts] : one.draws) record.statistics.draws[path].add(counts);
    if (one.views.empty()) return record.holes.push_back({number, one.why}), void();
    for (const MadeSample& view : one.views) {
      Record::Sample& into = record.samples.emplace_back();
      into.sample = number, into.view = view.view;
      into.pixels = view.statistics.pixels, into.valid = view.statistics.valid;
      const std::string key = sample_key(number, view.view, plan_.views);
      for (const MadeSample::Member& member : view.members) {
        tar.append(files::tar_header(key + "." + member.name, member.bytes.size()));
        into.members.push_back({member.name, tar.size(), member.bytes.size(), files::crc32(member.bytes)});
        tar.append(member.bytes);
        tar.append(std::string(files::tar_padding(member.bytes.size()), '\0'));
      }
      for (const auto& [name, sha256] : view.inputs) need_same(name, sha256, number, record);
      record.statistics.add(view.statistics);
    }
  }

  /// A file that a sample read has to be that of the plan, or of the samples before it.
  void need_same(const std::string& name, const std::string& sha256, std::uint64_t number, Record& record) const {
    const auto planned = plan_.reads.find(name);
    const std::string& expected = planned != plan_.reads.end() ? planned->second : record.inputs.emplace(name, sha256).first->second;
    if (expected != sha256)
      throw Error(ErrorKind::bad_input, fmt::format("{}: error: sample {} read another file than {} did\n  got the SHA-256 {}; expected {}",
                                                    base::printable(name), number,
                                                    planned != plan_.reads.end() ? "the plan" : "an earlier sample", sha256, expected));
  }

  /// The tar first, its record behind it. @return false where another process was quicker, with the same bytes
  bool publish(const Record& record, files::StreamedFile& tar) {
    const fs::path& folder = request_.folder;
    const std::string text = record_text(record);
    files::StreamedFile beside(folder / record_name(record.shard), worker_.folder());
    beside.append(text), beside.finish();
    bool ours = tar.publish();
    if (!ours) {
      // Its record says whether that tar is complete. One without, or with one of another plan or a shorter shard, gives way.
      std::optional<Record> there;
      try {
        there = read_record(folder, record.shard);
      } catch (const Error& error) {
        if (error.kind() != ErrorKind::bad_input) throw;
      }
      const bool same = there && there->fits(plan_, record.shard);
      if (same && record_text(*there) != text)
        throw Error(ErrorKind::bad_input, fmt::format("{}: error: another process made this shard with other bytes\n  it has the SHA-256 "
                                                      "{}, here it is {}: one of the two machines is at "
                                                      "fault; `tofray dataset verify --recompute 100%` says which shards are",
                                                      (folder / tar_name(record.shard)).native(), there->sha256, record.sha256));
      std::error_code fault;
      const bool whole = same && fs::file_size(folder / tar_name(record.shard), fault) == record.bytes && !fault;
      if (!whole) tar.replace(), ours = true;
    }
    if (!beside.publish() && ours) beside.replace();
    return ours;
  }

  const ShardRunRequest& request_;
  const ShardWatch& watch_;
  const Plan& plan_;
  const dataset::Scenes& scenes_;
  Worker worker_;
  SampleMaker maker_;
  std::uint64_t done_ = 0;
};

}  // namespace

ShardRunResult run(const ShardRunRequest& request, const ShardWatch& watch) {
  const Plan plan = load_plan(request.folder);
  const auto scenes = scenes_of(plan, request.folder);
  std::vector<std::uint64_t> wanted = chosen(plan, request.which);
  ShardRunResult out;
  const std::size_t all = wanted.size();
  std::erase_if(wanted, [&](std::uint64_t shard) { return is_complete(request.folder, plan, shard); });
  out.there = all - wanted.size();
  remove_dead_workers(request.folder);
  if (wanted.empty()) return out;
  refuse_other_bytes(plan);
  std::uint64_t total = 0;
  for (const std::uint64_t shard : wanted) total += plan.count_of(shard);
  ShardMaker maker(request, watch, plan, *scenes);
  const auto stopped = [&] { return request.progress != nullptr && request.progress->stop; };
  for (const std::uint64_t shard : wanted) {
    if (stopped()) break;
    // Somebody else may have made it meanwhile.
    if (is_complete(request.folder, plan, shard)) {
      ++out.there, total -= plan.count_of(shard);
      continue;
    }
    try {
      const ShardMade made = maker.make(shard, total);
      ++out.made, out.samples += made.samples, out.holes += made.holes;
      if (watch.shard) watch.shard(made);
    } catch (const Error&) {
      if (!stopped()) throw;
      break;
    }
  }
  out.interrupted = stopped() && out.made + out.there < all;
  out.too_many_holes = static_cast<double>(out.holes) > scenes->set().holes * static_cast<double>(out.samples + out.holes);
  return out;
}

}  // namespace tofray::shards

namespace tofray {

ShardRunResult run_shards(const ShardRunRequest& request, const ShardWatch& watch) { return shards::run(request, watch); }

}  // namespace tofray
