// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/faults.h"
#include "model/form.h"
#include "yaml/tree.h"

/// Reading a tree by its table.
namespace tofray::yaml {

using model::FileForm;
using model::ValueForm;

/// A value as its form says: numbers in SI units. It points into the tree, which has to stay.
struct Value {
  const Node* node = nullptr;           ///< none where the key is absent
  bool good = true;                     ///< no fault was found in it or below it
  double number = 0;                    ///< number; integer, too (exact up to 2^53)
  bool flag = false;                    ///< boolean
  std::string text;                     ///< text, choice; the tag of a tagged map
  int alternative = 0;                  ///< tagged, variant: which one
  int either = 0;                       ///< which form of ValueForm::Kind::either
  std::vector<std::string> names;       ///< map, dictionary: keys of `items`; list: empty
  std::vector<base::Place> key_places;  ///< dictionary and the open part of a map
  std::vector<Value> items;             ///< list, dictionary, map; variant: the one value

  [[nodiscard]] explicit operator bool() const { return node != nullptr; }
  /// A map's value by key; an absent value where there is none.
  const Value& operator[](std::string_view key) const;
  [[nodiscard]] const base::Place& place() const { return node->place; }
  /// Of a map's key, or of the map where the key was left to its default.
  [[nodiscard]] const base::Place& place_of(std::string_view key) const;
  [[nodiscard]] bool is_map() const { return node != nullptr && node->kind == Node::Kind::map; }
};

/// Where a key of that name stands in such a file, as a dotted path; empty where none does.
std::string home_of(const ValueForm& root, const std::string& name);

/// Reads all of the tree, adding every fault to `faults`.
Value read(const FileForm& file, const Node& root, base::Faults& faults);

}  // namespace tofray::yaml
