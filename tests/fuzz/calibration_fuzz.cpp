// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a calibration of other software, for each size of image that an Azure Kinect has, and one that it has not: an Error, or a
// profile that is read.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "fuzz/shown.h"
#include "load/lens_calibration.h"
#include "tofray/load.h"

namespace {

void read(const std::string& text, const char* profile) {
  using namespace tofray::load;
  try {
    const LensCalibration found = lens_calibration(text, "<fuzz>", profile == nullptr ? std::nullopt : std::optional(sensor_of(profile)));
    (void)lens_block(found, "<fuzz>");
    if (profile != nullptr) (void)tofray::load_camera_text(profile_with_lens(profile, found, "<fuzz>"), "<made>");
  } catch (const tofray::Error& e) {
    if (e.kind() == tofray::ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (std::string(e.what()).starts_with("<made>"))
      std::abort();  // what it writes it reads (a fault of what it is given may quote that word)
    if (!tofray::fuzz::may_be_shown(e)) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const char* profile : {static_cast<const char*>(nullptr), "pico-flexx", "azure-kinect-nfov"}) read(text, profile);
  return 0;
}
