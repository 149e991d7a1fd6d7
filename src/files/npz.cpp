// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/npz.h"

#include <fmt/core.h>
#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <memory>
#include <new>
#include <set>

#include "base/limits.h"
#include "files/data_limits.h"
#include "files/npy_header.h"
#include "files/read_bytes.h"

namespace tofray::files {
namespace {

struct SourceFree {
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};
struct ArchiveDiscard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct FileClose {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};
using Source = std::unique_ptr<zip_source_t, SourceFree>;
using Archive = std::unique_ptr<zip_t, ArchiveDiscard>;
using EntryFile = std::unique_ptr<zip_file_t, FileClose>;

/// What the directory of the zip says about one entry, checked before anything is unpacked.
struct Entry {
  zip_uint64_t index = 0;
  std::string name;      ///< without ".npy"
  std::size_t size = 0;  ///< unpacked
  std::size_t packed = 0;
};

/// What all arrays of a file together may take: nothing that a camera sees packs as well as this.
std::size_t most_unpacked(std::size_t file_bytes) {
  const auto least = static_cast<std::size_t>(base::limit::unpacked_bytes.value);
  return std::clamp(static_cast<std::size_t>(base::limit::unpacked_ratio.value) * file_bytes, least, max_unpacked_bytes);
}

Entry checked_entry(zip_t* archive, zip_uint64_t index, std::size_t file_bytes, const std::string& where) {
  zip_stat_t status;
  zip_stat_init(&status);
  constexpr zip_uint64_t needed = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD | ZIP_STAT_ENCRYPTION_METHOD;
  if (zip_stat_index(archive, index, ZIP_FL_ENC_RAW, &status) != 0 || (status.valid & needed) != needed)
    refuse(where, fmt::format("entry {} of the zip is damaged", index));
  const std::string name = status.name;
  const std::string here = fmt::format("{}[{}]", where, printable(name));
  if (status.encryption_method != ZIP_EM_NONE) refuse(here, "the entry is encrypted");
  if (status.comp_method != ZIP_CM_STORE && status.comp_method != ZIP_CM_DEFLATE)
    refuse(here, fmt::format("zip method {} is not read\n  expected stored or deflated, as numpy.savez and numpy.savez_compressed write",
                             status.comp_method));
  if (status.comp_size > file_bytes || (status.comp_method == ZIP_CM_STORE && status.size != status.comp_size))
    refuse(here, "the entry's declared size does not fit the file");
  if (status.size > max_array_bytes + max_npy_header_bytes || status.size / max_pack_ratio > status.comp_size)
    throw Error(ErrorKind::limit, fmt::format("{}: error: {} bytes unpack to {}, more than is taken", here, status.comp_size, status.size));
  const bool array = name.size() > 4 && name.ends_with(".npy");
  return {index, array ? name.substr(0, name.size() - 4) : std::string(), static_cast<std::size_t>(status.size),
          static_cast<std::size_t>(status.comp_size)};
}

/// What libzip says of an entry that it cannot read.
[[noreturn]] void refuse_entry(const std::string& here, zip_file_t* file) {
  zip_error_t* error = zip_file_get_error(file);
  if (zip_error_code_zip(error) == ZIP_ER_MEMORY) throw std::bad_alloc();
  refuse(here, fmt::format("the entry is damaged ({})", zip_error_strerror(error)));
}

/// Reads until the bytes are full or the entry ends. @return whether they are full
bool fill(zip_file_t* file, std::string& bytes, std::size_t& have, const std::string& here) {
  while (have < bytes.size()) {
    const zip_int64_t got = zip_fread(file, bytes.data() + have, bytes.size() - have);
    if (got < 0) refuse_entry(here, file);
    if (got == 0) return false;
    have += static_cast<std::size_t>(got);
  }
  return true;
}

/// Unpacks one entry; libzip compares its CRC. Memory is asked for as bytes come, not for what the entry promises, and only where the
/// array's own header promises as much.
std::string unpacked(zip_t* archive, const Entry& entry, const std::string& here) {
  const EntryFile file(zip_fopen_index(archive, entry.index, 0));
  if (!file) refuse(here, "the entry is damaged");
  std::string bytes(std::min<std::size_t>(entry.size, 1 << 20), '\0');
  std::size_t have = 0;
  bool full = fill(file.get(), bytes, have, here);
  if (full) check_npy_size(bytes, entry.size, here);
  while (full && have < entry.size) {
    bytes.resize(std::min(entry.size, 2 * have));
    full = fill(file.get(), bytes, have, here);
  }
  if (!full) refuse(here, "the entry is cut short");
  char beyond = 0;
  const zip_int64_t more = zip_fread(file.get(), &beyond, 1);  // at the end the CRC is compared
  if (more < 0) refuse_entry(here, file.get());
  if (more > 0) refuse(here, "the entry unpacks to more than its declared size");
  return bytes;
}

Archive open_archive(std::string_view file, const std::string& where) {
  if (file.empty())
    refuse(where, "the file is empty\n  expected a zip of .npy arrays, as numpy.savez writes");  // libzip takes that for a zip
  zip_error_t error;
  zip_error_init(&error);
  const auto refuse_zip = [&] {
    if (zip_error_code_zip(&error) == ZIP_ER_MEMORY) throw std::bad_alloc();
    const std::string why = zip_error_strerror(&error);
    zip_error_fini(&error);
    refuse(where, fmt::format("this is not a whole .npz file ({})\n  expected a zip of .npy arrays, as numpy.savez writes", why));
  };
  Source source(zip_source_buffer_create(file.data(), file.size(), 0, &error));
  if (!source) refuse_zip();
  Archive archive(zip_open_from_source(source.get(), ZIP_RDONLY | ZIP_CHECKCONS, &error));
  if (!archive) refuse_zip();
  (void)source.release();  // the archive owns it now
  zip_error_fini(&error);
  return archive;
}

}  // namespace

void npz_bytes(const std::vector<NpyView>& arrays, Packing packing, std::string& file) {
  ZipWriter zip(file, packing);
  for (const NpyView& view : arrays) zip.add(view.name + ".npy", npy_header(view.type, view.shape), view.bytes);
  zip.finish();
}

std::string npz_bytes(const std::vector<NpyView>& arrays, Packing packing) {
  std::string file;
  npz_bytes(arrays, packing, file);
  return file;
}

std::vector<NamedArray> parse_npz(std::string_view file, const std::string& where, const std::vector<std::string>& wanted) {
  const Archive archive = open_archive(file, where);
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  if (count > static_cast<zip_int64_t>(max_npz_entries))
    throw Error(ErrorKind::limit, fmt::format("{}: error: the zip has {} entries, more than {}", where, count, max_npz_entries));
  std::vector<NamedArray> arrays;
  std::set<std::string> names;
  std::size_t total = 0, packed = 0;
  const std::size_t most = most_unpacked(file.size());
  for (zip_int64_t i = 0; i < count; ++i) {
    const Entry entry = checked_entry(archive.get(), static_cast<zip_uint64_t>(i), file.size(), where);
    // Entries that lie upon each other would let the same bytes unpack many times over.
    packed += entry.packed;
    if (packed > file.size()) refuse(where, "the entries' declared sizes do not fit the file");
    if (entry.name.empty()) continue;  // no array
    const std::string here = fmt::format("{}[{}]", where, printable(entry.name));
    if (!names.insert(entry.name).second) refuse(here, "two arrays have this name");
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), entry.name) == wanted.end()) continue;
    total += entry.size;
    if (total > most)
      throw Error(ErrorKind::limit, fmt::format("{}: error: the arrays unpack to more than {} bytes (`tofray --limits`)", where, most));
    arrays.push_back({entry.name, parse_npy(unpacked(archive.get(), entry, here), here)});
  }
  return arrays;
}

std::vector<NamedArray> read_npz(const std::string& path, const std::vector<std::string>& wanted) {
  return parse_npz(read_bytes(path, max_data_file_bytes), path, wanted);
}

}  // namespace tofray::files
