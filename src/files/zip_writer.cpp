// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/zip_writer.h"

#include "files/crc32.h"
#include "files/deflate.h"

namespace tofray::files {
namespace {

constexpr std::uint32_t elsewhere = 0xffffffff;  ///< in place of a number that stands in 64 bits
constexpr std::uint16_t first_of_january_1980 = 1 << 5 | 1, made_on_unix = 3 << 8 | 63, regular_file = 0100666;
constexpr std::uint32_t header_signature = 0x04034b50, directory_signature = 0x02014b50, end_signature = 0x06054b50;
constexpr std::uint32_t end64_signature = 0x06064b50, locator64_signature = 0x07064b50;
constexpr std::uint16_t extra64 = 1, version64 = 45, deflate_method = 8;

/// Numbers of a zip: little endian, one after the other.
class Numbers {
 public:
  explicit Numbers(std::string& to) : to_(to) {}
  Numbers& u16(std::uint64_t value) { return put(value, 2); }
  Numbers& u32(std::uint64_t value) { return put(value, 4); }
  Numbers& u64(std::uint64_t value) { return put(value, 8); }

 private:
  Numbers& put(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) to_ += static_cast<char>(value >> 8 * i & 255);
    return *this;
  }
  std::string& to_;
};

std::uint16_t version_of(std::uint16_t method, bool large) { return large ? version64 : method == deflate_method ? 20 : 10; }

}  // namespace

ZipWriter::ZipWriter(std::string& file, Packing packing, std::uint64_t limit) : file_(file), packing_(packing), limit_(limit) {
  file_.clear();
}

/// Whether an entry's sizes need 64 bits; deflated bytes that cannot be packed are some more than they were.
bool ZipWriter::is_large(const Entry& entry) const { return entry.unpacked >= limit_ - limit_ / 1000; }

void ZipWriter::add(std::string_view name, std::string_view head, std::string_view body) {
  Entry entry{std::string(name), crc32(body, crc32(head)), 0, head.size() + body.size(), head.size() + body.size(), file_.size()};
  if (packing_ == Packing::stored) {
    put_header(entry);
    file_.append(head).append(body);
  } else {
    entry.method = deflate_method;
    const std::size_t before = file_.size();
    put_header(entry);
    const std::size_t start = file_.size();
    append_deflated(file_, head, body);
    entry.packed = file_.size() - start;
    // the packed size is known only now, and takes as much room
    std::string header;
    file_.swap(header);
    put_header(entry);
    file_.swap(header);
    file_.replace(before, header.size(), header);
  }
  entries_.push_back(std::move(entry));
}

void ZipWriter::put_header(const Entry& entry) {
  const bool large = is_large(entry);
  Numbers out(file_);
  out.u32(header_signature).u16(version_of(entry.method, large)).u16(0).u16(entry.method).u16(0).u16(first_of_january_1980).u32(entry.crc);
  out.u32(large ? elsewhere : entry.packed).u32(large ? elsewhere : entry.unpacked).u16(entry.name.size()).u16(large ? 20 : 0);
  file_ += entry.name;
  if (large) out.u16(extra64).u16(16).u64(entry.unpacked).u64(entry.packed);
}

void ZipWriter::put_directory_entry(const Entry& entry) {
  const bool large = is_large(entry), far = entry.offset >= limit_;
  const int numbers = (large ? 2 : 0) + (far ? 1 : 0);
  Numbers out(file_);
  out.u32(directory_signature).u16(made_on_unix).u16(version_of(entry.method, numbers > 0)).u16(0).u16(entry.method).u16(0);
  out.u16(first_of_january_1980).u32(entry.crc).u32(large ? elsewhere : entry.packed).u32(large ? elsewhere : entry.unpacked);
  out.u16(entry.name.size());
  out.u16(numbers > 0 ? 4 + 8 * numbers : 0)
      .u16(0)
      .u16(0)
      .u16(0)
      .u32(std::uint32_t{regular_file} << 16)
      .u32(far ? elsewhere : entry.offset);
  file_ += entry.name;
  if (numbers > 0) out.u16(extra64).u16(8 * numbers);
  if (large) out.u64(entry.unpacked).u64(entry.packed);
  if (far) out.u64(entry.offset);
}

void ZipWriter::finish() {
  const std::uint64_t start = file_.size(), count = entries_.size();
  for (const Entry& entry : entries_) put_directory_entry(entry);
  const std::uint64_t end = file_.size(), bytes = end - start;
  const bool large = start >= limit_ || bytes >= limit_ || count >= 0xffff;
  Numbers out(file_);
  if (large) {
    out.u32(end64_signature).u64(44).u16(made_on_unix).u16(version64).u32(0).u32(0).u64(count).u64(count).u64(bytes).u64(start);
    out.u32(locator64_signature).u32(0).u64(end).u32(1);
  }
  const std::uint64_t shown = large ? 0xffff : count;
  out.u32(end_signature).u16(0).u16(0).u16(shown).u16(shown).u32(large ? elsewhere : bytes).u32(large ? elsewhere : start).u16(0);
}

}  // namespace tofray::files
