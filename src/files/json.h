// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// A JSON document as a plain value. Text in and out goes through nlohmann-json, whose header only json.cpp pays for.
namespace tofray::files {

/// null, bool, integer, number, string, array or object; an object keeps the order in which its keys were added.
class Json {
 public:
  using Array = std::vector<Json>;
  using Object = std::vector<std::pair<std::string, Json>>;

  Json() = default;
  Json(std::nullptr_t) {}
  /// A true bool only: a pointer must not turn into one.
  template <class T>
  requires(std::is_same_v<T, bool>) Json(T value) : value_(value) {}
  template <class T>
  requires(std::is_integral_v<T> && !std::is_same_v<T, bool> && std::is_signed_v<T>) Json(T value)
      : value_(static_cast<std::int64_t>(value)) {}
  template <class T>
  requires(std::is_integral_v<T> && !std::is_same_v<T, bool> && std::is_unsigned_v<T>) Json(T value)
      : value_(static_cast<std::uint64_t>(value)) {}
  Json(double value) : value_(value) {}
  Json(const char* value) : value_(std::string(value)) {}
  Json(std::string value) : value_(std::move(value)) {}
  Json(std::string_view value) : value_(std::string(value)) {}
  Json(Array value) : value_(std::move(value)) {}
  Json(Object value) : value_(std::move(value)) {}

  static Json array() { return Json(Array()); }
  static Json object() { return Json(Object()); }
  /// An array of anything that a Json can be made of: numbers, strings, std::array, std::vector.
  template <class Range>
  static Json list(const Range& range) {
    Array items;
    for (const auto& item : range) items.emplace_back(item);
    return items;
  }

  /// Adds to an array, or a key to an object (which must not have it yet); returns this document for more.
  Json& push(Json item);
  Json& set(std::string key, Json item);

  [[nodiscard]] bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  [[nodiscard]] bool is_string() const { return std::holds_alternative<std::string>(value_); }
  [[nodiscard]] bool is_array() const { return std::holds_alternative<Array>(value_); }
  [[nodiscard]] bool is_object() const { return std::holds_alternative<Object>(value_); }
  /// The value, or nothing where the document is of another kind. Integers are numbers, too.
  [[nodiscard]] const std::string* string() const { return std::get_if<std::string>(&value_); }
  [[nodiscard]] const Array* items() const { return std::get_if<Array>(&value_); }
  [[nodiscard]] const Object* members() const { return std::get_if<Object>(&value_); }
  [[nodiscard]] const bool* boolean() const { return std::get_if<bool>(&value_); }
  /// An integer of 0…2^64−1. @return false where it is none
  bool unsigned_integer(std::uint64_t& value) const;
  /// Any number. @return false where it is none
  bool number(double& value) const;
  /// A member of an object, or nullptr.
  [[nodiscard]] const Json* find(std::string_view key) const;

  using Value = std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, Array, Object>;
  [[nodiscard]] const Value& value() const { return value_; }

 private:
  Value value_;
};

/// Text of a document: the shortest digits that give the same number back, in any locale; NaN and infinities become null, bytes that are
/// not UTF-8 become U+FFFD.
/// @param indent  spaces per level; −1: all on one line
std::string json_text(const Json& document, int indent = -1);

/// Reads a document.
/// @throws Error (bad_input) with `where`, line and column of the fault, also for keys that come twice; (limit) nested deeper than 64 levels,
/// or of more than `most_values` values
Json parse_json(std::string_view text, const std::string& where, std::size_t most_values = std::numeric_limits<std::size_t>::max());

}  // namespace tofray::files
