// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "io/stroke_font.h"

#include <algorithm>
#include <map>
#include <utility>

namespace tofray::io {
namespace {

/// Strokes of a glyph: words of two hexadecimal digits per point, x and y. A word that begins with ~ is rounded: its points are the corners of
/// a polygon that the pen rounds off, all the way where it ends where it began.
struct Drawing {
  const char* character;
  const char* strokes;
};

constexpr Drawing drawings[] = {
    {"0", "~00404448080400"},
    {"1", "032028 0848"},
    {"2", "~02004042440708 0848"},
    {"3", "~0100404424 ~2444480807"},
    {"4", "38300646"},
    {"5", "400004 ~0403434648 ~0343480807"},
    {"6", "~30000306 ~0343480803"},
    {"7", "004018"},
    {"8", "~0040440400 ~0444480804"},
    {"9", "~0040450500 ~42454818"},
    {"A", "083068 1555"},
    {"B", "0800 ~002040442404 ~043454583808"},
    {"C", "~52500004085856"},
    {"D", "0800 ~00305054583808"},
    {"E", "40000848 0434"},
    {"F", "400008 0434"},
    {"G", "~52500004085855 3555"},
    {"H", "0008 5058 0454"},
    {"I", "0008"},
    {"J", "~4046480806"},
    {"K", "0008 5005 2358"},
    {"L", "000848"},
    {"M", "0800356068"},
    {"N", "08005850"},
    {"O", "~00505458080400"},
    {"P", "0800 ~003050543404"},
    {"Q", "~00505458080400 3659"},
    {"R", "0800 ~003050543404 2458"},
    {"S", "~5150000354580807"},
    {"T", "0060 3038"},
    {"U", "~000508585550"},
    {"V", "003860"},
    {"W", "0028416880"},
    {"X", "0058 5008"},
    {"Y", "003460 3438"},
    {"Z", "00500858"},
    {"a", "~0343480803 4348"},
    {"b", "0008 ~0343480803"},
    {"c", "~444303084847"},
    {"d", "4048 ~0343480803"},
    {"e", "0545 ~454303084847"},
    {"f", "~30101318 18 0333"},
    {"g", "~0343480803 ~43484a0a"},
    {"h", "0008 ~0603434548"},
    {"i", "0308 0101"},
    {"j", "~23282a0a 2121"},
    {"k", "0008 4306 1548"},
    {"l", "~00060818"},
    {"m", "0308 ~0503333538 ~3533636568"},
    {"n", "0308 ~0503434548"},
    {"o", "~0343480803"},
    {"p", "030a ~0343480803"},
    {"q", "434a ~0343480803"},
    {"r", "0308 ~060333"},
    {"s", "~4443030546480807"},
    {"t", "~11161838 0333"},
    {"u", "~030608484643 4348"},
    {"v", "032843"},
    {"w", "0328346863"},
    {"x", "0348 4308"},
    {"y", "0328 431a"},
    {"z", "03430848"},
    {".", "0808"},
    {",", "1809"},
    {":", "0404 0808"},
    {";", "1414 1809"},
    {"-", "0535"},
    {"_", "0949"},
    {"+", "0545 2327"},
    {"=", "0444 0646"},
    {"/", "0940"},
    {"(", "~20020629"},
    {")", "~00222609"},
    {"[", "20000929"},
    {"]", "00202909"},
    {"<", "420548"},
    {">", "024508"},
    {"%", "~0020230300 ~4565684845 6008"},
    {"#", "2018 4038 0353 0555"},
    {"*", "2226 0335 0533"},
    {"!", "0005 0808"},
    {"?", "~020040432326 2828"},
    {"'", "0002"},
    {"\"", "0002 2022"},
    {"|", "000a"},
    {"\xC2\xB0", "~0020220200"},              // degree
    {"\xC2\xB1", "0444 2226 0848"},           // plus-minus
    {"\xC2\xB2", "~010020220404 0424"},       // squared
    {"\xC2\xB5", "030a ~030608484643 4348"},  // micro
    {"\xC2\xB7", "0505"},                     // middle dot
    {"\xC3\x97", "0448 4408"},                // times
    {"\xCF\x83", "~0343480803 2353"},         // sigma
    {"\xE2\x88\x92", "0545"},                 // minus
    {"\xE2\x80\x93", "0545"},                 // dash
    {"\xE2\x80\xA6", "0808 2828 4848"},       // ellipsis
};

using Points = std::vector<std::pair<double, double>>;

/// Chaikin's corner cutting: each round puts two points on every side, at a quarter and three quarters. Ends stay.
Points rounded(Points points) {
  const bool closed = points.front() == points.back();
  for (int round = 0; round < 4; ++round) {
    Points next;
    if (!closed) next.push_back(points.front());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto [x0, y0] = points[i];
      const auto [x1, y1] = points[i + 1];
      next.emplace_back(0.75 * x0 + 0.25 * x1, 0.75 * y0 + 0.25 * y1);
      next.emplace_back(0.25 * x0 + 0.75 * x1, 0.25 * y0 + 0.75 * y1);
    }
    next.push_back(closed ? next.front() : points.back());
    points = std::move(next);
  }
  return points;
}

double digit(char c) { return c >= 'a' ? c - 'a' + 10 : c - '0'; }

Glyph parsed(std::string_view strokes) {
  Glyph glyph;
  while (!strokes.empty()) {
    std::string_view word = strokes.substr(0, strokes.find(' '));
    strokes.remove_prefix(std::min(strokes.size(), word.size() + 1));
    const bool round = word[0] == '~';
    if (round) word.remove_prefix(1);
    Points points;
    for (std::size_t i = 0; i + 1 < word.size(); i += 2) points.emplace_back(digit(word[i]), digit(word[i + 1]));
    if (round) points = rounded(std::move(points));
    for (const auto& point : points) glyph.width = std::max(glyph.width, point.first);
    if (points.size() == 1) points.push_back(points[0]);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      glyph.segments.push_back({points[i].first, points[i].second, points[i + 1].first, points[i + 1].second});
  }
  return glyph;
}

std::map<std::string_view, Glyph> parsed_font() {
  std::map<std::string_view, Glyph> font;
  for (const Drawing& drawing : drawings) font.emplace(drawing.character, parsed(drawing.strokes));
  font.emplace(" ", Glyph{1.6, {}});
  font.emplace("", parsed("0040480800"));  // the box for the others
  return font;
}

}  // namespace

std::string_view take_character(std::string_view& utf8) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(utf8[i]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : byte(0) >= 0xC0 ? 2 : 0;
  bool good = length > 0 && length <= utf8.size();
  for (std::size_t i = 1; good && i < length; ++i) good = (byte(i) & 0xC0) == 0x80;
  const std::string_view character = good ? utf8.substr(0, length) : "?";
  utf8.remove_prefix(good ? length : 1);
  return character;
}

const Glyph& glyph_of(std::string_view character) {
  static const std::map<std::string_view, Glyph> font = parsed_font();
  const auto found = font.find(character);
  return found != font.end() ? found->second : font.at("");
}

}  // namespace tofray::io
