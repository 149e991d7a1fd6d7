// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "dataset/stored.h"
#include "model/form.h"
#include "yaml/tree.h"

/// A set's file as it is written: how many samples of which scene.
namespace tofray::dataset {

/// What a sample's first look has to show for it to be taken.
struct AcceptRule {
  base::Place place;
  std::string seen;          ///< name of an object, or of a scatter; empty: the rule is of all pixels
  std::uint64_t pixels = 0;  ///< that have to see it, of the whole image
  double valid = 0;          ///< share of the pixels that have to have a depth
};

/// Which samples are for which part of a network's life.
struct SplitShares {
  enum class By : std::uint8_t { nothing, scene, asset };
  By by = By::nothing;
  base::Place place;
  double test = 0, validation = 0;  ///< shares of the samples; the rest is for training
};

struct SetFile {
  std::string source;  ///< the file's name
  std::string folder;  ///< where tables and files beside it are looked for
  std::string name, license;
  std::uint64_t samples = 0, seed = 0, views = 1, devices = 1;
  std::vector<std::string> arrays;  ///< names and patterns of what is stored; empty: the usual ones
  std::vector<Quantised> as;
  double holes = 0;  ///< the share of samples that may fail
  SplitShares split;
  std::vector<AcceptRule> accept;
  std::uint64_t attempts = 50;  ///< at a sample that these take
  bool again = false;           ///< a scatter draws the sample again where a thing finds no room
  yaml::Node let, scene, set;   ///< forms in them, not yet drawn
  std::string text;             ///< the whole file
  /// All of it that the samples are made of, in one form whatever comments and blanks the file has: without `samples`.
  std::string laws;

  /// Whether a sample may take several attempts.
  [[nodiscard]] bool tries() const { return again || !accept.empty(); }
};

/// The keys of a set's file, from which it is read.
const model::FileForm& set_form();

/// @throws Error with every fault of these keys; what stands in let, scene and set is looked at when it is drawn
SetFile parse_set(std::string_view text, const std::string& source);

}  // namespace tofray::dataset
