// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a camera profile, or as the value of a key that is set: an Error or finite numbers, nothing else.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/shown.h"
#include "load/builtin.h"
#include "load/fields_finite.h"
#include "load/load.h"
#include "tofray/tofray.h"

namespace {

void load(const std::string& text, const tofray::CameraOptions& options) {
  try {
    if (!tofray::test::finite(tofray::load::camera_from_text(text, "<fuzz>", "", options))) std::abort();
  } catch (const tofray::Error& e) {
    if (e.kind() == tofray::ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (!tofray::fuzz::may_be_shown(e)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  load(text, {});
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals > 100) return 0;
  tofray::CameraOptions options;
  options.set.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  static const std::string profile(tofray::load::find_builtin(tofray::load::builtin_profiles(), "pico-flexx")->text);
  load(profile, options);
  return 0;
}
