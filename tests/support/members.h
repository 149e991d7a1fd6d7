// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <string>
#include <variant>

#include "model/check.h"

/// Every member of a public struct and of those in it, by the tables: a member that is added tomorrow is tested, too.
namespace tofray::test {

/// Calls visit(row, slot, path) for every member, each once: structs and lists of structs before what is in them.
template <class Visit>
void each_member(const model::Table& table, void* record, const std::string& path, const Visit& visit) {
  for (const model::Row& row : table.rows) {
    const bool again = std::any_of(table.rows.data(), &row, [&](const model::Row& other) { return other.member == row.member; });
    if (again) continue;
    const model::Slot slot = row.slot(record);
    const std::string here = path + (path.empty() ? "" : ".") + row.name();
    visit(row, slot, here);
    if (const auto* one = std::get_if<model::RecordSlot>(&slot)) each_member(one->table(), one->at, here, visit);
    if (const auto* one = std::get_if<model::VariantSlot>(&slot))
      each_member(one->tables[one->index(one->at)](), one->held(one->at), here, visit);
    if (const auto* list = std::get_if<model::ListSlot>(&slot))
      for (std::size_t i = 0; i < list->size(list->at); ++i)
        each_member(list->table(), list->element(list->at, i), here + "[" + std::to_string(i) + "]", visit);
  }
}

template <class T, class Visit>
void each_member(T& record, const Visit& visit) {
  each_member(model::table_of<T>(), &record, "", visit);
}

/// Calls visit(number) for every double of a member.
template <class Visit>
void each_real(const model::Slot& slot, const Visit& visit) {
  const auto all = [&](auto& list) {
    for (double& one : list) visit(one);
  };
  if (auto* const* one = std::get_if<double*>(&slot)) visit(**one);
  if (auto* const* one = std::get_if<Vec3*>(&slot)) all(**one);
  if (auto* const* one = std::get_if<std::array<double, 2>*>(&slot)) all(**one);
  if (auto* const* one = std::get_if<std::optional<double>*>(&slot); one != nullptr && (*one)->has_value()) visit(***one);
  if (auto* const* one = std::get_if<std::optional<Vec3>*>(&slot); one != nullptr && (*one)->has_value()) all(***one);
  if (auto* const* one = std::get_if<std::vector<double>*>(&slot)) all(**one);
  if (auto* const* one = std::get_if<std::array<Vec3, 3>*>(&slot))
    for (Vec3& point : **one) all(point);
  if (const auto* one = std::get_if<model::CurveSlot>(&slot)) all(*one->x), all(*one->y);
  if (const auto* one = std::get_if<model::GridSlot>(&slot)) all(*one->samples);
}

}  // namespace tofray::test
