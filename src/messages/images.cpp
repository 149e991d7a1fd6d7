// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "messages/parts.h"

namespace tofray::messages {

char* put_image(std::string& out, const ImageForm& form) {
  const auto width = static_cast<std::uint32_t>(form.size.width), height = static_cast<std::uint32_t>(form.size.height);
  const auto step = static_cast<std::uint32_t>(static_cast<std::size_t>(width) * form.bytes_per_pixel);
  Cdr cdr(out);
  put_header(cdr, form.header).put(height).put(width).text(form.encoding);
  constexpr std::uint8_t little_endian = 0;
  return cdr.put(little_endian).put(step).bytes(std::size_t{step} * height);
}

void put_depth(std::string& out, const Header& header, Size size, const std::vector<float>& depth_m, bool millimetres) {
  if (!millimetres) return put_plain(out, header, size, depth_m.data(), "32FC1");
  char* to = put_image(out, {header, size, "16UC1", 2});
  for (const float metres : depth_m) {
    const double mm = std::floor(1e3 * static_cast<double>(metres) + 0.5);
    const auto code = static_cast<std::uint16_t>(mm >= 0 && mm <= 65535 ? mm : 0);
    std::memcpy(to, &code, sizeof code);
    to += sizeof code;
  }
}

std::uint16_t amplitude_code(float amplitude_e, double step_e) {
  const double code = std::floor(static_cast<double>(amplitude_e) / step_e + 0.5);
  return static_cast<std::uint16_t>(code >= 65535 ? 65535 : code >= 0 ? code : 0);
}

void put_amplitude(std::string& out, const Header& header, Size size, const std::vector<float>& amplitude_e, double step_e,
                   bool eight_bits) {
  char* to = put_image(out, {header, size, eight_bits ? "mono8" : "mono16", eight_bits ? std::size_t{1} : std::size_t{2}});
  for (const float amplitude : amplitude_e) {
    const std::uint16_t code = amplitude_code(amplitude, step_e);
    if (eight_bits) {
      *to++ = static_cast<char>(code >> 8);
    } else {
      std::memcpy(to, &code, sizeof code);
      to += sizeof code;
    }
  }
}

}  // namespace tofray::messages
