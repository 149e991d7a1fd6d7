// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <set>

#include "base/version.h"
#include "results/array_table.h"
#include "shards/quantised.h"
#include "shards/summary.h"

namespace tofray::shards {

namespace {

using files::Json;

/// What the shown samples say of a key of their camera, each once.
std::string cameras_of(const Summary& of) {
  std::set<std::string> names;
  for (const ShownSample& one : of.spread)
    if (const Json* camera = one.about.find("camera"))
      names.insert(fmt::format("`{}`, mode `{}`, {} × {} pixels", *camera->find("profile")->string(), *camera->find("mode")->string(),
                               files::json_text(*camera->find("width")), files::json_text(*camera->find("height"))));
  std::string out;
  for (const std::string& name : names) out += "- " + name + "\n";
  return out.empty() ? "- none: no sample is there\n" : out;
}

std::string shape_text(const Json& shape) {
  std::string out;
  for (const Json& one : *shape.items()) out += (out.empty() ? "" : " × ") + files::json_text(one);
  return out;
}

std::string array_rows(const Summary& of) {
  const Json* const arrays = of.spread.empty() ? nullptr : of.spread.front().about.find("arrays");
  std::string out;
  for (const std::string& name : of.plan.arrays) {
    const results::ArrayRow& row = *results::find_array(name);
    const Json* const one = arrays != nullptr ? arrays->find(name) : nullptr;
    out += fmt::format("| `{}` | {} | {} | {} | {} |\n", name, stored_type(of.set, row),
                       one != nullptr ? shape_text(*one->find("shape")) : "", row.unit, row.what);
  }
  return out;
}

std::string flag_rows(const Summary& of) {
  std::string out;
  const Json counts = of.statistics.json();
  for (const auto& [name, count] : *counts.find("flags")->members()) {
    std::uint64_t pixels = 0;
    if (!count.unsigned_integer(pixels) || pixels == 0) continue;
    out += fmt::format("| `{}` | {:.2f} % |\n", name, 100 * static_cast<double>(pixels) / static_cast<double>(of.statistics.pixels));
  }
  return out;
}

std::string split_rows(const Summary& of) {
  const dataset::SplitShares& shares = of.set.split;
  if (shares.by == dataset::SplitShares::By::nothing) return {};
  std::string out = "\n## Splits\n\n| split | scenes |\n|---|---|\n";
  for (const dataset::Split split : {dataset::Split::train, dataset::Split::validation, dataset::Split::test})
    if (dataset::share_of(shares, split) > 0)
      out += fmt::format("| {} | {} |\n", split_name(split), of.by_split[static_cast<std::size_t>(split)]);
  return out +
         (shares.by == dataset::SplitShares::By::asset
              ? "\nNo two splits have a file of a `files` pattern in common, by its SHA-256. All else that the set's file says is in each: "
                "its primitives, materials, laws and camera.\n"
              : "\nNo two splits have a scene in common. Files, materials, laws and the camera are in each: what a network knows of these, "
                "it "
                "knows from training.\n");
}

std::string law_rows(const dataset::Judgement& draws) {
  if (draws.empty()) return {};
  std::string out =
      "\n## Draws\n\nValues by their place in the law that they are drawn by, in 16 bins, before any scene was refused.\n\n| key | form | "
      "draws | χ² |\n|---|---|---|---|\n";
  for (const auto& [path, one] : draws)
    out += fmt::format("| `{}` | {} | {} | {:.1f}{} |\n", path, one.form, one.draws(), one.chi_square(),
                       one.draws() < dataset::DrawCounts::least ? ", too few to judge"
                       : one.misses()                           ? ", **misses its law**"
                                                                : "");
  return out + fmt::format("\nRight samplers exceed {:.1f} once in a million times.\n", dataset::DrawCounts::most);
}

std::string input_rows(const Summary& of) {
  std::map<std::string, std::string> all = of.inputs;
  for (const FileRecord& one : of.plan.inputs) all.emplace(one.name, one.sha256);
  for (const auto& [name, sha256] : of.plan.reads) all.emplace(name, sha256);
  std::string out;
  for (const auto& [name, sha256] : all) out += fmt::format("| `{}` | `{}` |\n", name, sha256);
  return out.empty() ? "None: everything comes out of the file below and tofray.\n"
                     : "| file | SHA-256 |\n|---|---|\n" + out + "\nTheir licences are those of who made them.\n";
}

}  // namespace

std::string card_text(const Summary& of) {
  const Plan& plan = of.plan;
  const Statistics& seen = of.statistics;
  std::string out = fmt::format(
      "# {}\n\nSimulated raw and depth frames of time-of-flight cameras, with ground truth: {} frames of {} scenes, {:.1f} MB in {} "
      "shards. "
      "Made by tofray {}; the set's file, below, and this version decide every byte.\n\n",
      of.set.name, seen.frames, of.samples, 1e-6 * static_cast<double>(of.bytes), of.shards, plan.version);
  out += fmt::format(
      "| | |\n|---|---|\n| licence | {} |\n| plan | `{}` |\n| scenes | {} planned, {} there, {} left out |\n| views of each | {} |\n| "
      "pixels with a depth | {:.1f} % |\n",
      of.set.license.empty() ? "not said" : of.set.license, plan.id, plan.samples, of.samples, of.holes.size(), plan.views,
      seen.pixels == 0 ? 0 : 100 * static_cast<double>(seen.valid) / static_cast<double>(seen.pixels));
  out +=
      "\n`preview.html` shows some of it, `statistics.json` has histograms.\n\n## Cameras\n\nOf the samples that the preview shows:\n\n" +
      cameras_of(of);
  out +=
      "\nA simulated camera is not the camera: none of the profiles is certified by its maker, and how well each agrees with measurements "
      "stands in tofray's "
      "documentation (Cameras, Validation).\n";
  out +=
      "\n## Arrays\n\nRow-major, little endian; invalid values are NaN in floats and 0 in integers. `z` lies along the optical axis, "
      "`range` along the pixel's ray: check which one is meant.\n\n"
      "| array | type | shape | unit | what it is |\n|---|---|---|---|---|\n" +
      array_rows(of);
  out +=
      "\nEach sample's JSON has what is the same for all of its pixels (modulation frequency, reference phase and exposure of each raw "
      "frame, camera matrix, distortion, camera's pose), its objects with poses and boxes, what was drawn, and the whole scene as YAML.\n";
  if (const std::string flags = flag_rows(of); !flags.empty())
    out += "\n## Flags\n\nShare of all pixels.\n\n| flag | pixels |\n|---|---|\n" + flags;
  out += split_rows(of) + law_rows(seen.draws);
  out +=
      "\n## How to load it\n\n"
      "```python\nimport tofray\n\nsamples = tofray.open_dataset(\"FOLDER\")       # this folder, or the plan alone: then samples are "
      "computed\nsample = samples[0]\n```\n\n"
      "With the webdataset library: `wids.json` lists the shards. With nothing but numpy:\n\n"
      "```python\nimport io, json, tarfile\nimport numpy as np\n\nwith tarfile.open(\"shards/000/000000.tar\") as tar:\n    for member in "
      "tar:\n        key, name = member.name.split(\".\", 1)\n        data = tar.extractfile(member).read()\n        value = "
      "json.loads(data) if name == \"json\" else np.load(io.BytesIO(data))\n```\n\n"
      "Arrays begin at multiples of 64 bytes, so that `np.memmap` gives them without a copy: `index/` says where.\n";
  out += fmt::format(
      "\n## How to make it again\n\nWith tofray {} on any machine, the set's file as `set.yaml` and the files below beside it:\n\n"
      "```sh\ntofray dataset plan set.yaml -o again\ntofray dataset run again\ntofray dataset merge again\n(cd again && sha256sum --check "
      "--quiet SHA256SUMS)\n```\n\n"
      "The last line has to name no shard. `tofray dataset verify . --recompute 1%` computes one sample in a hundred of this folder "
      "again.\n",
      plan.version);
  out += "\n## Files that it is made of\n\n" + input_rows(of);
  out +=
      "\n## What is not in it\n\nColour pictures; diffraction and lens flare by reflections inside a lens; polarisation; people's and "
      "animals' motion unless the set's files have it; whatever tofray's documentation lists under Not simulated. Material of the near "
      "infrared is what the set's file says of it: these scenes were not measured.\n";
  if (!of.holes.empty()) {
    out += "\n## Scenes left out\n\nTheir numbers stay free.\n\n| scene | why |\n|---|---|\n";
    constexpr std::size_t most = 20;
    for (std::size_t i = 0; i < of.holes.size() && i < most; ++i)
      out += fmt::format("| {} | {} |\n", of.holes[i].first, of.holes[i].second.substr(0, of.holes[i].second.find('\n')));
    if (of.holes.size() > most) out += fmt::format("\n{} more stand in `statistics.json`.\n", of.holes.size() - most);
  }
  // A fence that no line of the file closes.
  std::string fence = "```";
  while (plan.set_text.find(fence) != std::string::npos) fence += '`';
  out += "\n## The set's file\n\n" + fence + "yaml\n" + plan.set_text + (plan.set_text.ends_with('\n') ? "" : "\n") + fence + "\n";
  return out;
}

}  // namespace tofray::shards
