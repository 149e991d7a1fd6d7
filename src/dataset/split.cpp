// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/split.h"

#include <algorithm>
#include <cmath>

#include "dataset/draw.h"

namespace tofray::dataset {

namespace {

/// How many of so many files a share is: one at least, of a share that is not 0.
std::size_t part_of(double share, std::size_t count) {
  return share > 0 ? std::max<std::size_t>(1, static_cast<std::size_t>(std::floor(share * static_cast<double>(count) + 0.5))) : 0;
}

}  // namespace

const char* split_name(Split split) {
  switch (split) {
    case Split::train: return "train";
    case Split::validation: return "validation";
    case Split::test: return "test";
  }
  return "";
}

double share_of(const SplitShares& shares, Split split) {
  switch (split) {
    case Split::train: return 1 - shares.test - shares.validation;
    case Split::validation: return shares.validation;
    case Split::test: return shares.test;
  }
  return 0;
}

Split split_of(const SetFile& set, std::uint64_t sample) {
  if (set.split.by == SplitShares::By::nothing) return Split::train;
  const double at = unit_number(random_bits({.seed = set.seed, .sample = sample}, "split"));
  if (at < set.split.test) return Split::test;
  return at < set.split.test + set.split.validation ? Split::validation : Split::train;
}

void assign_assets(const SetFile& set, const std::vector<std::string>& contents, std::map<std::string, Split>& known) {
  std::vector<std::string> fresh;
  for (const std::string& one : contents)
    if (!known.contains(one) && (fresh.empty() || fresh.back() != one)) fresh.push_back(one);
  const std::size_t test = part_of(set.split.test, fresh.size()), validation = part_of(set.split.validation, fresh.size());
  for (std::size_t i = 0; i < fresh.size(); ++i) {
    const std::uint64_t at = permuted(i, fresh.size(), set.seed, "split/assets");
    // Training comes first where there are few.
    known[fresh[i]] = at == 0 ? Split::train : at <= test ? Split::test : at <= test + validation ? Split::validation : Split::train;
  }
}

}  // namespace tofray::dataset
