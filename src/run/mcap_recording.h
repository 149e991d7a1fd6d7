// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "mcap/reader.h"
#include "run/recording.h"

/// Raw frames out of MCAP files: the topics …/raw/p0, … and …/raw/meta that `tofray render --emit mcap` writes.
namespace tofray::run {

/// Whether a file is called like one.
bool is_film(const std::string& path);

/// How the reading of a film went.
struct FilmRead {
  std::uint64_t frames = 0;   ///< that were whole
  bool complete = true;       ///< false: the file ends early
  std::string raw_topics_of;  ///< where images are, but no raw frames: one of its topics
};

/// Hands over the raw frames of each frame, in the file's order, as read_recording() has them of a frame.npz.
/// @param take  is given the frame's index; false: no more are wanted
/// @throws Error (bad_input) as mcap::read(), and for messages that are not what their type says
FilmRead read_film(mcap::Source& source, const std::string& where, const std::function<bool(std::uint64_t, const Recording&)>& take);

}  // namespace tofray::run
