// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dataset/expression.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/text.h"

namespace tofray::dataset {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool begins_word(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool in_word(char c) { return begins_word(c) || is_digit(c) || c == '.'; }

/// A value on the way: SI, and what it is of.
struct Sum {
  double value = 0;
  Dimensions of;
  std::optional<std::string> text;  ///< in place of a number
};

class Parser {
 public:
  Parser(std::string_view text, const base::Place& place, const Names& names) : text_(text), place_(place), names_(names) {}

  Sum all() {
    Sum value = sum();
    if (peek() != 0) fail(std::string("\"") + peek() + "\" is not what belongs there");
    if (!value.text && !std::isfinite(value.value)) fail("the value is not finite");
    return value;
  }

 private:
  static constexpr int deepest = 60;

  [[noreturn]] void fail(const std::string& why) const {
    base::fail(place_, "the expression " + base::in_quotes("=" + std::string(text_)) + " has no value: " + why,
               "expected numbers with units, names of `let`, + - * /, ( ), min, max and sqrt, as in \"= wall - 0.6 m\"");
  }
  char peek() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }
  void need(char c) {
    if (!take(c)) fail(std::string("\"") + c + "\" is missing");
  }
  const Sum& number(const Sum& value) const {
    if (value.text) fail(base::in_quotes(*value.text) + " is no number");
    return value;
  }
  void same(const Sum& a, const Sum& b, const char* what) const {
    number(a), number(b);
    // 0 is a bare number and any quantity.
    if (a.of == b.of || (a.of.bare() && a.value == 0) || (b.of.bare() && b.value == 0)) return;
    fail(std::string(what) + " of " + name_of(a.of) + " and " + name_of(b.of));
  }

  Sum sum() {
    Sum value = product();
    for (;;) {
      const bool plus = peek() == '+';
      if (!plus && peek() != '-') return value;
      ++at_;
      const Sum other = product();
      same(value, other, plus ? "a sum" : "a difference");
      value.value = plus ? value.value + other.value : value.value - other.value;
      if (value.of.bare()) value.of = other.of;
    }
  }
  Sum product() {
    Sum value = factor();
    for (;;) {
      const bool times = peek() == '*';
      if (!times && peek() != '/') return value;
      ++at_;
      const Sum other = factor();
      number(value), number(other);
      if (!times && other.value == 0) fail("it divides by 0");
      value.value = times ? value.value * other.value : value.value / other.value;
      for (std::size_t i = 0; i < value.of.powers.size(); ++i) {
        const int power = value.of.powers[i] + (times ? 1 : -1) * other.of.powers[i];
        if (std::abs(power) > 100) fail("its unit has too large a power");
        value.of.powers[i] = static_cast<signed char>(power);
      }
    }
  }
  Sum factor() {
    if (++depth_ > deepest) fail("it is nested too deeply");
    Sum value = factor_inside();
    --depth_;
    return value;
  }
  Sum factor_inside() {
    if (take('-')) {
      Sum value = factor();
      number(value);
      value.value = 0.0 - value.value;
      return value;
    }
    if (take('(')) {
      Sum value = sum();
      need(')');
      return value;
    }
    const char c = peek();
    if (is_digit(c) || c == '.') return literal();
    if (begins_word(c)) return word();
    fail(c == 0 ? "it ends too early" : std::string("\"") + c + "\" is not what belongs there");
  }
  Sum literal() {
    std::size_t end = at_;
    while (end < text_.size() && (is_digit(text_[end]) || text_[end] == '.')) ++end;
    if (end + 1 < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      std::size_t exponent = end + 1;
      if (text_[exponent] == '+' || text_[exponent] == '-') ++exponent;
      if (exponent < text_.size() && is_digit(text_[exponent]))
        for (end = exponent; end < text_.size() && is_digit(text_[end]);) ++end;
    }
    std::string written(text_.substr(at_, end - at_));
    at_ = end;
    if (const std::string unit = unit_here(); !unit.empty()) written += " " + unit;
    std::string why;
    const auto amount = parse_amount(written, why);
    if (!amount) fail(why);
    return {amount->si(), amount->dimensions(), {}};
  }
  /// The longest unit that stands here, taken.
  std::string unit_here() {
    peek();
    constexpr std::size_t longest = 12;
    for (std::size_t n = std::min(longest, text_.size() - at_); n > 0; --n) {
      const std::string_view name = text_.substr(at_, n);
      const bool ends = at_ + n == text_.size() || !in_word(text_[at_ + n]) || !in_word(name.back());
      if (!ends || base::find_unit(name) == nullptr) continue;
      at_ += n;
      return std::string(name);
    }
    return {};
  }
  Sum word() {
    std::size_t end = at_;
    while (end < text_.size() && in_word(text_[end])) ++end;
    const std::string_view name = text_.substr(at_, end - at_);
    at_ = end;
    if (name == "min" || name == "max") {
      need('(');
      Sum value = number(sum());
      while (take(',')) {
        const Sum other = sum();
        same(value, other, name == "min" ? "a min" : "a max");
        value.value = name == "min" ? std::min(value.value, other.value) : std::max(value.value, other.value);
        if (value.of.bare()) value.of = other.of;
      }
      need(')');
      return value;
    }
    if (name == "sqrt") {
      need('(');
      Sum value = number(sum());
      need(')');
      if (value.value < 0) fail("a square root of a number below 0");
      value.value = std::sqrt(value.value);
      for (signed char& power : value.of.powers) {
        if (power % 2 != 0) fail("a square root of " + name_of(number(value).of));
        power = static_cast<signed char>(power / 2);
      }
      return value;
    }
    const Named found = names_(name);
    if (const auto* text = std::get_if<std::string>(&found)) return {0, {}, *text};
    const Amount& amount = std::get<Amount>(found);
    return {amount.si(), amount.dimensions(), {}};
  }

  std::string_view text_;
  const base::Place& place_;
  const Names& names_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

Named evaluate(std::string_view expression, const base::Place& place, const Names& names) {
  const Sum value = Parser(expression, place, names).all();
  if (value.text) return *value.text;
  const auto amount = amount_of(value.value, value.of);
  if (!amount)
    base::fail(place, "the expression " + base::in_quotes("=" + std::string(expression)) + " is no quantity that a scene has",
               "got " + name_of(value.of));
  return *amount;
}

bool is_name(std::string_view word) {
  return !word.empty() && begins_word(word[0]) && std::all_of(word.begin(), word.end(), [](char c) { return in_word(c) && c != '.'; }) &&
         word != "min" && word != "max" && word != "sqrt";
}

}  // namespace tofray::dataset
