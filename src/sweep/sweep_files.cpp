// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/sweep_files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "base/version.h"
#include "files/npz.h"
#include "files/output_folder.h"
#include "results/manifest.h"
#include "run/manifest.h"
#include "tofray/error.h"

namespace tofray::sweeps {

namespace {

using files::Json;

constexpr const char* stage_names[] = {"trace", "power", "raw", "depth"};

std::string in_csv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// An array of texts, as numpy has them: all as wide as the longest.
struct Texts {
  std::string bytes;
  files::NpyType type{'U', 4};
  std::size_t count;

  explicit Texts(const std::vector<std::string>& texts) : count(texts.size()) {
    std::vector<std::string> wide;
    std::size_t most = 4;
    for (const std::string& one : texts) wide.push_back(files::utf32_of(one)), most = std::max(most, wide.back().size());
    for (std::string& one : wide) one.resize(most, '\0'), bytes += one;
    type.size = static_cast<int>(most);
  }
  [[nodiscard]] files::NpyView view(const std::string& name) const { return {name, type, {count}, bytes}; }
};

std::string meta_text(const Sweep& sweep) {
  Json axes = Json::array();
  for (const SweepAxis& axis : sweep.axes)
    axes.push(Json::object()
                  .set("key", axis.key)
                  .set("unit", axis.unit)
                  .set("values", Json::list(axis.values))
                  .set("first_stage", stage_names[static_cast<int>(axis.stage)]));
  return files::json_text(Json::object().set("tofray", base::version()).set("axes", std::move(axes)).set("repeat", sweep.repeat), -1);
}

}  // namespace

std::string csv_text(const Sweep& sweep) {
  std::string out;
  for (const SweepAxis& axis : sweep.axes)
    out += in_csv(axis.key + (axis.numbers.empty() || axis.unit.empty() ? "" : " [" + axis.unit + "]")) + ",";
  out += "region";
  for (const std::string& metric : sweep.metrics) out += "," + metric;
  out += "\n";
  for (std::uint64_t cell = 0; cell < sweep.cells(); ++cell) {
    std::string before;
    for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
      const SweepAxis& axis = sweep.axes[i];
      const std::size_t place = sweep.place(cell, i);
      before += (axis.numbers.empty() ? in_csv(axis.values[place]) : base::number_text(axis.numbers[place])) + ",";
    }
    for (std::size_t region = 0; region < sweep.regions.size(); ++region) {
      out += before + in_csv(sweep.regions[region]);
      for (std::size_t metric = 0; metric < sweep.metrics.size(); ++metric) {
        const double value = sweep.value(cell, region, metric);
        out += "," + (std::isnan(value) ? "" : base::number_text(value));
      }
      out += "\n";
    }
  }
  return out;
}

std::string npz_bytes(const Sweep& sweep) {
  std::vector<std::string> keys;
  files::NpyShape shape;
  for (const SweepAxis& axis : sweep.axes) keys.push_back(axis.key), shape.push_back(axis.values.size());
  shape.push_back(sweep.regions.size());
  const Texts axes(keys), regions(sweep.regions), metrics(sweep.metrics);
  std::vector<files::NpyView> views = {axes.view("axes"), regions.view("regions"), metrics.view("metrics")};
  std::vector<Texts> words;
  words.reserve(sweep.axes.size());
  for (const SweepAxis& axis : sweep.axes)
    views.push_back(axis.numbers.empty() ? words.emplace_back(axis.values).view(axis.key)
                                         : files::npy_view(axis.key, {axis.numbers.size()}, axis.numbers));
  std::vector<std::vector<double>> arrays(sweep.metrics.size());
  for (std::size_t metric = 0; metric < arrays.size(); ++metric) {
    for (std::uint64_t cell = 0; cell < sweep.cells(); ++cell)
      for (std::size_t region = 0; region < sweep.regions.size(); ++region) arrays[metric].push_back(sweep.value(cell, region, metric));
    views.push_back(files::npy_view(sweep.metrics[metric], shape, arrays[metric]));
  }
  const std::string meta = files::utf32_of(meta_text(sweep));
  views.push_back({"meta", {'U', static_cast<int>(meta.size())}, {}, meta});
  return files::npz_bytes(views);
}

Json json_of(const Sweep& sweep) {
  Json axes = Json::array(), cells = Json::array();
  for (const SweepAxis& axis : sweep.axes) {
    Json one = Json::object();
    one.set("key", axis.key).set("values", Json::list(axis.values));
    if (!axis.numbers.empty()) one.set("numbers", Json::list(axis.numbers)).set("unit", axis.unit);
    axes.push(std::move(one.set("first_stage", stage_names[static_cast<int>(axis.stage)])));
  }
  for (std::uint64_t cell = 0; cell < sweep.cells(); ++cell) {
    Json regions = Json::object();
    for (std::size_t region = 0; region < sweep.regions.size(); ++region) {
      Json numbers = Json::object();
      for (std::size_t metric = 0; metric < sweep.metrics.size(); ++metric) {
        const double value = sweep.value(cell, region, metric);
        numbers.set(sweep.metrics[metric], std::isnan(value) ? Json() : Json(value));
      }
      regions.set(sweep.regions[region], std::move(numbers));
    }
    Json set = Json::object();
    for (std::size_t i = 0; i < sweep.axes.size(); ++i) set.set(sweep.axes[i].key, sweep.axes[i].values[sweep.place(cell, i)]);
    cells.push(Json::object().set("set", std::move(set)).set("regions", std::move(regions)));
  }
  return Json::object()
      .set("axes", std::move(axes))
      .set("metrics", Json::list(sweep.metrics))
      .set("repeat", sweep.repeat)
      .set("traced", sweep.traced)
      .set("from_light", sweep.from_light)
      .set("from_raw", sweep.from_raw)
      .set("cells", std::move(cells));
}

}  // namespace tofray::sweeps

namespace tofray {

std::vector<FileRecord> save_sweep(const Sweep& sweep, const SweepRequest& request, const std::string& name,
                                   const std::vector<std::string>& command) {
  if (sweep.interrupted)
    throw Error(ErrorKind::bad_input,
                "error: the sweep was interrupted, and what it holds means nothing\n  expected one that came to its end");
  files::OutputFolder folder(name);
  folder.write("sweep.csv", sweeps::csv_text(sweep));
  folder.write("sweep.npz", sweeps::npz_bytes(sweep));
  RunRequest as_run;
  as_run.inputs = request.inputs, as_run.simulator = request.simulator, as_run.simulator.arrays.clear(), as_run.command = command;
  results::Manifest manifest = run::manifest_of(as_run);
  for (const SweepAxis& axis : request.axes) {
    std::string values;
    for (const std::string& one : axis.values) values += (values.empty() ? "" : ",") + one;
    manifest.options.emplace_back("vary", axis.key + "=" + values);
  }
  manifest.options.emplace_back("repeat", std::to_string(request.repeat));
  if (request.region.width > 0)
    manifest.options.emplace_back(
        "region", fmt::format("{},{},{},{}", request.region.u, request.region.v, request.region.width, request.region.height));
  if (request.by_object) manifest.options.emplace_back("by-object", "on");
  manifest.inputs = sweep.files;
  manifest.backend = sweep.ran_on.backend, manifest.threads = sweep.ran_on.threads, manifest.isa = sweep.ran_on.isa;
  manifest.cpu_model = results::cpu_model();
  manifest.timings_s = {{"sweep", sweep.seconds}};
  manifest.files = folder.files();
  folder.write("manifest.json", results::manifest_text(manifest));
  return folder.files();
}

}  // namespace tofray
