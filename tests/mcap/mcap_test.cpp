// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Records against bytes that were put together by hand from the specification; what is left of files that were cut or damaged. (What readers of
// others find in a whole film: tests/ros.)
#include <gtest/gtest.h>
#include <zlib.h>

#include <cerrno>

#include "mcap/reader.h"
#include "mcap/writer.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::mcap;
using out_test::error_of;
using out_test::read_file;
using out_test::TemporaryFolder;

namespace {

std::string bytes_of(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> (8 * i) & 255);
  return out;
}
std::string text_of(const std::string& text) { return bytes_of(text.size(), 4) + text; }
std::string record_of(int opcode, const std::string& content) {
  return bytes_of(static_cast<std::uint64_t>(opcode), 1) + bytes_of(content.size(), 8) + content;
}
std::string sum_of(const std::string& bytes) {
  return bytes_of(::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())), 4);
}

/// What a reader gives of a file, one line each.
struct Heard {
  std::vector<std::string> messages, attachments;
  Ended ended;
};
Heard heard(std::string_view file) {
  Heard out;
  MemorySource source(file);
  Reading reading;
  reading.message = [&](const SeenMessage& one) {
    out.messages.push_back(one.channel.topic + " " + one.channel.schema.name + " " + std::to_string(one.log_ns) + " " +
                           std::string(one.data));
  };
  reading.attachment = [&](std::string_view name, std::string_view, std::string_view data) {
    out.attachments.push_back(std::string(name) + " " + std::string(data));
  };
  out.ended = read(source, "x.mcap", reading);
  return out;
}

/// A film of so many messages in chunks of 200 bytes or so.
std::string film(int messages, bool zstd) {
  const TemporaryFolder folder;
  GrowingFile file(folder.file("x.mcap"));
  Writer writer(file, {"ros2", "test", zstd, 200});
  writer.attach("a.txt", "text/plain", "attached");
  writer.add_metadata("tofray", {{"seed", "7"}});
  const std::uint16_t schema = writer.add_schema("pkg/msg/T", "ros2msg", "string data\n");
  const std::uint16_t one = writer.add_channel(schema, "/one", "cdr"), two = writer.add_channel(schema, "/two", "cdr", {{"k", "v"}});
  for (int i = 0; i < messages; ++i)
    writer.message(i % 3 == 0 ? two : one, static_cast<std::uint64_t>(100 + i), static_cast<std::uint64_t>(200 + i),
                   "message " + std::to_string(i));
  writer.finish();
  (void)file.finish();
  return read_file(folder.file("x.mcap"));
}

}  // namespace

TEST(mcap_writer, writes_the_bytes_that_the_specification_asks_for) {
  const TemporaryFolder folder;
  GrowingFile file(folder.file("x.mcap"));
  Writer writer(file, {"ros2", "me", false, 1000});
  const std::uint16_t schema = writer.add_schema("p/msg/T", "ros2msg", "int8 a\n");
  const std::uint16_t channel = writer.add_channel(schema, "/t", "cdr", {{"q", "x"}});
  writer.message(channel, 5, 6, "AB");
  writer.message(channel, 7, 8, "C");
  writer.finish();
  const FileRecord record = file.finish();

  const std::string schema_record = record_of(3, bytes_of(1, 2) + text_of("p/msg/T") + text_of("ros2msg") + text_of("int8 a\n"));
  const std::string channel_record =
      record_of(4, bytes_of(0, 2) + bytes_of(1, 2) + text_of("/t") + text_of("cdr") + text_of(text_of("q") + text_of("x")));
  const std::string first = record_of(5, bytes_of(0, 2) + bytes_of(0, 4) + bytes_of(5, 8) + bytes_of(6, 8) + "AB");
  const std::string second = record_of(5, bytes_of(0, 2) + bytes_of(1, 4) + bytes_of(7, 8) + bytes_of(8, 8) + "C");
  const std::string body = first + second;
  const std::string chunk = record_of(
      6, bytes_of(5, 8) + bytes_of(7, 8) + bytes_of(body.size(), 8) + sum_of(body) + text_of("") + bytes_of(body.size(), 8) + body);
  const std::string index =
      record_of(7, bytes_of(0, 2) + text_of(bytes_of(5, 8) + bytes_of(0, 8) + bytes_of(7, 8) + bytes_of(first.size(), 8)));
  const std::string before = std::string(magic) + record_of(1, text_of("ros2") + text_of("me")) + schema_record + channel_record;
  const std::string data = before + chunk + index;
  const std::string data_end = record_of(15, sum_of(data));
  const std::size_t summary = data.size() + data_end.size();
  const std::string statistics =
      record_of(11, bytes_of(2, 8) + bytes_of(1, 2) + bytes_of(1, 4) + bytes_of(0, 4) + bytes_of(0, 4) + bytes_of(1, 4) + bytes_of(5, 8) +
                        bytes_of(7, 8) + text_of(bytes_of(0, 2) + bytes_of(2, 8)));
  const std::string chunk_index =
      record_of(8, bytes_of(5, 8) + bytes_of(7, 8) + bytes_of(before.size(), 8) + bytes_of(chunk.size(), 8) +
                       text_of(bytes_of(0, 2) + bytes_of(before.size() + chunk.size(), 8)) + bytes_of(index.size(), 8) + text_of("") +
                       bytes_of(body.size(), 8) + bytes_of(body.size(), 8));
  const auto offset = [](int opcode, std::size_t at, const std::string& group) {
    return record_of(14, bytes_of(static_cast<std::uint64_t>(opcode), 1) + bytes_of(at, 8) + bytes_of(group.size(), 8));
  };
  std::size_t at = summary;
  std::string offsets, all;
  for (const auto& [opcode, group] :
       std::vector<std::pair<int, std::string>>{{3, schema_record}, {4, channel_record}, {11, statistics}, {8, chunk_index}}) {
    offsets += offset(opcode, at, group);
    all += group, at += group.size();
  }
  const std::string footer = bytes_of(2, 1) + bytes_of(20, 8) + bytes_of(summary, 8) + bytes_of(at, 8);
  const std::string expected = data + data_end + all + offsets + footer + sum_of(all + offsets + footer) + std::string(magic);
  const std::string written = read_file(folder.file("x.mcap"));
  EXPECT_EQ(written, expected);
  EXPECT_EQ(record.bytes, expected.size());
  EXPECT_EQ(record.sha256, files::sha256_hex(expected));
}

TEST(mcap_writer, has_its_file_under_another_name_until_it_is_complete) {
  const TemporaryFolder folder;
  out_test::write_file(folder.file("x.mcap"), "what was there before");
  {
    GrowingFile file(folder.file("x.mcap"));
    file.write("half of it");
    EXPECT_EQ(read_file(folder.file("x.part.mcap")), "half of it");
  }
  EXPECT_EQ(read_file(folder.file("x.mcap")), "what was there before");
  EXPECT_EQ(read_file(folder.file("x.part.mcap")), "half of it");  // of a program that ended early
  GrowingFile again(folder.file("x.mcap"));
  again.write("all of it");
  (void)again.finish();
  EXPECT_EQ(read_file(folder.file("x.mcap")), "all of it");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(mcap_writer, follows_no_link_that_lies_in_its_way) {
  const TemporaryFolder folder;
  out_test::write_file(folder.file("mine.txt"), "mine");
  std::filesystem::create_symlink("mine.txt", folder.file("x.part.mcap"));
  GrowingFile file(folder.file("x.mcap"));
  file.write("film");
  (void)file.finish();
  EXPECT_EQ(read_file(folder.file("mine.txt")), "mine");
  EXPECT_EQ(read_file(folder.file("x.mcap")), "film");
}

TEST(mcap_writer, says_where_the_disk_is_full_and_that_the_rest_can_be_read) {
  const TemporaryFolder folder;
  files::FileCalls calls = files::system_file_calls();
  calls.write = [](int, const void*, std::size_t) -> ssize_t {
    errno = ENOSPC;
    return -1;
  };
  GrowingFile file(folder.file("x.mcap"), calls);
  const Error error = error_of([&] { file.write("film"); });
  EXPECT_EQ(error.kind(), ErrorKind::io);
  const std::string text = error.what();
  EXPECT_NE(text.find("x.part.mcap: error: cannot write it: No space left on device\n"), std::string::npos) << text;
  EXPECT_NE(text.find("bytes in "), std::string::npos) << text;
  EXPECT_NE(text.find("can be read: `tofray inspect "), std::string::npos) << text;
}

TEST(mcap_writer, refuses_folders_that_are_not_there_and_places_that_are_no_files) {
  const TemporaryFolder folder;
  EXPECT_EQ(error_of([&] { const GrowingFile file(folder.file("no/x.mcap")); }).kind(), ErrorKind::io);
  EXPECT_EQ(error_of([&] { const GrowingFile file(folder.path()); }).kind(), ErrorKind::io);
}

TEST(mcap_reader, gives_back_what_was_written_packed_or_not) {
  for (const bool zstd : {false, true}) {
    if (zstd && !has_zstd()) continue;
    const Heard all = heard(film(100, zstd));
    ASSERT_EQ(all.messages.size(), 100U);
    EXPECT_EQ(all.messages[0], "/two pkg/msg/T 100 message 0");
    EXPECT_EQ(all.messages[98], "/one pkg/msg/T 198 message 98");
    EXPECT_EQ(all.attachments, std::vector<std::string>{"a.txt attached"});
    EXPECT_TRUE(all.ended.complete);
    EXPECT_GT(all.ended.chunks, 10U);
    EXPECT_EQ(all.ended.profile, "ros2");
    EXPECT_EQ(all.ended.channels.at(1).metadata, (Pairs{{"k", "v"}}));
  }
}

TEST(mcap_reader, of_a_file_cut_anywhere_gives_all_up_to_the_last_whole_chunk) {
  for (const bool zstd : {false, true}) {
    if (zstd && !has_zstd()) continue;
    const std::string whole = film(30, zstd);
    const std::vector<std::string> all = heard(whole).messages;
    std::size_t before = 0;
    for (std::size_t size = magic.size(); size < whole.size(); ++size) {
      const Heard cut = heard(whole.substr(0, size));
      EXPECT_FALSE(cut.ended.complete) << size;
      ASSERT_GE(cut.messages.size(), before) << size;
      ASSERT_TRUE(std::equal(cut.messages.begin(), cut.messages.end(), all.begin())) << size;
      before = cut.messages.size();
    }
    EXPECT_EQ(before, all.size());
  }
}

TEST(mcap_reader, sees_every_changed_byte_of_data_and_summary) {
  const std::string whole = film(12, false);
  const Heard good = heard(whole);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x41);
    bool seen = false;
    try {
      const Heard after = heard(changed);
      seen = !after.ended.complete || after.messages != good.messages || after.attachments != good.attachments;
    } catch (const Error& error) {
      seen = error.kind() == ErrorKind::bad_input || error.kind() == ErrorKind::limit;
    }
    EXPECT_TRUE(seen) << "byte " << i;
  }
}

TEST(mcap_reader, says_which_chunk_is_damaged_and_how_that_shows) {
  std::string file = film(12, false);
  file[file.find("message 7")] = 'M';
  const std::string text = error_of([&] { (void)heard(file); }).what();
  EXPECT_TRUE(text.starts_with("x.mcap: error: the chunk at byte ")) << text;
  EXPECT_NE(text.find("is damaged\n  its CRC-32 is "), std::string::npos) << text;
}

TEST(mcap_reader, refuses_what_is_no_mcap_and_what_it_cannot_unpack) {
  EXPECT_STREQ(error_of([] { (void)heard("PK\x03\x04 and so on"); }).what(),
               "x.mcap: error: this is no MCAP file\n  expected one that begins with \\x89MCAP0");
  const std::string body = "packed";
  const std::string lz4 = std::string(magic) + record_of(6, bytes_of(0, 8) + bytes_of(0, 8) + bytes_of(99, 8) + bytes_of(0, 4) +
                                                                text_of("lz4") + bytes_of(body.size(), 8) + body);
  const std::string text = error_of([&] { (void)heard(lz4); }).what();
  EXPECT_NE(text.find("is packed by \"lz4\", which is not read\n  expected zstd or none; `mcap compress --compression zstd`"),
            std::string::npos)
      << text;
}

TEST(mcap_reader, refuses_chunks_that_are_too_long_or_lie_about_it) {
  for (const std::uint64_t size : {std::uint64_t{1} << 40, std::uint64_t{255} << 20}) {
    const std::string lie = std::string(magic) + record_of(6, bytes_of(0, 8) + bytes_of(0, 8) + bytes_of(size, 8) + bytes_of(0, 4) +
                                                                  text_of("zstd") + bytes_of(4, 8) + "\x28\xb5\x2f\xfd");
    const ErrorKind kind = error_of([&] { (void)heard(lie); }).kind();
    EXPECT_EQ(kind, size > max_chunk_bytes ? ErrorKind::limit : ErrorKind::bad_input);
  }
}

TEST(mcap_reader, refuses_a_message_of_a_channel_that_nobody_told_of) {
  const std::string file = std::string(magic) + record_of(5, bytes_of(3, 2) + bytes_of(0, 4) + bytes_of(5, 8) + bytes_of(6, 8) + "AB");
  const std::string text = error_of([&] { (void)heard(file); }).what();
  EXPECT_NE(text.find("it is of channel 3, which was not told before"), std::string::npos) << text;
}
