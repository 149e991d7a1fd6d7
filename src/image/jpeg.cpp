// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// JPEG by libjpeg, which leaves by longjmp where something is wrong: it is called by functions only in which nothing has a destructor.
#include <csetjmp>
#include <cstdio>
// (libjpeg's header needs what cstdio declares)
#include <jerror.h>
#include <jpeglib.h>

#include "image/formats.h"
#include "image/jpeg_markers.h"

namespace tofray::image {
namespace {

/// All that the functions below share. No member has a destructor.
struct JpegReading {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  std::jmp_buf leave{};
  char message[JMSG_LENGTH_MAX] = "";

  const unsigned char* bytes = nullptr;
  unsigned long size = 0;
  JpegHeader header;
  std::uint16_t* samples = nullptr;
  bool complete = false;  ///< there are all bits of all coefficients
};

[[noreturn]] void leave_jpeg(j_common_ptr jpeg) {
  auto& reading = *static_cast<JpegReading*>(jpeg->client_data);
  jpeg->err->format_message(jpeg, reading.message);
  std::longjmp(reading.leave, 1);
}

/// Warnings (level -1) are about broken data, for which libjpeg makes something up: errors here. But for a version of JFIF of which it
/// says itself that it does not matter.
void take_jpeg_message(j_common_ptr jpeg, int level) {
  if (level < 0 && jpeg->err->msg_code != JWRN_JFIF_MAJOR) leave_jpeg(jpeg);
}

void print_nothing(j_common_ptr) {}

/// Whether the scans of a progressive file have all bits of all coefficients of each block: libjpeg takes zeros for others, as a file has
/// that somebody cut and ended.
bool has_all_bits(const jpeg_decompress_struct& jpeg) {
  if (jpeg.coef_bits == nullptr) return true;
  for (int component = 0; component < jpeg.num_components; ++component)
    for (const int missing : jpeg.coef_bits[component])
      if (missing != 0) return false;
  return true;
}

void begin_jpeg(JpegReading& reading) {
  jpeg_decompress_struct& jpeg = reading.jpeg;
  jpeg.err = jpeg_std_error(&reading.errors);
  jpeg.client_data = &reading;
  reading.errors.error_exit = leave_jpeg;
  reading.errors.emit_message = take_jpeg_message;
  reading.errors.output_message = print_nothing;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, reading.bytes, reading.size);
  jpeg_read_header(&jpeg, TRUE);
  jpeg.out_color_space = reading.header.components == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg.dct_method = JDCT_ISLOW;     // the exact one
  jpeg.do_block_smoothing = FALSE;  // nothing that is not in the file
  jpeg_start_decompress(&jpeg);
  reading.complete = has_all_bits(jpeg);
}

void read_jpeg_rows(JpegReading& reading) {
  jpeg_decompress_struct& jpeg = reading.jpeg;
  const std::size_t count = std::size_t{jpeg.output_width} * static_cast<std::size_t>(jpeg.output_components);
  while (jpeg.output_scanline < jpeg.output_height) {
    std::uint16_t* row = reading.samples + jpeg.output_scanline * count;
    // A row's bytes come to the end of its memory, which they then leave from its beginning on.
    JSAMPROW bytes = reinterpret_cast<JSAMPROW>(row) + count;
    jpeg_read_scanlines(&jpeg, &bytes, 1);
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned byte = bytes[i];
      row[i] = static_cast<std::uint16_t>(257 * byte);
    }
  }
  jpeg_finish_decompress(&jpeg);
}

/// @return false where libjpeg gave up; its message then is in `reading`
bool runs(JpegReading& reading, void (*step)(JpegReading&)) {
  if (setjmp(reading.leave) != 0) return false;
  step(reading);
  return true;
}

class JpegFile {
 public:
  JpegFile(std::string_view bytes, const std::string& file) : file_(file) {
    reading_.header = check_jpeg(bytes, file);
    reading_.bytes = reinterpret_cast<const unsigned char*>(bytes.data());
    reading_.size = static_cast<unsigned long>(bytes.size());
  }
  ~JpegFile() { jpeg_destroy_decompress(&reading_.jpeg); }
  JpegFile(const JpegFile&) = delete;
  JpegFile& operator=(const JpegFile&) = delete;

  Image read() {
    run(begin_jpeg);
    if (!reading_.complete) broken_image(file_, "the JPEG file is not complete", "there are scans that it should have and has not");
    const JpegHeader& header = reading_.header;
    Image image{static_cast<int>(header.width), static_cast<int>(header.height), header.components, 8, {}};
    if (reading_.jpeg.output_width != header.width || reading_.jpeg.output_height != header.height ||
        reading_.jpeg.output_components != header.components)
      throw Error(ErrorKind::bug, "error: libjpeg made an image of another size than was asked for");
    image.samples.resize(std::size_t{header.width} * header.height * static_cast<std::size_t>(header.components));
    reading_.samples = image.samples.data();
    run(read_jpeg_rows);
    return image;
  }

 private:
  void run(void (*step)(JpegReading&)) {
    if (!runs(reading_, step)) broken_image_data(file_, "JPEG", reading_.message);
  }

  const std::string& file_;
  JpegReading reading_;
};

}  // namespace

Image read_jpeg(std::string_view bytes, const std::string& file) { return JpegFile(bytes, file).read(); }

}  // namespace tofray::image
