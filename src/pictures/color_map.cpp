// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pictures/color_map.h"

#include <cstddef>

namespace tofray::pictures {
namespace {

// Tables computed once in the OKLCh space: lightness falls evenly, hue turns one way. Between their colours sRGB is interpolated.

constexpr Rgb depth_table[] = {{252, 242, 162}, {252, 226, 134}, {255, 209, 107}, {255, 190, 83}, {255, 170, 66}, {255, 149, 58},
                               {255, 128, 62},  {254, 106, 76},  {244, 89, 94},   {229, 76, 110}, {213, 65, 124}, {194, 56, 137},
                               {170, 50, 150},  {139, 47, 160},  {107, 45, 163},  {75, 45, 155},  {43, 45, 137}};
constexpr Rgb near_table[] = {{239, 239, 239}, {201, 221, 248}, {167, 203, 249}, {134, 182, 244}, {105, 161, 232},
                              {79, 139, 215},  {56, 115, 196},  {36, 90, 175},   {20, 64, 151}};
constexpr Rgb far_table[] = {{239, 239, 239}, {249, 212, 192}, {251, 186, 150}, {246, 160, 111}, {233, 136, 77},
                             {217, 112, 49},  {200, 85, 27},   {181, 56, 17},   {158, 22, 20}};
constexpr Rgb grey_table[] = {{12, 12, 14}, {255, 255, 255}};

template <std::size_t count>
Rgb of_table(const Rgb (&table)[count], double t) {
  if (!(t > 0)) return table[0];
  if (t >= 1) return table[count - 1];
  const double at = t * static_cast<double>(count - 1);
  const auto i = static_cast<std::size_t>(at);
  return mixed(table[i], table[i + 1], at - static_cast<double>(i));
}

}  // namespace

Rgb mixed(Rgb a, Rgb b, double t) {
  const auto channel = [t](std::uint8_t x, std::uint8_t y) { return static_cast<std::uint8_t>(x + t * (y - x) + 0.5); };
  return {channel(a.red, b.red), channel(a.green, b.green), channel(a.blue, b.blue)};
}

Rgb depth_color(double t) { return of_table(depth_table, t); }

Rgb error_color(double t) { return t < 0 ? of_table(near_table, -t) : of_table(far_table, t); }

Rgb grey_color(double t) { return of_table(grey_table, t); }

std::span<const Rgb> depth_stops() { return depth_table; }
std::span<const Rgb> near_stops() { return near_table; }
std::span<const Rgb> far_stops() { return far_table; }
std::span<const Rgb> grey_stops() { return grey_table; }

}  // namespace tofray::pictures
