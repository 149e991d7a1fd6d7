// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/pictures.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pictures/picture_scale.h"
#include "pictures/png_file.h"

namespace tofray::pictures {

const std::vector<FlagRow>& flag_table() {
#define TOFRAY_ROW(name, bit, invalid, letter, dark, light, words, what, advice) \
  {#name, bit, (invalid) != 0, letter, dark, light, words, what, advice},
  static const std::vector<FlagRow> rows = {TOFRAY_FLAGS(TOFRAY_ROW)};
#undef TOFRAY_ROW
  return rows;
}

const FlagRow* flag_of_bit(int bit) {
  for (const FlagRow& one : flag_table())
    if (one.bit == 1u << bit) return &one;
  return nullptr;
}

const FlagRow* invalid_reason(std::uint16_t flags) {
  if ((flags & flags_invalid) == 0) return nullptr;
  for (const FlagRow& one : flag_table())
    if ((flags & one.bit) != 0) return &one;
  return nullptr;
}

std::optional<Format> format_of(std::string_view file) {
  std::string ending(file.substr(file.size() < 4 ? 0 : file.size() - 4));
  for (char& one : ending) one = one >= 'A' && one <= 'Z' ? static_cast<char>(one - 'A' + 'a') : one;
  if (ending == ".png") return Format::png;
  if (ending == ".svg") return Format::svg;
  if (ending == ".pdf") return Format::pdf;
  return {};
}

std::string raw_png(const Raw& raw, Theme theme, int scale) { return raw_picture(raw, {theme, scale, Format::png}); }

std::string preview_png(const Depth& depth, const Truth& truth, const Raw& raw, const std::string& caption, Theme theme, int scale) {
  return preview_picture(depth, truth, raw, caption, {theme, scale, Format::png});
}

namespace {

constexpr double most_millimetres = 65535;
double rounded_millimetres(float z) { return std::floor(1000.0 * static_cast<double>(z) + 0.5); }

}  // namespace

std::size_t beyond_depth_png(const Depth& depth) {
  return static_cast<std::size_t>(std::count_if(depth.z_m.begin(), depth.z_m.end(), [](float z) {
    return 1000.0 * static_cast<double>(z) + 0.5 >= most_millimetres + 1;  // as rounded_millimetres(), without a call for each pixel
  }));
}

std::string depth_png(const Depth& depth) {
  std::vector<std::uint16_t> millimetres;
  millimetres.reserve(depth.z_m.size());
  for (const float z : depth.z_m) {
    const double mm = rounded_millimetres(z);
    millimetres.push_back(mm >= 1 && mm <= most_millimetres ? static_cast<std::uint16_t>(mm) : std::uint16_t{0});
  }
  return png_grey16(depth.width, depth.height, millimetres);
}

std::string amplitude_png(const Depth& depth) {
  const double white = percentile({depth.amplitude_e.begin(), depth.amplitude_e.end()}, 0.995, 1.0);
  std::vector<std::uint8_t> grey;
  grey.reserve(depth.amplitude_e.size());
  for (const float amplitude : depth.amplitude_e) {
    const double share = white > 0 ? static_cast<double>(amplitude) / white : 0.0;
    grey.push_back(share > 0 ? static_cast<std::uint8_t>(255 * std::sqrt(share < 1 ? share : 1.0) + 0.5) : std::uint8_t{0});
  }
  return png_grey8(depth.width, depth.height, grey);
}

}  // namespace tofray::pictures
