// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"
#include "cli/console.h"
#include "load/load.h"

namespace tofray::app {

int run_schema(const Options& options) {
  const std::string text = load::schema_json(options.words[0]);
  print(text.ends_with('\n') ? text : text + "\n");
  return 0;
}

}  // namespace tofray::app
