// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/item.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/faults.h"
#include "base/limits.h"
#include "base/text.h"

namespace tofray::gltf {
namespace {

using files::Json;

constexpr double most_exact = 9007199254740992;  // 2^53

/// What a value is, for messages.
std::string shown(const Json& value) {
  double number = 0;
  if (value.number(number)) return base::number_text(number);
  if (const std::string* text = value.string()) return base::in_quotes(*text);
  if (const bool* flag = value.boolean()) return *flag ? "true" : "false";
  return value.is_array() ? "a list" : value.is_object() ? "an object" : "null";
}

bool whole(const Json& value, std::uint64_t& number) {
  double real = 0;
  if (!value.number(real) || !(real >= 0 && real <= most_exact) || real != std::floor(real)) return false;
  number = static_cast<std::uint64_t>(real);
  return true;
}

}  // namespace

Item::Item(const Json& json, const std::string& file) : json_(&json), file_(&file) {
  if (!json.is_object()) base::fail(base::whole(file), "this is no glTF file", "got JSON that is " + shown(json) + ", expected an object");
}

std::string Item::place(std::string_view key) const { return path_.empty() ? std::string(key) : path_ + "." + std::string(key); }

void Item::fail(const std::string& what, const std::string& more, ErrorKind kind) const {
  base::fail(base::whole(*file_), path_.empty() ? what : path_ + " " + what, more, kind);
}

void Item::fail_at(std::string_view key, const std::string& what, const std::string& more, ErrorKind kind) const {
  base::fail(base::whole(*file_), place(key) + " " + what, more, kind);
}

void Item::fail_kind(std::string_view key, std::string_view expected) const {
  fail_at(key, fmt::format("is not {}", expected), "got " + shown(*find(key)));
}

void Item::fail_missing(std::string_view key, std::string_view expected) const {
  fail_at(key, "is missing", fmt::format("expected {}", expected));
}

std::optional<Item> Item::object(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return {};
  if (!value->is_object()) fail_kind(key, "an object");
  return Item(*value, *file_, place(key));
}

Item Item::required_object(std::string_view key) const {
  if (!has(key)) fail_missing(key, "an object");
  return *object(key);
}

const Json::Array* Item::list(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return nullptr;
  if (!value->is_array()) fail_kind(key, "a list");
  return value->items();
}

std::vector<Item> Item::objects(std::string_view key) const {
  std::vector<Item> out;
  const Json::Array* items = list(key);
  if (items == nullptr) return out;
  out.reserve(items->size());
  for (std::size_t i = 0; i < items->size(); ++i) {
    const Json& one = (*items)[i];
    std::string path = fmt::format("{}[{}]", place(key), i);
    if (!one.is_object()) base::fail(base::whole(*file_), path + " is not an object", "got " + shown(one));
    out.push_back(Item(one, *file_, std::move(path)));
  }
  return out;
}

std::size_t Item::size(std::string_view key) const {
  const Json::Array* items = list(key);
  return items == nullptr ? 0 : items->size();
}

std::vector<std::string> Item::texts(std::string_view key) const {
  std::vector<std::string> out;
  const Json::Array* items = list(key);
  if (items == nullptr) return out;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const std::string* text = (*items)[i].string();
    if (text == nullptr) fail_at(fmt::format("{}[{}]", key, i), "is not a string", "got " + shown((*items)[i]));
    out.push_back(*text);
  }
  return out;
}

std::optional<double> Item::number(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return {};
  double number = 0;
  if (!value->number(number)) fail_kind(key, "a number");
  return number;
}

double Item::number_or(std::string_view key, double fallback) const { return number(key).value_or(fallback); }

double Item::number_within(std::string_view key, double low, double high, double fallback) const {
  const double value = number_or(key, fallback);
  if (!(value >= low && value <= high))
    fail_at(key, "is out of range", fmt::format("got {}, expected {} to {}", base::number_text(value), low, high));
  return value;
}

bool Item::numbers(std::string_view key, std::span<double> values) const {
  if (!has(key)) return false;
  const std::vector<double> all = all_numbers(key);
  if (all.size() != values.size())
    fail_at(key, fmt::format("is not a list of {} numbers", values.size()), fmt::format("got {}", all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) values[i] = all[i];
  return true;
}

std::vector<double> Item::all_numbers(std::string_view key) const {
  std::vector<double> out;
  const Json::Array* items = list(key);
  if (items == nullptr) return out;
  out.resize(items->size());
  for (std::size_t i = 0; i < items->size(); ++i)
    if (!(*items)[i].number(out[i])) fail_at(fmt::format("{}[{}]", key, i), "is not a number", "got " + shown((*items)[i]));
  return out;
}

bool Item::flag_or(std::string_view key, bool fallback) const {
  const Json* value = find(key);
  if (value == nullptr) return fallback;
  if (value->boolean() == nullptr) fail_kind(key, "true or false");
  return *value->boolean();
}

std::optional<std::string_view> Item::text(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return {};
  if (!value->is_string()) fail_kind(key, "a string");
  return *value->string();
}

std::string Item::name() const {
  const std::string_view name = text("name").value_or("");
  if (name.size() > static_cast<std::size_t>(base::limit::text_bytes.value))
    fail_at("name", "is too long", fmt::format("got {} bytes, at most {} (`tofray --limits`)", name.size(), base::limit::text_bytes.value),
            ErrorKind::limit);
  return std::string(name);
}

std::string_view Item::required_text(std::string_view key) const {
  if (!has(key)) fail_missing(key, "a string");
  return *text(key);
}

std::optional<std::uint64_t> Item::count(std::string_view key) const {
  const Json* value = find(key);
  if (value == nullptr) return {};
  std::uint64_t number = 0;
  if (!whole(*value, number)) fail_kind(key, "a whole number from 0 to 2^53");
  return number;
}

std::uint64_t Item::required_count(std::string_view key) const {
  if (!has(key)) fail_missing(key, "a whole number");
  return *count(key);
}

int Item::checked_index(const Json& value, const std::string& key, std::size_t size, std::string_view things) const {
  std::uint64_t number = 0;
  if (!whole(value, number)) fail_at(key, "is not a whole number from 0 to 2^53", "got " + shown(value));
  if (number >= size)
    fail_at(key, fmt::format("is none of the {}", things), fmt::format("got {}, and there are {}, of which the first is 0", number, size));
  return static_cast<int>(number);
}

int Item::index(std::string_view key, std::size_t size, std::string_view things) const {
  const Json* value = find(key);
  return value == nullptr ? -1 : checked_index(*value, std::string(key), size, things);
}

int Item::required_index(std::string_view key, std::size_t size, std::string_view things) const {
  if (!has(key)) fail_missing(key, fmt::format("one of the {}", things));
  return index(key, size, things);
}

std::vector<int> Item::indices(std::string_view key, std::size_t size, std::string_view things) const {
  std::vector<int> out;
  const Json::Array* items = list(key);
  if (items == nullptr) return out;
  out.reserve(items->size());
  for (std::size_t i = 0; i < items->size(); ++i) out.push_back(checked_index((*items)[i], fmt::format("{}[{}]", key, i), size, things));
  std::vector<int> sorted = out;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) fail_at(key, fmt::format("names {} twice", *twice), "expected each once");
  return out;
}

}  // namespace tofray::gltf
