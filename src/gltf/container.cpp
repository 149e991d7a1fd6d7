// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/container.h"

#include <fmt/core.h>

#include <cstdint>

#include "base/bytes.h"
#include "base/faults.h"

namespace tofray::gltf {
namespace {

constexpr std::size_t header_bytes = 12, chunk_header_bytes = 8;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;  // "JSON", "BIN\0"

/// The file's chunks, one after the other.
class Chunks {
 public:
  Chunks(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {
    if (bytes.size() < header_bytes) cut_short(fmt::format("it has {} bytes, a header alone has {}", bytes.size(), header_bytes));
    const auto version = base::read_bytes_as<std::uint32_t>(bytes.data() + 4),
               length = base::read_bytes_as<std::uint32_t>(bytes.data() + 8);
    if (version != 2)
      base::fail(base::whole(name), fmt::format("this is binary glTF of version {}", version), "expected version 2: export it as glTF 2.0");
    if (length > bytes.size()) cut_short(fmt::format("its header says {} bytes, it has {}", length, bytes.size()));
    if (length < bytes.size())
      base::fail(base::whole(name), fmt::format("{} bytes are left over behind the end", bytes.size() - length),
                 fmt::format("its header says {} bytes, it has {}", length, bytes.size()));
  }

  bool next(std::uint32_t& type, std::string_view& data) {
    if (at_ == bytes_.size()) return false;
    if (bytes_.size() - at_ < chunk_header_bytes) cut_short(fmt::format("the header of chunk {} is not whole", number_));
    const auto length = base::read_bytes_as<std::uint32_t>(bytes_.data() + at_);
    type = base::read_bytes_as<std::uint32_t>(bytes_.data() + at_ + 4);
    at_ += chunk_header_bytes;
    if (length > bytes_.size() - at_)
      cut_short(fmt::format("chunk {} has {} bytes, and {} are left of the file", number_, length, bytes_.size() - at_));
    data = bytes_.substr(at_, length);
    at_ += length;
    ++number_;
    return true;
  }

 private:
  [[noreturn]] void cut_short(const std::string& more) const { base::fail(base::whole(name_), "the file is cut short", more); }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_ = header_bytes;
  int number_ = 0;
};

}  // namespace

Container split(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  Chunks chunks(bytes, name);
  std::uint32_t type = 0;
  std::string_view data;
  if (!chunks.next(type, data) || type != json_chunk)
    base::fail(base::whole(name), "the first chunk is not JSON", "expected a chunk of type JSON");
  Container out{data, {}};
  while (chunks.next(type, data)) {
    if (type == json_chunk) base::fail(base::whole(name), "there are two chunks of JSON", "expected one");
    if (type != binary_chunk) continue;
    if (out.binary) base::fail(base::whole(name), "there are two binary chunks", "expected one at most");
    out.binary = data;
  }
  return out;
}

}  // namespace tofray::gltf
