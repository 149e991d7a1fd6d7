// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "base/in_order.h"
#include "dataset/draw.h"
#include "files/crc32.h"
#include "files/sha256.h"
#include "shards/layout.h"
#include "shards/record.h"
#include "shards/sample.h"
#include "shards/shard_tar.h"
#include "tofray/error.h"

/// Shards against their records, and against samples that are computed again.
namespace tofray::shards {

namespace {

namespace fs = std::filesystem;

std::string member_name(const Plan& plan, const Record::Sample& sample, const Record::Member& member) {
  return sample_key(sample.sample, sample.view, plan.views) + "." + member.name;
}

/// Which members are not those of the record.
std::vector<std::string> damaged_members(const Plan& plan, const Record& record, ShardTar& tar) {
  std::vector<std::string> out;
  for (const Record::Sample& sample : record.samples)
    for (const Record::Member& member : sample.members) {
      const std::string bytes = tar.read(member);
      if (bytes.size() != member.bytes || files::crc32(bytes) != member.crc) out.push_back(member_name(plan, sample, member));
    }
  return out;
}

/// Whether a sample is among so large a share of them: always the same ones.
bool is_picked(const Plan& plan, std::uint64_t sample, double share) {
  return dataset::unit_number(dataset::random_bits({0, sample, 0, 0}, "verify " + plan.id)) < share;
}

class Verifier {
 public:
  Verifier(const VerifyRequest& request, const Plan& plan, const dataset::Scenes& scenes)
      : request_(request), plan_(plan), maker_(scenes, plan.arrays, request.progress) {}

  /// @return nothing where all is well
  std::optional<ShardFault> look(std::uint64_t shard, VerifyResult& into) const {
    ++into.shards;
    std::optional<Record> record;
    try {
      record = read_record(request_.folder, shard);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::bad_input) throw;
      return ShardFault{shard, "its record cannot be read", {}};
    }
    if (!record) return {};
    if (!record->fits(plan_, shard)) return ShardFault{shard, "its record is of another plan", {}};
    ShardTar tar(request_.folder / tar_name(shard));
    if (!tar.is_open()) return ShardFault{shard, "it has a record and no tar", {}};
    if (tar.sha256() != record->sha256)
      return ShardFault{shard, "its bytes are not those of its record", damaged_members(plan_, *record, tar)};
    std::vector<std::string> other = recompute(*record, tar, into);
    if (!other.empty()) return ShardFault{shard, "computed again, samples have other bytes", std::move(other)};
    return {};
  }

 private:
  std::vector<std::string> recompute(const Record& record, ShardTar& tar, VerifyResult& into) const {
    std::vector<const Record::Sample*> picked;
    for (const Record::Sample& one : record.samples)
      if (is_picked(plan_, one.sample, request_.recompute)) picked.push_back(&one);
    std::vector<std::string> out;
    base::in_order<MadeSample>(
        picked.size(), request_.threads, [&](std::uint64_t i) { return maker_.make(picked[i]->sample, picked[i]->view); },
        [&](std::uint64_t i, const MadeSample& made) {
          ++into.recomputed;
          for (std::size_t k = 0; k < picked[i]->members.size(); ++k)
            if (k >= made.members.size() || made.members[k].bytes != tar.read(picked[i]->members[k]))
              out.push_back(member_name(plan_, *picked[i], picked[i]->members[k]));
        });
    return out;
  }

  const VerifyRequest& request_;
  const Plan& plan_;
  SampleMaker maker_;
};

}  // namespace

VerifyResult verify(const VerifyRequest& request, const ShardWatch& watch) {
  if (!(request.recompute >= 0 && request.recompute <= 1))
    throw Error(ErrorKind::bad_input, fmt::format("error: a share of {} cannot be computed again\n  expected 0 to 1", request.recompute));
  const Plan plan = load_plan(request.folder);
  const auto scenes = scenes_of(plan, request.folder);
  const Verifier verifier(request, plan, *scenes);
  const std::vector<std::uint64_t> wanted = chosen(plan, request.which);
  VerifyResult out;
  std::uint64_t done = 0;
  const auto stopped = [&] { return request.progress != nullptr && request.progress->stop; };
  for (const std::uint64_t shard : wanted) {
    if (stopped()) break;
    std::error_code none;
    if (!fs::exists(request.folder / record_name(shard), none)) {
      ++out.missing;
    } else {
      try {
        if (std::optional<ShardFault> fault = verifier.look(shard, out)) {
          const fs::path record = request.folder / record_name(shard);
          fs::rename(record, record.native() + ".damaged", none);
          out.faults.push_back(std::move(*fault));
        }
      } catch (const Error&) {
        if (!stopped()) throw;
        break;
      }
    }
    if (watch.samples) watch.samples(++done, wanted.size());
  }
  out.interrupted = stopped() && out.shards + out.missing < wanted.size();
  return out;
}

}  // namespace tofray::shards

namespace tofray {

VerifyResult verify_shards(const VerifyRequest& request, const ShardWatch& watch) { return shards::verify(request, watch); }

}  // namespace tofray
