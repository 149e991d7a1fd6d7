// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tofray/frame.h"

/// Pictures of a frame as files in memory, those for people also as SVG and PDF. The same frame gives the same bytes on every machine, but for the letters of raw.png and
/// preview.png, which are those of the machine's font.
namespace tofray::pictures {

/// Light writing on a dark ground for screens, or dark on white for papers. Colours of values are the same in both.
enum class Theme : std::uint8_t { dark, light };

/// What file a picture becomes: SVG and PDF have letters, lines and scale bars as such, and each image as a PNG or the like within.
enum class Format : std::uint8_t { png, svg, pdf };
/// By the ending of a file's name, in small or capital letters: .png, .svg, .pdf; none for others.
std::optional<Format> format_of(std::string_view file);

/// How a picture looks.
struct Style {
  Theme theme = Theme::dark;
  int scale = 1;  ///< times as many pixels along either side (SVG and PDF: as large), letters drawn as finely: 2 for slides
  Format format = Format::png;
};

/// A row of TOFRAY_FLAGS.
struct FlagRow {
  const char* name;
  std::uint16_t bit;
  bool invalid;
  char letter;
  std::uint32_t dark, light;
  const char *words, *what, *advice;
};
/// Reasons first, in the order in which the first one that is set explains an invalid pixel.
const std::vector<FlagRow>& flag_table();
/// The row of bit number 0, 1, …; null where there is none.
const FlagRow* flag_of_bit(int bit);
/// Why a pixel is invalid; null where it is valid.
const FlagRow* invalid_reason(std::uint16_t flags);

/// depth.png: uint16, z in mm, rounded. 0 where invalid, and where z does not fit (nearer than 0.5 mm, farther than 65.535 m).
std::string depth_png(const Depth& depth);
/// Pixels that have a depth, but one farther than depth.png holds.
std::size_t beyond_depth_png(const Depth& depth);

/// amplitude.png: 8-bit grey, 255 · sqrt(amplitude / its 99.5th percentile), so that the far and dark is seen beside the near and bright.
std::string amplitude_png(const Depth& depth);

/// raw.png: the raw frames as a labelled contact sheet, one row per modulation frequency. One scale of codes, from the 0.5th to the 99.5th
/// percentile of the lit raw frames; an unlit one of which more than 2 % lie beyond it, as in the sun, has a scale of its own beside
/// its label. Without `raw` it shows tap A − tap B in electrons.
std::string raw_picture(const Raw& raw, const Style& style);
std::string raw_png(const Raw& raw, Theme theme = Theme::dark, int scale = 1);

/// preview.png, for people: z in colours (scale: 1st to 99th percentile; where truth is known, of pixels that are no cycle off), amplitude (0 to 99.5th), and the error z − gt_z (± the 98th
/// percentile of |error|, or three times the 68th where that is less, so that wrong cycles do not set the scale; without ground truth:
/// the noise estimate, 0 to 98th), each with its scale bar and a line on its scale. Where light bounced, the error by multipath stands
/// beside it: gt_multipath_m of the first lit raw frame, on a scale made in the same way. Invalid pixels of z have the colour of their
/// invalid_reason(), which a legend names with its share.
/// @param raw      says which raw frames are lit, and at which modulation frequency
/// @param caption  one line above, UTF-8; may be empty
std::string preview_picture(const Depth& depth, const Truth& truth, const Raw& raw, const std::string& caption, const Style& style);
std::string preview_png(const Depth& depth, const Truth& truth, const Raw& raw, const std::string& caption, Theme theme = Theme::dark,
                        int scale = 1);

/// One of several frames side by side.
struct SheetImage {
  std::string label;
  Depth depth;  ///< z_m, flags, width, height
};
/// The depth of several frames in rows and columns, all on one scale from the 1st to the 99th percentile; invalid pixels have the colours of
/// their reasons.
std::string contact_sheet(const std::vector<SheetImage>& images, const std::string& caption, const Style& style);

}  // namespace tofray::pictures
