// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "base/in_order.h"
#include "base/text.h"
#include "files/atomic_file.h"
#include "files/json.h"
#include "files/npy.h"
#include "files/read_bytes.h"
#include "files/sha256.h"
#include "files/streamed_file.h"
#include "shards/layout.h"
#include "shards/record.h"
#include "shards/shown_samples.h"
#include "shards/summary.h"
#include "shards/worker.h"
#include "tofray/error.h"

/// What is made of all records of a set.
namespace tofray::shards {

namespace {

namespace fs = std::filesystem;
using files::Json;

/// A column of the index: one row for each view of each sample, in order, a hole's with what stands for none.
class Column {
 public:
  template <class T>
  Column(const fs::path& folder, const fs::path& work, const std::string& name, const files::NpyShape& shape, T)
      : file_(folder / (name + ".npy"), work) {
    file_.append(files::npy_header(files::npy_type_of<T>(), shape));
  }
  template <class T>
  void push(T value) {
    file_.append({reinterpret_cast<const char*>(&value), sizeof value});
  }
  std::string finish() {
    const std::string sum = file_.finish();
    file_.replace();
    return sum;
  }

 private:
  files::StreamedFile file_;
};

constexpr std::uint32_t no_shard = 0xffffffff;

/// "sha256  name" as sha256sum has it.
std::string sum_line(const std::string& sha256, const std::string& name) { return sha256 + "  " + name + "\n"; }

class Merger {
 public:
  Merger(const fs::path& folder, const Plan& plan)
      : folder_(folder),
        plan_(plan),
        shown_(folder, plan.samples * plan.views),
        worker_(folder),
        rows_(static_cast<std::size_t>(plan.samples * plan.views)),
        index_(make_index()),
        shard_(index_, worker_.folder(), "shard", {rows_}, std::uint32_t{}),
        offset_(index_, worker_.folder(), "offset", {rows_, plan.arrays.size() + 1}, std::uint64_t{}),
        bytes_(index_, worker_.folder(), "bytes", {rows_, plan.arrays.size() + 1}, std::uint64_t{}),
        split_(index_, worker_.folder(), "split", {rows_}, std::uint8_t{}),
        set_(dataset::parse_set(plan.set_text, plan.set_name)) {}

  void add(const Record& record, const std::string& sha256) {
    ++result.shards, result.samples += record.count - record.holes.size(), result.holes += record.holes.size(),
        result.bytes += record.bytes;
    statistics_.add(record.statistics);
    const std::string tar = tar_name(record.shard);
    sums_ += sum_line(sha256, record_name(record.shard)) + sum_line(record.sha256, tar);
    list_.push(
        Json::object().set("url", tar).set("nsamples", static_cast<std::uint64_t>(record.samples.size())).set("filesize", record.bytes));
    for (const Record::Hole& hole : record.holes) holes_.emplace_back(hole.sample, hole.why);
    for (const auto& [name, sha256] : record.inputs) {
      const auto [before, is_new] = inputs_.emplace(name, std::pair(sha256, record.shard));
      if (!is_new && before->second.first != sha256)
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}: error: shards {} and {} read different files of this name\n  got the SHA-256 {} and {}; expected one: "
                                "make one of the shards again, "
                                "where the file is the right one",
                                base::printable(name), before->second.second, record.shard, before->second.first, sha256));
    }
    auto next = record.samples.begin();
    for (std::uint64_t i = 0; i < record.count; ++i)
      for (std::uint64_t view = 0; view < plan_.views; ++view) {
        const bool there = next != record.samples.end() && next->sample == record.first + i && next->view == view;
        row(there ? &*next : nullptr, record.shard, record.first + i);
        if (there) shown_.add(record, *next++, (record.first + i) * plan_.views + view);
      }
  }
  /// Rows of a shard that is not there.
  void skip(std::uint64_t shard) {
    for (std::uint64_t i = 0; i < plan_.count_of(shard) * plan_.views; ++i) row(nullptr, shard, plan_.first_of(shard) + i / plan_.views);
  }

  void finish() {
    sum(shard_, "index/shard.npy"), sum(offset_, "index/offset.npy"), sum(bytes_, "index/bytes.npy");
    sum(split_, "index/split.npy");
    std::vector<std::string> members;
    for (const std::string& array : plan_.arrays) members.push_back(array + ".npy");
    members.emplace_back("json");
    write("index/index.json", files::json_text(Json::object()
                                                   .set("samples", plan_.samples)
                                                   .set("views", plan_.views)
                                                   .set("row", "sample * views + view")
                                                   .set("members", Json::list(members))
                                                   .set("shard", "where it is; 4294967295: a hole, or a shard that is not there")
                                                   .set("offset", "of each member's bytes in the shard's tar")
                                                   .set("bytes", "of each member")
                                                   .set("split", "0 train, 1 validation, 2 test"),
                                               2) +
                                  "\n");
    Json inputs = Json::object(), holes = Json::array();
    for (const auto& [name, one] : inputs_) inputs.set(name, one.first);
    for (const auto& [sample, why] : holes_) holes.push(Json::object().set("sample", sample).set("why", why));
    write("statistics.json", files::json_text(Json::object()
                                                  .set("plan", plan_.id)
                                                  .set("shards", result.shards)
                                                  .set("samples", result.samples)
                                                  .set("bytes", result.bytes)
                                                  .set("holes", std::move(holes))
                                                  .set("inputs", std::move(inputs))
                                                  .set("statistics", statistics_.json()),
                                              2) +
                                 "\n");
    Json list = Json::object().set("__kind__", "wids-shard-index-v1").set("wids_version", 1);
    write("wids.json", files::json_text(list.set("name", plan_.set_name).set("shardlist", std::move(list_)), 1) + "\n");
    Summary summary{plan_,  set_, result.shards,   result.samples, result.bytes, statistics_,
                    holes_, {},   shown_.spread(), shown_.worst(), by_split_};
    for (const auto& [name, one] : inputs_) summary.inputs.emplace(name, one.first);
    write("card.md", card_text(summary));
    sums_ += sum_line(files::sha256_hex(files::read_bytes((folder_ / "plan.json").native(), std::size_t{1} << 28)), "plan.json");
    files::write_file_atomically(folder_ / "SHA256SUMS", sums_);
    result.files.emplace_back("SHA256SUMS");
    // These two have no line in SHA256SUMS: one holds its sum, and pictures are packed by the machine's library.
    const auto beside = [&](const char* name, const std::string& text) {
      files::write_file_atomically(folder_ / name, text), result.files.emplace_back(name);
    };
    beside("croissant.json", croissant_text(summary, files::sha256_hex(sums_))), beside("preview.html", preview_page(summary));
    result.missed_laws = dataset::missed_laws(statistics_.draws);
    result.pixels = statistics_.pixels, result.valid = statistics_.valid;
  }

  MergeResult result;

 private:
  [[nodiscard]] fs::path make_index() const {
    std::error_code fault;
    fs::create_directories(folder_ / "index", fault);
    if (fault)
      throw Error(ErrorKind::io, fmt::format("{}: error: cannot make this folder: {}", (folder_ / "index").native(), fault.message()));
    return folder_ / "index";
  }
  void row(const Record::Sample* sample, std::uint64_t shard, std::uint64_t number) {
    const auto split = static_cast<std::size_t>(dataset::split_of(set_, number));
    split_.push(static_cast<std::uint8_t>(split));
    if (sample != nullptr && sample->view == 0) ++by_split_[split];
    shard_.push(sample != nullptr ? static_cast<std::uint32_t>(shard) : no_shard);
    for (std::size_t k = 0; k <= plan_.arrays.size(); ++k) {
      const bool there = sample != nullptr && k < sample->members.size();
      offset_.push(there ? sample->members[k].offset : std::uint64_t{0}), bytes_.push(there ? sample->members[k].bytes : std::uint64_t{0});
    }
  }
  void sum(Column& column, const std::string& name) { sums_ += sum_line(column.finish(), name), result.files.push_back(name); }
  void write(const std::string& name, const std::string& text) {
    files::write_file_atomically(folder_ / name, text);
    sums_ += sum_line(files::sha256_hex(text), name), result.files.push_back(name);
  }

  const fs::path& folder_;
  const Plan& plan_;
  ShownSamples shown_;
  Worker worker_;
  std::size_t rows_;
  fs::path index_;
  Column shard_, offset_, bytes_, split_;
  dataset::SetFile set_;
  std::array<std::uint64_t, 3> by_split_{};
  Statistics statistics_;
  std::string sums_;
  Json list_ = Json::array();
  std::vector<std::pair<std::uint64_t, std::string>> holes_;
  std::map<std::string, std::pair<std::string, std::uint64_t>> inputs_;
};

/// A record, and the SHA-256 of its file.
struct Read {
  Record record;
  std::string sha256;
};

/// None where there is no such file. @throws Error (bad_input) where it is of another plan
std::optional<Read> read_fitting(const fs::path& folder, const Plan& plan, std::uint64_t shard) {
  const std::optional<std::string> text = read_record_text(folder, shard);
  if (!text) return {};
  const std::string where = (folder / record_name(shard)).native();
  Read out{parse_record(*text, where), files::sha256_hex(*text)};
  if (!out.record.fits(plan, shard))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: this record is of another plan\n  `tofray dataset run {}` makes the shard again", where,
                            base::printable(folder.native())));
  return out;
}

}  // namespace

MergeResult merge(const fs::path& folder, bool partial) {
  const Plan plan = load_plan(folder);
  if (!partial) {
    const std::vector<std::uint64_t> missing = dataset_status(folder).missing;
    if (!missing.empty())
      throw Error(
          ErrorKind::bad_input,
          fmt::format(
              "{}: error: {} of {} shards are missing, {} the first of them\n  `tofray dataset run {}` makes them; --partial merges "
              "what is there",
              base::printable(folder.native()), missing.size(), plan.shards(), missing[0], base::printable(folder.native())));
  }
  Merger merger(folder, plan);
  base::in_order<std::optional<Read>>(
      plan.shards(), 0, [&](std::uint64_t shard) { return read_fitting(folder, plan, shard); },
      [&](std::uint64_t shard, const std::optional<Read>& read) {
        if (read)
          merger.add(read->record, read->sha256);
        else
          merger.skip(shard);
      });
  merger.finish();
  return merger.result;
}

}  // namespace tofray::shards

namespace tofray {

MergeResult merge_shards(const std::filesystem::path& folder, bool partial) { return shards::merge(folder, partial); }

}  // namespace tofray
