// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <zip.h>

#include "files/npz.h"
#include "files/zip_writer.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using out_test::Python;
using out_test::TemporaryFolder;

namespace {

struct Piece {
  std::string name, head, body;
};

/// A long one, an empty one, one that can be packed and one that cannot.
std::vector<Piece> pieces() {
  out_test::Random random(5);
  std::string noise(200'001, 0);
  for (char& letter : noise) letter = static_cast<char>(random.next());
  return {{"a.npy", "head", "body"},
          {"empty", "", ""},
          {"zeros.npy", std::string(128, 'h'), std::string(500'000, 0)},
          {"noise.npy", "x", noise}};
}

std::string zip_of(const std::vector<Piece>& all, Packing packing, std::uint64_t limit = ZipWriter::most_in_32_bits) {
  std::string file = "what was there before";
  ZipWriter zip(file, packing, limit);
  for (const Piece& one : all) zip.add(one.name, one.head, one.body);
  zip.finish();
  return file;
}

/// A zip file of the pieces by libzip.
std::string zip_by_libzip(const std::vector<Piece>& all) {
  zip_source_t* buffer = zip_source_buffer_create(nullptr, 0, 0, nullptr);
  zip_source_keep(buffer);
  zip_t* archive = zip_open_from_source(buffer, ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  std::vector<std::string> whole;
  whole.reserve(all.size());
  for (const Piece& one : all) {
    const std::string& bytes = whole.emplace_back(one.head + one.body);
    const auto index = static_cast<zip_uint64_t>(
        zip_file_add(archive, one.name.c_str(), zip_source_buffer(archive, bytes.data(), bytes.size(), 0), ZIP_FL_ENC_UTF_8));
    zip_set_file_compression(archive, index, ZIP_CM_STORE, 0);
    zip_file_set_dostime(archive, index, 0, 1 << 5 | 1, 0);
  }
  EXPECT_EQ(zip_close(archive), 0);
  zip_stat_t status;
  zip_source_stat(buffer, &status);
  std::string bytes(status.size, 0);
  zip_source_open(buffer);
  zip_source_read(buffer, bytes.data(), bytes.size());
  zip_source_close(buffer);
  zip_source_free(buffer);
  return bytes;
}

/// Python's zipfile reads every entry, compares its CRC, and the bytes are those that went in.
void expect_readable(const std::string& file, const std::vector<Piece>& all) {
  const Python python;
  if (!python.there()) GTEST_SKIP() << "no /usr/bin/python3 with numpy";
  TemporaryFolder folder;
  out_test::write_file(folder.file("x.zip"), file);
  for (std::size_t i = 0; i < all.size(); ++i) out_test::write_file(folder.file(std::to_string(i)), all[i].head + all[i].body);
  EXPECT_EQ(python.run(R"py(
import sys, zipfile
folder = sys.argv[1]
z = zipfile.ZipFile(folder + '/x.zip')
assert z.testzip() is None
for i, entry in enumerate(z.infolist()):
  assert z.read(entry) == open(f'{folder}/{i}', 'rb').read(), entry
  assert entry.date_time == (1980, 1, 1, 0, 0, 0), entry
)py",
                       folder.path().string()),
            0);
}

}  // namespace

TEST(zip, of_stored_entries_is_what_libzip_writes_bit_by_bit) {
  const std::string ours = zip_of(pieces(), Packing::stored);
  expect_readable(ours, pieces());
  // Later ones (Debian 13 has 1.11) fill fields that say nothing of the contents otherwise.
  if (std::string(zip_libzip_version()).starts_with("1.7.")) {
    EXPECT_TRUE(ours == zip_by_libzip(pieces()));
  }
}

TEST(zip, of_deflated_entries_is_smaller_and_read_by_others) {
  const std::string packed = zip_of(pieces(), Packing::deflated);
  EXPECT_LT(packed.size(), 210'000U);  // the noise cannot be packed, 500,000 zeros can
  expect_readable(packed, pieces());
  EXPECT_TRUE(zip_of(pieces(), Packing::deflated) == packed);
}

// With a small limit in place of four gigabytes every size and place stands in 64 bits, as readers have to take it.
TEST(zip, beyond_32_bits_is_read_by_others) {
  expect_readable(zip_of(pieces(), Packing::stored, 3), pieces());
  expect_readable(zip_of(pieces(), Packing::deflated, 3), pieces());
  expect_readable(zip_of(pieces(), Packing::stored, 1000), pieces());
}

TEST(zip, of_more_entries_than_16_bits_count_is_read_by_libzip) {
  std::vector<Piece> many;
  for (int i = 0; i < 70'000; ++i) many.push_back({std::to_string(i), "", ""});
  std::string file = zip_of(many, Packing::stored);
  zip_t* archive = zip_open_from_source(zip_source_buffer_create(file.data(), file.size(), 0, nullptr), ZIP_RDONLY, nullptr);
  ASSERT_NE(archive, nullptr);
  EXPECT_EQ(zip_get_num_entries(archive, 0), 70'000);
  zip_discard(archive);
}

TEST(npz, deflated_is_read_back_and_the_same_each_time) {
  const std::vector<float> values(10'000, 2.5f);
  const std::vector<NpyView> views = {npy_view("a", {100, 100}, values)};
  const std::string file = npz_bytes(views, Packing::deflated);
  EXPECT_LT(file.size(), 1000U);
  EXPECT_EQ(file, npz_bytes(views, Packing::deflated));
  EXPECT_EQ(parse_npz(file, "memory")[0].array.bytes, parse_npz(npz_bytes(views), "memory")[0].array.bytes);
}
