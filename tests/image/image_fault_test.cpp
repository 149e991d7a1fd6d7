// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// One fault each, and what the error says of it.
#include <png.h>

#include <functional>
#include <memory>

#include "image_files.h"
#include "jpeg_by_hand.h"

using namespace tofray;
using namespace tofray::image_test;

namespace {

/// The bytes, and how the error's text goes on behind "m: error: ".
struct ImageFault {
  std::string bytes;
  std::string message;
  ErrorKind kind = ErrorKind::bad_input;
};

Error error_of_image(std::string_view bytes) {
  try {
    (void)image::read(bytes, "m");
  } catch (const Error& error) {
    test::expect_told(error, "m");
    return error;
  }
  return {ErrorKind::bug, "it was taken"};
}

/// Each is told as an error, and in no other way.
void expect_faults(const std::vector<ImageFault>& faults) {
  testing::internal::CaptureStderr();
  for (const ImageFault& fault : faults) {
    SCOPED_TRACE(testing::Message() << "the fault " << &fault - faults.data());
    const Error error = error_of_image(fault.bytes);
    EXPECT_EQ(std::string(error.what()).rfind("m: error: " + fault.message, 0), 0U) << error.what() << "\nexpected: " << fault.message;
    EXPECT_EQ(error.kind(), fault.kind) << error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

const std::string row_of_2 = bytes_of({0, 100, 200});
const std::string header_2 = ihdr(2, 1, 8, grey);
const std::string pixels_2 = chunk("IDAT", deflated(row_of_2));

/// A file of these chunks.
std::string png_of(const std::vector<std::string>& chunks) {
  std::string file = signature;
  for (const std::string& one : chunks) file += one;
  return file;
}

std::string with_wrong_crc(std::string one) {
  one.back() = static_cast<char>(one.back() ^ 1);
  return one;
}

std::string header_with(int at, int value) {
  std::string data = big_endian(2) + big_endian(1) + bytes_of({8, 0, 0, 0, 0});
  data[static_cast<std::size_t>(at)] = static_cast<char>(value);
  return png_of({chunk("IHDR", data), pixels_2, iend});
}

std::string jpeg_with(const std::function<void(HandJpeg&)>& change) {
  HandJpeg jpeg;
  change(jpeg);
  return jpeg.file();
}

std::string jpeg_of_frame(int marker, int bits = 8) {
  return jpeg_with([&](HandJpeg& jpeg) { jpeg.frame = marker, jpeg.bits = bits; });
}

std::string jpeg_of_size(int width, int height) {
  return jpeg_with([&](HandJpeg& jpeg) { jpeg.width = width, jpeg.height = height; });
}

}  // namespace

TEST(image_fault, of_another_format_is_told_by_its_name) {
  const auto other = [](const std::string& bytes, const std::string& name) {
    return ImageFault{bytes, "this kind of image is not read\n  it looks like " + name + "; expected PNG or JPEG: convert it to PNG"};
  };
  expect_faults({
      other("RIFF" + big_endian(7) + "WEBPVP8 ", "WebP"),
      other("GIF89a", "GIF"),
      other("BM" + std::string(30, '\0'), "BMP"),
      other("\xABKTX 20\xBB\r\n\x1A\n", "KTX 2"),
      other("\xABKTX 11\xBB\r\n\x1A\n", "KTX"),
      other("DDS |", "DDS"),
      other("\x76\x2F\x31\x01\x02", "OpenEXR"),
      other("#?RADIANCE\n", "Radiance HDR"),
      other(std::string("II*\0", 4), "TIFF"),
      other(std::string("MM\0*", 4), "TIFF"),
      other("8BPS", "Photoshop"),
      other(big_endian(28) + "ftypavif", "AVIF"),
      other(big_endian(28) + "ftypheic", "HEIF"),
      other(big_endian(28) + "ftypmif1", "HEIF or AVIF"),
      other("\xFF\x0A", "JPEG XL"),
      other(big_endian(12) + "JXL \r\n", "JPEG XL"),
      other(big_endian(12) + "jP  \r\n", "JPEG 2000"),
      other("\xFF\x4F\xFF\x51", "JPEG 2000"),
      other("<svg xmlns=", "SVG"),
      other("<?xml version", "XML, perhaps SVG"),
      other("%PDF-1.4", "PDF"),
      other("P5\n2 2", "PNM"),
      other("\x89PNG\n\x1A\n", "a PNG file whose first bytes are damaged, as by a transfer as text"),
      {"", "the image file is empty\n  expected PNG or JPEG"},
      {"hello\x1b[1m", "this is no image that can be read\n  got \"hello\\x1b[1m\" at its beginning, expected PNG or JPEG"},
      {"\xFF", "this is no image that can be read"},
      {"\x89PN", "the PNG file is cut short\n  it ends in its first 8 bytes"},
  });
}

TEST(image_fault, of_a_png_s_header_is_told) {
  const std::string way_out = "make it smaller (`tofray --limits`), or mend its header if that is wrong";
  const auto size = [](std::uint32_t width, std::uint32_t height) { return png_of({ihdr(width, height, 8, grey), pixels_2, iend}); };
  expect_faults({
      {size(16385, 1), "the image has more than 16384 pixels along a side\n  its header says 16385 by 1: " + way_out, ErrorKind::limit},
      {size(1, 16385), "the image has more than 16384 pixels along a side", ErrorKind::limit},
      {size(0xFFFFFFFF, 0xFFFFFFFF), "the image has more than 16384 pixels along a side", ErrorKind::limit},
      {size(16384, 4097), "the image has more than 67108864 pixels\n  its header says 16384 by 4097: " + way_out, ErrorKind::limit},
      {size(8193, 8193), "the image has more than 67108864 pixels", ErrorKind::limit},
      {size(0, 1), "the image has no pixels\n  its header says 0 by 1"},
      {size(1, 0), "the image has no pixels\n  its header says 1 by 0"},
      {size(16384, 4096), "the PNG file is too short for its pixels\n  its 16384 by 4096 pixels cannot be packed into"},
      {header_with(8, 3), "PNG has no samples of 3 bits for colour type 0"},
      {header_with(8, 0), "PNG has no samples of 0 bits"},
      {header_with(8, 255), "PNG has no samples of 255 bits"},
      {png_of({ihdr(2, 1, 4, rgb), pixels_2, iend}), "PNG has no samples of 4 bits for colour type 2"},
      {png_of({ihdr(2, 1, 16, palette), pixels_2, iend}), "PNG has no samples of 16 bits for colour type 3"},
      {png_of({ihdr(2, 1, 2, grey_alpha), pixels_2, iend}), "PNG has no samples of 2 bits for colour type 4"},
      {header_with(9, 1), "PNG has no colour type 1"},
      {header_with(9, 5), "PNG has no colour type 5"},
      {header_with(9, 7), "PNG has no colour type 7"},
      {header_with(10, 1), "PNG has no compression method 1"},
      {header_with(11, 64), "PNG has no filter method 64"},
      {header_with(12, 2), "PNG has no interlace method 2"},
      {png_of({with_wrong_crc(header_2), pixels_2, iend}), "the PNG file is broken: IHDR: CRC error\n  expected a whole file"},
      {png_of({pixels_2, header_2, iend}), "the PNG file does not begin with its header\n  got a chunk \"IDAT\""},
      {png_of({chunk("IHDR", std::string(14, '\1')), pixels_2, iend}),
       "the PNG file does not begin with its header\n  got a chunk \"IHDR\" of 14 bytes, expected IHDR of 13"},
      {png_of({header_2, header_2, pixels_2, iend}), "the PNG file is broken: IHDR: out of place"},
      {png_of({}), "the PNG file is cut short\n  it ends in its header"},
  });
}

TEST(image_fault, of_a_png_s_chunks_is_told) {
  const std::string indices = chunk("IDAT", deflated(bytes_of({0, 1, 2})));
  const std::string header = ihdr(2, 1, 8, palette), three = chunk("PLTE", "abcdefghi");
  expect_faults({
      {png_of({header_2, pixels_2}), "the PNG file is cut short\n  it ends without IEND in the chunk that begins at byte"},
      {png_of({header_2, iend}), "the PNG file has no pixels\n  it has no chunk IDAT"},
      {png_of({header_2, big_endian(0x7FFFFFFF) + "IDAT" + std::string(40, 'x')}),
       "the PNG file is cut short\n  its chunk \"IDAT\" at byte 33 says that it has 2147483647 bytes, and 36 are left"},
      {png_of({header_2, big_endian(0xFFFFFFFF) + "IDAT" + std::string(40, 'x')}), "the PNG file is cut short"},
      {png_of({header_2, big_endian(0x7FFFFFFF) + "iCCP" + std::string(40, 'x')}), "the PNG file is cut short"},
      {png_of({header_2, with_wrong_crc(pixels_2), iend}), "the PNG file is broken: IDAT: CRC error"},
      {png_of({header_2, pixels_2, with_wrong_crc(iend)}), "the PNG file is broken: IEND: CRC error"},
      {png_of({header_2, with_wrong_crc(chunk("tEXt", "abc")), pixels_2, iend}), "the PNG file is broken: tEXt: CRC error"},
      {png_of({header_2, with_wrong_crc(chunk("gAMA", big_endian(45455))), pixels_2, iend}), "the PNG file is broken: gAMA: CRC error"},
      {png_of({header_2, pixels_2, with_wrong_crc(chunk("tIME", std::string(7, '\1'))), iend}), "the PNG file is broken: tIME: CRC error"},
      {png_of({header, with_wrong_crc(three), indices, iend}), "the PNG file is broken: PLTE: CRC error"},
      {png_of({header, three, with_wrong_crc(chunk("tRNS", "ab")), indices, iend}), "the PNG file is broken: tRNS: CRC error"},
      {png_of({header_2, chunk("ABCD", "x"), pixels_2, iend}), "the PNG file is broken: ABCD: unhandled critical chunk"},
      {png_of({header_2, chunk("a1cd", "x"), pixels_2, iend}), "the PNG file is broken: "},
      {png_of({header, indices, iend}), "the PNG file is broken: IDAT: Missing PLTE before IDAT"},
      {png_of({header, indices, three, iend}), "the PNG file is broken: IDAT: Missing PLTE before IDAT"},
      {png_of({header, three, three, indices, iend}), "the PNG file is broken: PLTE: duplicate"},
      {png_of({header, chunk("PLTE", "abcd"), indices, iend}), "the PNG file is broken: PLTE: invalid"},
      {png_of({header, chunk("PLTE"), indices, iend}), "the PNG file is broken: "},
      {png_of({header, chunk("PLTE", std::string(771, 'x')), indices, iend}), "the PNG file is broken: PLTE: invalid"},
      {png_of({header, chunk("PLTE", "abcdef"), indices, iend}),
       "the PNG file has a pixel of a colour that its palette has not\n  pixel 1, 0 has index 2, and there are 2 colours"},
      {png_of({ihdr(2, 1, 8, palette, 1), chunk("PLTE", "abcdef"), chunk("IDAT", deflated(bytes_of({0, 1, 0, 2}))), iend}),
       "the PNG file has a pixel of a colour that its palette has not\n  pixel 1, 0 has index 2"},
      {png_of({header, three, chunk("tRNS", "abcd"), indices, iend}), "the PNG file is broken: tRNS: invalid"},
      {png_of({header, chunk("tRNS", "ab"), three, indices, iend}), "the PNG file is broken: tRNS: out of place"},
      {png_of({header_2, chunk("tRNS", "abc"), pixels_2, iend}), "the PNG file is broken: tRNS: invalid"},
      {png_of({header_2, pixels_2, chunk("tEXt", "abc"), pixels_2, iend}),
       "the PNG file has pixels in two places\n  there is another chunk before that at byte "},
  });
}

TEST(image_fault, of_a_png_s_chunk_that_nobody_knows_and_is_huge_is_told_where_libpng_reads_it) {
  const std::string file = png_of({header_2, chunk("abCd", std::string(8'000'001, 'x')), pixels_2, iend});
  // libpng 1.6.48 (Debian 13) goes past it without a look, 1.6.39 (Debian 12) would hold it in memory.
  if (png_access_version_number() < 10640)
    expect_faults({{file, "the PNG file is broken: abCd: chunk data is too large"}});
  else
    EXPECT_EQ(image::read(file, "m").width, 2);
}

TEST(image_fault, of_a_png_s_pixels_is_told) {
  const auto pixels = [](const std::string& data) { return png_of({header_2, chunk("IDAT", data), iend}); };
  const std::string good = deflated(row_of_2);
  std::string wrong_sum = good;
  wrong_sum.back() = static_cast<char>(wrong_sum.back() ^ 1);
  expect_faults({
      {pixels(deflated(bytes_of({5, 1, 2}))), "the PNG file is broken: bad adaptive filter value"},
      {pixels(deflated(bytes_of({255, 1, 2}))), "the PNG file is broken: bad adaptive filter value"},
      {pixels(deflated(bytes_of({0, 1}))), "the PNG file is broken: "},
      {pixels(deflated("")), "the PNG file is broken: "},
      {pixels(deflated(bytes_of({0, 1, 2, 3}))), "the PNG file is broken: "},
      {pixels(deflated(row_of_2 + std::string(100'000, 'x'))), "the PNG file is broken: "},
      {pixels(good.substr(0, 5)), "the PNG file is broken: "},
      {pixels(good.substr(0, good.size() - 1)), "the PNG file is broken: "},
      {pixels(good + "more"), "the PNG file is broken: "},
      {pixels(wrong_sum), "the PNG file is broken: "},
      {pixels("no zlib"), "the PNG file is broken: "},
      {pixels(bytes_of({0x78, 0x9C, 0x07})), "the PNG file is broken: "},
      {pixels(bytes_of({0x78, 0xBB}) + good.substr(2)), "the PNG file is broken: "},
  });
}

TEST(image_fault, of_a_jpeg_s_kind_is_told) {
  const auto kind = [](const std::string& bytes, const std::string& got) {
    return ImageFault{bytes, "this kind of JPEG is not read\n  got " + got +
                                 ", expected 8 bits in grey, YCbCr or RGB, baseline or progressive: save it as such, or as PNG"};
  };
  HandJpeg four;
  four.components = {{1, 0x11}, {2, 0x11}, {3, 0x11}, {4, 0x11}};
  HandJpeg two;
  two.components = {{1, 0x11}, {2, 0x11}};
  HandJpeg none;
  none.components = {};
  Jpeg arithmetic{8, 8, 1};
  arithmetic.arithmetic = true;
  const std::vector<unsigned char> samples(256, 100);
  std::vector<ImageFault> faults = {
      kind(libjpeg_jpeg({8, 8, 4}, samples), "4 components (CMYK or YCCK)"),
      kind(four.file(), "4 components (CMYK or YCCK)"),
      kind(two.file(), "2 components"),
      kind(none.file(), "0 components"),
      kind(libjpeg_jpeg(arithmetic, samples), "JPEG with arithmetic coding"),
      kind(jpeg_of_frame(0xC1, 12), "12 bits"),
      kind(jpeg_of_frame(0xC0, 12), "12 bits"),
      kind(jpeg_of_frame(0xC2, 16), "16 bits"),
      kind(jpeg_of_frame(0xC3), "lossless JPEG"),
      kind(jpeg_of_frame(0xF7), "JPEG-LS"),
      kind(jpeg_of_frame(0xDE), "hierarchical JPEG"),
  };
  for (const int marker : {0xC5, 0xC6, 0xC7}) faults.push_back(kind(jpeg_of_frame(marker), "hierarchical JPEG"));
  for (const int marker : {0xC9, 0xCA, 0xCB, 0xCD, 0xCE, 0xCF})
    faults.push_back(kind(jpeg_of_frame(marker), "JPEG with arithmetic coding"));
  expect_faults(faults);
}

TEST(image_fault, of_a_jpeg_s_size_is_told) {
  const HandJpeg jpeg;
  std::string scans;
  for (int i = 0; i < 101; ++i) scans += jpeg.scan_header() + jpeg.data;
  expect_faults({
      {jpeg_of_size(0, 8), "the image has no pixels\n  its header says 0 by 8"},
      {jpeg_of_size(8, 0), "the image has no pixels\n  its header says 8 by 0"},
      {jpeg_of_size(16385, 8), "the image has more than 16384 pixels along a side", ErrorKind::limit},
      {jpeg_of_size(65535, 65535), "the image has more than 16384 pixels along a side", ErrorKind::limit},
      {jpeg_of_size(8192, 8200), "the image has more than 67108864 pixels", ErrorKind::limit},
      {jpeg_of_size(8192, 8192), "the JPEG file is too short for its pixels\n  its 8192 by 8192 pixels cannot be packed into"},
      {jpeg.beginning() + jpeg.frame_header() + jpeg.huffman + scans + jpeg.end,
       "the JPEG file has more than 100 scans\n  save it anew, or as baseline JPEG (`tofray --limits`)", ErrorKind::limit},
  });
}

TEST(image_fault, of_a_jpeg_s_segments_is_told) {
  const HandJpeg j;
  HandJpeg three;
  three.components = {{1, 0x11}, {2, 0x11}, {3, 0x11}};
  const auto frame = [&](const std::string& header) {
    return j.beginning() + hand_segment(0xC0, header) + j.scan_header() + j.data + j.end;
  };
  const auto sampling = [](int value) { return jpeg_with([&](HandJpeg& jpeg) { jpeg.components = {{1, value}}; }); };
  const std::string start = bytes_of({0xFF, 0xD8});
  expect_faults({
      {start, "the JPEG file is cut short\n  it ends without its end marker"},
      {start + j.end, "the JPEG file has no image\n  it ends without a frame header"},
      {start + "x", "the JPEG file has no marker at byte 2\n  got the byte 78, expected FF"},
      {start + bytes_of({0xFF, 0xFF}), "the JPEG file is cut short"},
      {start + bytes_of({0xFF, 0xE0, 0}), "the JPEG file is cut short"},
      {start + bytes_of({0xFF, 0xE0, 0, 1}) + j.end, "the JPEG file has a segment of 1 bytes at byte 4\n  expected 2 and more"},
      {start + bytes_of({0xFF, 0xE0, 0xFF, 0xFF}) + j.end, "the JPEG file is cut short"},
      {jpeg_with([](HandJpeg& jpeg) { jpeg.end = ""; }), "the JPEG file is cut short"},
      {j.beginning() + j.frame_header() + j.huffman + j.scan_header().substr(0, 6), "the JPEG file is cut short"},
      {j.beginning() + j.frame_header() + j.huffman + j.end, "the JPEG file is not complete\n  there are no data for its component 1"},
      {three.beginning() + three.frame_header() + three.huffman + three.scan_header(2) + hand_data({5, 5}) + j.end,
       "the JPEG file is not complete\n  there are no data for its component 3"},
      {j.beginning() + hand_segment(0xC2, j.frame_header().substr(4)) + j.huffman + j.scan_header(1, bytes_of({1, 63, 0})) + j.data + j.end,
       "the JPEG file is broken: "},
      {j.beginning() + j.frame_header() + j.frame_header() + j.huffman + j.scan_header() + j.data + j.end, "the JPEG file has two frames"},
      {j.beginning() + j.huffman + j.scan_header() + j.data + j.end, "the JPEG file has data before its frame header"},
      {frame("short"), "the JPEG file's frame header is too short"},
      {frame(j.frame_header().substr(4) + "x"), "the JPEG file's frame header has not the length that its components need"},
      {frame(j.frame_header().substr(4, 8)), "the JPEG file's frame header has not the length that its components need"},
      {sampling(0x00), "the JPEG file has a sampling factor that is none of 1 to 4\n  got 00"},
      {sampling(0x01), "the JPEG file has a sampling factor that is none of 1 to 4\n  got 01"},
      {sampling(0x15), "the JPEG file has a sampling factor that is none of 1 to 4\n  got 15"},
      {j.beginning() + j.frame_header() + j.huffman + hand_segment(0xDA, "") + j.data + j.end,
       "the JPEG file's scan header has not the length that its components need"},
      {j.beginning() + j.frame_header() + j.huffman + hand_segment(0xDA, bytes_of({0, 0, 63, 0})) + j.data + j.end,
       "the JPEG file's scan header has not the length that its components need"},
      {j.beginning() + j.frame_header() + j.huffman + hand_segment(0xDA, bytes_of({1, 1, 0, 0, 63, 0, 0})) + j.data + j.end,
       "the JPEG file's scan header has not the length that its components need"},
      {start + j.file(), "the JPEG file is broken: "},
  });
}

TEST(image_fault, of_a_jpeg_s_tables_is_told) {
  const auto broken = [](std::string HandJpeg::*part, const std::string& value, const std::string& message) {
    HandJpeg jpeg;
    jpeg.*part = value;
    return ImageFault{jpeg.file(), "the JPEG file is broken: " + message};
  };
  expect_faults({
      broken(&HandJpeg::quantisation, "", "Quantization table 0x00 was not defined"),
      broken(&HandJpeg::quantisation, hand_segment(0xDB, bytes_of({0}) + std::string(10, '\x08')), "Bogus marker length"),
      broken(&HandJpeg::quantisation, hand_segment(0xDB, bytes_of({9}) + std::string(64, '\x08')), "Bogus DQT index 9"),
      broken(&HandJpeg::huffman, "", ""),
      broken(&HandJpeg::huffman, hand_segment(0xC4, bytes_of({0, 200})), "Bogus marker length"),
      broken(&HandJpeg::huffman, hand_segment(0xC4, bytes_of({0x77}) + std::string(16, '\0')), "Bogus DHT index"),
      broken(&HandJpeg::before, hand_segment(0xDD, "abc"), "Bogus marker length"),
      broken(&HandJpeg::before, bytes_of({0xFF, 0x02}) + word(2), "Unsupported marker type 0x02"),
  });
}

TEST(image_fault, of_a_jpeg_s_data_is_told) {
  const auto broken = [](const std::string& data, int width = 8, int restart = 0) {
    HandJpeg jpeg;
    jpeg.data = data;
    jpeg.width = width;
    if (restart > 0) jpeg.before = hand_segment(0xDD, word(restart));
    return ImageFault{jpeg.file(), "the JPEG file is broken: Corrupt JPEG data: "};
  };
  const std::string block = hand_data({5});
  HandJpeg twice;
  twice.components = {{1, 0x11}, {1, 0x11}, {1, 0x11}};
  expect_faults({
      broken(""),
      broken(bytes_of({0xFF, 0})),                            // no such code
      broken(block, 32),                                      // one block in place of four
      broken(hand_data(std::vector<int>(100, 5))),            // a hundred in place of one
      broken(block + bytes_of({0xFF, 0xD0}) + block, 16),     // a restart that was not announced
      broken(block + bytes_of({0xFF, 0xD1}) + block, 16, 1),  // the second one in the first one's place
      broken(block + block, 16, 1),                           // none where there should be one
      {twice.file(), "the JPEG file is broken: "},
  });
}

TEST(image_fault, of_a_progressive_jpeg_that_has_not_all_scans_is_told) {
  const std::string whole = libjpeg_jpeg({8, 8, 1, true}, std::vector<unsigned char>(64, 77));
  ASSERT_TRUE(is_taken(whole));
  std::vector<std::size_t> scans;
  for (std::size_t at = whole.find("\xFF\xDA"); at != std::string::npos; at = whole.find("\xFF\xDA", at + 1)) scans.push_back(at);
  ASSERT_EQ(scans.size(), 6U);
  for (std::size_t i = 1; i < scans.size(); ++i) {
    // (the tables of a scan stand before it)
    std::size_t end = scans[i];
    for (std::size_t table = whole.rfind("\xFF\xC4", end); table != std::string::npos && table > scans[i - 1];
         table = whole.rfind("\xFF\xC4", table - 1))
      end = table;
    expect_faults({{whole.substr(0, end) + bytes_of({0xFF, 0xD9}),
                    "the JPEG file is not complete\n  there are scans that it should have and has not"}});
  }
}

TEST(image_fault, of_too_many_bytes_is_told_before_any_is_looked_at) {
  const std::unique_ptr<char, decltype(&std::free)> memory(static_cast<char*>(std::calloc((256 << 20) + 1, 1)), std::free);
  const Error error = error_of_image({memory.get(), (256 << 20) + 1});
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_EQ(std::string(error.what()),
            "m: error: the image file has more than 268435456 bytes\n  got 268435457: make it smaller (`tofray --limits`)");
}
