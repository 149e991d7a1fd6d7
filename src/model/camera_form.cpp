// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "base/limits.h"
#include "model/tables.h"

/// The file of a camera profile: what camera_table.cpp says of the struct, its modes, and what takes the place of theirs.
namespace tofray::model {

namespace {

using enum base::Dimension;

constexpr Number binning{none, {1, 16}, "2"};

Form region_form() {
  const auto start = [](const char* name, const char* doc) {
    return required(name, whole_number({none, {0, sensor_side.range.high - 1}, "0"}), doc);
  };
  return map({start("left", "its first column"), start("top", "its first row"), required("width", whole_number(sensor_side), "columns"),
              required("height", whole_number(sensor_side), "rows")});
}

}  // namespace

const FileForm& camera_form() {
  static const FileForm form = [] {
    FileForm file{"camera", "tofray camera profile: lens, light, pixel, ADC, modes and decoding", form_of(table_of<Camera>()), true};
    const auto most = static_cast<int>(base::limit::modes.value);
    Form mode = form_of(table_of<Mode>());
    mode.keys.push_back(absent("decoding", form_of(table_of<Decoding>()), "keys of decoding that this mode has otherwise"));
    for (Form* of : {&mode, &file.root}) {
      const std::string whose = of == &mode ? "" : ", in place of the mode's";
      of->keys.push_back(absent("region", region_form(), "the part of the sensor that is read" + whose));
      of->keys.push_back(absent("binning", whole_number(binning), "so many pixels across and down are read as one" + whose));
    }
    file.root.keys.push_back(required("modes", dictionary(mode, 1, most), "the camera's use cases by name; the first is the default"));
    file.root.keys.push_back(absent("mode", text("a mode", "MODE_9_5FPS_2000"), "which of the modes; the first unless given"));
    file.root.keys.push_back(
        absent("integration_time", form_of(integration_time), "takes the place of that of every lit raw frame of the mode"));
    file.root.keys.push_back(absent("frame_rate", form_of(frame_rate), "takes the place of the mode's"));
    return file;
  }();
  return form;
}

}  // namespace tofray::model
