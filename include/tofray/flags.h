// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

/// The flags of a pixel's depth: one row each, and no other list of them. `tofray::flag_…`, the kernels' bits, names in messages and
/// legends, colours and letters of pictures and viewer, advice, counts of invalid pixels (tofray/analysis.h), `tofray.flags` and
/// docs/reference/arrays.md come from these rows.
///
/// A row:
///
///     name       tofray::flag_NAME, depth::NAME in kernels, tofray.flags["NAME"]
///     bit        of Depth::flags
///     invalid    1: the pixel has no depth; 0: it keeps it
///     letter     in the viewer's pixels
///     dark       colour of pixels of which it is the reason, on a dark ground, 0xRRGGBB …
///     light      … and on a light one
///     words      what people read
///     what       what has happened
///     advice     what helps
///
/// To add one: its row here, and the place that sets it, in a kernel.
namespace tofray {

// clang-format off

/// Reasons why a pixel has no depth, the one that explains most first: of those that are set the first one is told. For a pixel that got
/// nothing back is also weak and noisy. The last two keep the depth, unless the camera rejects what they warn of.
#define TOFRAY_REASONS(row) \
  /*  name                      bit invalid letter dark  light     words                       what                                               advice */ \
  row(outside_lens,              16, 1, 'O', 0xd4d7dd, 0xebedf0, "outside the lens model",   "the lens model has no ray there",                  "the lens model has no rays there: see camera.lens.distortion") \
  row(saturated,                  1, 1, 'S', 0x46e1cd, 0x00a596, "saturated",                "a well or the ADC is full",                        "less light, a shorter integration time, or more distance") \
  row(no_return,                  8, 1, 'N', 0x2c2e33, 0xc0c3c9, "no return",                "no light came back",                               "no light comes back: nothing is there, it is dark, or out of the light's reach") \
  row(low_signal,                 2, 1, 'L', 0x7c8089, 0x767a83, "low signal",               "the noise is above camera.decoding.noise_threshold", "more light, a longer integration time, or a higher camera.decoding.noise_threshold") \
  row(flying_pixel,               4, 1, 'F', 0x3eaf54, 0x3eaf54, "flying pixel",             "its range lies between those of its neighbours",   "surfaces that are seen at a glancing angle, or thinner than a few pixels; camera.decoding says what is one") \
  row(inconsistent_phases,       32, 0, 'P', 0xbe3cbe, 0xbe3cbe, "inconsistent phases",      "the raw frames of one modulation frequency do not fit together", "something moves, or camera.decoding.asymmetry rejects too much") \
  row(inconsistent_frequencies,  64, 0, 'M', 0x783c82, 0x783c82, "inconsistent frequencies", "the ranges of the modulation frequencies do not fit together", "multipath, a wrong cycle, or camera.decoding.multipath rejects too much")

/// What else is said of a pixel.
#define TOFRAY_MARKS(row) \
  row(rejected,                 128, 1, 'R', 0x783c82, 0x783c82, "rejected for these", "reject of camera.decoding.asymmetry or multipath is on", "") \
  row(filtered,                 256, 0, 'A', 0x000000, 0xffffff, "filtered",           "the range is a filter's, or a mean over frames", "")

// clang-format on

#define TOFRAY_FLAGS(row) TOFRAY_REASONS(row) TOFRAY_MARKS(row)

/// Bits of Depth::flags.
enum Flag : std::uint16_t {
#define TOFRAY_FLAG(name, bit, ...) flag_##name = bit,
  TOFRAY_FLAGS(TOFRAY_FLAG)
#undef TOFRAY_FLAG
};

/// Bits of which a pixel without depth has at least one.
#define TOFRAY_INVALID(name, bit, invalid, ...) +(bit) * (invalid)
inline constexpr std::uint16_t flags_invalid = 0 TOFRAY_FLAGS(TOFRAY_INVALID);
#undef TOFRAY_INVALID

/// Bits that say why a pixel has no depth, or warn of that. Those that say something else are not among them.
#define TOFRAY_BIT(name, bit, ...) | (bit)
inline constexpr std::uint16_t flags_reasons = 0 TOFRAY_REASONS(TOFRAY_BIT);
#undef TOFRAY_BIT

}  // namespace tofray
