// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include "files/crc32.h"

namespace tofray::test {
namespace {

/// What zlib unpacks. @param window_bits  negative for a stream without a header
std::string inflated(const std::string& packed, int window_bits, std::size_t size) {
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, window_bits), Z_OK);
  std::string in = packed, out(size + 1, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(in.data()), stream.avail_in = static_cast<uInt>(in.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data()), stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0U);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  return out;
}

std::string text_of(std::size_t size) {
  std::string text;
  while (text.size() < size) text += std::to_string(text.size() * text.size()) + (text.size() % 3 == 0 ? "\n" : ", ");
  text.resize(size);
  return text;
}

TEST(deflate, of_two_pieces_is_one_stream_behind_what_was_there) {
  for (const std::size_t head : {0, 1, 128, 65'535, 65'536, 200'000})
    for (const std::size_t body : {0, 1, 100'000}) {
      const std::string first = text_of(head), second = text_of(body);
      std::string packed = "before";
      files::append_deflated(packed, first, second);
      ASSERT_TRUE(packed.starts_with("before"));
      EXPECT_TRUE(inflated(packed.substr(6), -MAX_WBITS, head + body) == first + second) << head << " and " << body;
    }
}

TEST(deflate, of_a_page_is_a_stream_of_zlib) {
  const std::string text = text_of(50'000), packed = files::zlib_stream(text);
  EXPECT_LT(packed.size(), text.size() / 2);
  EXPECT_TRUE(inflated(packed, MAX_WBITS, text.size()) == text);
}

// The check value of the algorithm is that of these nine digits.
TEST(crc32, has_its_check_value_in_one_piece_and_in_several) {
  EXPECT_EQ(files::crc32("123456789"), 0xcbf43926U);
  EXPECT_EQ(files::crc32("56789", files::crc32({}, files::crc32("1234"))), 0xcbf43926U);
  EXPECT_EQ(files::crc32({}), 0U);
}

}  // namespace
}  // namespace tofray::test
