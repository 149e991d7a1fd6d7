// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "dataset/set_file.h"

/// Which samples are for training, for validation and for testing: it follows from the set's seed and the sample's number before all else, so that files are drawn for it.
namespace tofray::dataset {

enum class Split : std::uint8_t { train, validation, test };

/// The files of a pattern, as indices, by split.
using Pools = std::array<std::vector<std::size_t>, 3>;

const char* split_name(Split split);
double share_of(const SplitShares& shares, Split split);

/// Of a set without `split` all samples are for training.
Split split_of(const SetFile& set, std::uint64_t sample);

/// Gives each file that has no split yet one, by shares of their number; one at least for each split as far as there are files.
/// @param contents  SHA-256 of each, sorted
void assign_assets(const SetFile& set, const std::vector<std::string>& contents, std::map<std::string, Split>& known);

}  // namespace tofray::dataset
