// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/member_rows.h"

#include <set>

#include "base/units.h"
#include "model/tables.h"

namespace tofray::model {

namespace {

/// The numbers that a form is made of; none where it has none.
const ValueForm* numbers_of(const ValueForm& form) {
  using enum ValueForm::Kind;
  if (form.kind == number || form.kind == integer) return &form;
  return form.kind == list || form.kind == either ? numbers_of(form.forms[0]) : nullptr;
}

MemberNumbers numbers_said(const std::string& name, const ValueForm& form) {
  return {name, base::si_unit(form.dimension), form.low, form.high};
}

class RowsByMember {
 public:
  MemberRows all;

  void at(const Table& table) {
    if (!seen_.insert(&table).second) return;
    for (const Row& row : table.rows) {
      add(row, table);
      const Slot slot = slot_of(row, table.fresh);
      if (const auto* record = std::get_if<RecordSlot>(&slot)) at(record->table());
      if (const auto* list = std::get_if<ListSlot>(&slot)) at(list->table());
      if (const auto* variant = std::get_if<VariantSlot>(&slot))
        for (const auto& one : variant->tables) at(one());
    }
    all.without_row.insert(all.without_row.end(), table.without_row.begin(), table.without_row.end());
  }

 private:
  void add(const Row& row, const Table& table) {
    const std::string record = row.member.substr(0, row.member.find(':'));
    MemberRow one{record, row.name(), row.key, row.doc, {}, {}, row.kinds, row.presence == Presence::absent, {}};
    for (const Group& group : table.groups)
      if (row.key.starts_with(group.key + ".")) one.group = group.doc;
    for (const Row& other : table.rows)
      if (row.tag != nullptr && other.slot == row.tag) one.tag = other.name();
    if (row.x_key.empty()) {
      if (const ValueForm* const form = numbers_of(row.form)) one.numbers.push_back(numbers_said("", *form));
    } else if (row.second.empty()) {
      one.numbers = {numbers_said(row.x_key, row.x), numbers_said(row.y_key, row.y)};
    } else {  // positions are a member of their own, and values another one
      one.numbers = {numbers_said("", row.x)};
      all.rows.push_back(one);
      one.member = row.second.substr(row.second.rfind(':') + 1);
      one.numbers = {numbers_said("", row.y)};
    }
    all.rows.push_back(std::move(one));
  }

  std::set<const Table*> seen_;
};

}  // namespace

MemberRows member_rows() {
  RowsByMember walk;
  walk.at(table_of<Camera>());
  walk.at(table_of<Scene>());
  return std::move(walk.all);
}

}  // namespace tofray::model
