// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "messages/parts.h"

namespace tofray::messages {

namespace {

/// As ROS names the models, in the order in which it has their numbers.
struct Distortion {
  const char* model;
  std::vector<double> numbers;
};

Distortion distortion_for(const Lens& l, bool rational) {
  if (l.distortion == Lens::Distortion::fisheye) return {"equidistant", {l.k1, l.k2, l.k3, l.k4}};
  if (rational || l.k4 != 0 || l.k5 != 0 || l.k6 != 0) return {"rational_polynomial", {l.k1, l.k2, l.p1, l.p2, l.k3, l.k4, l.k5, l.k6}};
  return {"plumb_bob", {l.k1, l.k2, l.p1, l.p2, l.k3}};
}

}  // namespace

void put_camera_info(std::string& out, const Header& header, Size size, const Lens& lens, bool rational) {
  const Distortion distortion = distortion_for(lens, rational);
  const double fx = lens.fx_px, fy = lens.fy_px, cx = lens.cx_px, cy = lens.cy_px;
  Cdr cdr(out);
  put_header(cdr, header).put(static_cast<std::uint32_t>(size.height)).put(static_cast<std::uint32_t>(size.width));
  cdr.text(distortion.model).count(distortion.numbers.size()).items(distortion.numbers);
  cdr.items(std::array<double, 9>{fx, 0, cx, 0, fy, cy, 0, 0, 1});            // k
  cdr.items(std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1});                // r
  cdr.items(std::array<double, 12>{fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0});  // p
  // The numbers above are of the image as delivered: no binning and no region is left to be taken into account.
  cdr.items(std::array<std::uint32_t, 2>{0, 0}).items(std::array<std::uint32_t, 4>{0, 0, 0, 0});
  constexpr std::uint8_t do_rectify = 0;
  cdr.put(do_rectify);
}

}  // namespace tofray::messages
