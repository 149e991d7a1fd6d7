// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/quality.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "analysis/quality_metrics.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/remarks.h"
#include "commands/limits.h"
#include "files/atomic_file.h"
#include "files/json.h"
#include "tofray/depth_file.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

struct Measurement {
  std::vector<std::string> files;
  Quality quality;
};

bool same_truth(const Truth& a, const Truth& b) {
  return std::equal(a.z_m.begin(), a.z_m.end(), b.z_m.begin(), b.z_m.end(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

Measurement measured(const Options& options, Remarks& remarks) {
  Measurement out;
  std::vector<Depth> frames;
  Truth truth;
  const DepthFileOptions how{options.unit_m, options.intrinsics};
  bool moves = false;
  for (const std::string& word : options.words)
    for (DepthFile& one : load_depths(word, how)) {
      if (one.depth.z_m.empty())
        throw Error(
            ErrorKind::bad_input,
            base::printable(one.file) + ": error: there is no depth in it, only truth\n  expected z_m; `tofray compare` takes truth, too");
      if (out.files.empty())
        truth = std::move(one.truth);
      else
        moves = moves || (!truth.z_m.empty() && !one.truth.z_m.empty() && !same_truth(truth, one.truth));
      out.files.push_back(one.file), frames.push_back(std::move(one.depth));
    }
  if (moves)
    remarks.tell(
        "warning: the truth of the frames differs: something moves, and counts as noise and bias\n  expected frames of a still scene and "
        "camera\n");
  const QualityRequest request{options.region, options.like, options.truth_m};
  const Depth right = depth_of(truth);
  out.quality = quality(frames, request, right.z_m.empty() ? nullptr : &right);
  for (const std::string& note : out.quality.notes) remarks.tell("note: " + note + "\n");
  return out;
}

std::string region_text(const ImageRegion& region) {
  return fmt::format("columns {} to {}, rows {} to {}", region.u, region.u + region.width - 1, region.v, region.v + region.height - 1);
}

std::string text_of(const Measurement& of, const Options& options) {
  const Quality& quality = of.quality;
  std::string text = quality.frames == 1 ? fmt::format("{}: {}\n", of.files.front(), region_text(quality.region))
                                         : fmt::format("{} frames, {} to {}: {}\n", quality.frames, of.files.front(), of.files.back(),
                                                       region_text(quality.region));
  for (const QualityPreset& preset : quality_presets()) {
    if (preset.name != options.like) continue;
    text += fmt::format("conditions of {}: {}\n", preset.maker, preset.target);
    if (!preset.stated.empty()) text += fmt::format("the maker states: {}\n", preset.stated);
  }
  text += "\n";
  std::vector<std::string> unknown;
  for (const analysis::QualityMetric& one : analysis::quality_metrics()) {
    const double value = quality.*(one.member);
    if (std::isnan(value))
      unknown.push_back(fmt::format("  {:<25} needs {}\n", one.name, one.needs));
    else
      text += fmt::format("  {:<25} {:>12}   {}\n", one.name, measured_text(one.name, value), one.what);
  }
  if (!unknown.empty()) text += "\nnot known:\n";
  for (const std::string& one : unknown) text += one;
  return text;
}

std::string json_of(const Measurement& of) {
  const Quality& quality = of.quality;
  files::Json metrics = files::Json::object();
  for (const analysis::QualityMetric& one : analysis::quality_metrics()) {
    const double value = quality.*(one.member);
    metrics.set(one.name, std::isnan(value) ? files::Json() : files::Json(value));
  }
  files::Json json = files::Json::object();
  json.set("files", files::Json::list(of.files))
      .set("frames", quality.frames)
      .set("region", files::Json::list(std::vector<int>{quality.region.u, quality.region.v, quality.region.width, quality.region.height}))
      .set("notes", files::Json::list(quality.notes))
      .set("metrics", std::move(metrics));
  return files::json_text(json, 2) + "\n";
}

std::string csv_of(const Measurement& of) {
  std::string text = "name,value\n";
  for (const analysis::QualityMetric& one : analysis::quality_metrics()) {
    const double value = of.quality.*(one.member);
    text += fmt::format("{},{}\n", one.name, std::isnan(value) ? "" : base::number_text(value));
  }
  return text;
}

}  // namespace

int run_quality(const Options& options) {
  Remarks remarks;
  const Measurement of = measured(options, remarks);
  std::vector<Measured> all;
  for (const analysis::QualityMetric& one : analysis::quality_metrics())
    all.push_back({one.name, of.quality.*(one.member), one.at_least, one.needs});
  const std::string beyond = beyond_limits(all, options.limits);
  const std::string& file = options.output;
  if (!file.empty()) files::write_file_atomically(file, file.ends_with(".json") ? json_of(of) : csv_of(of));
  if (options.json)
    print(json_of(of));
  else if (options.csv)
    print(csv_of(of));
  else if (file.empty())
    print(text_of(of, options));
  say(beyond);
  return beyond.empty() ? 0 : 1;
}

}  // namespace tofray::app
