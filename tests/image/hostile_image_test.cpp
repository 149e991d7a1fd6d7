// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files cut short, changed or far too large: an error or an image of the size that its header says, and no memory for what is not there.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <functional>

#include "image_files.h"
#include "jpeg_by_hand.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::image_test;

namespace {

std::vector<std::string> png_samples() {
  std::vector<std::string> all;
  for (const bool interlaced : {false, true}) {
    for (const auto& [color_type, bits] : {std::pair{grey, 1}, {grey, 16}, {rgb, 8}, {grey_alpha, 8}, {rgba, 16}})
      all.push_back(libpng_png({7, 6, bits, color_type, interlaced}, random_samples(7 * 6 * 4, bits, 8)));
    all.push_back(
        libpng_png({9, 3, 2, palette, interlaced, {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {0, 0, 0}}, "\x10\x20"}, random_samples(27, 2, 9)));
  }
  all.push_back(hand_png(2, 1, 8, grey, bytes_of({0, 1, 2}), chunk("tRNS", bytes_of({0, 1})) + chunk("gAMA", big_endian(45455))));
  return all;
}

std::vector<std::string> jpeg_samples() {
  std::vector<unsigned char> samples;
  for (const int sample : random_samples(20 * 20 * 3, 8, 10)) samples.push_back(static_cast<unsigned char>(sample / 8 + 100));
  Jpeg with_restarts{17, 9, 3};
  with_restarts.restart = 1;
  Jpeg one_by_one{9, 9, 3};
  one_by_one.one_by_one = true;
  std::vector<std::string> all = {HandJpeg().file()};
  for (const Jpeg& jpeg : {Jpeg{9, 7, 1, false, 1, 60}, Jpeg{20, 17, 3, false, 2, 60}, Jpeg{9, 7, 1, true, 1, 60},
                           Jpeg{20, 17, 3, true, 2, 60}, with_restarts, one_by_one})
    all.push_back(libjpeg_jpeg(jpeg, samples));
  return all;
}

/// Makes all checksums right, so that a change is not found by them.
std::string with_right_sums(std::string file) {
  for (std::size_t at = 8; at + 12 <= file.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = 256 * length + static_cast<unsigned char>(file[at + i]);
    if (length > file.size() - at - 12) break;
    file.replace(at + 8 + length, 4, big_endian(crc_of(std::string_view(file).substr(at + 4, 4 + length))));
    at += 12 + length;
  }
  return file;
}

std::string changed(std::string file, test::Random& random) {
  for (int changes = 1 + random.below(4); changes > 0; --changes) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<int>(file.size())));
    const auto from = static_cast<std::size_t>(random.below(static_cast<int>(file.size())));
    switch (random.below(4)) {
      case 0: file[at] = static_cast<char>(random.below(256)); break;
      case 1: file[at] = static_cast<char>(file[at] ^ (1 << random.below(8))); break;
      case 2:
        file.replace(at, static_cast<std::size_t>(random.below(12)), file.substr(from, static_cast<std::size_t>(random.below(12))));
        break;
      default: file[at] = "\x00\xFF\x01\x7F\x80\xD9\xC4\xDA"[random.below(8)]; break;
    }
    if (file.empty()) file = "x";
  }
  return file;
}

/// Bytes of memory at most, beyond those at the beginning, that another process takes for this; 0 where it failed.
std::size_t peak_bytes(const std::function<bool()>& work) {
  int ends[2];
  if (::pipe(ends) != 0) return 0;
  const pid_t child = ::fork();
  if (child == 0) {
    const auto peak = [] {
      rusage usage{};
      ::getrusage(RUSAGE_SELF, &usage);
      return 1024 * static_cast<std::size_t>(usage.ru_maxrss);
    };
    const std::size_t before = peak();
    const std::size_t taken = work() ? peak() - before + 1 : 0;
    const bool told = ::write(ends[1], &taken, sizeof taken) == sizeof taken;
    ::_exit(told ? 0 : 1);
  }
  std::size_t taken = 0;
  if (::read(ends[0], &taken, sizeof taken) != sizeof taken) taken = 0;
  ::waitpid(child, nullptr, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  return taken;
}

/// In MiB; `good` says whether there is to be an image.
double peak_mib(const std::string& file, bool good) {
  const std::size_t peak = peak_bytes([&] { return is_taken(file) == good; });
  EXPECT_GT(peak, 0U) << "it was not " << (good ? "taken" : "refused");
  return static_cast<double>(peak) / (1 << 20);
}

constexpr double little = 8;  // MiB: what an exception and the libraries take themselves

/// zlib's bytes of very many zeros, of which memory never has many.
std::string deflated_zeros(std::size_t count) {
  z_stream stream{};
  EXPECT_EQ(deflateInit(&stream, 9), Z_OK);
  std::string zeros(1 << 20, '\0'), out, piece(1 << 16, '\0');
  for (std::size_t left = count; left > 0 || stream.avail_in > 0;) {
    if (stream.avail_in == 0) {
      stream.avail_in = static_cast<uInt>(std::min(left, zeros.size()));
      stream.next_in = reinterpret_cast<Bytef*>(zeros.data());
      left -= stream.avail_in;
    }
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    deflate(&stream, Z_NO_FLUSH);
    out.append(piece, 0, piece.size() - stream.avail_out);
  }
  for (int result = Z_OK; result == Z_OK;) {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    result = deflate(&stream, Z_FINISH);
    out.append(piece, 0, piece.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return out;
}

std::string bomb(std::uint32_t width, std::uint32_t height, int bits, int color_type, std::size_t zeros, const std::string& before = {}) {
  return signature + ihdr(width, height, bits, color_type) + before + chunk("IDAT", deflated_zeros(zeros)) + iend;
}

}  // namespace

TEST(hostile_png, cut_short_anywhere_is_refused) {
  for (const std::string& file : png_samples()) {
    ASSERT_TRUE(is_taken(file));
    for (std::size_t size = 0; size < file.size(); ++size) EXPECT_FALSE(is_taken(std::string_view(file).substr(0, size))) << size;
  }
}

TEST(hostile_jpeg, cut_short_anywhere_is_refused) {
  for (const std::string& file : jpeg_samples()) {
    ASSERT_TRUE(is_taken(file));
    for (std::size_t size = 0; size < file.size(); ++size) EXPECT_FALSE(is_taken(std::string_view(file).substr(0, size))) << size;
  }
}

TEST(hostile_jpeg, cut_short_and_ended_is_refused_but_for_its_last_bits) {
  const std::string end = bytes_of({0xFF, 0xD9});
  for (const std::string& file : jpeg_samples())
    for (std::size_t size = 2; size + 2 + 8 < file.size(); ++size)
      EXPECT_FALSE(is_taken(file.substr(0, size) + end)) << size << " of " << file.size();
}

TEST(hostile_png, with_any_bit_changed_is_refused) {
  // Each bit is in the signature, a length, or what a checksum is of.
  for (const std::string& file : png_samples())
    for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
      std::string other = file;
      other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
      EXPECT_FALSE(is_taken(other)) << bit;
    }
}

TEST(hostile_png, with_many_changes_and_right_checksums_is_an_error_or_an_image) {
  test::Random random(11);
  const std::vector<std::string> all = png_samples();
  int taken = 0, refused = 0;
  for (int trial = 0; trial < 8000; ++trial) {
    const std::string file = with_right_sums(changed(all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))], random));
    SCOPED_TRACE(trial);
    (is_taken(file) ? taken : refused) += 1;
  }
  EXPECT_GT(taken, 200);
  EXPECT_GT(refused, 4000);
}

TEST(hostile_jpeg, with_many_changes_is_an_error_or_an_image) {
  test::Random random(12);
  const std::vector<std::string> all = jpeg_samples();
  int taken = 0, refused = 0;
  for (int trial = 0; trial < 8000; ++trial) {
    const std::string file = changed(all[static_cast<std::size_t>(random.below(static_cast<int>(all.size())))], random);
    SCOPED_TRACE(trial);
    (is_taken(file) ? taken : refused) += 1;
  }
  EXPECT_GT(taken, 1000);
  EXPECT_GT(refused, 4000);
}

TEST(hostile_image, takes_memory_for_the_pixels_that_are_there_and_no_more) {
  if constexpr (test::with_sanitizers) GTEST_SKIP() << "a sanitizer has memory of its own";
  const std::size_t pixels = std::size_t{8192} * 8192;
  // 2 bytes a sample: 128 MiB of 8 KiB
  const double all_black = peak_mib(bomb(8192, 8192, 1, grey, 8192 * (1 + 8192 / 8)), true);
  EXPECT_GT(all_black, 127);
  EXPECT_LT(all_black, 128 + little);
  // a palette makes 384 MiB of them
  EXPECT_LT(peak_mib(bomb(8192, 8192, 1, palette, 8192 * (1 + 8192 / 8), chunk("PLTE", "abc")), true), 384 + little);
  // a progressive JPEG in grey has 2 bytes a pixel of coefficients beside its samples
  const std::string jpeg = libjpeg_jpeg({8192, 8192, 1, true}, std::vector<unsigned char>(pixels, 77));
  EXPECT_LT(peak_mib(jpeg, true), 256 + little);
}

TEST(hostile_image, that_claims_more_than_it_has_is_refused_before_memory_is_taken) {
  if constexpr (test::with_sanitizers) GTEST_SKIP() << "a sanitizer has memory of its own";
  EXPECT_LT(peak_mib(bomb(16384, 4096, 16, rgba, 1000), false), little);
  EXPECT_LT(peak_mib(bomb(16384, 4096, 1, grey, 1000), false), little);
  EXPECT_LT(peak_mib(bomb(0x7FFFFFFF, 0x7FFFFFFF, 16, rgba, 1000), false), little);
  HandJpeg jpeg;
  jpeg.width = jpeg.height = 8192;
  EXPECT_LT(peak_mib(jpeg.file(), false), little);
  jpeg.frame = 0xC2;
  EXPECT_LT(peak_mib(jpeg.file(), false), little);
}

TEST(hostile_image, that_unpacks_to_far_more_than_its_pixels_takes_no_memory_for_it) {
  if constexpr (test::with_sanitizers) GTEST_SKIP() << "a sanitizer has memory of its own";
  // pixels: 256 MiB behind one
  EXPECT_LT(peak_mib(bomb(1, 1, 8, grey, 256 << 20), false), little);
  // and what is passed over
  const std::string zeros = deflated_zeros(256 << 20);
  const std::string profile = chunk("iCCP", "a" + bytes_of({0, 0}) + zeros), text = chunk("zTXt", "a" + bytes_of({0, 0}) + zeros),
                    utf8 = chunk("iTXt", "a" + bytes_of({0, 1, 0, 0, 0}) + zeros);
  EXPECT_LT(peak_mib(bomb(1, 1, 8, grey, 2, profile + text + text + utf8 + utf8), true), little);
  std::string many;
  for (int i = 0; i < 20'000; ++i) many += chunk("tEXt", "a" + std::string(100, 'x')) + chunk("abCd", std::string(100, 'x'));
  EXPECT_LT(peak_mib(bomb(1, 1, 8, grey, 2, many), true), little);
}
