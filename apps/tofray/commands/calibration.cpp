// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/commands.h"
#include "cli/console.h"
#include "files/text_file.h"
#include "load/lens_calibration.h"
#include "run/input_kind.h"

namespace tofray::app {

int run_calibration(const Options& options) {
  const std::string& file = options.words[0];
  run::refuse_missing(file);
  const std::string text = files::read_text(file);
  if (options.camera.empty()) {
    const load::LensCalibration lens = load::lens_calibration(text, file, {});
    print(load::lens_block(lens, file));
    return 0;
  }
  const load::LensCalibration lens = load::lens_calibration(text, file, load::sensor_of(options.camera));
  if (!lens.size) say("note: " + file + " does not say the size of its images\n  taken for that of the camera's sensor\n");
  print(load::profile_with_lens(options.camera, lens, file));
  return 0;
}

}  // namespace tofray::app
