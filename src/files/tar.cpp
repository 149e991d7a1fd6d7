// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/tar.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "tofray/error.h"

namespace tofray::files {

std::string tar_header(std::string_view name, std::uint64_t size) {
  constexpr std::size_t most_name = 100;
  constexpr std::uint64_t most_size = 077777777777;
  if (name.size() > most_name || size > most_size)
    throw Error(ErrorKind::limit,
                fmt::format("error: {} with {} bytes does not fit into a tar\n  expected at most {} bytes of name and {} bytes", name, size,
                            most_name, most_size));
  std::string block(tar_block, '\0');
  const auto put = [&block](std::size_t at, std::string_view text) {
    std::copy(text.begin(), text.end(), block.begin() + static_cast<std::ptrdiff_t>(at));
  };
  put(0, name);
  put(100, "0000644"), put(108, "0000000"), put(116, "0000000");    // mode, user, group
  put(124, fmt::format("{:011o}", size)), put(136, "00000000000");  // size, time
  put(148, "        "), put(156, "0");                              // the sum's own place counts as blanks; a plain file
  put(257, std::string_view("ustar\00000", 8));
  put(329, "0000000"), put(337, "0000000");  // device numbers
  const auto sum =
      std::accumulate(block.begin(), block.end(), 0U, [](unsigned total, char c) { return total + static_cast<unsigned char>(c); });
  put(148, fmt::format("{:06o}", sum)), block[154] = '\0', block[155] = ' ';
  return block;
}

std::size_t tar_padding(std::uint64_t size) { return (tar_block - size % tar_block) % tar_block; }

std::string tar_end() { return std::string(2 * tar_block, '\0'); }

}  // namespace tofray::files
