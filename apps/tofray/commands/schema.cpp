// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/text.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "dataset/schema.h"
#include "load/load.h"

namespace tofray::app {

int run_schema(const Options& options) {
  std::vector<std::string> kinds = load::schema_kinds();
  kinds.emplace_back("dataset");
  const std::string& kind = options.words[0];
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    base::fail(base::whole("schema"), "no schema of that kind: " + base::in_quotes(kind) + base::did_you_mean(kind, kinds),
               "expected one of " + base::listed(kinds));
  const std::string text = kind == "dataset" ? dataset::schema_json() : load::schema_json(kind);
  print(text.ends_with('\n') ? text : text + "\n");
  return 0;
}

}  // namespace tofray::app
