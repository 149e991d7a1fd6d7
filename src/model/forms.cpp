// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/text.h"
#include "model/check.h"
#include "model/tables.h"

/// From the rows of a struct to what a file may say of it.
namespace tofray::model {

namespace {

using Kind = ValueForm::Kind;

bool has(const std::vector<int>& kinds, int kind) { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); }

/// A value as one writes it, in the example's unit.
std::string written(double value, const ValueForm& form) { return base::quantity_text(value, form.example); }

std::string written(const Vec3& v, const ValueForm& form) {
  return "[" + written(v[0], form) + ", " + written(v[1], form) + ", " + written(v[2], form) + "]";
}

/// What the struct has where the file is silent; empty where that is a struct.
std::string fallback(const Row& row, const Table& table) {
  if (row.presence != Presence::optional) return {};
  const Slot slot = slot_of(row, table.fresh);
  if (const auto* number = std::get_if<double*>(&slot)) return written(**number, row.form);
  if (const auto* number = std::get_if<int*>(&slot)) return std::to_string(**number);
  if (const auto* number = std::get_if<unsigned long long*>(&slot)) return std::to_string(**number);
  if (const auto* flag = std::get_if<bool*>(&slot)) return **flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string*>(&slot)) return **text;
  if (const auto* vector = std::get_if<Vec3*>(&slot)) return written(**vector, row.form.forms[0]);
  if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) return row.form.names[static_cast<std::size_t>(choice->get(choice->at))];
  if (const auto* curve = std::get_if<CurveSlot>(&slot); curve != nullptr && curve->y->size() == 1)
    return written(curve->y->front(), row.y);
  if (const auto* record = std::get_if<RecordSlot>(&slot); record != nullptr && !record->table().tag.empty()) {
    const Table& below = record->table();
    const auto kind = std::find_if(below.rows.begin(), below.rows.end(), [&](const Row& one) { return one.key == below.tag; });
    return fallback(*kind, below);
  }
  return {};
}

/// What stands under the row's key.
ValueForm value_form(const Row& row, const Table& table) {
  const Slot slot = slot_of(row, table.fresh);
  ValueForm form = row.form;
  if (const auto* record = std::get_if<RecordSlot>(&slot)) return form_of(record->table());
  if (const auto* records = std::get_if<ListSlot>(&slot)) {
    form.forms[0] = form_of(records->table());
    if (row.otherwise.kind != Kind::anything) form = either({std::move(form), row.otherwise});
  }
  // A kind that another row under the same key stands for is no word of the files.
  if (std::holds_alternative<ChoiceSlot>(slot))
    for (const Row& other : table.rows)
      if (&other != &row && other.key == row.key)
        for (const int kind : other.kinds) form.names.erase(form.names.begin() + kind);
  return form;
}

Key key_of(const std::string& name, const Row& row, const Table& table, bool required) {
  return {name, value_form(row, table), row.doc, required, fallback(row, table), row.member, row.stage};
}

/// The keys of one map of the struct: the struct's own (before is empty), or those of a group.
class Keys {
 public:
  Keys(const Table& table, int kind) : table_(table), kind_(kind) {}

  std::vector<Key> at(const std::string& before) {
    std::vector<Key> keys;
    for (const Row& row : table_.rows) {
      if (row.member.empty() || !row.key.starts_with(before) || !belongs(row)) continue;
      const std::string rest = row.key.substr(before.size());
      const std::size_t dot = rest.find('.');
      if (dot != std::string::npos)
        group(rest.substr(0, dot), before, keys);
      else
        add(rest, row, keys);
    }
    return keys;
  }

 private:
  [[nodiscard]] bool belongs(const Row& row) const {
    if (!table_.tag.empty() && (row.key == table_.tag || (row.tag != nullptr && !has(row.kinds, kind_)))) return false;
    return !row.key.empty() || !row.x_key.empty();
  }

  void group(const std::string& name, const std::string& before, std::vector<Key>& keys) {
    if (std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; })) return;
    const auto group = std::find_if(table_.groups.begin(), table_.groups.end(), [&](const Group& one) { return one.key == before + name; });
    keys.push_back(absent(name, map(at(before + name + ".")), group->doc));
  }

  void add(const std::string& name, const Row& row, std::vector<Key>& keys) {
    if (name.empty()) {  // a curve among the other keys
      keys.push_back(absent(row.x_key, list(row.x, 2, row.form.max_items), "ascending; " + row.doc));
      keys.push_back(absent(row.y_key, list(row.y, 2, row.form.max_items), "one for each " + row.x_key + " of the table"));
      for (Key* key : {&keys[keys.size() - 2], &keys.back()}) key->member = row.member, key->stage = row.stage;
      return;
    }
    const auto other = std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.name == name; });
    if (other != keys.end()) {
      other->form = either({std::move(other->form), value_form(row, table_)});
      return;
    }
    const bool free = row.tag == nullptr || !table_.tag.empty();  // else the row holds for some kinds that a value says
    keys.push_back(key_of(name, row, table_, row.presence == Presence::required && free && row.file.empty()));
    if (row.file.empty()) return;
    keys.push_back(absent("file", text("a file", row.file), "a text file of these numbers, one row a line, beside the profile or below"));
    keys.back().member = row.member, keys.back().stage = row.stage;
  }

  const Table& table_;
  int kind_;
};

/// A map of the keys, with what they exclude: numbers and their file, ways to say one number.
ValueForm map_of(const Table& table, int kind) {
  ValueForm form = map(keys_of(table, kind));
  form.keys.insert(form.keys.end(), table.more.begin(), table.more.end());
  form.at_most_one = table.at_most_one, form.exactly_one = table.exactly_one, form.meant = table.meant;
  const auto there = [&](const Row& row) {
    return std::any_of(form.keys.begin(), form.keys.end(), [&](const Key& key) { return key.name == row.key && key.member == row.member; });
  };
  for (const Row& row : table.rows) {
    if (!row.file.empty() && there(row)) form.exactly_one = {row.key, "file"};
    const auto again = [&](const Row& other) { return other.key != row.key && other.member == row.member && there(other); };
    if (there(row) && std::any_of(table.rows.begin(), table.rows.end(), again)) form.at_most_one.push_back(row.key);
  }
  return form;
}

}  // namespace

std::vector<Key> keys_of(const Table& table, int kind) { return Keys(table, kind).at(""); }

ValueForm form_of(const Table& table) {
  if (table.tag.empty()) return map_of(table, all_kinds);
  const auto kind = std::find_if(table.rows.begin(), table.rows.end(), [&](const Row& row) { return row.key == table.tag; });
  ValueForm form;
  form.kind = Kind::tagged;
  form.tag = table.tag;
  form.names = kind->form.names;
  form.what = table.file;
  if (table.default_kind) form.default_tag = fallback(*kind, table);
  for (std::size_t i = 0; i < form.names.size(); ++i) form.forms.push_back(map_of(table, static_cast<int>(i)));
  return form;
}

}  // namespace tofray::model
