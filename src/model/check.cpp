// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/check.h"

#include <algorithm>
#include <type_traits>

#include "base/text.h"
#include "base/vec.h"

namespace tofray::model {

namespace {

using base::number_text;

template <class T>
constexpr bool is_number = std::is_same_v<T, double> || std::is_same_v<T, int> || std::is_same_v<T, unsigned long long>;

/// Calls visit(number, part, index) for every number of a member, until it returns false.
template <class Visit>
void each_number(const Slot& slot, const Visit& visit) {
  const auto list = [&](const auto& values, Spot::Part part) {
    long long index = 0;
    for (const double value : values)
      if (!visit(value, part, index++)) return;
  };
  std::visit(
      [&](const auto& one) {
        using One = std::decay_t<decltype(one)>;
        if constexpr (std::is_pointer_v<One>) {
          using Member = std::remove_pointer_t<One>;
          if constexpr (is_number<Member>)
            visit(static_cast<double>(*one), Spot::whole, -1LL);
          else if constexpr (std::is_same_v<Member, Vec3> || std::is_same_v<Member, std::array<double, 2>> ||
                             std::is_same_v<Member, std::vector<double>>)
            list(*one, Spot::whole);
          else if constexpr (std::is_same_v<Member, std::optional<double>>)
            one->has_value() ? void(visit(**one, Spot::whole, -1LL)) : void();
          else if constexpr (std::is_same_v<Member, std::optional<Vec3>> || std::is_same_v<Member, std::optional<Quaternion>>)
            one->has_value() ? list(**one, Spot::whole) : void();
          else if constexpr (std::is_same_v<Member, std::array<Vec3, 3>>)
            for (const Vec3& point : *one) list(point, Spot::whole);
        } else if constexpr (std::is_same_v<One, CurveSlot>) {
          if (one.x->size() > 1) list(*one.x, Spot::x);  // where a single sample stands means nothing
          list(*one.y, Spot::y);
        } else if constexpr (std::is_same_v<One, GridSlot>) {
          list(*one.samples, Spot::whole);
        }
      },
      slot);
}

/// What one number of the row may be.
const ValueForm& number_form(const ValueForm& form) { return form.forms.empty() ? form : number_form(form.forms[0]); }

bool same(const Slot& a, const Slot& b) {
  return std::visit(
      [&](const auto& one) {
        using One = std::decay_t<decltype(one)>;
        const One& other = std::get<One>(b);
        if constexpr (std::is_pointer_v<One>)
          return *one == *other;
        else if constexpr (std::is_same_v<One, CurveSlot>)
          return *one.x == *other.x && *one.y == *other.y;
        else if constexpr (std::is_same_v<One, GridSlot>)
          return *one.samples == *other.samples;
        else if constexpr (std::is_same_v<One, ChoiceSlot>)
          return one.get(one.at) == other.get(other.at);
        else
          return false;
      },
      a);
}

class Checker {
 public:
  Checker(const Table& table, const void* record, Complaints& complaints) : table_(table), record_(record), complaints_(complaints) {}

  void row(const Row& row, bool sound) {
    const Slot slot = slot_of(row, record_);
    below(row, slot, sound);
    if (!sound || unused(row, slot)) return;
    if (const auto* list = std::get_if<std::vector<double>*>(&slot); list != nullptr && !count(row, (*list)->size())) return;
    if (const auto* choice = std::get_if<ChoiceSlot>(&slot)) known(row, choice->get(choice->at));
    if (!numbers(row, slot)) return;
    if (const auto* curve = std::get_if<CurveSlot>(&slot)) samples(row, *curve);
    if (row.direction) length(row, slot);
  }

 private:
  /// A member that another kind uses, or that may be missing, is as the struct begins with; or another row says what it may be.
  [[nodiscard]] bool unused(const Row& row, const Slot& slot) const {
    const bool idle = !applies(row, record_);
    const auto instead = [&](const Row& other) { return &other != &row && other.member == row.member && applies(other, record_); };
    if (idle && std::any_of(table_.rows.begin(), table_.rows.end(), instead)) return true;
    return (idle || row.presence == Presence::absent) && same(slot, slot_of(row, table_.fresh));
  }

  [[nodiscard]] Spot spot(const Row& row, Spot::Part part = Spot::whole, long long index = -1) const {
    return {record_, &table_, &row, part, index};
  }

  void below(const Row& row, const Slot& slot, bool sound) {
    if (const auto* record = std::get_if<RecordSlot>(&slot)) check(record->table(), record->at, complaints_);
    if (const auto* one = std::get_if<VariantSlot>(&slot)) check(one->tables[one->index(one->at)](), one->held(one->at), complaints_);
    if (const auto* list = std::get_if<ListSlot>(&slot)) {
      const std::size_t size = list->size(list->at);
      if (sound && !count(row, size)) return;
      for (std::size_t i = 0; i < size; ++i) check(list->table(), list->element(list->at, i), complaints_);
    }
  }

  void known(const Row& row, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= row.form.names.size())
      complaints_.add_named(spot(row), " is none of its values",
                            "got " + std::to_string(index) + ", expected " + base::listed(row.form.names), ErrorKind::bad_input);
  }

  bool count(const Row& row, std::size_t size) {
    const auto number = static_cast<long long>(size);
    if (number > row.form.max_items)
      complaints_.add_named(spot(row), " has too many elements",
                            "got " + std::to_string(size) + ", at most " + std::to_string(row.form.max_items), ErrorKind::limit);
    else if (number < row.form.min_items)
      complaints_.add_named(spot(row), " has too few elements",
                            "got " + std::to_string(size) + ", expected at least " + std::to_string(row.form.min_items),
                            ErrorKind::bad_input);
    else
      return true;
    return false;
  }

  bool numbers(const Row& row, const Slot& slot) {
    bool good = true;
    each_number(slot, [&](double value, Spot::Part part, long long index) {
      const ValueForm& form = part == Spot::x ? row.x : part == Spot::y ? row.y : number_form(row.form);
      if (value >= form.low && value <= form.high) return true;  // NaN: no
      complaints_.add_named(spot(row, part, index), " is out of range",
                            "got " + number_text(value) + ", expected " + number_text(form.low) + " to " + number_text(form.high),
                            ErrorKind::bad_input);
      return good = false;
    });
    return good;
  }

  void samples(const Row& row, const CurveSlot& curve) {
    const std::vector<double>&x = *curve.x, &y = *curve.y;
    if (x.size() != y.size() || x.empty()) {
      complaints_.add(spot(row, Spot::y), row.y_key + " is not as long as " + row.x_key,
                      "got " + std::to_string(y.size()) + " and " + std::to_string(x.size()) + " elements, expected one for each",
                      ErrorKind::bad_input);
      return;
    }
    if (y.size() > static_cast<std::size_t>(row.form.max_items))
      complaints_.add_named(spot(row), " has too many samples",
                            "got " + std::to_string(y.size()) + ", at most " + std::to_string(row.form.max_items), ErrorKind::limit);
    for (std::size_t i = 1; i < x.size(); ++i) {
      if (x[i] > x[i - 1]) continue;
      complaints_.add(spot(row, Spot::x, static_cast<long long>(i)), row.x_key + " does not ascend",
                      "got " + number_text(x[i]) + " after " + number_text(x[i - 1]), ErrorKind::bad_input);
      return;
    }
  }

  void length(const Row& row, const Slot& slot) {
    const auto* maybe = std::get_if<std::optional<Vec3>*>(&slot);
    const Vec3& v = maybe != nullptr ? ***maybe : *std::get<Vec3*>(slot);
    if (base::length(v) >= base::shortest_m) return;
    complaints_.add_named(
        spot(row), " has no length",
        "got [" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + "], expected a direction such as [0, 0, 1]",
        ErrorKind::bad_input);
  }

  const Table& table_;
  const void* record_;
  Complaints& complaints_;
};

/// The path of a struct below another one: "illumination[1].waveform"; false where it is not below.
bool path_to(const Table& table, const void* record, const Spot& wanted, std::string& path) {
  if (record == wanted.record && &table == wanted.table) return true;
  const std::string before = path.empty() ? path : path + ".";
  for (const Row& row : table.rows) {
    const Slot slot = slot_of(row, record);
    const auto at = [&](const Table& below, const void* there, const std::string& suffix) {
      std::string longer = before + row.name() + suffix;
      if (!path_to(below, there, wanted, longer)) return false;
      path = longer;
      return true;
    };
    if (const auto* one = std::get_if<RecordSlot>(&slot); one != nullptr && at(one->table(), one->at, "")) return true;
    if (const auto* one = std::get_if<VariantSlot>(&slot); one != nullptr && at(one->tables[one->index(one->at)](), one->held(one->at), ""))
      return true;
    if (const auto* list = std::get_if<ListSlot>(&slot))
      for (std::size_t i = 0; i < list->size(list->at); ++i)
        if (at(list->table(), list->element(list->at, i), "[" + std::to_string(i) + "]")) return true;
  }
  return false;
}

/// The first fault ends it.
class InCode : public Complaints {
 public:
  InCode(const Table& table, const void* record, const std::string& name) : table_(table), record_(record), name_(name) {}
  using Complaints::add;
  void add(const Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) override {
    const std::string where = path(spot);
    throw Error(kind, "error: " + where + (where.empty() ? "" : ": ") + what + "\n  " + more);
  }
  void add_named(const Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) override {
    throw Error(kind, "error: " + path(spot) + what + "\n  " + more);
  }

 private:
  [[nodiscard]] std::string path(const Spot& spot) const {
    std::string text = name_;
    path_to(table_, record_, spot, text);
    if (spot.row == nullptr) return text;
    const bool two = !spot.row->second.empty();
    text += (text.empty() ? "" : ".") +
            (two && spot.part == Spot::y ? spot.row->second.substr(spot.row->second.rfind(':') + 1) : spot.row->name());
    if (!two && spot.part != Spot::whole) text += spot.part == Spot::x ? ".x" : ".y";
    return spot.index < 0 ? text : text + "[" + std::to_string(spot.index) + "]";
  }

  const Table& table_;
  const void* record_;
  std::string name_;
};

}  // namespace

const void* address(const Slot& slot) {
  return std::visit(
      [](const auto& one) -> const void* {
        using One = std::decay_t<decltype(one)>;
        if constexpr (std::is_pointer_v<One>)
          return one;
        else if constexpr (std::is_same_v<One, CurveSlot>)
          return one.x;
        else if constexpr (std::is_same_v<One, GridSlot>)
          return one.samples;
        else
          return one.at;
      },
      slot);
}

const Row* Complaints::row_of(const Table& table, const void* record, const void* member) {
  const auto found =
      std::find_if(table.rows.begin(), table.rows.end(), [&](const Row& row) { return address(slot_of(row, record)) == member; });
  return found == table.rows.end() ? nullptr : &*found;
}

bool applies(const Row& row, const void* record) {
  if (row.tag == nullptr) return true;
  const Slot tag = row.tag(const_cast<void*>(record));
  const auto* choice = std::get_if<ChoiceSlot>(&tag);
  const int kind = choice != nullptr ? choice->get(choice->at) : *std::get<bool*>(tag);
  return std::find(row.kinds.begin(), row.kinds.end(), kind) != row.kinds.end();
}

void check(const Table& table, const void* record, Complaints& complaints) {
  const bool sound = complaints.is_sound(record, table);
  for (const Row& row : table.rows) Checker(table, record, complaints).row(row, sound);
  if (sound && table.rule) table.rule(record, complaints);
}

void check_in_code(const Table& table, const void* record, const std::string& name) {
  InCode complaints(table, record, name);
  check(table, record, complaints);
}

}  // namespace tofray::model
