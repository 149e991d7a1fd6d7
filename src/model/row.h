// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/form.h"
#include "model/slot.h"
#include "tofray/frame_arrays.h"

/// One row for each member of the public structs that users can set: what files call it, what it may be, what it means.
///
/// From the rows come the file reader, the checks of files and of structs set in code, `meta` both ways, JSON Schema, the reference pages,
/// completion and the tests' values.
namespace tofray::model {

/// What a number is: its dimension, its range in SI units, and one as people write it, whose unit messages and pages use.
struct Number {
  base::Dimension dimension;
  base::Range range;
  const char* example;
  bool bare = false;  ///< also where it has a unit, one may leave the unit away (SI)
};
ValueForm form_of(const Number& number);
ValueForm whole_number(const Number& number);

enum class Presence {
  required,
  optional,  ///< the struct's own value holds where the file is silent
  absent,    ///< may be missing, and the row's line says what then holds
};

struct Row {
  std::string key;     ///< in files, dotted where it stands in a map of its own; empty: files have no such key
  std::string member;  ///< in code, with its struct: "Pixel::read_noise_e"
  std::string second;  ///< of a curve in two members: the one of its values
  Slot (*slot)(void* record) = nullptr;
  ValueForm form;  ///< of what the file says
  std::string doc;
  Presence presence = Presence::optional;
  bool in_meta = true;
  bool meta_if_set = false;              ///< `meta` has it only where it is not as in a fresh struct
  std::vector<std::string> in_place_of;  ///< members that count for nothing where this one is given, and that `meta` then leaves out
  bool direction = false;                ///< has to have a length
  bool scales_lengths = false;           ///< all lengths of the struct are multiplied by it
  std::string file;                      ///< the numbers may be in a text file, under the key `file`, called for instance this
  std::optional<Stage> stage;  ///< the first stage of a frame that looks at it; none: as what it is a part of, in the end the first of all
  ValueForm otherwise;         ///< of a list of structs: what may stand in its place, which the reader of files makes such a list of
  // of a curve
  std::string x_key, y_key;
  ValueForm x, y;
  // where the struct has several kinds: the member that says which, and the ones that this row belongs to
  Slot (*tag)(void* record) = nullptr;
  std::vector<int> kinds;

  /// The member as `meta` calls it.
  [[nodiscard]] std::string name() const { return member.substr(member.rfind(':') + 1); }
};

/// A map within a struct's map, and its line.
struct Group {
  std::string key, doc;
};

/// The row's member of a struct that stays as it is.
inline Slot slot_of(const Row& row, const void* record) { return row.slot(const_cast<void*>(record)); }
/// Whether the row belongs to the kind that the struct is of.
bool applies(const Row& row, const void* record);

class Complaints;
/// Whether the file said a member.
using Given = std::function<bool(const void* member)>;

struct Table {
  std::vector<Row> rows;
  std::vector<Group> groups;
  std::vector<std::string> without_row;                       ///< members that users do not set
  int member_count = 0;                                       ///< of the struct
  const void* fresh = nullptr;                                ///< a struct as it is when nothing was set
  std::string tag;                                            ///< the key that says which kind it is; empty: there is but one
  std::string file;                                           ///< of several kinds: a text may stand for it that is this file's name
  bool default_kind = false;                                  ///< where the key is missing, the fresh struct's kind holds
  std::vector<Key> more;                                      ///< further keys of files: the reader makes members of them
  std::vector<std::string> at_most_one, exactly_one;          ///< of the keys, those of `more` too
  std::vector<std::pair<std::string, std::string>> meant;     ///< unknown keys that people try, and what they mean
  std::function<void(const void* record, Complaints&)> rule;  ///< what has to hold between members
  std::function<void(void* record, const Given&)> complete;   ///< members that follow from others unless the file gives them

  /// @param rule   called where every number by itself is good
  template <class T>
  Table& check_with(void (*rule)(const T&, Complaints&));
  template <class T>
  Table& complete_with(void (*complete)(T&, const Given&));
  Table& and_keys(std::vector<Key> keys) {
    more = std::move(keys);
    return *this;
  }
  Table& with_at_most_one(std::vector<std::string> keys) {
    at_most_one = std::move(keys);
    return *this;
  }
  Table& with_exactly_one(std::vector<std::string> keys) {
    exactly_one = std::move(keys);
    return *this;
  }
  Table& with_meant(std::vector<std::pair<std::string, std::string>> words) {
    meant = std::move(words);
    return *this;
  }
  /// A text that is no kind's name is a file with such a struct: this is what it is.
  Table& or_a_file(std::string what) {
    file = std::move(what);
    return *this;
  }
  Table& kind_may_be_missing() {
    default_kind = true;
    return *this;
  }
};

template <class T>
Table& Table::check_with(void (*wanted)(const T&, Complaints&)) {
  rule = [wanted](const void* record, Complaints& complaints) { wanted(*static_cast<const T*>(record), complaints); };
  return *this;
}

template <class T>
Table& Table::complete_with(void (*wanted)(T&, const Given&)) {
  complete = [wanted](void* record, const Given& given) { wanted(*static_cast<T*>(record), given); };
  return *this;
}

namespace detail {

template <class M>
struct Of;
template <class R, class M>
struct Of<M R::*> {
  using Record = R;
  using Member = M;
};

template <auto M>
Slot slot_at(void* record) {
  return slot_of(static_cast<typename Of<decltype(M)>::Record*>(record)->*M);
}

/// "Pixel::read_noise_e" out of what the compiler calls this function.
template <auto M>
std::string member_text() {
  const std::string_view all = __PRETTY_FUNCTION__, mark = "M = &tofray::";
  const std::size_t from = all.find(mark) + mark.size();
  return std::string(all.substr(from, all.find_first_of(";]", from) - from));
}

/// Stands for a member of any type.
struct Anything {
  template <class T>
  operator T() const;
};

template <class T, class... Member>
consteval int member_count() {
  if constexpr (requires { T{Member{}..., Anything{}}; }) {
    return member_count<T, Member..., Anything>();
  } else {
    return sizeof...(Member);
  }
}

}  // namespace detail

/// Rows that stand for so many members of a struct.
template <int Members>
struct Rows {
  std::vector<Row> rows;
  std::vector<Group> groups;
  std::string tag;
  std::vector<std::string> without_row;

  Rows required() && { return std::move(*this).with(&Row::presence, Presence::required); }
  Rows absent() && { return std::move(*this).with(&Row::presence, Presence::absent); }
  Rows not_in_meta() && { return std::move(*this).with(&Row::in_meta, false); }
  Rows in_meta_if_set() && { return std::move(*this).with(&Row::meta_if_set, true); }
  Rows in_place_of(std::vector<std::string> members) && { return std::move(*this).with(&Row::in_place_of, members); }
  Rows or_else(ValueForm form) && { return std::move(*this).with(&Row::otherwise, form); }
  /// Its numbers may also be in a text file.
  Rows or_file(const char* example) && { return std::move(*this).with(&Row::file, std::string(example)); }
  Rows scales_lengths() && { return std::move(*this).with(&Row::scales_lengths, true); }
  Rows direction() && { return std::move(*this).with(&Row::direction, true); }
  /// No stage of a frame before this one looks at it.
  Rows since(Stage stage) && {
    for (Row& row : rows)
      if (!row.stage) row.stage = stage;
    return std::move(*this);
  }
  /// Only where the member Tag has one of these values.
  template <auto Tag, class... Kind>
  Rows when(Kind... kinds) && {
    for (Row& row : rows) row.tag = &detail::slot_at<Tag>, row.kinds = {static_cast<int>(kinds)...};
    return std::move(*this);
  }

 private:
  template <class Field>
  Rows with(Field Row::*field, const Field& value) && {
    for (Row& row : rows) row.*field = value;
    return std::move(*this);
  }
};

namespace detail {
template <auto M>
Rows<1> row(const char* key, ValueForm form, const char* doc) {
  Row one;
  one.key = key, one.member = member_text<M>(), one.slot = &slot_at<M>, one.form = std::move(form), one.doc = doc;
  return {{std::move(one)}, {}, {}, {}};
}
}  // namespace detail

/// A number, a whole number, two lengths, three coordinates, three points, a quaternion: what the member is.
template <auto M>
Rows<1> number(const char* key, const Number& number, const char* doc) {
  using Member = typename detail::Of<decltype(M)>::Member;
  const ValueForm one = form_of(number);
  if constexpr (std::is_integral_v<Member>) {
    return detail::row<M>(key, whole_number(number), doc);
  } else if constexpr (std::is_same_v<Member, double> || std::is_same_v<Member, std::optional<double>>) {
    return detail::row<M>(key, one, doc);
  } else if constexpr (std::is_same_v<Member, std::array<Vec3, 3>>) {
    return detail::row<M>(key, list(list(one, 3, 3), 3, 3), doc);
  } else if constexpr (std::is_same_v<Member, std::array<double, 2>>) {
    return detail::row<M>(key, list(one, 2, 2), doc);
  } else if constexpr (std::is_same_v<Member, std::optional<Quaternion>>) {
    return detail::row<M>(key, list(one, 4, 4), doc);
  } else {
    return detail::row<M>(key, list(one, 3, 3), doc);
  }
}

/// A number; in files also a list of them, which makes several structs of one.
template <auto M>
Rows<1> number_or_list(const char* key, const Number& number, int most, const char* doc) {
  return detail::row<M>(key, either({form_of(number), list(form_of(number), 1, most)}), doc);
}

template <auto M>
Rows<1> numbers(const char* key, const Number& number, int least, int most, const char* doc) {
  return detail::row<M>(key, list(form_of(number), least, most), doc);
}

/// Rows of numbers, each as long as the others; Count members hold how many.
template <auto M, auto RowCount, auto ColumnCount>
Rows<1> grid(const char* key, const Number& number, int least, int most, const char* doc) {
  Rows<1> out = detail::row<M>(key, list(list(form_of(number), least, most), least, most), doc);
  out.rows[0].slot = [](void* record) -> Slot {
    auto& one = *static_cast<typename detail::Of<decltype(M)>::Record*>(record);
    return GridSlot{&(one.*M), &(one.*RowCount), &(one.*ColumnCount)};
  };
  return out;
}

template <auto M>
Rows<1> flag(const char* key, const char* doc) {
  return detail::row<M>(key, boolean(), doc);
}

template <auto M>
Rows<1> words(const char* key, const char* what, const char* example, const char* doc) {
  return detail::row<M>(key, text(what, example), doc);
}

/// One of `names`, in the order of the enumeration. A row with the same key and .when(…) takes its kind's name out of the files.
template <auto M>
Rows<1> choice(const char* key, std::vector<std::string> names, const char* doc) {
  return detail::row<M>(key, choice(std::move(names)), doc);
}

/// The choice that says which of the other rows there are.
template <auto M>
Rows<1> kind(const char* key, std::vector<std::string> names) {
  Rows<1> out = choice<M>(key, std::move(names), "");
  out.tag = key;
  return out;
}

/// A struct with a table of its own.
template <auto M>
Rows<1> record(const char* key, const char* doc) {
  return detail::row<M>(key, {}, doc);
}

/// A list of such structs.
template <auto M>
Rows<1> records(const char* key, int least, int most, const char* doc) {
  return detail::row<M>(key, list({}, least, most), doc);
}

/// One of several structs, by name.
template <auto M>
Rows<1> one_of(std::vector<std::string> names) {
  ValueForm form;
  form.kind = ValueForm::Kind::variant, form.names = std::move(names);
  return detail::row<M>("", std::move(form), "");
}

/// Samples: a map of two lists; where the key is empty, the two lists stand among the other keys.
struct Axis {
  const char* key;
  Number number;
};
enum class Constant { no, allowed };  ///< whether one number alone is good, too
Rows<1> curve_row(Row row, const Axis& x, const Axis& y, Constant constant);

template <auto M>
Rows<1> curve(const char* key, const Axis& x, const Axis& y, const char* doc, Constant constant = Constant::no) {
  return curve_row(std::move(detail::row<M>(key, {}, doc).rows[0]), x, y, constant);
}

/// A curve whose positions and values are members of their own.
template <auto X, auto Y>
Rows<2> curve_of_two(const char* key, const Axis& x, const Axis& y, const char* doc) {
  Row row = std::move(detail::row<X>(key, {}, doc).rows[0]);
  row.second = detail::member_text<Y>();
  row.slot = [](void* record) -> Slot {
    auto& one = *static_cast<typename detail::Of<decltype(X)>::Record*>(record);
    return CurveSlot{&(one.*X), &(one.*Y)};
  };
  return {std::move(curve_row(std::move(row), x, y, Constant::no).rows), {}, {}, {}};
}

/// A further way of files to say a member that has its row.
template <int Members>
Rows<0> also(Rows<Members> rows) {
  return {std::move(rows.rows), {}, {}, {}};
}

/// Members that no row is for, and why.
template <auto... M>
Rows<static_cast<int>(sizeof...(M))> no_row(const char* /*why*/) {
  return {{}, {}, {}, {detail::member_text<M>()...}};
}

/// A map within the struct's map.
template <int... Members>
Rows<(Members + ...)> group(const std::string& key, const char* doc, Rows<Members>... rows) {
  Rows<(Members + ...)> out;
  out.groups.push_back({key, doc});
  const auto take = [&](auto& from) {
    for (Row& row : from.rows) row.key = key + "." + row.key, out.rows.push_back(std::move(row));
  };
  (take(rows), ...);
  return out;
}

/// The table of a struct. A member without a row does not compile.
template <class T, int... Members>
Table table(Rows<Members>... rows) {
  static_assert((Members + ...) == detail::member_count<T>(), "every member of the struct needs its row (or no_row)");
  static const T fresh{};
  Table out;
  out.fresh = &fresh, out.member_count = detail::member_count<T>();
  const auto take = [&](auto& from) {
    for (Row& row : from.rows) out.rows.push_back(std::move(row));
    for (Group& one : from.groups) out.groups.push_back(std::move(one));
    for (std::string& one : from.without_row) out.without_row.push_back(std::move(one));
    if (!from.tag.empty()) out.tag = from.tag;
  };
  (take(rows), ...);
  return out;
}

}  // namespace tofray::model
