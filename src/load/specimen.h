// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>
#include <vector>

#include "yaml/tree.h"

/// What decoding knows of a specimen, out of a file of its own.
namespace tofray::load {

/// The file that names a calibration's file, and where that lies then.
struct NamedBy {
  std::string folder;     ///< empty: it can name none
  std::string root;       ///< as of files::read_reference
  bool anywhere = false;  ///< the user himself: any path
};

/// Puts what is in the file into the place of its name, where `decoding.calibration` of a profile, or of a mode, is one.
/// @param who    names it, by the source of its place
/// @return       the folder of each such file
/// @throws Error where a file cannot be read, or is none of a specimen
std::map<std::string, std::string> splice_calibrations(yaml::Node& profile, const std::map<std::string, NamedBy>& who);

/// Phases of all pixels, row by row, out of a file of NumPy. @throws Error likewise
std::vector<double> read_pixel_phases(const std::string& name, const std::string& folder, const base::Place& place);

}  // namespace tofray::load
