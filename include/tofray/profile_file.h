// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "tofray/load.h"

/// What stands in a camera profile: its numbers with their ranges, and where they are written. For tools that change one number among
/// others and leave the comments as they are. Part of libtofray_files, as load.h is.
namespace tofray {

/// A number that CameraOptions::set can change.
struct ProfileNumber {
  std::string key;       ///< key as CameraOptions::set takes it, such as illumination.0.power
  std::string unit;      ///< unit of `value`, `low` and `high`, as the profile writes it; empty: none
  double value = 0;      ///< value in force
  double low = 0;        ///< least value that the key may have
  double high = 0;       ///< largest one
  bool whole = false;    ///< whole numbers alone
  bool assumed = false;  ///< the profile says so
};

/// Where a value begins in the profile's text, from 1 on.
struct ProfilePlace {
  std::string key;
  int line = 0;
  int column = 0;
};

/// A profile as it is written, and the numbers in it.
struct ProfileFile {
  std::string source;  ///< the file's name; that of a built-in profile stands in angle brackets
  std::string text;
  std::vector<ProfileNumber> numbers;  ///< those in force of one mode
  std::vector<ProfilePlace> places;    ///< places of all values, maps and lists that are written, of all modes
};

/// Reads a profile, a built-in name or a YAML file. Places are those of the text, without `options`.
/// @throws Error as load_camera() does
ProfileFile profile_file(const std::string& file_or_name, const CameraOptions& options = {});

}  // namespace tofray
