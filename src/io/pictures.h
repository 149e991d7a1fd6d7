// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "tofray/frame.h"

/// Pictures of a frame as PNG files in memory. The same frame gives the same bytes on every machine.
namespace tofray::io {

/// depth.png: uint16, z in mm, rounded. 0 where invalid, and where z does not fit (nearer than 0.5 mm, farther than 65.535 m).
std::string depth_png(const Depth& depth);

/// amplitude.png: 8-bit grey, 255 · sqrt(amplitude / its 99.5th percentile), so that the far and dark is seen beside the near and bright.
std::string amplitude_png(const Depth& depth);

/// raw.png: the raw frames as a labelled contact sheet, one row per modulation frequency, all on one scale of codes.
/// Without `raw` it shows tap A − tap B in electrons.
std::string raw_png(const Raw& raw);

/// preview.png, for people: z in colours, amplitude, and the error z − gt_z (without ground truth: the noise estimate), each with its scale bar.
/// @param caption  one line above, UTF-8; may be empty
std::string preview_png(const Depth& depth, const Truth& truth, const std::string& caption);

}  // namespace tofray::io
