// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "base/limits.h"
#include "model/tables.h"

/// The file of a camera profile: what camera_table.cpp says of the struct, its modes, and what takes the place of theirs.
namespace tofray::model {

const FileForm& camera_form() {
  static const FileForm form = [] {
    FileForm file{"camera", "tofray camera profile: lens, light, pixel, ADC, modes and decoding", form_of(table_of<Camera>()), true};
    const auto most = static_cast<int>(base::limit::modes.value);
    ValueForm mode = form_of(table_of<Mode>());
    mode.keys.push_back(
        since(Stage::depth, absent("decoding", form_of(table_of<Decoding>()), "keys of decoding that this mode has otherwise")));
    mode.keys.push_back(absent("readout", form_of(table_of<Readout>()), "keys of readout that this mode has otherwise"));
    mode.keys.push_back(since(
        Stage::raw, absent("auto_exposure", form_of(table_of<AutoExposure>()), "keys of auto_exposure that this mode has otherwise")));
    file.root.keys.push_back(required("modes", dictionary(mode, 1, most), "the camera's use cases by name; the first is the default"));
    file.root.keys.push_back(absent("mode", text("a mode", "MODE_9_5FPS_2000"), "which of the modes; the first unless given"));
    file.root.keys.push_back(since(
        Stage::raw, absent("integration_time", form_of(integration_time), "takes the place of that of every lit raw frame of the mode")));
    file.root.keys.push_back(since(Stage::raw, absent("frame_rate", form_of(frame_rate), "takes the place of the mode's")));
    file.root.meant = {{"wavelength", "illumination.0.illumination_wavelength"}, {"power", "illumination.0.power"}};
    return file;
  }();
  return form;
}

}  // namespace tofray::model
