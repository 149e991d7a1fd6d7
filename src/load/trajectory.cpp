// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/trajectory.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>

#include "base/limits.h"
#include "base/range.h"
#include "base/rotation.h"
#include "base/text.h"
#include "base/units.h"

namespace tofray::load {

using base::in_quotes;

namespace {

constexpr std::size_t column_count = 8;
constexpr std::array<const char*, column_count> column_names{"t", "x", "y", "z", "qx", "qy", "qz", "qw"};
constexpr const char* in_order = "t x y z qx qy qz qw";
constexpr double longest_s = 1e6;    // of a scene
constexpr double oldest_s = 1e12;    // of a file: nobody's clock
constexpr double no_clock_s = 1e11;  // the year 5138: a time without a unit is not in seconds

struct Field {
  std::string_view text;
  std::size_t at;  ///< in its line
};

bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Without blanks and quotation marks around it.
Field trimmed(std::string_view line, std::size_t from, std::size_t to) {
  const auto outer = [](char c) { return is_blank(c) || c == '"'; };
  while (from < to && outer(line[from])) ++from;
  while (to > from && outer(line[to - 1])) --to;
  return {line.substr(from, to - from), from};
}

std::vector<Field> split_at(std::string_view line, char separator) {
  std::vector<Field> out;
  for (std::size_t from = 0;;) {
    const std::size_t end = std::min(line.find(separator, from), line.size());
    out.push_back(trimmed(line, from, end));
    if (end == line.size()) break;
    from = end + 1;
  }
  while (!out.empty() && out.back().text.empty()) out.pop_back();  // a separator at the line's end
  return out;
}

std::vector<Field> split_at_blanks(std::string_view line) {
  std::vector<Field> out;
  for (std::size_t i = 0; i < line.size();) {
    if (is_blank(line[i])) {
      ++i;
      continue;
    }
    const std::size_t end = std::min(line.find_first_of(" \t", i), line.size());
    const bool unit = !out.empty() && (line[i] == '[' || line[i] == '(');  // of the name before
    const std::size_t from = unit ? out.back().at : i;
    if (unit) out.pop_back();
    out.push_back(trimmed(line, from, end));
    i = end;
  }
  return out;
}

/// @param names  whether the fields may have blanks in them
std::vector<Field> fields_of(std::string_view line, bool names) {
  if (line.find(';') != std::string_view::npos) return split_at(line, ';');
  if (line.find(',') != std::string_view::npos) return split_at(line, ',');
  if (names && line.find('\t') != std::string_view::npos) return split_at(line, '\t');
  return split_at_blanks(line);
}

bool begins_like_a_number(std::string_view text) {
  const bool digit = !text.empty() && std::string_view("0123456789+-.").find(text[0]) != std::string_view::npos;
  return digit || base::parse_quantity(text, base::Dimension::none).status == base::Quantity::Status::not_finite;
}

/// A column's name: lower case, its words, and the unit that stands in brackets.
struct ColumnName {
  std::vector<std::string> words;
  std::string unit;

  explicit ColumnName(std::string_view text) {
    const std::size_t bracket = std::min(text.find_first_of("[("), text.size());
    const std::size_t close = text.find_first_of("])", bracket);
    if (close != std::string_view::npos) unit = std::string(text.substr(bracket + 1, close - bracket - 1));
    std::string word;
    const auto end_word = [&] {
      if (!word.empty()) words.push_back(std::move(word));
      word.clear();
    };
    for (const char c : text.substr(0, bracket)) {
      const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
      if (!letter) {
        end_word();
        continue;
      }
      word += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    end_word();
  }

  [[nodiscard]] bool has(std::initializer_list<const char*> any) const {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return std::any_of(any.begin(), any.end(), [&](const char* one) { return word == one; });
    });
  }

  /// Its place in column_names; −1: another column.
  [[nodiscard]] int column() const {
    if (words.empty()) return -1;
    const std::string& last = words.back();
    if (has({"t", "time", "timestamp", "timestamps", "stamp", "sec", "secs", "seconds"}) &&
        !(last.size() == 1 && words.size() > 1 && std::string_view("xyzw").find(last[0]) != std::string_view::npos))
      return 0;
    // "qx", "tx", "p_RS_R_x", "pose.orientation.w"
    const auto part = [&](const char* before, std::initializer_list<const char*> names) {
      if (last.size() == 1 && words.size() > 1 && has(names)) return last[0];
      const bool joined = words.size() == 1 && last.size() == 2 && std::string_view(before).find(last[0]) != std::string_view::npos;
      return joined ? last[1] : '\0';
    };
    static constexpr std::string_view quaternion = "xyzw", position = "xyz";
    const char turn = part("q", {"q", "quat", "quaternion", "orientation", "rotation", "rot"});
    if (turn != '\0' && quaternion.find(turn) != std::string_view::npos) return 4 + static_cast<int>(quaternion.find(turn));
    const char place = words.size() == 1 && last.size() == 1 ? last[0] : part("tp", {"t", "p", "pos", "position", "translation", "trans"});
    if (place != '\0' && position.find(place) != std::string_view::npos) return 1 + static_cast<int>(position.find(place));
    return -1;
  }
  /// The unit of a time by its name: "timestamp_ns", "time [ns]".
  [[nodiscard]] std::string time_unit() const {
    if (!unit.empty()) return unit == "sec" ? "s" : unit == "nsec" ? "ns" : unit;
    if (has({"ns", "nsec", "nsecs", "nanoseconds"})) return "ns";
    if (has({"us", "usec", "usecs", "microseconds"})) return "us";
    if (has({"ms", "msec", "msecs", "milliseconds"})) return "ms";
    if (has({"s", "sec", "secs", "seconds"})) return "s";
    return {};
  }
};

/// A decimal number that is good, shifted by so many digits; nothing where it is beyond oldest_s.
std::optional<Stamp> shifted(std::string_view text, int digits) {
  if (text.size() > 400) return {};
  const bool negative = !text.empty() && text[0] == '-';
  if (!text.empty() && (text[0] == '-' || text[0] == '+')) text.remove_prefix(1);
  if (const std::size_t e = text.find_first_of("eE"); e != std::string_view::npos) {
    std::string_view exponent = text.substr(e + 1);
    if (!exponent.empty() && exponent[0] == '+') exponent.remove_prefix(1);
    int value = 0;
    if (std::from_chars(exponent.data(), exponent.data() + exponent.size(), value).ec != std::errc() || std::abs(value) > 400) return {};
    digits += value, text = text.substr(0, e);
  }
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string whole(text.substr(0, point)), rest(point < text.size() ? text.substr(point + 1) : "");
  for (; digits > 0; --digits) whole += rest.empty() ? '0' : rest[0], rest.erase(0, rest.empty() ? 0 : 1);
  for (; digits < 0; ++digits)
    rest.insert(rest.begin(), whole.empty() ? '0' : whole.back()), whole.resize(whole.empty() ? 0 : whole.size() - 1);
  Stamp out;
  whole.insert(0, "0"), rest.insert(0, "0.");
  if (std::from_chars(whole.data(), whole.data() + whole.size(), out.whole).ec != std::errc()) return {};
  std::from_chars(rest.data(), rest.data() + rest.size(), out.rest);
  const std::string both = whole + rest.substr(1);
  std::from_chars(both.data(), both.data() + both.size(), out.seconds);
  if (out.seconds > oldest_s) return {};
  if (negative) out.whole = -out.whole, out.rest = -out.rest, out.seconds = -out.seconds;
  return out;
}

class TrajectoryParser {
 public:
  TrajectoryParser(std::string_view text, const std::string& path, const TrajectoryTimes& times, std::optional<Stamp>& clock,
                   base::Faults& faults)
      : text_(text), path_(std::make_shared<const std::string>(path)), times_(times), clock_(clock), faults_(faults) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3), bom_ = 3;
  }

  std::vector<TimedPose> parse() {
    const std::size_t before = faults_.size();
    for (std::size_t from = 0; from < text_.size() && !broken_;) {
      const std::size_t end = std::min(text_.find_first_of("\r\n", from), text_.size());
      ++number_;
      line(text_.substr(from, end - from));
      from = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1), bom_ = 0;
    }
    if (faults_.size() == before && out_.empty())
      faults_.add(base::whole(*path_), "there are no poses in it", std::string("expected lines of ") + in_order);
    if (faults_.size() != before) out_.clear();
    return std::move(out_);
  }

  /// The pose of one line more, where it has one. The last pose is all that is kept.
  std::optional<TimedPose> next(std::string_view text) {
    ++number_;
    const std::size_t before = out_.size();
    line(text);
    if (out_.size() == before) return {};
    out_.erase(out_.begin(), out_.end() - 1);
    return out_.back();
  }

 private:
  [[nodiscard]] base::Place place(std::size_t at) const { return {path_, number_, static_cast<int>(at + bom_) + 1}; }

  void line(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
    if (first == text.size()) return;
    const bool comment = text[first] == '#' || text[first] == '%';
    const bool data = !comment && !fields_of(text, false).empty();
    if (comment) {
      if (out_.empty() && !headed_) header(fields_in(text, first + 1), true);
    } else if (data && out_.empty() && !plain_header_ && !begins_like_a_number(fields_of(text, false)[0].text)) {
      plain_header_ = true;
      header(fields_in(text, 0), false);
    } else if (data) {
      row(text.substr(0, text.find('#')));
    }
  }

  /// Of a header, from a place on.
  static std::vector<Field> fields_in(std::string_view text, std::size_t from) {
    std::vector<Field> fields = fields_of(text.substr(from), true);
    for (Field& field : fields) field.at += from;
    return fields;
  }

  /// @param comment  other comments are no headers
  void header(const std::vector<Field>& fields, bool comment) {
    std::array<int, column_count> columns{};
    columns.fill(-1);
    std::array<double, 3> scales{1, 1, 1};
    std::string unit;
    std::optional<std::size_t> again;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const ColumnName name(fields[i].text);
      const int column = name.column();
      if (column < 0) continue;
      const auto which = static_cast<std::size_t>(column);
      if (columns[which] >= 0) {
        if (!again) again = i;
        continue;
      }
      columns[which] = static_cast<int>(i);
      if (which == 0) unit = name.time_unit();
      if (which >= 1 && which <= 3 && !name.unit.empty()) scales[which - 1] = metres_in(name.unit);
    }
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < column_count; ++i)
      if (columns[i] < 0) missing.emplace_back(column_names[i]);
    if (!missing.empty()) {
      if (comment) return;
      return broken(place(fields[0].at), "the header has no column for " + base::listed(missing, "and"),
                    "got " + names_of(fields) + "\nexpected names such as t, x, y, z, qx, qy, qz, qw, in any order, among others");
    }
    if (again) {
      const auto which = static_cast<std::size_t>(ColumnName(fields[*again].text).column());
      return broken(place(fields[*again].at), std::string("the header has two columns for ") + column_names[which],
                    "got " + in_quotes(fields[static_cast<std::size_t>(columns[which])].text) + " and " + in_quotes(fields[*again].text) +
                        "; take one of them out, or rename it");
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (scales[i] == 0)
        return broken(
            place(fields[static_cast<std::size_t>(columns[1 + i])].at), "the header has an unknown unit of length",
            "got " + in_quotes(fields[static_cast<std::size_t>(columns[1 + i])].text) + ", expected m, cm or mm, or none: metres");
    if (!unit.empty() && digits_of(unit) > 0)
      return broken(place(fields[static_cast<std::size_t>(columns[0])].at), "the header has an unknown unit of time",
                    "got " + in_quotes(fields[static_cast<std::size_t>(columns[0])].text) + ", expected s, ms, us or ns, or none: seconds");
    columns_ = columns, scales_ = scales, header_unit_ = unit, width_ = fields.size(), headed_ = true;
  }

  static std::string names_of(const std::vector<Field>& fields) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 20); ++i) names.push_back(in_quotes(fields[i].text));
    if (fields.size() > 20) names.push_back(std::to_string(fields.size() - 20) + " more");
    return base::listed(names, "and");
  }

  /// 0: unknown.
  static double metres_in(const std::string& unit) {
    const auto one = base::parse_quantity("1 " + unit, base::Dimension::length);
    return one.status == base::Quantity::Status::good ? one.value : 0;
  }
  /// Decimal digits from seconds; 1: unknown.
  static int digits_of(const std::string& unit) { return unit == "s" ? 0 : unit == "ms" ? -3 : unit == "us" ? -6 : unit == "ns" ? -9 : 1; }

  void broken(const base::Place& where, const std::string& what, const std::string& more, ErrorKind kind = ErrorKind::bad_input) {
    faults_.add(where, what, more, kind);
    broken_ = true;
  }

  void row(std::string_view text) {
    const std::vector<Field> fields = fields_of(text, false);
    if (fields.size() != width_) {
      const bool both = std::any_of(fields.begin(), fields.end(),
                                    [](const Field& field) { return field.text.find_first_of(" \t") != std::string_view::npos; });
      const bool comma =
          (fields.size() > width_ || both) && text.find(';') == std::string_view::npos && text.find(',') != std::string_view::npos;
      faults_.add(place(fields[0].at), "the line has the wrong number of columns",
                  "got " + std::to_string(fields.size()) + ", expected " + std::to_string(width_) +
                      (headed_ ? " as in the header" : std::string(": ") + in_order + ", or a header that names them") +
                      (comma ? "\na decimal comma makes two of one: write 1.5, not 1,5" : ""));
      return;
    }
    if (out_.size() >= static_cast<std::size_t>(base::limit::keyframes.value))
      return broken(
          place(0), "there are too many poses",
          "at most " + std::to_string(base::limit::keyframes.value) + " (`tofray --limits`); take every other line, or a part of them",
          ErrorKind::limit);
    std::array<double, column_count> values{};
    bool good = true;
    for (std::size_t i = 0; i < column_count; ++i) good = number(field(fields, i), i, values[i]) && good;
    if (good) pose(fields, values);
  }

  [[nodiscard]] const Field& field(const std::vector<Field>& fields, std::size_t column) const {
    return fields[static_cast<std::size_t>(columns_[column])];
  }

  bool number(const Field& field, std::size_t column, double& value) {
    const auto quantity = base::parse_quantity(field.text, base::Dimension::none);
    value = quantity.value;
    using enum base::Quantity::Status;
    if (quantity.status == good || quantity.status == bare) return true;
    const std::string name = column_names[column];
    if (quantity.status == not_finite || quantity.status == out_of_range)
      faults_.add(place(field.at), name + " is not finite",
                  "got " + in_quotes(field.text) + "; take the line out: between its neighbours all moves evenly");
    else if (field.text.empty())
      faults_.add(place(field.at), name + " is empty", "expected a number");
    else
      faults_.add(place(field.at), name + " is not a number",
                  "got " + in_quotes(field.text) + ", expected a number such as 1.5" +
                      (field.text.find(',') != std::string_view::npos ? ", with a decimal point" : ""));
    return false;
  }

  void pose(const std::vector<Field>& fields, const std::array<double, column_count>& values) {
    TimedPose one;
    for (std::size_t k = 0; k < 3; ++k) {
      one.position[k] = scales_[k] * values[1 + k];
      if (!(std::abs(one.position[k]) <= base::farthest_m)) {
        faults_.add(place(field(fields, 1 + k).at), std::string(column_names[1 + k]) + " is out of range",
                    "got " + base::number_text(one.position[k]) + " m, expected " + base::number_text(-base::farthest_m) + " to " +
                        base::number_text(base::farthest_m) + "; take a place of yours from all positions: the scene's zero");
        return;
      }
    }
    const Quaternion q{values[4], values[5], values[6], values[7]};
    if (const base::NoRotation wrong = base::why_no_rotation(q); !wrong.what.empty())
      return faults_.add(place(field(fields, 4).at), wrong.what, wrong.more);
    one.quaternion = base::normalized(q);
    if (!time(field(fields, 0), one.time_s)) return;
    if (!out_.empty() && !(one.time_s > out_.back().time_s))
      return faults_.add(place(field(fields, 0).at), "the time is not later than that of the line before",
                         "got " + in_quotes(field(fields, 0).text) + "; sort the lines by time, and take out those that come twice");
    out_.push_back(one);
  }

  bool time(const Field& field, double& time_s) {
    const std::string& unit = times_.unit.empty() ? header_unit_ : times_.unit;
    const std::optional<Stamp> stamp = shifted(field.text, unit.empty() ? 0 : digits_of(unit));
    if (!stamp || (unit.empty() && std::abs(stamp->seconds) > no_clock_s)) {
      broken(place(field.at), "the time is out of range",
             "got " + in_quotes(field.text) + (unit.empty() ? " s" : " " + unit) +
                 (unit.empty() ? "; nanoseconds? say so in the header, timestamp [ns], or in the scene, time_unit: ns" : ""));
      return false;
    }
    const Stamp* zero = times_.zero ? &*times_.zero : nullptr;
    if (zero == nullptr && (is_clock_ || (out_.empty() && std::abs(stamp->seconds) > longest_s))) {
      is_clock_ = true;
      if (!clock_) clock_ = stamp;
      zero = &*clock_;
    }
    time_s = zero == nullptr ? stamp->seconds : static_cast<double>(stamp->whole - zero->whole) + (stamp->rest - zero->rest);
    if (std::abs(time_s) <= longest_s) return true;
    broken(place(field.at), "the time is out of range",
           "got " + base::number_text(time_s) + " s" + (zero == nullptr ? "" : " after the scene's zero") +
               ", expected -1e6 s to 1e6 s; time_zero says which of the file's times is 0 in the scene");
    return false;
  }

  std::string_view text_;
  std::shared_ptr<const std::string> path_;
  const TrajectoryTimes& times_;
  std::optional<Stamp>& clock_;
  base::Faults& faults_;
  std::size_t bom_ = 0;
  int number_ = 0;  ///< of the line
  std::array<int, column_count> columns_{0, 1, 2, 3, 4, 5, 6, 7};
  std::array<double, 3> scales_{1, 1, 1};
  std::string header_unit_;
  std::size_t width_ = column_count;
  bool headed_ = false, plain_header_ = false, is_clock_ = false, broken_ = false;
  std::vector<TimedPose> out_;
};

}  // namespace

Stamp stamp_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int64_t>(whole), seconds - whole, seconds};
}

std::vector<TimedPose> parse_trajectory(std::string_view text, const std::string& path, const TrajectoryTimes& times,
                                        std::optional<Stamp>& clock, base::Faults& faults) {
  return TrajectoryParser(text, path, times, clock, faults).parse();
}

struct TrajectoryLines::Impl {
  explicit Impl(const std::string& path) : parser("", path, times, clock, faults) {}
  TrajectoryTimes times;
  std::optional<Stamp> clock;
  base::Faults faults;
  TrajectoryParser parser;
};

TrajectoryLines::TrajectoryLines(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
TrajectoryLines::~TrajectoryLines() = default;

std::optional<TimedPose> TrajectoryLines::take(std::string_view line) {
  const std::optional<TimedPose> out = impl_->parser.next(line);
  impl_->faults.raise();
  return out;
}

}  // namespace tofray::load
