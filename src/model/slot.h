// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "tofray/camera.h"
#include "tofray/scene.h"

/// A member of a public struct, whatever its type: what reads, checks and writes members does so by visiting a Slot.
namespace tofray::model {

struct Table;

/// The table of a struct. Each struct has a specialisation (tables.h).
template <class T>
const Table& table_of();

/// The tables of all shapes, in the order of the variant Object::shape.
std::vector<const Table& (*)()> tables_of_shapes();

/// An enumeration, by the place of its name in the table.
struct ChoiceSlot {
  void* at;
  int (*get)(const void* at);
  void (*set)(void* at, int index);
};
/// Samples y over positions x.
struct CurveSlot {
  std::vector<double>*x, *y;
};
/// Samples row by row on a grid.
struct GridSlot {
  std::vector<double>* samples;
  int *rows, *columns;
};
/// A struct that has a table of its own.
struct RecordSlot {
  void* at;
  const Table& (*table)();
};
/// A list of such structs.
struct ListSlot {
  void* at;
  const Table& (*table)();
  std::size_t (*size)(const void* at);
  void (*resize)(void* at, std::size_t size);
  void* (*element)(void* at, std::size_t index);
};
/// One of several structs.
struct VariantSlot {
  void* at;
  std::vector<const Table& (*)()> tables;
  std::size_t (*index)(const void* at);
  void* (*held)(void* at);
  void (*emplace)(void* at, std::size_t index);
};

using Slot = std::variant<double*, int*, unsigned long long*, bool*, std::string*, Vec3*, std::optional<double>*, std::optional<Vec3>*,
                          std::optional<Quaternion>*, std::array<double, 2>*, std::array<Vec3, 3>*, std::vector<double>*, CurveSlot,
                          GridSlot, ChoiceSlot, RecordSlot, ListSlot, VariantSlot>;

template <class T>
Slot slot_of(T& member);

namespace detail {

template <class T>
Slot list_slot(std::vector<T>& list) {
  using List = std::vector<T>;
  return ListSlot{&list, &table_of<T>, [](const void* at) { return static_cast<const List*>(at)->size(); },
                  [](void* at, std::size_t size) { static_cast<List*>(at)->resize(size); },
                  [](void* at, std::size_t index) -> void* { return &(*static_cast<List*>(at))[index]; }};
}

template <class... T>
Slot variant_slot(std::variant<T...>& one) {
  using One = std::variant<T...>;
  static_assert(std::is_same_v<One, decltype(Object::shape)>, "there is one variant, and tables_of_shapes() knows its tables");
  return VariantSlot{&one, tables_of_shapes(), [](const void* at) { return static_cast<const One*>(at)->index(); },
                     [](void* at) { return std::visit([](auto& held) -> void* { return &held; }, *static_cast<One*>(at)); },
                     [](void* at, std::size_t index) {
                       static constexpr void (*make[])(One&) = {[](One& into) { into.template emplace<T>(); }...};
                       make[index](*static_cast<One*>(at));
                     }};
}

template <class T>
concept list_of_records = requires(T& list) {
  list_slot(list);
};
template <class T>
concept one_of_records = requires(T& one) {
  variant_slot(one);
};

}  // namespace detail

template <class T>
Slot slot_of(T& member) {
  if constexpr (std::is_constructible_v<Slot, T*>) {
    return &member;
  } else if constexpr (std::is_enum_v<T>) {
    return ChoiceSlot{&member, [](const void* at) { return static_cast<int>(*static_cast<const T*>(at)); },
                      [](void* at, int index) { *static_cast<T*>(at) = static_cast<T>(index); }};
  } else if constexpr (std::is_same_v<T, Curve>) {
    return CurveSlot{&member.x, &member.y};
  } else if constexpr (detail::list_of_records<T>) {
    return detail::list_slot(member);
  } else if constexpr (detail::one_of_records<T>) {
    return detail::variant_slot(member);
  } else {
    return RecordSlot{&member, &table_of<T>};
  }
}

}  // namespace tofray::model
