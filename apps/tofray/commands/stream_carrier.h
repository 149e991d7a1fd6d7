// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/options.h"
#include "files/json.h"
#include "stream/publisher.h"

namespace tofray::app {

/// What carries a stream, open for readers.
struct Carrier {
  std::unique_ptr<stream::Publisher> publisher;
  std::string name;                                        ///< as --to says it
  std::string where;                                       ///< in a sentence
  std::vector<std::pair<std::string, files::Json>> place;  ///< for programs
};

/// Of --to and the options that go with it.
/// @throws Error (bad_input) for an option of another carrier and for settings that cannot be, (device) where this build or this machine
/// lacks what it needs, (io) where no port can be had
Carrier open_carrier(const Options& options);

}  // namespace tofray::app
