// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shards/plan.h"
#include "shards/shown_samples.h"
#include "shards/statistics.h"

/// What people and catalogues read of a set: card.md, preview.html, croissant.json.
namespace tofray::shards {

/// What to do where values miss their law.
inline constexpr const char* law_advice =
    "right samplers do that once in a million times: another `seed` tells chance from a fault of this tofray or this processor";

/// A set as merge found it.
struct Summary {
  const Plan& plan;
  const dataset::SetFile& set;
  std::uint64_t shards = 0, samples = 0, bytes = 0;
  Statistics statistics;
  std::vector<std::pair<std::uint64_t, std::string>> holes;  ///< samples, and why
  std::map<std::string, std::string> inputs;                 ///< SHA-256 of files that samples read, by name
  std::vector<ShownSample> spread, worst;
  std::array<std::uint64_t, 3> by_split{};  ///< samples that are there
};

/// For people who find the set: what it is, how it was made, how to load it and to make it again, what is not in it.
std::string card_text(const Summary& of);
/// One page without anything from elsewhere: pictures of some samples, histograms, holes, the worst samples with their commands.
std::string preview_page(const Summary& of);
/// Croissant 1.0. @param sums  SHA-256 of the file SHA256SUMS
std::string croissant_text(const Summary& of, const std::string& sums);

}  // namespace tofray::shards
