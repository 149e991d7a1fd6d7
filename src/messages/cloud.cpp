// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "messages/parts.h"

namespace tofray::messages {

namespace {

template <class T>
void store(char* to, T value) {
  std::memcpy(to, &value, sizeof value);
}

void put_field(char* to, const CloudField& field, const Depth& depth, std::size_t i, double step_e) {
  switch (field.from) {
    case CloudField::From::x: return store(to, depth.points_m[3 * i]);
    case CloudField::From::y: return store(to, depth.points_m[3 * i + 1]);
    case CloudField::From::z: return store(to, depth.points_m[3 * i + 2]);
    case CloudField::From::amplitude: return store(to, depth.amplitude_e[i]);
    case CloudField::From::noise: return store(to, depth.noise_m[i]);
    case CloudField::From::flags: return store(to, depth.flags[i]);
    case CloudField::From::confidence: return store(to, depth.confidence[i]);
    case CloudField::From::amplitude16: return store(to, amplitude_code(depth.amplitude_e[i], step_e));
    case CloudField::From::amplitude8: return store(to, static_cast<std::uint8_t>(amplitude_code(depth.amplitude_e[i], step_e) >> 8));
    case CloudField::From::confidence_share: return store(to, static_cast<float>(depth.confidence[i]) / 255);
  }
}

}  // namespace

void put_cloud(std::string& out, const Header& header, const Depth& depth, const CloudForm& form) {
  const std::size_t pixels = depth.z_m.size();
  std::size_t valid = 0;
  const auto is_point = [&](std::size_t i) {
    return std::isfinite(depth.points_m[3 * i]) && std::isfinite(depth.points_m[3 * i + 1]) && std::isfinite(depth.points_m[3 * i + 2]);
  };
  for (std::size_t i = 0; i < pixels; ++i) valid += is_point(i) ? 1 : 0;
  const auto height = static_cast<std::uint32_t>(form.unorganized ? 1 : depth.height);
  const auto width = static_cast<std::uint32_t>(form.unorganized ? valid : static_cast<std::size_t>(depth.width));
  Cdr cdr(out);
  put_header(cdr, header).put(height).put(width).count(form.fields.size());
  for (const CloudField& field : form.fields) cdr.text(field.name).put(field.offset).put(field.datatype).put(std::uint32_t{1});
  constexpr std::uint8_t little_endian = 0;
  const std::uint32_t row_step = form.point_step * width;
  cdr.put(little_endian).put(form.point_step).put(row_step);
  char* to = cdr.bytes(std::size_t{row_step} * height);
  for (std::size_t i = 0; i < pixels; ++i) {
    if (form.unorganized && !is_point(i)) continue;
    for (const CloudField& field : form.fields) put_field(to + field.offset, field, depth, i, form.amplitude_step_e);
    to += form.point_step;
  }
  const bool is_dense = form.unorganized || valid == pixels;
  cdr.put(static_cast<std::uint8_t>(is_dense));
}

}  // namespace tofray::messages
