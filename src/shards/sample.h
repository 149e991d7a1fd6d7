// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "dataset/judge.h"
#include "shards/plan.h"
#include "shards/statistics.h"
#include "tofray/camera.h"

/// What a shard holds of one sample.
namespace tofray::shards {

struct MadeSample {
  struct Member {
    std::string name;   ///< behind the key and a dot: "raw.npy"
    std::string bytes;  ///< the whole file
  };
  std::uint64_t view = 0;
  std::vector<Member> members;                ///< arrays in the order of the table of arrays, then "json"
  std::map<std::string, std::string> inputs;  ///< SHA-256 of the files that it read, by name from the set's folder on
  Statistics statistics;
  dataset::Judgement draws;  ///< as Scenes::judge() adds it; of a set that refuses nothing
};

/// Samples of a set, by number.
class SampleMaker {
 public:
  /// @param arrays  names; empty: those that the set's file asks for, or the usual ones, as far as the sample has them
  SampleMaker(const dataset::Scenes& scenes, std::vector<std::string> arrays, FrameProgress* progress);

  /// Several threads may ask at once. @throws Error (bad_input) where the scene makes no sense, or has other arrays than the set's
  [[nodiscard]] MadeSample make(std::uint64_t sample, std::uint64_t view) const;
  /// A message without the folder of the set, so that it is the same on every machine.
  [[nodiscard]] std::string without_folder(const std::string& text) const;

 private:
  /// The camera that a scene asks for; those of the samples before are kept, since most samples have one of a few.
  [[nodiscard]] std::shared_ptr<const Camera> camera_of(const Scene& scene) const;
  [[nodiscard]] std::string name_of(const std::string& path) const;
  void add_inputs(const Scene& scene, const Camera& camera, std::map<std::string, std::string>& inputs) const;

  const dataset::Scenes& scenes_;
  std::vector<std::string> arrays_, wanted_;  ///< as they were given; that are computed
  results::ArrayChoice choice_;
  FrameProgress* progress_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::shared_ptr<const Camera>> cameras_;  ///< by what the scene says of them; guarded by the mutex
};

/// What it takes of a tar.
std::uint64_t tar_bytes(const MadeSample& sample);

/// Names of the arrays that a sample has, of its members' names.
std::vector<std::string> arrays_of(const MadeSample& sample);

}  // namespace tofray::shards
