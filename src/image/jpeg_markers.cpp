// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The markers of a JPEG file (ITU-T T.81, annex B): what is between them libjpeg reads.
#include "image/jpeg_markers.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "base/faults.h"
#include "base/limits.h"
#include "image/formats.h"

namespace tofray::image {
namespace {

enum Marker : int {
  huffman_tables = 0xC4,
  jpeg_extension = 0xC8,
  arithmetic_tables = 0xCC,
  restart_0 = 0xD0,
  restart_7 = 0xD7,
  start_of_image = 0xD8,
  end_of_image = 0xD9,
  start_of_scan = 0xDA,
  hierarchical = 0xDE,
  jpeg_ls = 0xF7,
  temporary = 0x01,
};

bool is_frame(int marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != huffman_tables && marker != jpeg_extension && marker != arithmetic_tables;
}
bool is_alone(int marker) { return marker == temporary || (marker >= restart_0 && marker <= start_of_image); }

/// Why a frame is not read, by its marker; null where it is.
const char* not_read(int marker) {
  if (marker == jpeg_ls) return "JPEG-LS";
  if (marker == 0xC0 || marker == 0xC1 || marker == 0xC2) return nullptr;
  if (marker == 0xC3) return "lossless JPEG";
  if (marker == hierarchical || marker == 0xC5 || marker == 0xC6 || marker == 0xC7) return "hierarchical JPEG";
  return "JPEG with arithmetic coding";
}

class JpegMarkers {
 public:
  JpegMarkers(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  JpegHeader check() {
    for (int marker = next_marker(); marker != end_of_image; marker = next_marker()) {
      if (is_alone(marker)) continue;
      const std::string_view segment = take_segment();
      if (is_frame(marker) || marker == jpeg_ls || marker == hierarchical) read_frame(marker, segment);
      if (marker == start_of_scan) read_scan(segment);
    }
    if (header_.components == 0) broken_image(file_, "the JPEG file has no image", "it ends without a frame header");
    for (int i = 0; i < header_.components; ++i)
      if (!components_[static_cast<std::size_t>(i)].has_scan)
        broken_image(file_, "the JPEG file is not complete", fmt::format("there are no data for its component {}", i + 1));
    return header_;
  }

 private:
  struct Component {
    int id = 0, across = 0, down = 0;  ///< across, down: sampling factors
    bool has_scan = false;
  };

  static int byte_of(std::string_view bytes, std::size_t at) { return static_cast<unsigned char>(bytes[at]); }
  static int word_of(std::string_view bytes, std::size_t at) { return 256 * byte_of(bytes, at) + byte_of(bytes, at + 1); }

  [[noreturn]] void cut_short() const { broken_image(file_, "the JPEG file is cut short", "it ends without its end marker"); }

  /// Behind the next FF, of which there may be several.
  int next_marker() {
    if (at_ >= bytes_.size()) cut_short();
    if (byte_of(bytes_, at_) != 0xFF)
      broken_image(file_, fmt::format("the JPEG file has no marker at byte {}", at_),
                   fmt::format("got the byte {:02X}, expected FF", byte_of(bytes_, at_)));
    while (at_ < bytes_.size() && byte_of(bytes_, at_) == 0xFF) ++at_;
    if (at_ >= bytes_.size()) cut_short();
    return byte_of(bytes_, at_++);
  }

  std::string_view take_segment() {
    if (bytes_.size() - at_ < 2) cut_short();
    const auto length = static_cast<std::size_t>(word_of(bytes_, at_));
    if (length < 2)
      broken_image(file_, fmt::format("the JPEG file has a segment of {} bytes at byte {}", length, at_), "expected 2 and more");
    if (bytes_.size() - at_ < length) cut_short();
    const std::string_view segment = bytes_.substr(at_ + 2, length - 2);
    at_ += length;
    return segment;
  }

  [[noreturn]] void refuse(const std::string& kind) const {
    base::fail(base::whole(file_), "this kind of JPEG is not read",
               fmt::format("got {}, expected 8 bits in grey, YCbCr or RGB, baseline or progressive: save it as such, or as PNG", kind));
  }

  void read_frame(int marker, std::string_view segment) {
    if (const char* kind = not_read(marker)) refuse(kind);
    if (header_.components != 0) broken_image(file_, "the JPEG file has two frames", "expected one image");
    if (segment.size() < 6) broken_image(file_, "the JPEG file's frame header is too short");
    check_image_size(static_cast<std::uint64_t>(word_of(segment, 3)), static_cast<std::uint64_t>(word_of(segment, 1)), file_);
    if (byte_of(segment, 0) != 8) refuse(fmt::format("{} bits", byte_of(segment, 0)));
    const int count = byte_of(segment, 5);
    if (count == 4) refuse("4 components (CMYK or YCCK)");
    if (count != 1 && count != 3) refuse(fmt::format("{} components", count));
    if (segment.size() != 6 + 3 * static_cast<std::size_t>(count))
      broken_image(file_, "the JPEG file's frame header has not the length that its components need");
    header_ = {static_cast<std::uint32_t>(word_of(segment, 3)), static_cast<std::uint32_t>(word_of(segment, 1)), count};
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const int sampling = byte_of(segment, 7 + 3 * i);
      components_[i] = {byte_of(segment, 6 + 3 * i), sampling / 16, sampling % 16, false};
      if (std::min(sampling / 16, sampling % 16) < 1 || std::max(sampling / 16, sampling % 16) > 4)
        broken_image(file_, "the JPEG file has a sampling factor that is none of 1 to 4", fmt::format("got {:02X}", sampling));
    }
    check_room();
  }

  /// Each block of 8 by 8 takes a bit at least.
  void check_room() const {
    std::uint64_t most_across = 1, most_down = 1, blocks = 0;
    for (const Component& c : components_) {
      most_across = std::max(most_across, static_cast<std::uint64_t>(c.across));
      most_down = std::max(most_down, static_cast<std::uint64_t>(c.down));
    }
    const auto blocks_along = [](std::uint64_t pixels, int factor, std::uint64_t most) {
      return (pixels * static_cast<std::uint64_t>(factor) + 8 * most - 1) / (8 * most);
    };
    for (const Component& c : components_)
      blocks += blocks_along(header_.width, c.across, most_across) * blocks_along(header_.height, c.down, most_down);
    if (blocks > 8 * static_cast<std::uint64_t>(bytes_.size()))
      broken_image(file_, "the JPEG file is too short for its pixels",
                   fmt::format("its {} by {} pixels cannot be packed into {} bytes", header_.width, header_.height, bytes_.size()));
  }

  void read_scan(std::string_view segment) {
    if (header_.components == 0) broken_image(file_, "the JPEG file has data before its frame header");
    if (++scans_ > base::limit::image_scans.value)
      base::fail(base::whole(file_), fmt::format("the JPEG file has more than {} scans", base::limit::image_scans.value),
                 "save it anew, or as baseline JPEG (`tofray --limits`)", ErrorKind::limit);
    const std::size_t count = segment.empty() ? 0 : static_cast<std::size_t>(byte_of(segment, 0));
    if (count < 1 || count > 4 || segment.size() != 4 + 2 * count)
      broken_image(file_, "the JPEG file's scan header has not the length that its components need");
    for (std::size_t i = 0; i < count; ++i)
      for (Component& component : components_)
        if (component.id == byte_of(segment, 1 + 2 * i) && component.across > 0) component.has_scan = true;
    pass_over_data();
  }

  /// Up to the next marker that is none of those within data.
  void pass_over_data() {
    for (; at_ + 1 < bytes_.size(); ++at_) {
      const int next = byte_of(bytes_, at_ + 1);
      if (byte_of(bytes_, at_) == 0xFF && next != 0 && next != 0xFF && (next < restart_0 || next > restart_7)) return;
    }
    cut_short();
  }

  std::string_view bytes_;
  const std::string& file_;
  std::size_t at_ = jpeg_signature.size();
  JpegHeader header_;
  std::array<Component, 3> components_{};
  std::int64_t scans_ = 0;
};

}  // namespace

JpegHeader check_jpeg(std::string_view bytes, const std::string& file) { return JpegMarkers(bytes, file).check(); }

}  // namespace tofray::image
