// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// PNG by libpng, which leaves by longjmp where something is wrong: it is called by functions only in which nothing has a destructor.
#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "base/faults.h"
#include "base/limits.h"
#include "image/formats.h"
#include "image/png_chunks.h"

namespace tofray::image {
namespace {

constexpr png_alloc_size_t most_other_chunk = 8'000'000;  // bytes of a chunk that is passed over: libpng's own limit

/// All that the functions below share. No member has a destructor.
struct PngReading {
  png_structp png = nullptr;
  png_infop info = nullptr;
  const char* bytes = nullptr;
  std::size_t left = 0;
  char message[200] = "";

  bool palette = false, transparent = false;
  int channels = 0, passes = 0;
  std::uint32_t width = 0, height = 0;
  std::size_t row_bytes = 0, stride = 0, offset = 0;  ///< of a row that libpng writes; of rows in memory; where in it libpng's begin
  unsigned char* rows = nullptr;
};

PngReading& reading_of(png_structp png) { return *static_cast<PngReading*>(png_get_error_ptr(png)); }

[[noreturn]] void leave_png(png_structp png, png_const_charp message) {
  std::snprintf(reading_of(png).message, sizeof(PngReading::message), "%s", message);
  png_longjmp(png, 1);
}

void pass_over_warning(png_structp, png_const_charp) {}  // what matters is an error: png_set_benign_errors

void take_bytes(png_structp png, png_bytep out, png_size_t count) {
  PngReading& reading = reading_of(png);
  if (count > reading.left) png_error(png, "it is cut short");
  std::memcpy(out, reading.bytes, count);
  reading.bytes += count;
  reading.left -= count;
}

/// The header and all chunks before the pixels, and what libpng is to make of these.
void begin_png(PngReading& reading) {
  const png_structp png = reading.png;
  png_set_read_fn(png, &reading, take_bytes);
  png_set_crc_action(png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
  png_set_benign_errors(png, 0);
  // Nothing but IHDR, PLTE, tRNS, IDAT and IEND: what else there is is passed over without being kept or unpacked.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_user_limits(png, static_cast<png_uint_32>(base::limit::image_side.value),
                      static_cast<png_uint_32>(base::limit::image_side.value));
  png_set_chunk_malloc_max(png, most_other_chunk);
  png_set_chunk_cache_max(png, 1);
  png_set_check_for_invalid_index(png, 0);  // expand_palette does
  png_read_info(png, reading.info);
  reading.palette = png_get_color_type(png, reading.info) == PNG_COLOR_TYPE_PALETTE;
  reading.transparent = png_get_valid(png, reading.info, PNG_INFO_tRNS) != 0;
  if (reading.palette) {
    png_set_packing(png);  // a byte for each index
  } else {
    png_set_expand_16(png);  // and tRNS becomes alpha
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
  }
  reading.passes = png_set_interlace_handling(png);
  png_read_update_info(png, reading.info);
  reading.width = png_get_image_width(png, reading.info);
  reading.height = png_get_image_height(png, reading.info);
  reading.channels = reading.palette ? (reading.transparent ? 4 : 3) : png_get_channels(png, reading.info);
  reading.row_bytes = png_get_rowbytes(png, reading.info);
}

/// All rows, and what is behind them.
void read_png_rows(PngReading& reading) {
  for (int pass = 0; pass < reading.passes; ++pass)
    for (std::uint32_t y = 0; y < reading.height; ++y)
      png_read_row(reading.png, reading.rows + y * reading.stride + reading.offset, nullptr);
  png_read_end(reading.png, nullptr);
}

/// @return false where libpng gave up; its message then is in `reading`
bool runs(PngReading& reading, void (*step)(PngReading&)) {
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  step(reading);
  return true;
}

class PngFile {
 public:
  PngFile(std::string_view bytes, const std::string& file) : file_(file), header_(check_png(bytes, file)) {
    reading_.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading_, leave_png, pass_over_warning);
    if (reading_.png != nullptr) reading_.info = png_create_info_struct(reading_.png);
    if (reading_.info == nullptr) {
      png_destroy_read_struct(&reading_.png, nullptr, nullptr);
      throw Error(ErrorKind::limit, "error: out of memory while a PNG was read");
    }
    reading_.bytes = bytes.data();
    reading_.left = bytes.size();
  }
  ~PngFile() { png_destroy_read_struct(&reading_.png, &reading_.info, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  Image read() {
    run(begin_png);
    Image image{
        static_cast<int>(reading_.width), static_cast<int>(reading_.height), reading_.channels, reading_.palette ? 8 : header_.bits, {}};
    const std::size_t samples = std::size_t{reading_.width} * static_cast<std::size_t>(reading_.channels);
    reading_.stride = 2 * samples;
    const std::size_t expected = reading_.palette ? std::size_t{reading_.width} : reading_.stride;
    if (reading_.row_bytes != expected || reading_.width != header_.width || reading_.height != header_.height)
      throw Error(ErrorKind::bug, "error: libpng made rows of another size than was asked for");
    image.samples.resize(samples * reading_.height);
    // Indices come to the end of the memory of their row, which they then leave from its beginning on.
    reading_.offset = reading_.stride - reading_.row_bytes;
    reading_.rows = reinterpret_cast<unsigned char*>(image.samples.data());
    run(read_png_rows);
    if (reading_.palette) expand_palette(image);
    return image;
  }

 private:
  void run(void (*step)(PngReading&)) {
    if (!runs(reading_, step)) broken_image_data(file_, "PNG", reading_.message);
  }

  struct Palette {
    std::array<std::array<std::uint16_t, 4>, 256> colors{};
    int size = 0;
  };

  Palette palette() const {
    png_colorp colors = nullptr;
    png_bytep alphas = nullptr;
    int opaque_from = 0;
    Palette palette;
    png_get_PLTE(reading_.png, reading_.info, &colors, &palette.size);
    if (reading_.transparent) png_get_tRNS(reading_.png, reading_.info, &alphas, &opaque_from, nullptr);
    const auto share = [](int v) { return static_cast<std::uint16_t>(257 * v); };
    for (int i = 0; i < palette.size; ++i)
      palette.colors[static_cast<std::size_t>(i)] = {share(colors[i].red), share(colors[i].green), share(colors[i].blue),
                                                     share(i < opaque_from ? alphas[i] : 255)};
    return palette;
  }

  void expand_palette(Image& image) const {
    const Palette palette = this->palette();
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::uint32_t y = 0; y < reading_.height; ++y) {
      const unsigned char* indices = reading_.rows + y * reading_.stride + reading_.offset;
      std::uint16_t* out = image.samples.data() + y * reading_.stride / 2;
      for (std::uint32_t x = 0; x < reading_.width; ++x, out += channels) {
        const unsigned char index = indices[x];
        if (index >= palette.size)
          broken_image(file_, "the PNG file has a pixel of a colour that its palette has not",
                       fmt::format("pixel {}, {} has index {}, and there are {} colours", x, y, index, palette.size));
        std::copy_n(palette.colors[index].begin(), channels, out);
      }
    }
  }

  const std::string& file_;
  PngHeader header_;
  PngReading reading_;
};

}  // namespace

Image read_png(std::string_view bytes, const std::string& file) { return PngFile(bytes, file).read(); }

}  // namespace tofray::image
