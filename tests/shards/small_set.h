// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <map>
#include <string>

#include "support/tool.h"
#include "tofray/shards.h"

/// A set whose samples take a millisecond: 32 x 24 pixels.
namespace tofray::test {

struct SetText {
  std::string name = "small", license = "CC0-1.0", samples = "40", seed = "5", views = "1", radius = "{uniform: [5 cm, 15 cm]}", more;
  std::string objects;  ///< further ones

  [[nodiscard]] std::string text() const {
    return "name: " + name + "\nlicense: " + license + "\nsamples: " + samples + "\nseed: " + seed + "\nviews: " + views + "\n" + more +
           "scene:\n"
           "  camera: {profile: pico-flexx, mode: {choice: [MODE_9_15FPS_700, MODE_5_45FPS_500]}}\n"
           "  objects:\n"
           "    - plane: {point: [0, 0, {uniform: [1 m, 2 m], per: view}], reflectivity: {uniform: [20 %, 90 %]}}\n"
           "    - sphere: {name: ball, center: [{uniform: [-20 cm, 20 cm]}, 0, 80 cm], radius: " +
           radius + ", reflectivity: 0.5}\n" + objects +
           "set: {camera.sensor.width: 32, camera.sensor.height: 24, camera.lens.fx: 30 px, camera.lens.fy: 30 px, camera.lens.cx: 15.5 "
           "px, camera.lens.cy: 11.5 px}\n";
  }
};

/// The bytes of all files of a set that are the same on every machine, by name.
inline std::map<std::string, std::string> published(const fs::path& folder) {
  std::map<std::string, std::string> out;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).native();
    if (entry.is_regular_file() && !name.starts_with("work/") && !name.starts_with("log/")) out[name] = content(entry.path());
  }
  return out;
}

/// Files below work/: none, where nobody is at work.
inline std::size_t under_way(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code none;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "work", none)) count += entry.is_regular_file() ? 1 : 0;
  return count;
}

/// Writes the set, plans it with eight shards of five samples and makes what `parts` asks for.
struct SmallSet {
  explicit SmallSet(const SetText& text = {}, std::uint64_t shard_samples = 5) {
    write(folder / "set.yaml", text.text());
    plan_dataset({(folder / "set.yaml").native(), folder / "out", 2, shard_samples, 1});
  }
  [[nodiscard]] fs::path out() const { return folder / "out"; }
  ShardRunResult run(std::uint64_t part = 0, std::uint64_t parts = 1, int threads = 1) const {
    return run_shards({out(), {part, parts, {}}, threads});
  }
  Folder folder;
};

/// All of a set made by one process on one thread, and merged.
inline const std::map<std::string, std::string>& undisturbed() {
  static const std::map<std::string, std::string> files = [] {
    const SmallSet set;
    set.run();
    merge_shards(set.out());
    return published(set.out());
  }();
  return files;
}

}  // namespace tofray::test
