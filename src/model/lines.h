// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "model/form.h"

/// A file kind as a list of its keys: for the reference page, `tofray list keys` and completion.
namespace tofray::model {

struct Line {
  std::string key;       ///< dotted, as --set takes it; the first of a list is 0, a name that is free NAME
  std::string value;     ///< what may stand there: "`50 e`, 0 e to 1e+06 e"
  std::string fallback;  ///< what holds where the key is absent; empty: the line says it
  bool required = false;
  std::string doc;
  std::string member;  ///< in code: "Pixel::read_noise_e"
  std::string kind;    ///< which kind of a thing the key belongs to, with which `doc` then begins: "gaussian: …"
};

/// All keys that have a value of their own, in the order of the tables.
std::vector<Line> lines_of(const FileForm& file);

}  // namespace tofray::model
