// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

#include "tofray/error.h"

namespace tofray::files {

namespace {

/// Frames become as small as by zlib's level 6, in a third of its time: most of them is noise, which no level packs.
constexpr int level = 4;

class Packer {
 public:
  Packer() {
    if (!state_) throw std::bad_alloc();
  }
  libdeflate_compressor* operator()() const { return state_.get(); }

 private:
  std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> state_{libdeflate_alloc_compressor(level),
                                                                                       &libdeflate_free_compressor};
};

/// Appends what `pack(to, room)` writes of at most so many bytes.
template <class Pack>
void append_packed(std::string& to, std::size_t most, Pack&& pack) {
  const std::size_t before = to.size();
  to.resize(before + most);
  const std::size_t size = pack(to.data() + before, most);
  if (size == 0) throw Error(ErrorKind::bug, "error: libdeflate found too little room");
  to.resize(before + size);
}

/// Blocks of bytes as they are (RFC 1951, 3.2.4), with others to come: what follows begins at a whole byte.
void append_stored_blocks(std::string& to, std::string_view bytes) {
  constexpr std::size_t most = 0xffff;
  for (; !bytes.empty(); bytes.remove_prefix(std::min(most, bytes.size()))) {
    const std::string_view block = bytes.substr(0, most);
    const auto size = static_cast<unsigned>(block.size());
    to += '\0';
    for (const unsigned number : {size, ~size}) to += static_cast<char>(number & 255), to += static_cast<char>(number >> 8 & 255);
    to.append(block);
  }
}

}  // namespace

void append_deflated(std::string& to, std::string_view head, std::string_view body) {
  const Packer packer;
  if (body.empty()) std::swap(head, body);
  append_stored_blocks(to, head);
  append_packed(to, libdeflate_deflate_compress_bound(packer(), body.size()),
                [&](char* at, std::size_t room) { return libdeflate_deflate_compress(packer(), body.data(), body.size(), at, room); });
}

std::string zlib_stream(std::string_view bytes) {
  const Packer packer;
  std::string out;
  append_packed(out, libdeflate_zlib_compress_bound(packer(), bytes.size()),
                [&](char* at, std::size_t room) { return libdeflate_zlib_compress(packer(), bytes.data(), bytes.size(), at, room); });
  return out;
}

}  // namespace tofray::files
