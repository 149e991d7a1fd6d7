// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "recall.h"

#include <fmt/core.h>

#include "base/text.h"
#include "commands.h"
#include "tofray/error.h"

namespace tofray::app {

Options recalled(const Options& now, const results::Manifest& manifest) {
  Options options = now;
  options.set = manifest.set;
  options.seed = manifest.seed;
  for (const auto& [key, value] : manifest.options) {
    if (key == "mode")
      options.mode = value;
    else if (key == "noise" || key == "emit" || key == "arrays" || key == "compress" || key == "theme" || key == "scale" ||
             key == "frames" || key == "first-frame" || key == "exposure-samples" || key == "subpixel")
      option("--" + key).take(options, value);
    else
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: error: unknown option {}\n  a newer tofray wrote this", now.from, base::in_quotes(key)));
  }
  return options;
}

}  // namespace tofray::app
