// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "fuzz/shown.h"
#include "mcap/reader.h"
#include "run/mcap_contents.h"
#include "run/mcap_recording.h"
#include "tofray/error.h"

namespace {

template <class Call>
void try_out(const Call& call) {
  try {
    call();
  } catch (const tofray::Error& error) {
    // an input may be bad or too large; anything else is a fault of ours
    if (error.kind() != tofray::ErrorKind::bad_input && error.kind() != tofray::ErrorKind::limit) __builtin_trap();
    if (!tofray::fuzz::may_be_shown(error)) __builtin_trap();
  }
}

/// Sums would keep every changed byte from being read, and lengths too: pieces that "@@" parts, an opcode first, are the records of a file, too.
std::string file_of(std::string_view data) {
  constexpr std::string_view mark = "@@";
  std::string file(tofray::mcap::magic);
  for (std::size_t begin = data.find(mark); begin != std::string_view::npos;) {
    begin += mark.size();
    const std::size_t end = data.find(mark, begin);
    const std::string_view piece = data.substr(begin, end == std::string_view::npos ? end : end - begin);
    tofray::mcap::Put put(file);
    if (!piece.empty()) {
      const std::size_t at = put.begin(static_cast<tofray::mcap::Opcode>(piece[0] & 15));
      put.raw(piece.substr(1));
      put.end(at);
    }
    begin = end;
  }
  return file;
}

void read(std::string_view file) {
  try_out([&] {
    tofray::mcap::MemorySource source(file);
    (void)tofray::run::contents_of(source, "fuzz.mcap");
  });
  try_out([&] {
    tofray::mcap::MemorySource source(file);
    (void)tofray::run::read_film(source, "fuzz.mcap", [](std::uint64_t, const tofray::run::Recording& one) {
      tofray::Camera camera;
      tofray::Noise noise = tofray::Noise::exact;
      (void)tofray::run::recorded_frame(one, camera, noise);
      return true;
    });
  });
  try_out([&] {
    const tofray::run::Film film("fuzz.mcap", std::make_unique<tofray::mcap::MemorySource>(file));
    for (std::uint64_t i = 0; i < film.count() && i < 4; ++i) (void)film.frame(i);
  });
}

}  // namespace

/// Any bytes as an MCAP file, and as the records of one: contents, raw frames, or an Error, nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  read(file);
  if (file.starts_with("@@")) read(file_of(file));
  return 0;
}
