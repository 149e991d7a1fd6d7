// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <zlib.h>

#include <algorithm>
#include <map>

#include "pictures/painter.h"
#include "pictures/pictures.h"
#include "pictures/read_png.h"
#include "support/samples.h"

/// Pictures as SVG and PDF: the same drawing as PNG, of texts, rectangles and images.
namespace tofray::pictures {
namespace {

using out_test::read_back;
using out_test::ReadBack;

std::vector<std::size_t> places_of(const std::string& text, const std::string& part) {
  std::vector<std::size_t> all;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) all.push_back(at);
  return all;
}

/// Digits of RFC 4648, by its table.
std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    held += 6;
    if (held >= 8) out += static_cast<char>(bits >> (held -= 8) & 255);
  }
  return out;
}

/// The PNG files within an SVG.
std::vector<ReadBack> images_of(const std::string& svg) {
  const std::string before = "data:image/png;base64,";
  std::vector<ReadBack> all;
  for (const std::size_t at : places_of(svg, before)) {
    const std::size_t from = at + before.size();
    all.push_back(read_back(from_base64(svg.substr(from, svg.find('"', from) - from))));
  }
  return all;
}

/// What cairo compressed of a PDF, unpacked, all behind each other.
std::string unpacked(const std::string& pdf) {
  std::string out;
  for (const std::size_t at : places_of(pdf, "stream\n")) {
    if (at >= 3 && pdf.compare(at - 3, 3, "end") == 0) continue;
    const std::size_t from = at + 7;
    std::string part(4'000'000, '\0');
    uLongf size = part.size();
    if (::uncompress(reinterpret_cast<Bytef*>(part.data()), &size, reinterpret_cast<const Bytef*>(&pdf[from]), pdf.size() - from) == Z_OK)
      out += part.substr(0, size) + "\n";
  }
  return out;
}

std::string preview_of(const Frame& frame, Format format, int scale = 1, Theme theme = Theme::dark) {
  return preview_picture(frame.depth, frame.truth, frame.raw, "a <small> \"room\" & more", {theme, scale, format});
}

TEST(format, is_what_a_files_name_ends_in) {
  EXPECT_EQ(format_of("slide.svg"), Format::svg);
  EXPECT_EQ(format_of("a.b/slide.PDF"), Format::pdf);
  EXPECT_EQ(format_of("slide.Png"), Format::png);
  for (const char* other : {"slide.jpg", "slide", "svg", "", "slide.svg.gz", "slide.pdfx", "pdf"})
    EXPECT_EQ(format_of(other), std::nullopt) << other;
}

TEST(svg, has_each_image_as_a_png_of_the_sensors_pixels) {
  const Frame frame = out_test::sample_frame(100, 50);
  const std::string svg = preview_of(frame, Format::svg);
  const std::vector<ReadBack> images = images_of(svg);
  ASSERT_EQ(images.size(), 4U) << "z, amplitude, error, multipath";
  // Pixels as in the PNG, each of which is 5 x 5 there (100 columns on about 450 pixels), from 26, 86 on.
  const ReadBack png = read_back(preview_of(frame, Format::png));
  EXPECT_EQ(svg.find("<image x=\"26\" y=\"86\" width=\"500\" height=\"250\""), places_of(svg, "<image")[0]);
  ASSERT_EQ(images[0].width, 100U);
  ASSERT_EQ(images[0].height, 50U);
  for (std::size_t v = 0; v < 50; ++v)
    for (std::size_t u = 0; u < 100; ++u)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(images[0].bytes[3 * (v * 100 + u) + c], png.bytes[3 * ((86 + 5 * v + 2) * png.width + 26 + 5 * u + 2) + c])
            << u << " " << v;
}

TEST(svg, has_texts_as_texts_as_wide_as_ours) {
  const std::string svg = preview_of(out_test::sample_frame(100, 50), Format::svg);
  EXPECT_NE(svg.find(">a &lt;small&gt; \"room\" &amp; more</text>"), std::string::npos);
  EXPECT_NE(svg.find(">z [m]</text>"), std::string::npos);
  for (const std::size_t at : places_of(svg, "<text ")) {
    const std::string one = svg.substr(at, svg.find("</text>", at) - at);
    if (one.find(">z [m]") == std::string::npos) continue;
    EXPECT_NEAR(std::stod(one.substr(one.find("textLength=\"") + 12)), Canvas::text_width(0.9 * 13, "z [m]"), 0.01);
  }
  EXPECT_EQ(svg.find("http", svg.find("xlink\"")), std::string::npos) << "nothing comes from elsewhere";
}

TEST(svg, scale_makes_it_larger_and_draws_the_same) {
  const Frame frame = out_test::sample_frame(64, 48);
  const std::string one = preview_of(frame, Format::svg), two = preview_of(frame, Format::svg, 2);
  const auto behind_first_line = [](const std::string& text) { return text.substr(text.find('\n')); };
  EXPECT_EQ(behind_first_line(one), behind_first_line(two));
  const auto number = [](const std::string& text, const std::string& key) { return std::stoi(text.substr(text.find(key) + key.size())); };
  EXPECT_EQ(2 * number(one, " width=\""), number(two, " width=\""));
  EXPECT_EQ(number(one, " width=\""), static_cast<int>(read_back(preview_of(frame, Format::png)).width));
  EXPECT_NE(two.find("viewBox=\"0 0 " + std::to_string(number(one, " width=\""))), std::string::npos);
}

TEST(svg, has_bars_without_gaps) {
  // Each colour of a bar reaches down to its end, so that no ground is seen between two of them at any zoom.
  const std::string svg = preview_of(out_test::sample_frame(100, 50), Format::svg);
  std::map<int, std::vector<std::pair<int, int>>> bars;  // by x: where each begins and ends
  for (const std::size_t at : places_of(svg, "<rect ")) {
    int x = 0, y = 0, width = 0, height = 0;
    ASSERT_EQ(std::sscanf(&svg[at], "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\"", &x, &y, &width, &height), 4);
    if (width == 14) bars[x].emplace_back(y, y + height);
  }
  ASSERT_EQ(bars.size(), 4U);
  for (const auto& [x, parts] : bars) {
    EXPECT_GT(parts.size(), 20U) << "colours";
    EXPECT_EQ(parts[0].first, 86);
    for (const auto& [begin, end] : parts) EXPECT_EQ(end, 86 + 250);
  }
}

TEST(pdf, is_one_page_with_letters_and_images_within) {
  const Frame frame = out_test::sample_frame(100, 50);
  const std::string pdf = preview_of(frame, Format::pdf);
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_EQ(places_of(pdf, "%%EOF").size(), 1U);
  const std::string all = pdf + unpacked(pdf);
  EXPECT_EQ(places_of(all, "/Type /Page\n").size() + places_of(all, "/Type /Page ").size(), 1U);
  EXPECT_EQ(places_of(all, "/Subtype /Image").size(), 4U) << "z, amplitude, error, multipath";
  EXPECT_EQ(places_of(all, "/Width 100").size(), 4U) << "of the sensor's pixels";
  EXPECT_GE(places_of(all, "/FontFile").size(), 1U) << "letters, not their picture";
  EXPECT_EQ(places_of(all, "/CreationDate").size(), 0U);
  EXPECT_EQ(preview_of(frame, Format::pdf), pdf) << "the same file again";
  // 1 px is 0.75 pt.
  const std::size_t box = all.find("/MediaBox [ 0 0 ");
  ASSERT_NE(box, std::string::npos);
  EXPECT_NEAR(std::stod(all.substr(box + 16)), 0.75 * static_cast<double>(read_back(preview_of(frame, Format::png)).width), 0.01);
}

TEST(pdf, and_svg_have_the_theme) {
  const Frame frame = out_test::sample_frame(64, 48);
  const auto ground = [](const std::string& svg) { return svg.substr(svg.find("fill=\"") + 6, 7); };
  EXPECT_EQ(ground(preview_of(frame, Format::svg, 1, Theme::light)), "#ffffff");
  EXPECT_EQ(ground(preview_of(frame, Format::svg, 1, Theme::dark)), "#17181c");
  const auto first_fill = [](const std::string& pdf) { return unpacked(pdf).substr(0, unpacked(pdf).find(" re f")); };
  EXPECT_NE(first_fill(preview_of(frame, Format::pdf, 1, Theme::light)).find("1 1 1 rg"), std::string::npos);
  EXPECT_NE(first_fill(preview_of(frame, Format::pdf, 1, Theme::dark)).find("0.0901961 0.0941176 0.109804 rg"), std::string::npos);
}

TEST(raw_sheet, is_svg_and_pdf_too) {
  const Frame frame = out_test::sample_frame(30, 20);
  const std::string svg = raw_picture(frame.raw, {Theme::dark, 1, Format::svg});
  EXPECT_EQ(images_of(svg).size(), static_cast<std::size_t>(frame.raw.phases));
  EXPECT_NE(svg.find("xml:space=\"preserve\""), std::string::npos) << "two blanks between the parts of a label stay two";
  EXPECT_TRUE(raw_picture(frame.raw, {Theme::dark, 1, Format::pdf}).starts_with("%PDF-"));
}

}  // namespace
}  // namespace tofray::pictures
