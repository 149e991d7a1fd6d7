// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A JPEG file by hand (ITU-T T.81): one block of each component, of which only the mean is there.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "image_files.h"

namespace tofray::image_test {

inline std::string word(int value) { return bytes_of({value >> 8, value & 255}); }

inline std::string hand_segment(int marker, const std::string& data) {
  return bytes_of({0xFF, marker}) + word(static_cast<int>(data.size()) + 2) + data;
}

/// The blocks' means, one after the other, by the table of HandJpeg: 0 for no difference, 10 and three bits for one of 4 to 7; then 0, the
/// end of the block.
inline std::string hand_data(const std::vector<int>& means) {
  std::string bits;
  for (const int mean : means) {
    if (mean == 0) {
      bits += "0";
    } else {
      const int value = mean > 0 ? mean : mean + 7;
      bits += "10";
      for (const int bit : {4, 2, 1}) bits += (value & bit) != 0 ? '1' : '0';
    }
    bits += "0";
  }
  while (bits.size() % 8 != 0) bits += '1';
  std::string bytes;
  for (std::size_t i = 0; i < bits.size(); i += 8) bytes += static_cast<char>(std::stoi(bits.substr(i, 8), nullptr, 2));
  return bytes;
}

struct HandComponent {
  int id, sampling;
};

struct HandJpeg {
  int frame = 0xC0, bits = 8, width = 8, height = 8;
  std::vector<HandComponent> components = {{1, 0x11}};
  std::string before;  ///< segments behind the beginning
  std::string quantisation = hand_segment(0xDB, bytes_of({0}) + std::string(64, '\x08'));
  // codes: 0 for category 0, 10 for category 3; 0 for the end of a block
  std::string huffman = hand_segment(0xC4, bytes_of({0x00, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3})) +
                        hand_segment(0xC4, bytes_of({0x10, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
  std::string data = hand_data({5});
  std::string end = bytes_of({0xFF, 0xD9});

  [[nodiscard]] std::string frame_header() const {
    std::string header = bytes_of({bits}) + word(height) + word(width) + bytes_of({static_cast<int>(components.size())});
    for (const HandComponent& component : components) header += bytes_of({component.id, component.sampling, 0});
    return hand_segment(frame, header);
  }
  /// @param most  components in it
  [[nodiscard]] std::string scan_header(std::size_t most = 4, const std::string& range = bytes_of({0, 63, 0})) const {
    const std::size_t count = std::min(most, components.size());
    std::string header = bytes_of({static_cast<int>(count)});
    for (std::size_t i = 0; i < count; ++i) header += bytes_of({components[i].id, 0});
    return hand_segment(0xDA, header + range);
  }
  [[nodiscard]] std::string beginning() const { return bytes_of({0xFF, 0xD8}) + before + quantisation; }
  [[nodiscard]] std::string file() const { return beginning() + frame_header() + huffman + scan_header() + data + end; }
};

}  // namespace tofray::image_test
