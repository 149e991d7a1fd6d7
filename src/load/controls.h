// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/json.h"
#include "load/load.h"
#include "model/form.h"

/// The keys of a scene and of its camera with the values in force: what a viewer shows as controls, and what --set can change.
namespace tofray::load {

struct Control {
  enum class Kind { number, integer, boolean, choice, text, vector, list };
  std::string key;    ///< as --set takes it
  std::string part;   ///< the key's first word; "scene" where it has but one
  std::string group;  ///< its second word, if it has more
  std::string name;   ///< the rest
  std::string label;  ///< of the object that it belongs to
  Kind kind = Kind::number;
  const model::ValueForm* form = nullptr;  ///< of the value; of a vector's or a list's items where these are numbers
  std::string unit;                        ///< of `value`, `low`, `high` and `slider`
  std::optional<std::string> text;         ///< in force, as --set takes it: with it, the frame has the same bytes
  std::vector<double> value;               ///< in force, of numbers and vectors
  std::vector<std::string> choices;        ///< where there are such
  std::string fallback;                    ///< what holds where the key is absent
  std::string what;                        ///< one line
  std::string source;                      ///< where the number comes from, as its profile says it
  bool assumed = false;                    ///< whether the number is an assumption, as its profile says
  std::optional<double> slider_low, slider_high;
  bool logarithmic = false;
  bool settable = true;  ///< false: it does not go with another key that is in force
  bool changed = false;  ///< by one of the settings
};

/// @param scene     as it was read from the text with the settings
/// @param text      the scene's file
/// @param settings  as of --set
/// @param camera    how the scene's camera was read: its mode and folder
/// @return all keys of scene and camera, but for those of kinds and modes that are not in force: the camera's first, objects last
std::vector<Control> controls_of(const Scene& scene, std::string_view text, const Settings& settings, const CameraOptions& camera);

/// A number in a unit, without what rounding adds.
double in_unit(double si, const std::string& unit);
/// All keys of a camera alone, but for those of kinds and modes that are not in force. @param profile  its text  @param camera  mode and settings, without "camera." before them
std::vector<Control> camera_controls_of(const std::string& profile, const std::string& source, const CameraOptions& camera);

/// key, part, group, name, label, kind, unit, units, dimension, low, high, choices, what, text, value, default, source, assumed, log,
/// slider, settable, changed; what says nothing is left out.
files::Json json_of(const Control& control);

/// The scene's file with the settings in it, as YAML. Comments are lost.
/// @throws Error
std::string scene_yaml(std::string_view text, const std::string& source, const Settings& settings);

/// The text of a built-in scene; empty: none is called so.
std::string_view builtin_scene_text(const std::string& name);

}  // namespace tofray::load
