// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "files/json.h"
#include "options.h"
#include "run/inputs.h"
#include "view/control.h"

namespace tofray::view {

/// Scene + list of --set + seed + frame: all there is to know of what pages see.
struct State {
  app::Options options;  ///< its list of --set is the state's, the first word the scene
  run::Loaded in;
  std::uint32_t generation = 1;
  std::uint64_t frame = 0;
  bool playing = true;
};

/// The state of a command line. @throws Error
State first_state(const app::Options& options);

/// The same with a change. @throws Error in the command line's own words
State changed(const State& before, const Edit& edit);

/// The command that makes the frame's files: where time stands still, with its number.
std::string command_of(const State& state);

/// width, height, phases, frame_rate_hz, camera and mode of the camera.
void put_camera(files::Json& json, const State& state);
/// The message `state`.
std::string state_text(const State& state);

/// A message `fault` out of an error's text. @param id  of the message that it answers; none where it answers nothing
std::string fault_text(std::optional<std::uint64_t> id, const std::string& text);
std::string fault_text(std::optional<std::uint64_t> id, const std::string& text, const std::string& more);

}  // namespace tofray::view
