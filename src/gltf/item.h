// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/json.h"
#include "tofray/error.h"

namespace tofray::gltf {

/// An object of the JSON document, and where it stands: "meshes[0].primitives[2]". Its members are taken by key; each function fails with
/// the member's place where it is of another kind.
class Item {
 public:
  /// The document itself. @throws Error where it is no object
  Item(const files::Json& json, const std::string& file);

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] const files::Json::Object& members() const { return *json_->members(); }
  [[nodiscard]] const files::Json* find(std::string_view key) const { return json_->find(key); }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }

  [[nodiscard]] std::optional<Item> object(std::string_view key) const;
  [[nodiscard]] Item required_object(std::string_view key) const;
  /// A list of objects; empty where there is none.
  [[nodiscard]] std::vector<Item> objects(std::string_view key) const;
  /// How long a list is; 0 where there is none.
  [[nodiscard]] std::size_t size(std::string_view key) const;
  /// A list of strings; empty where there is none.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;

  [[nodiscard]] std::optional<double> number(std::string_view key) const;
  [[nodiscard]] double number_or(std::string_view key, double fallback) const;
  /// A number between low and high, ends included.
  [[nodiscard]] double number_within(std::string_view key, double low, double high, double fallback) const;
  /// Fills `values` where the member is there. @return whether it is
  bool numbers(std::string_view key, std::span<double> values) const;
  /// A list of any length; empty where there is none.
  [[nodiscard]] std::vector<double> all_numbers(std::string_view key) const;
  [[nodiscard]] bool flag_or(std::string_view key, bool fallback) const;
  [[nodiscard]] std::optional<std::string_view> text(std::string_view key) const;
  /// At most limit::text_bytes; empty where there is none.
  [[nodiscard]] std::string name() const;
  [[nodiscard]] std::string_view required_text(std::string_view key) const;

  /// A whole number from 0 to 2^53.
  [[nodiscard]] std::optional<std::uint64_t> count(std::string_view key) const;
  [[nodiscard]] std::uint64_t required_count(std::string_view key) const;
  /// One of `size` things, else `none` where it is missing.
  /// @param things  what they are called: "meshes"
  [[nodiscard]] int index(std::string_view key, std::size_t size, std::string_view things) const;
  [[nodiscard]] int required_index(std::string_view key, std::size_t size, std::string_view things) const;
  /// A list of them, each at most once.
  [[nodiscard]] std::vector<int> indices(std::string_view key, std::size_t size, std::string_view things) const;

  /// @throws Error: this object's place, `what`; then `more`
  [[noreturn]] void fail(const std::string& what, const std::string& more, ErrorKind kind = ErrorKind::bad_input) const;
  /// @throws Error: the place of this object's member, `what`; then `more`
  [[noreturn]] void fail_at(std::string_view key, const std::string& what, const std::string& more,
                            ErrorKind kind = ErrorKind::bad_input) const;

 private:
  Item(const files::Json& json, const std::string& file, std::string path) : json_(&json), file_(&file), path_(std::move(path)) {}
  [[nodiscard]] std::string place(std::string_view key) const;
  [[noreturn]] void fail_kind(std::string_view key, std::string_view expected) const;
  [[noreturn]] void fail_missing(std::string_view key, std::string_view expected) const;
  [[nodiscard]] const files::Json::Array* list(std::string_view key) const;
  [[nodiscard]] int checked_index(const files::Json& value, const std::string& key, std::size_t size, std::string_view things) const;

  const files::Json* json_;
  const std::string* file_;
  std::string path_;
};

}  // namespace tofray::gltf
