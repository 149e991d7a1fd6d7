// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/json.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/text.h"
#include "tofray/error.h"

namespace tofray::files {
namespace {

using Tree = nlohmann::ordered_json;

Tree tree_of(const Json& document) {
  return std::visit(
      [](const auto& value) -> Tree {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, std::monostate>) {
          return nullptr;
        } else if constexpr (std::is_same_v<T, Json::Array>) {
          Tree tree = Tree::array();
          for (const Json& item : value) tree.push_back(tree_of(item));
          return tree;
        } else if constexpr (std::is_same_v<T, Json::Object>) {
          Tree tree = Tree::object();
          // Not by operator[], which looks through all keys for each: an object's keys differ.
          auto& members = static_cast<std::vector<Tree::object_t::value_type>&>(tree.get_ref<Tree::object_t&>());
          for (const auto& [key, item] : value) members.emplace_back(key, tree_of(item));
          return tree;
        } else {
          return value;
        }
      },
      document.value());
}

constexpr std::size_t max_depth = 64;

/// Takes nlohmann's events and builds a Json, so that depth and double keys can be refused on the way.
class Builder : public nlohmann::json_sax<Tree> {
 public:
  Builder(std::string_view text, const std::string& where, std::size_t most_values)
      : text_(text), where_(where), most_values_(most_values) {}

  Json take() { return std::move(root_); }

  bool null() override { return put({}); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    Open& object = open_.back();
    if (!object.seen.insert(name).second)
      throw Error(ErrorKind::bad_input, fmt::format("{}: error: key {} comes twice", where_, base::in_quotes(name)));
    object.key = std::move(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& exception) override {
    const std::string_view before = text_.substr(0, position > 0 ? position - 1 : 0);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0
    constexpr int beyond_double = 406;                 // nlohmann's number of that fault
    throw Error(ErrorKind::bad_input,
                fmt::format("{}:{}:{}: error: {}", where_, line, before.size() - start + 1,
                            exception.id == beyond_double ? "a number is beyond the range of double\n  expected one below 1.8e308"
                                                          : "this is not JSON\n  expected a document that is complete and well formed"));
  }

 private:
  /// A container that is not complete.
  struct Open {
    Json container;
    std::string key;             ///< of an object: the one that waits for its value
    std::set<std::string> seen;  ///< a tree: no file can be made whose keys share a slot
  };

  bool open(Json container) {
    if (open_.size() == max_depth) throw Error(ErrorKind::limit, fmt::format("{}: error: nested deeper than {} levels", where_, max_depth));
    open_.push_back({std::move(container), {}, {}});
    return true;
  }
  bool close() {
    Json done = std::move(open_.back().container);
    open_.pop_back();
    return put(std::move(done));
  }
  bool put(Json item) {
    if (++values_ > most_values_) throw Error(ErrorKind::limit, fmt::format("{}: error: more than {} values", where_, most_values_));
    if (open_.empty()) {
      root_ = std::move(item);
    } else if (Open& parent = open_.back(); parent.container.is_object()) {
      parent.container.set(std::move(parent.key), std::move(item));
    } else {
      parent.container.push(std::move(item));
    }
    return true;
  }

  std::string_view text_;
  const std::string& where_;
  std::size_t most_values_, values_ = 0;
  Json root_;
  std::vector<Open> open_;
};

}  // namespace

Json& Json::push(Json item) {
  std::get<Array>(value_).push_back(std::move(item));
  return *this;
}

Json& Json::set(std::string key, Json item) {
  std::get<Object>(value_).emplace_back(std::move(key), std::move(item));
  return *this;
}

bool Json::unsigned_integer(std::uint64_t& value) const {
  if (const auto* positive = std::get_if<std::uint64_t>(&value_)) {
    value = *positive;
    return true;
  }
  const auto* number = std::get_if<std::int64_t>(&value_);
  if (number == nullptr || *number < 0) return false;
  value = static_cast<std::uint64_t>(*number);
  return true;
}

bool Json::number(double& value) const {
  if (const auto* real = std::get_if<double>(&value_)) {
    value = *real;
  } else if (const auto* positive = std::get_if<std::uint64_t>(&value_)) {
    value = static_cast<double>(*positive);
  } else if (const auto* integer = std::get_if<std::int64_t>(&value_)) {
    value = static_cast<double>(*integer);
  } else {
    return false;
  }
  return true;
}

const Json* Json::find(std::string_view key) const {
  if (const Object* object = members())
    for (const auto& [name, item] : *object)
      if (name == key) return &item;
  return nullptr;
}

std::string json_text(const Json& document, int indent) {
  return tree_of(document).dump(indent, ' ', false, Tree::error_handler_t::replace);
}

Json parse_json(std::string_view text, const std::string& where, std::size_t most_values) {
  Builder builder(text, where, most_values);
  Tree::sax_parse(text.begin(), text.end(), &builder);
  return builder.take();
}

}  // namespace tofray::files
