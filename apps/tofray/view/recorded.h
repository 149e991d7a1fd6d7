// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "load/controls.h"
#include "results/file_arrays.h"
#include "run/mcap_recording.h"
#include "run/recording.h"
#include "tofray/frame.h"
#include "view/control.h"

namespace tofray::view {

/// Frames that lie in files: those of `tofray render`, or measured ones. Where they have raw frames of a camera that is known, depth is
/// computed of these as `tofray process` does it, and keys of the camera can be set.
class Recorded {
 public:
  /// @param path    a .npz file, a folder of such, which are taken in the order of their names, or a film
  /// @param camera  a profile that made them, and its mode; empty: what the files say
  /// @param set     of the first state, to be checked
  /// @throws Error where nothing can be shown
  Recorded(std::string path, std::string camera, std::string mode, const Overrides& set);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::uint64_t count() const { return film_ ? film_->count() : files_.size(); }
  [[nodiscard]] const std::string& file(std::uint64_t index) const { return film_ ? path_ : files_[index]; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Whether depth is computed of raw frames.
  [[nodiscard]] bool live() const { return live_; }
  /// Whether the camera is known, by its profile or by the files.
  [[nodiscard]] bool has_camera() const { return has_camera_; }
  /// Whether the files have raw frames.
  [[nodiscard]] bool has_raw() const { return has_raw_; }
  /// Whether the first frame has all arrays of depth.
  [[nodiscard]] bool has_depth() const { return has_depth_; }

  /// A scene without objects and the camera, if it is known, with these settings.
  [[nodiscard]] run::Loaded loaded(const Overrides& set) const;
  /// @param options  where and with how many threads depth is computed
  [[nodiscard]] Frame frame(std::uint64_t index, const Camera& camera, const SimulatorOptions& options) const;
  /// Keys of the camera that change depth.
  [[nodiscard]] std::vector<load::Control> controls(const Overrides& set) const;
  /// The words of `tofray process` that make the frame's files; none where nothing is computed.
  [[nodiscard]] std::vector<std::string> command(std::uint64_t index, const Overrides& set) const;

 private:
  struct Read {
    run::Recording recording;
    results::Arrays arrays;
  };
  [[nodiscard]] Read read(std::uint64_t index) const;
  void refuse_other_size(const Frame& frame, const std::string& file) const;
  [[nodiscard]] run::RecordingCamera camera_with(const Overrides& set) const;

  std::string path_, camera_, mode_;
  std::unique_ptr<run::Film> film_;  ///< in the place of files
  std::vector<std::string> files_;
  int width_ = 0, height_ = 0;
  bool live_ = false, has_camera_ = false, has_raw_ = false, has_depth_ = false;
  mutable std::optional<std::pair<std::uint64_t, std::shared_ptr<const Read>>> last_;  ///< settings change more often than files
};

/// Whether a word names files of frames, not a scene. A built-in scene or camera counts more than a folder of its name.
bool names_recorded(const std::string& word);

}  // namespace tofray::view
