// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/options.h"
#include "files/json.h"
#include "run/inputs.h"
#include "view/control.h"
#include "view/picture_state.h"
#include "view/recorded.h"

namespace tofray::view {

/// Scene + list of --set + seed + frame: all there is to know of what pages see.
struct State {
  app::Options options;  ///< its list of --set is the state's, the first word the scene
  run::Loaded in;
  std::uint32_t generation = 1;
  std::uint64_t frame = 0;
  bool playing = true;
  std::shared_ptr<const Recorded> recorded = {};  ///< where frames lie in files: nothing is simulated then, and the scene is empty
};

/// Why messages of a type cannot be answered in this state; empty where they can.
std::string why_not(const State& state, std::string_view type);
/// @throws Error where they cannot
void refuse(const State& state, std::string_view type);
/// The types for which that is so, and why.
std::vector<std::pair<const char*, std::string>> cannot(const State& state);
/// The frame that is shown for a number, and the one behind it: files begin anew at their end.
std::uint64_t frame_within(const State& state, std::uint64_t frame);
std::uint64_t frame_after(const State& state);

/// The state of a command line. @throws Error
State first_state(const app::Options& options);

/// The state of side B that --beside asks for; none where it does not. @throws Error
std::optional<State> state_beside(const app::Options& options);

/// A state with a change, of the next generation. @throws Error in the command line's own words
State changed(const State& before, const Edit& edit);
/// What side B begins with. @param like  side A  @throws Error
State opened(const State& like, const Edit& edit, std::uint32_t generation);

/// The command that makes the frame's files: where time stands still, with its number.
std::string command_of(const State& state);

/// The words of the command that makes these frames' files.
std::vector<std::string> recording_words(const State& state, std::uint64_t first, std::uint64_t frames);
/// The words of `tofray view` that show the state.
std::vector<std::string> live_words(const State& state);
/// Words as a shell takes them.
std::string shell_text(const std::vector<std::string>& words);

/// What a picture of a frame carries, and the command that shows it live.
PictureState picture_state(const State& state, std::uint64_t frame);
std::string live_command(const PictureState& state);

/// The scene's file with all that --set and --mode changed, and the command that makes the frame's files out of it.
struct Saved {
  std::string name, text, command;
};
Saved saved(const State& state);

/// Adds to a document what `hello` and `state` have of both sides. @param other  side B, or none
void put_state(files::Json& json, const State& state, const State* other);
/// The message `state`.
std::string state_text(const State& state, const State* other);
/// The message `controls`.
std::string controls_text(const State& state, const Query& query);

/// A message `fault` out of an error's text. @param id  of the message that it answers; none where it answers nothing
/// @param key  at fault; empty: none in particular
std::string fault_text(std::optional<std::uint64_t> id, const std::string& text, const std::string& key = {});
/// A message `fault` of a first line and what follows it.
std::string fault_lines(std::optional<std::uint64_t> id, const std::string& text, const std::string& more, const std::string& key = {});

const char* name_of(Side side);

}  // namespace tofray::view
