// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "files/json.h"
#include "files/npy.h"
#include "files/npz.h"
#include "files/zip_writer.h"
#include "fuzz/shown.h"
#include "results/manifest.h"
#include "results/meta_camera.h"
#include "results/raw_file.h"
#include "results/transient_file.h"
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

// A zip's checksums would keep every changed byte of an entry from being read. So pieces that "@@" parts, a name up to the end of its first line
// each, are the entries of a zip, too.
std::string zip_of(std::string_view data, tofray::files::Packing packing) {
  constexpr std::string_view mark = "@@";
  std::string zip;
  tofray::files::ZipWriter writer(zip, packing);
  for (std::size_t begin = data.find(mark); begin != std::string_view::npos;) {
    begin += mark.size();
    const std::size_t end = data.find(mark, begin);
    const std::string_view piece = data.substr(begin, end == std::string_view::npos ? end : end - begin);
    const std::size_t line = piece.find('\n');
    writer.add(piece.substr(0, line), {}, line == std::string_view::npos ? std::string_view{} : piece.substr(line + 1));
    begin = end;
  }
  writer.finish();
  return zip;
}

void read_as_npz(std::string_view file) {
  try_out([&] { (void)tofray::files::parse_npz(file, "fuzz"); });
  try_out([&] { (void)tofray::results::parse_raw_npz(file, "fuzz"); });
  tofray::Camera camera;
  camera.sensor.width = 3, camera.sensor.height = 2;
  for (const char* name : {"fuzz.npy", "fuzz.npz"})
    try_out([&] { (void)tofray::results::parse_transient(file, name, camera, {{}, 0.1, 2}); });
}

}  // namespace

/// Any bytes as .npy, as .npz and as the entries of one, as raw data, as light by path length, as JSON, as a manifest and as a frame's meta: an Error
/// or a result, nothing else.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view file(reinterpret_cast<const char*>(data), size);
  try_out([&] {
    const tofray::files::NpyArray array = tofray::files::parse_npy(file, "fuzz");
    for (std::size_t i = 0; array.type.kind != 'U' && i < array.count(); ++i) (void)array.number(i);
    (void)array.text();
  });
  read_as_npz(file);
  if (file.starts_with("@@"))
    read_as_npz(zip_of(file, (file.size() & 1) != 0 ? tofray::files::Packing::deflated : tofray::files::Packing::stored));
  try_out([&] { (void)tofray::files::json_text(tofray::files::parse_json(file, "fuzz")); });
  try_out([&] { (void)tofray::results::parse_manifest(file, "fuzz"); });
  try_out([&] { (void)tofray::results::camera_of_meta(std::string(file), "fuzz", {}); });
  return 0;
}
