// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/reference.h"

#include <fmt/core.h>

#include <algorithm>

#include "model/lines.h"

namespace tofray::load {

namespace {

using model::Line;

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

/// A line without the kind that it is of.
std::string plain_doc(const Line& line) { return line.kind.empty() ? line.doc : line.doc.substr(line.kind.size() + 2); }

bool says_the_same(const Line& a, const Line& b) {
  return a.value == b.value && a.fallback == b.fallback && a.required == b.required && plain_doc(a) == plain_doc(b) && a.member == b.member;
}

/// The lines of a file kind, one for all kinds of a thing of which a key says the same.
std::vector<Line> merged_lines(const model::FileForm& file) {
  std::vector<Line> out;
  for (const Line& line : model::lines_of(file)) {
    const auto same = std::find_if(out.begin(), out.end(), [&](const Line& one) {
      return !line.kind.empty() && !one.kind.empty() && one.key == line.key && says_the_same(one, line);
    });
    if (same == out.end()) {
      out.push_back(line);
      continue;
    }
    same->doc = same->kind + ", " + line.kind + ": " + plain_doc(line);
    same->kind += ", " + line.kind;
  }
  return out;
}

/// A file kind's keys as tables, one for each of its sections. Keys that stand below several others are written once, with a link from the
/// other places.
class Tables {
 public:
  explicit Tables(const model::FileForm& file) : lines_(merged_lines(file)) {}

  std::string text() {
    begin("top level");
    for (const Line& line : lines_)
      if (line.key.find('.') == std::string::npos) add(line);
    for (std::size_t i = 0; i < lines_.size();) {
      const std::size_t dot = lines_[i].key.find('.');
      const std::size_t end = dot == std::string::npos ? i + 1 : end_of({lines_[i].key.substr(0, dot), i, 0});
      if (dot != std::string::npos) {
        const std::string section = lines_[i].key.substr(0, dot);
        if (section != section_) begin(section);
        add_below({section, i, end});
      }
      i = end;
    }
    return std::move(out_);
  }

 private:
  /// Lines first to end, whose keys begin with `prefix` and a dot.
  struct Span {
    std::string prefix;
    std::size_t first = 0, end = 0;
    [[nodiscard]] std::size_t size() const { return end - first; }
  };

  static constexpr std::size_t worth_a_link = 4;

  [[nodiscard]] std::size_t end_of(const Span& span) const {
    std::size_t i = span.first;
    while (i < lines_.size() && lines_[i].key.starts_with(span.prefix + ".")) ++i;
    return i;
  }

  [[nodiscard]] std::string name(const Span& span, std::size_t line) const { return lines_[line].key.substr(span.prefix.size() + 1); }

  /// How many of the last lines of both say the same of keys of the same names.
  [[nodiscard]] std::size_t common(const Span& a, const Span& b) const {
    std::size_t count = 0;
    while (count < std::min(a.size(), b.size())) {
      const std::size_t x = a.end - 1 - count, y = b.end - 1 - count;
      if (name(a, x) != name(b, y) || !says_the_same(lines_[x], lines_[y]) || lines_[x].kind != lines_[y].kind) break;
      ++count;
    }
    return count;
  }

  void begin(const std::string& section) {
    section_ = section;
    out_ += "\n### " + section + "\n\n| key | value, range | unless given | meaning | in code |\n|---|---|---|---|---|\n";
  }

  void add(const Line& line) {
    const std::string fallback = line.required ? "required" : line.fallback.empty() ? "–" : "`" + line.fallback + "`";
    out_ += fmt::format("| `{}` | {} | {} | {} | {} |\n", line.key, cell(line.value), fallback, cell(line.doc),
                        line.member.empty() ? "" : "`" + line.member + "`");
  }

  /// The lines of a span: as far as an earlier one ends alike, by a link to that.
  void add_below(const Span& span) {
    std::size_t most = 0;
    Span like;
    for (const Span& one : written_)
      if (const std::size_t count = common(span, one); count > most) most = count, like = one;
    if (most < worth_a_link) most = 0;
    for (std::size_t i = span.first; i < span.end - most;) {
      const std::size_t dot = lines_[i].key.find('.', span.prefix.size() + 1);
      if (dot == std::string::npos) {
        add(lines_[i++]);
        continue;
      }
      Span below{lines_[i].key.substr(0, dot), i, 0};
      below.end = std::min(end_of(below), span.end - most);
      add_below(below);
      i = below.end;
    }
    if (most > 0) add_link(span, like, most);
    written_.push_back(span);
  }

  void add_link(const Span& span, const Span& like, std::size_t count) {
    const std::string section = like.prefix.substr(0, like.prefix.find('.'));
    const std::string from =
        count == span.size() && count == like.size() ? "" : fmt::format(", from `{}` on", name(span, span.end - count));
    out_ += fmt::format("| `{}.…` |  |  | {} keys as those of [`{}`](#{}){} |  |\n", span.prefix, count, like.prefix, section, from);
  }

  std::vector<Line> lines_;
  std::vector<Span> written_;
  std::string section_, out_;
};

}  // namespace

std::string reference_page() {
  return "<!-- SPDX-FileCopyrightText: 2026 The tofray authors -->\n<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
         "# Every key of camera profiles and scenes\n\n"
         "Written by `tofray list keys` from the tables of `src/model`. Keys are as `--set` takes them: the first of a list is 0, a name\n"
         "that is free is NAME; in a scene's `camera:` section and in `--set camera.…`, the profile's keys stand in for the profile's "
         "values.\n"
         "Keys that stand in several places are described once; a line with … leads there from the others.\n"
         "\n## Camera profile\n" +
         Tables(model::camera_form()).text() + "\n## Scene\n" + Tables(model::scene_form()).text();
}

}  // namespace tofray::load
