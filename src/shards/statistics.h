// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dataset/judge.h"
#include "files/json.h"
#include "tofray/frame.h"

/// What shards count of their frames: whole numbers on fixed bins, so that sums are the same in any order.
namespace tofray::shards {

struct Statistics {
  static constexpr int flag_bits = 16;
  static constexpr double range_step_m = 0.125, error_step_m = 0.002;  ///< of the bins
  static constexpr int range_bins = 128,
                       error_bins = 256;  ///< the last range bin has all beyond; errors from −0.256 m on, the outer ones all beyond

  std::uint64_t frames = 0, pixels = 0, valid = 0;
  std::array<std::uint64_t, flag_bits> flags{};    ///< pixels by bit of `flags`
  std::array<std::uint64_t, range_bins> true_z{};  ///< gt_z_m of pixels that see something
  std::array<std::uint64_t, error_bins> error{};   ///< z_m − gt_z_m of valid pixels
  dataset::Judgement draws;                        ///< what was drawn, by key, against its law

  void add(const Frame& frame);
  void add(const Statistics& other);
  [[nodiscard]] files::Json json() const;
};

/// @throws Error (bad_input) where it has another form; `where` for messages
Statistics statistics_of(const files::Json& json, const std::string& where);

}  // namespace tofray::shards
