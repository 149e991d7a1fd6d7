// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/manifest.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "base/faults.h"
#include "files/data_limits.h"
#include "files/json.h"
#include "files/read_bytes.h"
#include "tofray/error.h"

namespace tofray::results {

using files::Json;
using files::json_text;
using files::max_manifest_bytes;
using files::parse_json;
using files::read_bytes;

namespace {

using Pairs = std::vector<std::pair<std::string, std::string>>;

Json pairs_json(const Pairs& pairs) {
  Json list = Json::array();
  for (const auto& [key, value] : pairs) list.push(Json::list(std::vector<std::string>{key, value}));
  return list;
}

/// Takes members out of a manifest and collects what is wrong with it.
class Reader {
 public:
  Reader(Json document, const std::string& path) : document_(std::move(document)), path_(path) {}

  Manifest read() {
    Manifest manifest;
    if (!document_.is_object()) fault("the document", "an object");
    string(document_, "", "tofray", manifest.tofray_version);
    read_command(manifest);
    read_inputs(manifest);
    read_pairs("set", manifest.set);
    read_pairs("options", manifest.options);
    const Json* seed = find(document_, "", "seed", "a whole number of 0 or more");
    if (seed != nullptr && !seed->unsigned_integer(manifest.seed)) fault("seed", "a whole number of 0 or more");
    read_machine(manifest);
    read_files("files", manifest.files);
    if (document_.is_object() && document_.find("earlier_files") != nullptr) read_files("earlier_files", manifest.earlier_files);
    faults_.raise();
    return manifest;
  }

 private:
  void fault(const std::string& what, const std::string& expected) {
    faults_.add(base::whole(path_), what + " is missing or malformed", "expected " + expected);
  }
  const Json* find(const Json& object, const std::string& before, const char* key, const char* expected) {
    const Json* member = object.find(key);
    if (member == nullptr) fault(before + key, expected);
    return member;
  }
  void string(const Json& object, const std::string& before, const char* key, std::string& value) {
    const Json* member = find(object, before, key, "a string");
    if (member == nullptr) return;
    if (member->is_string())
      value = *member->string();
    else
      fault(before + key, "a string");
  }
  /// The items of a list, or an empty list and a fault.
  const Json::Array& items(const Json& object, const char* key, const char* expected) {
    static const Json::Array none;
    const Json* member = find(object, "", key, expected);
    if (member == nullptr) return none;
    if (member->is_array()) return *member->items();
    fault(key, expected);
    return none;
  }
  void read_command(Manifest& manifest) {
    for (const Json& word : items(document_, "command", "a list of strings")) {
      if (!word.is_string()) return fault("command", "a list of strings");
      manifest.command.push_back(*word.string());
    }
  }
  void read_inputs(Manifest& manifest) {
    const Json::Array& inputs = items(document_, "inputs", "a list of role, name and text");
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const std::string before = fmt::format("inputs[{}].", i);
      InputFile& input = manifest.inputs.emplace_back();
      string(inputs[i], before, "role", input.role);
      string(inputs[i], before, "name", input.name);
      string(inputs[i], before, "text", input.text);
      if (inputs[i].find("sha256") != nullptr) string(inputs[i], before, "sha256", input.sha256);
    }
  }
  void read_pairs(const char* key, Pairs& pairs) {
    for (const Json& pair : items(document_, key, "a list of pairs of strings")) {
      const Json::Array* both = pair.items();
      if (both == nullptr || both->size() != 2 || !(*both)[0].is_string() || !(*both)[1].is_string())
        return fault(key, "a list of pairs of strings");
      pairs.emplace_back(*(*both)[0].string(), *(*both)[1].string());
    }
  }
  void read_machine(Manifest& manifest) {
    string(document_, "", "backend", manifest.backend);
    const Json* device = find(document_, "", "device", "an object with cpu and isa");
    if (device != nullptr) {
      string(*device, "device.", "cpu", manifest.cpu_model);
      string(*device, "device.", "isa", manifest.isa);
      if (device->find("gpu") != nullptr) string(*device, "device.", "gpu", manifest.gpu);
    }
    std::uint64_t threads = 0;
    const Json* count = find(document_, "", "threads", "a whole number");
    if (count != nullptr && (!count->unsigned_integer(threads) || threads > 1'000'000)) fault("threads", "a whole number");
    manifest.threads = static_cast<int>(threads);
    const Json* timings = find(document_, "", "timings_s", "an object of numbers");
    if (timings == nullptr) return;
    if (!timings->is_object()) return fault("timings_s", "an object of numbers");
    for (const auto& [stage, seconds] : *timings->members()) {
      double value = 0;
      if (!seconds.number(value)) return fault("timings_s." + stage, "a number");
      manifest.timings_s.emplace_back(stage, value);
    }
  }
  void read_files(const char* key, std::vector<FileRecord>& records) {
    const Json::Array& files = items(document_, key, "a list of name, bytes and sha256");
    for (std::size_t i = 0; i < files.size(); ++i) {
      const std::string before = fmt::format("{}[{}].", key, i);
      FileRecord& file = records.emplace_back();
      string(files[i], before, "name", file.name);
      string(files[i], before, "sha256", file.sha256);
      const Json* bytes = find(files[i], before, "bytes", "a whole number");
      if (bytes != nullptr && !bytes->unsigned_integer(file.bytes)) fault(before + "bytes", "a whole number");
    }
  }

  Json document_;
  const std::string& path_;
  base::Faults faults_;
};

Json json_of(const InputFile& input) {
  Json out = Json::object();
  out.set("role", input.role).set("name", input.name).set("text", input.text);
  if (!input.sha256.empty()) out.set("sha256", input.sha256);
  return out;
}

Json records_json(const std::vector<FileRecord>& records) {
  Json out = Json::array();
  for (const FileRecord& file : records)
    out.push(Json::object().set("name", file.name).set("bytes", file.bytes).set("sha256", file.sha256));
  return out;
}

}  // namespace

std::string cpu_model_in(std::string_view cpuinfo) {
  const auto value = [&](std::string_view key) -> std::string {
    for (std::size_t at = 0; at < cpuinfo.size();) {
      const std::size_t end = std::min(cpuinfo.find('\n', at), cpuinfo.size());
      const std::string_view line = cpuinfo.substr(at, end - at);
      const std::size_t colon = line.find(": ");
      if (line.starts_with(key) && colon != std::string_view::npos) return std::string(line.substr(colon + 2));
      at = end + 1;
    }
    return "";
  };
  const std::string model = value("model name"), maker = value("CPU implementer"), design = value("CPU part");
  if (!model.empty()) return model;
  return maker.empty() || design.empty() ? "unknown" : "ARM, implementer " + maker + ", part " + design;
}

std::string cpu_model() {
  std::FILE* file = std::fopen("/proc/cpuinfo", "re");
  if (file == nullptr) return "unknown";
  char text[4096];  // the first processor's part, and more
  const std::size_t count = std::fread(text, 1, sizeof text, file);
  std::fclose(file);
  return cpu_model_in({text, count});
}

std::string manifest_text(const Manifest& manifest) {
  Json inputs = Json::array(), timings = Json::object();
  for (const InputFile& input : manifest.inputs) inputs.push(json_of(input));
  for (const auto& [stage, seconds] : manifest.timings_s) timings.set(stage, seconds);
  Json json = Json::object();
  json.set("tofray", manifest.tofray_version).set("command", Json::list(manifest.command)).set("inputs", std::move(inputs));
  json.set("set", pairs_json(manifest.set)).set("options", pairs_json(manifest.options)).set("seed", manifest.seed);
  Json device = Json::object().set("cpu", manifest.cpu_model).set("isa", manifest.isa);
  if (!manifest.gpu.empty()) device.set("gpu", manifest.gpu);
  json.set("backend", manifest.backend).set("device", std::move(device));
  if (manifest.interrupted_after_frames) json.set("interrupted_after_frames", *manifest.interrupted_after_frames);
  json.set("threads", manifest.threads).set("timings_s", std::move(timings)).set("files", records_json(manifest.files));
  if (!manifest.earlier_files.empty()) json.set("earlier_files", records_json(manifest.earlier_files));
  return json_text(json, 2) + "\n";
}

Manifest parse_manifest(std::string_view text, const std::string& path) { return Reader(parse_json(text, path), path).read(); }

Manifest read_manifest(const std::string& path) { return parse_manifest(read_bytes(path, max_manifest_bytes), path); }

}  // namespace tofray::results
