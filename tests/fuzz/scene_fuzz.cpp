// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a scene, and the camera that it asks for: an Error or finite numbers, nothing else.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/shown.h"
#include "load/fields_finite.h"
#include "load/load.h"
#include "tofray/tofray.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const tofray::Scene scene = tofray::load::scene_from_text(std::string(reinterpret_cast<const char*>(data), size), "<fuzz>");
    if (!tofray::test::finite(scene)) std::abort();
    if (!tofray::test::finite(tofray::load_camera(scene))) std::abort();
  } catch (const tofray::Error& e) {
    if (e.kind() == tofray::ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (!tofray::fuzz::may_be_shown(e)) std::abort();
  }
  return 0;
}
