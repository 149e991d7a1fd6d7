// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/mtl.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/text.h"
#include "mesh/numbers.h"
#include "mesh/words.h"

namespace tofray::mesh {
namespace {

using base::in_quotes;

constexpr std::string_view own_statement = "#!nir_reflectivity";
constexpr std::size_t most_left_out = 20;

/// An option of map_Kd, and how many words follow it: of numbers up to that many.
struct Option {
  std::string_view name;
  int words;
  bool numbers;
};
constexpr Option options[] = {{"-s", 3, true},    {"-o", 3, true},       {"-t", 3, true},       {"-clamp", 1, false},
                              {"-bm", 1, true},   {"-boost", 1, true},   {"-mm", 2, true},      {"-texres", 1, true},
                              {"-cc", 1, false},  {"-blendu", 1, false}, {"-blendv", 1, false}, {"-imfchan", 1, false},
                              {"-type", 1, false}};

class MtlReader {
 public:
  MtlReader(std::string_view bytes, const std::string& name, std::size_t most)
      : words_(bytes, name, Words::Style::mtl), name_(std::make_shared<const std::string>(name)), most_(most) {}

  Mtl read() {
    do {
      std::string_view keyword;
      if (!words_.in_line(keyword)) continue;
      if (keyword.starts_with("#!"))
        read_own(keyword);
      else if (is(keyword, "newmtl"))
        begin_material();
      else
        read_statement(keyword);
    } while (words_.next_line());
    return std::move(read_);
  }

 private:
  static bool is(std::string_view keyword, std::string_view small) { return equals_in_any_case(keyword, small); }

  MtlMaterial& material() {
    if (read_.materials.empty())
      words_.fail("a statement stands before the first newmtl", "expected an MTL file, whose materials begin with newmtl and a name");
    return read_.materials.back();
  }

  void begin_material() {
    const Mark start = words_.mark();
    std::string name = words_.rest_of_line();
    if (read_.materials.size() == most_)
      words_.fail(start, fmt::format("there are more than {} materials", most_), "(`tofray --limits`)", ErrorKind::limit);
    read_.materials.emplace_back().name = std::move(name);
  }

  /// What begins with "#!" is a comment, too, unless it looks like our own statement.
  void read_own(std::string_view keyword) {
    if (keyword != own_statement) {
      const std::string meant = base::did_you_mean(keyword.substr(0, 100), {std::string(own_statement)});
      if (!meant.empty()) words_.fail("unknown statement " + in_quotes(keyword) + meant, {});
      return;
    }
    MtlMaterial& of = material();
    const Mark start = words_.mark();
    of.nir_reflectivity = share();
    end_line(start);
  }

  void read_statement(std::string_view keyword) {
    MtlMaterial& of = material();
    if (is(keyword, "kd"))
      read_color(of);
    else if (is(keyword, "map_kd"))
      read_picture(of);
    else
      leave_out(std::string(keyword));
  }

  void leave_out(std::string_view what) {
    std::string shown = base::printable(what.substr(0, 60));
    std::vector<std::string>& all = read_.left_out;
    if (all.size() < most_left_out && std::find(all.begin(), all.end(), shown) == all.end()) all.push_back(std::move(shown));
  }

  std::string_view word(const char* what) {
    std::string_view out;
    if (!words_.in_line(out)) words_.fail(fmt::format("{} is missing", what), "the line ends here");
    return out;
  }

  double number(std::string_view text) const {
    double value = 0;
    if (!read_number(text, value)) words_.fail("a number is none", "got " + in_quotes(text) + ", expected a number such as 0.25");
    return value;
  }

  double share() { return share(word("a number")); }
  [[nodiscard]] double share(std::string_view text) const {
    const double value = number(text);
    if (!(value >= 0 && value <= 1)) words_.fail("a number is out of range", "got " + in_quotes(text) + ", expected 0 to 1");
    return value;
  }

  void end_line(const Mark& start) {
    std::string_view more;
    if (words_.in_line(more)) words_.fail(start, "the line goes on where it should end", "got " + in_quotes(more));
  }

  /// Red, green and blue, or one number for all.
  void read_color(MtlMaterial& of) {
    const Mark start = words_.mark();
    const std::string_view first = word("a colour");
    if (first == "spectral" || first == "xyz")
      words_.fail("only colours of red, green and blue are read", "got " + in_quotes(first) + ", expected Kd 0.8 0.5 0.2");
    std::array<double, 3> color{};
    color.fill(share(first));
    std::string_view text;
    if (words_.in_line(text)) {
      color[1] = share(text);
      color[2] = share();
    }
    end_line(start);
    of.color = color;
  }

  void read_picture(MtlMaterial& of) {
    MtlPicture picture;
    std::string_view text = word("the name of a picture");
    while (text.starts_with('-')) {
      const auto* const option = std::find_if(std::begin(options), std::end(options), [&](const Option& one) { return one.name == text; });
      text = read_option(option == std::end(options) ? Option{text, 1, false} : *option, picture);
    }
    const Mark start = words_.mark();
    std::string file(text);
    if (const std::string more = words_.rest_of_line(); !more.empty()) file += " " + more;
    std::replace(file.begin(), file.end(), '\\', '/');
    if (file.size() > 2 && file.front() == '"' && file.back() == '"') file = file.substr(1, file.size() - 2);
    picture.reference = {std::move(file), Words::place(start, name_)};
    of.picture = std::move(picture);
  }

  /// @return the word behind the option's own
  std::string_view read_option(const Option& option, MtlPicture& picture) {
    if (!option.numbers) {
      const std::string_view value = word("an option's value");
      if (option.name == "-clamp") {
        if (value != "on" && value != "off") words_.fail("-clamp is neither on nor off", "got " + in_quotes(value));
        picture.clamp = value == "on";
      } else {
        leave_out(fmt::format("{} of map_Kd", option.name));  // also what nobody knows
      }
      return word("the name of a picture");
    }
    std::array<double, 3> number{};
    int count = 0;
    std::string_view text = word("an option's number");
    for (double value = 0; count < option.words && read_number(text, value); text = word("the name of a picture")) {
      if (!(std::abs(value) <= 1e6)) words_.fail("a number is out of range", "got " + in_quotes(text) + ", expected up to 1e6");
      number[static_cast<std::size_t>(count++)] = value;
    }
    if (count == 0) words_.fail("a number is none", "got " + in_quotes(text) + " behind " + std::string(option.name));
    std::array<double, 2>* const to = option.name == "-s" ? &picture.scale : option.name == "-o" ? &picture.offset : nullptr;
    if (to == nullptr) leave_out(fmt::format("{} of map_Kd", option.name));
    for (int k = 0; to != nullptr && k < std::min(count, 2); ++k) (*to)[static_cast<std::size_t>(k)] = number[static_cast<std::size_t>(k)];
    return text;
  }

  Words words_;
  std::shared_ptr<const std::string> name_;
  std::size_t most_;
  Mtl read_;
};

}  // namespace

Mtl parse_mtl(std::string_view bytes, const std::string& name, std::size_t most) { return MtlReader(bytes, name, most).read(); }

}  // namespace tofray::mesh
