// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/plan.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "base/version.h"
#include "files/json.h"
#include "files/read_bytes.h"
#include "files/sha256.h"
#include "shards/quantised.h"
#include "tofray/error.h"

namespace tofray::shards {

namespace {

using files::Json;

constexpr const char* form = "tofray-plan-1";
constexpr std::size_t most_bytes = std::size_t{256} << 20;

Json inputs_json(const std::vector<FileRecord>& inputs) {
  Json out = Json::array();
  for (const FileRecord& one : inputs) out.push(Json::object().set("file", one.name).set("bytes", one.bytes).set("sha256", one.sha256));
  return out;
}

Json reads_json(const std::map<std::string, std::string>& reads) {
  Json out = Json::object();
  for (const auto& [name, sha256] : reads) out.set(name, sha256);
  return out;
}

[[noreturn]] void refuse_plan(const std::string& where, const std::string& key) {
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: error: its {} is not what a plan has\n  expected the plan.json of a `tofray dataset plan` of the format {}",
                          where, key, form));
}

Json as_json(const std::vector<dataset::Quantised>& all) {
  Json out = Json::object();
  for (const dataset::Quantised& one : all) {
    Json about = Json::object();
    put_type(about, one);
    out.set(one.array, std::move(about));
  }
  return out;
}

}  // namespace

std::uint64_t Plan::count_of(std::uint64_t shard) const { return std::min(shard_samples, samples - first_of(shard)); }

std::string id_of(const Plan& plan, const std::string& laws) {
  Json out = Json::object();
  out.set("format", form).set("tofray", plan.version).set("laws", laws).set("inputs", inputs_json(plan.inputs));
  out.set("arrays", Json::list(plan.arrays))
      .set("shard_samples", plan.shard_samples)
      .set("canary", plan.canary)
      .set("reads", reads_json(plan.reads));
  return files::sha256_hex(files::json_text(out));
}

std::string plan_text(const Plan& plan, const std::vector<dataset::Quantised>& as) {
  Json out = Json::object();
  out.set("format", form).set("id", plan.id).set("tofray", plan.version);
  out.set("samples", plan.samples).set("views", plan.views).set("shard_samples", plan.shard_samples).set("shards", plan.shards());
  out.set("sample_bytes", plan.sample_bytes).set("arrays", Json::list(plan.arrays)).set("canary", plan.canary);
  if (!as.empty()) out.set("as", as_json(as));
  out.set("folder", plan.folder).set("inputs", inputs_json(plan.inputs)).set("reads", reads_json(plan.reads));
  out.set("set", Json::object().set("file", plan.set_name).set("text", plan.set_text));
  return files::json_text(out, 2) + "\n";
}

Plan parse_plan(std::string_view text, const std::string& where) {
  const Json json = files::parse_json(text, where);
  const auto string = [&](const Json* one, const char* key) {
    if (one == nullptr || one->string() == nullptr) refuse_plan(where, key);
    return *one->string();
  };
  const auto number = [&](const Json* one, const char* key, std::uint64_t least) {
    std::uint64_t out = 0;
    if (one == nullptr || !one->unsigned_integer(out) || out < least) refuse_plan(where, key);
    return out;
  };
  const auto list = [&](const Json* one, const char* key) -> const Json::Array& {
    if (one == nullptr || !one->is_array()) refuse_plan(where, key);
    return *one->items();
  };
  if (string(json.find("format"), "format") != form) refuse_plan(where, "format");
  Plan out;
  out.id = string(json.find("id"), "id"), out.version = string(json.find("tofray"), "tofray");
  out.samples = number(json.find("samples"), "samples", 1), out.views = number(json.find("views"), "views", 1);
  out.shard_samples = number(json.find("shard_samples"), "shard_samples", 1),
  out.sample_bytes = number(json.find("sample_bytes"), "sample_bytes", 0);
  for (const Json& one : list(json.find("arrays"), "arrays")) {
    out.arrays.push_back(string(&one, "arrays"));
    if (results::find_array(out.arrays.back()) == nullptr) refuse_plan(where, "arrays");
  }
  out.canary = string(json.find("canary"), "canary"), out.folder = string(json.find("folder"), "folder");
  for (const Json& one : list(json.find("inputs"), "inputs"))
    out.inputs.push_back(
        {string(one.find("file"), "inputs"), number(one.find("bytes"), "inputs", 0), string(one.find("sha256"), "inputs")});
  const Json* reads = json.find("reads");
  if (reads == nullptr || !reads->is_object()) refuse_plan(where, "reads");
  for (const auto& [name, sha256] : *reads->members()) out.reads[name] = string(&sha256, "reads");
  const Json* set = json.find("set");
  if (set == nullptr) refuse_plan(where, "set");
  out.set_name = string(set->find("file"), "set"), out.set_text = string(set->find("text"), "set");
  return out;
}

Plan load_plan(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "plan.json";
  std::error_code fault;
  if (!std::filesystem::exists(path, fault))
    throw Error(
        ErrorKind::io,
        fmt::format("{}: error: there is no plan in this folder\n  expected the folder of a `tofray dataset plan SET.yaml -o FOLDER`",
                    base::printable(folder.native())));
  return parse_plan(files::read_bytes(path.native(), most_bytes), path.native());
}

std::unique_ptr<const dataset::Scenes> scenes_of(const Plan& plan, const std::filesystem::path& folder) {
  const std::filesystem::path beside = (folder / plan.folder).lexically_normal(), path = folder / "plan.json";
  std::error_code fault;
  if (!plan.inputs.empty() && !std::filesystem::is_directory(beside, fault))
    throw Error(ErrorKind::io, fmt::format("{}: error: the folder of the set's files is not there: {}\n  expected {} in it", path.native(),
                                           base::in_quotes(beside.native(), 200), base::in_quotes(plan.inputs[0].name)));
  auto out = std::make_unique<const dataset::Scenes>(plan.set_text, (beside / plan.set_name).native());
  for (const FileRecord& now : out->fixed().inputs) {
    const auto then = std::find_if(plan.inputs.begin(), plan.inputs.end(), [&](const FileRecord& one) { return one.name == now.name; });
    if (then == plan.inputs.end() || then->sha256 != now.sha256)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: error: this file is another one than {}: {}\n  expected the file of the SHA-256 {}; or plan the set "
                              "anew in another folder",
                              (beside / now.name).native(), then == plan.inputs.end() ? "those of the plan" : "at the plan", now.sha256,
                              then == plan.inputs.end() ? "of one of them" : then->sha256));
  }
  if (id_of(plan, out->set().laws) != plan.id) refuse_plan(path.native(), "id");
  return out;
}

DatasetPlan shown(const Plan& plan, const dataset::Scenes& scenes) {
  DatasetPlan out;
  out.id = plan.id, out.name = scenes.set().name, out.license = scenes.set().license;
  out.samples = plan.samples, out.views = plan.views, out.shard_samples = plan.shard_samples, out.shards = plan.shards();
  out.arrays = plan.arrays, out.sample_bytes = plan.sample_bytes;
  return out;
}

std::vector<std::uint64_t> chosen(const Plan& plan, const ShardChoice& which) {
  if (which.parts == 0 || which.part >= which.parts)
    throw Error(ErrorKind::bad_input, fmt::format("error: there is no part {} of {}\n  expected 0 to {}", which.part, which.parts,
                                                  which.parts == 0 ? 0 : which.parts - 1));
  std::vector<std::uint64_t> out;
  const auto take = [&](std::uint64_t shard) {
    if (shard % which.parts == which.part) out.push_back(shard);
  };
  for (const std::uint64_t shard : which.shards) {
    if (shard >= plan.shards())
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: there is no shard {}\n  the plan has {}, numbered from 0", shard, plan.shards()));
    take(shard);
  }
  if (which.shards.empty())
    for (std::uint64_t shard = 0; shard < plan.shards(); ++shard) take(shard);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace tofray::shards

namespace tofray {

DatasetPlan read_plan(const std::filesystem::path& folder) {
  const shards::Plan plan = shards::load_plan(folder);
  return shards::shown(plan, *shards::scenes_of(plan, folder));
}

}  // namespace tofray
