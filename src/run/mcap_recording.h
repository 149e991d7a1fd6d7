// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

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

/// Says of a film without raw frames what it should have. @throws Error (bad_input)
[[noreturn]] void refuse_film_without_raw(const std::string& path);

/// The raw frames of a film, any of them at any time. The file is looked through once, to find them.
class Film {
 public:
  /// @throws Error (io), and as read_film(), also where there are no raw frames
  explicit Film(const std::string& path) : Film(path, mcap::open_file(path)) {}
  /// @param path  for messages
  Film(std::string path, std::unique_ptr<mcap::Source> source);

  [[nodiscard]] std::uint64_t count() const { return places_.size(); }
  /// The index by which `tofray process --first-frame` knows it.
  [[nodiscard]] std::uint64_t index_of(std::uint64_t number) const { return places_[number].index; }
  /// false: the file ends early.
  [[nodiscard]] bool complete() const { return complete_; }
  /// @throws Error where the file is no longer what it was
  [[nodiscard]] Recording frame(std::uint64_t number) const;

  /// Where the messages of a frame are.
  struct Place {
    std::uint64_t index, log_ns;
    std::uint64_t first, last;  ///< records of the file
  };

 private:
  std::string path_, meta_;
  std::unique_ptr<mcap::Source> source_;
  std::map<std::uint16_t, mcap::Channel> channels_;
  std::vector<Place> places_;
  bool complete_ = false;
};

}  // namespace tofray::run
