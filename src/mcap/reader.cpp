// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mcap/reader.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/text.h"
#include "files/crc32.h"
#include "files/descriptor.h"
#include "mcap/compression.h"
#include "tofray/error.h"

namespace tofray::mcap {

namespace {

[[noreturn]] void fail_to_read(const std::string& path, int code) {
  throw Error(ErrorKind::io, fmt::format("{}: error: cannot read it: {}", base::printable(path), std::generic_category().message(code)));
}

class FileSource : public Source {
 public:
  explicit FileSource(const std::string& path) : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    struct stat status {};
    if (file_.number() < 0 || ::fstat(file_.number(), &status) != 0) fail_to_read(path, errno);
    if (!S_ISREG(status.st_mode))
      throw Error(ErrorKind::io, fmt::format("{}: error: this is {}\n  expected a file", base::printable(path),
                                             S_ISDIR(status.st_mode) ? "a folder" : "not a regular file"));
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
  [[nodiscard]] std::uint64_t size() const override { return size_; }
  std::string_view read(std::uint64_t from, std::uint64_t size) override {
    memory_.resize(size);
    for (std::uint64_t have = 0; have < size;) {
      const ssize_t got = ::pread(file_.number(), memory_.data() + have, size - have, static_cast<off_t>(from + have));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) fail_to_read(path_, got < 0 ? errno : EIO);  // it was longer a moment ago
      have += static_cast<std::uint64_t>(got);
    }
    return memory_;
  }

 private:
  std::string path_;
  files::Descriptor file_;
  std::uint64_t size_ = 0;
  std::string memory_;
};

class Reader {
 public:
  Reader(Source& file, const std::string& where, const Reading& reading) : file_(file), where_(base::printable(where)), reading_(reading) {}

  Ended read() {
    if (file_.size() < magic.size() || file_.read(0, magic.size()) != magic)
      throw Error(ErrorKind::bad_input, where_ + ": error: this is no MCAP file\n  expected one that begins with \\x89MCAP0");
    out_.bytes = magic.size();
    crc_ = files::crc32(magic);
    while (next_record()) {}
    return std::move(out_);
  }

  void read(const Part& part) {
    out_.channels = part.channels, out_.bytes = part.first;
    while (out_.bytes <= part.last && next_record()) {}
  }

 private:
  [[noreturn]] void damaged(const std::string& what, std::uint64_t at, const std::string& more) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: error: {} at byte {} is damaged\n  {}", where_, what, at, more));
  }
  void check_sum(const char* what, std::uint64_t at, std::uint32_t got, std::uint32_t said) const {
    if (said != 0 && got != said)  // 0: the writer made none
      damaged(what, at, fmt::format("its CRC-32 is {:08x}, and {:08x} was written; copy the file again", got, said));
  }

  /// @return false at the end, its own or where it was cut
  bool next_record() {
    const std::uint64_t at = out_.bytes, left = file_.size() - at;
    if (left < record_head) return false;
    Take head(file_.read(at, record_head));
    const auto opcode = static_cast<Opcode>(head.number<std::uint8_t>());
    const std::uint64_t size = head.u64();
    if (size > left - record_head) return false;
    if (size > max_record_bytes)
      throw Error(ErrorKind::limit,
                  fmt::format("{}: error: the record at byte {} has {} bytes, more than {}", where_, at, size, max_record_bytes));
    const std::string_view whole = file_.read(at, record_head + size), record = whole.substr(record_head);
    if (opcode == Opcode::data_end) return end_data(at, record), false;
    crc_ = files::crc32(whole, crc_);
    Take from(record);
    switch (opcode) {
      case Opcode::header: out_.profile = from.text(), out_.library = from.text(); break;
      case Opcode::chunk: take_chunk(from, at); break;
      case Opcode::attachment: take_attachment(record, at); break;
      case Opcode::metadata: take_metadata(from); break;
      default: take_inner(opcode, from, at);
    }
    if (!from.good()) damaged("the record", at, "it is shorter than what it says of itself");
    out_.bytes += record_head + size;
    return true;
  }

  /// What stands within chunks and without.
  void take_inner(Opcode opcode, Take& from, std::uint64_t at) {
    if (opcode == Opcode::schema) {
      const std::uint16_t id = from.u16();
      const std::string_view name = from.text(), encoding = from.text(), definition = from.text();
      if (from.good()) schemas_[id] = {std::string(name), std::string(encoding), std::string(definition)};
    } else if (opcode == Opcode::channel) {
      const std::uint16_t id = from.u16(), schema = from.u16();
      const std::string_view topic = from.text(), encoding = from.text();
      Pairs metadata = from.pairs();
      if (from.good()) out_.channels[id] = {schemas_[schema], std::string(topic), std::string(encoding), std::move(metadata)};
    } else if (opcode == Opcode::message) {
      const std::uint16_t id = from.u16();
      const std::uint32_t sequence = from.u32();
      const std::uint64_t log_ns = from.u64(), publish_ns = from.u64();
      if (!from.good()) return;
      const auto channel = out_.channels.find(id);
      if (channel == out_.channels.end()) damaged("a message", at, fmt::format("it is of channel {}, which was not told before", id));
      if (reading_.message) reading_.message({channel->second, sequence, log_ns, publish_ns, from.rest(), at});
    }
    // message indexes, and records of newer versions
  }

  void take_chunk(Take& from, std::uint64_t at) {
    from.u64(), from.u64();  // first and last time
    const std::uint64_t size = from.u64();
    const std::uint32_t said = from.u32();
    const std::string compression(from.text());
    const std::string_view packed = from.raw(from.u64());
    if (!from.good()) return;
    if (size > max_chunk_bytes)
      throw Error(ErrorKind::limit,
                  fmt::format("{}: error: the chunk at byte {} unpacks to {} bytes, more than {}", where_, at, size, max_chunk_bytes));
    const std::string_view records = unpacked(packed, size, compression, at);
    check_sum("the chunk", at, files::crc32(records), said);
    ++out_.chunks, ++out_.compressions[compression];
    out_.unpacked_bytes += size, out_.packed_bytes += packed.size();
    Take inner(records);
    while (!inner.rest().empty()) {
      const auto opcode = static_cast<Opcode>(inner.number<std::uint8_t>());
      Take record(inner.raw(inner.u64()));
      if (inner.good()) take_inner(opcode, record, at);
      if (!inner.good() || !record.good()) damaged("the chunk", at, "a record in it is shorter than what it says of itself");
    }
  }

  std::string_view unpacked(std::string_view packed, std::uint64_t size, const std::string& compression, std::uint64_t at) {
    if (compression.empty()) {
      if (packed.size() != size) damaged("the chunk", at, fmt::format("it has {} bytes and says {}", packed.size(), size));
      return packed;
    }
    if (compression != "zstd" || !has_zstd())
      throw Error(
          ErrorKind::bad_input,
          fmt::format("{}: error: the chunk at byte {} is packed by {}, which is not read\n  {}", where_, at, base::in_quotes(compression),
                      compression == "zstd" ? "this tofray was built without libzstd (Debian: libzstd-dev)"
                                            : "expected zstd or none; `mcap compress --compression zstd` packs it anew"));
    if (!unpack(packed, size, chunk_)) damaged("the chunk", at, fmt::format("its {} bytes are not zstd's for {}", packed.size(), size));
    return chunk_;
  }

  void take_attachment(std::string_view record, std::uint64_t at) {
    Take from(record);
    from.u64(), from.u64();  // times
    const std::string_view name = from.text(), media_type = from.text(), data = from.raw(from.u64());
    const std::uint32_t said = from.u32();
    if (!from.good()) damaged("the attachment", at, "it is shorter than what it says of itself");
    check_sum("the attachment", at, files::crc32(record.substr(0, record.size() - from.rest().size() - 4)), said);
    if (reading_.attachment) reading_.attachment(name, media_type, data);
  }

  void take_metadata(Take& from) {
    const std::string_view name = from.text();
    const Pairs pairs = from.pairs();
    if (from.good() && reading_.metadata) reading_.metadata(name, pairs);
  }

  /// The summary says nothing that the data do not: its sum shows whether the file is whole.
  void end_data(std::uint64_t at, std::string_view record) {
    Take from(record);
    check_sum("what stands before the record", at, crc_, from.u32());
    const std::uint64_t start = at + record_head + record.size(), size = file_.size() - start;
    constexpr std::uint64_t footer = record_head + 8 + 8 + 4;
    if (size < footer + magic.size()) return;
    if (size > max_record_bytes) throw Error(ErrorKind::limit, where_ + ": error: the summary is too long");
    const std::string_view rest = file_.read(start, size), end = rest.substr(size - footer - magic.size());
    if (end.substr(footer) != magic) return;
    Take foot(end.substr(0, footer));
    if (static_cast<Opcode>(foot.number<std::uint8_t>()) != Opcode::footer || foot.u64() != 20) return;
    foot.u64(), foot.u64();
    check_sum("the summary", start, files::crc32(rest.substr(0, size - magic.size() - 4)), foot.u32());
    out_.complete = true;
    out_.bytes = file_.size();
  }

  Source& file_;
  std::string where_;
  const Reading& reading_;
  Ended out_;
  std::map<std::uint16_t, Schema> schemas_;
  std::string chunk_;
  std::uint32_t crc_ = 0;
};

}  // namespace

std::unique_ptr<Source> open_file(const std::string& path) { return std::make_unique<FileSource>(path); }

Ended read(Source& file, const std::string& where, const Reading& reading) { return Reader(file, where, reading).read(); }

void read_part(Source& file, const std::string& where, const Reading& reading, const Part& part) {
  Reader(file, where, reading).read(part);
}

}  // namespace tofray::mcap
