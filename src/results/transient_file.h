// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "tofray/camera.h"
#include "tofray/scene.h"
#include "tofray/stages.h"

/// Light by the length of its path, out of files, for `tofray process --transient`.
namespace tofray::results {

/// What a file need not say.
struct TransientHints {
  std::optional<double> first_m;  ///< where the first bin begins, whole path from light to camera; otherwise what `meta` says, or 0
  std::optional<double> width_m;  ///< of a bin; otherwise what `meta` says
  double factor = 1;              ///< electrons per second for 1 of the file's unit
};

/// The bins that `meta` tells of; none: it knows of no histograms.
std::optional<TransientBins> transient_of_meta(const std::string& meta, const std::string& where);

/// Reads histograms from a .npz file (`transient_e_per_s` [bin, height, width] as tofray writes it, with its bins in `meta` and
/// `gt_ambient_e_per_s` as ambient light where it is there, or else the only array of three axes or four), or from a .npy file. Such an array
/// of another renderer is [bin, height, width], or [height, width, bin], which the camera's size tells apart (where it cannot, it is the
/// latter); a last axis of one channel is left out. Floats and whole numbers of any width.
/// @param where  the path, whose ending says which file it is
/// @throws Error (bad_input) for arrays of another kind or shape, values that are no numbers or below 0, and bins of unknown width; (limit)
/// for more values than histograms may have
Transient parse_transient(std::string_view file, const std::string& where, const Camera& camera, const TransientHints& hints);

}  // namespace tofray::results
