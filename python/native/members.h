// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// What the compiler knows of the public structs: how many members they have, what these are called, and references to them. Nothing is
/// listed here: a member is where its struct declares it.
namespace tofray::python {

namespace detail {

/// Stands for a member of any type.
struct Anything {
  template <class T>
  operator T() const;
};

template <class T, class... Member>
consteval std::size_t member_count() {
  if constexpr (requires { T{Member{}..., Anything{}}; }) {
    return member_count<T, Member..., Anything>();
  } else {
    return sizeof...(Member);
  }
}

/// The last name in what the compiler calls a function, before `end`.
constexpr std::string_view name_before(std::string_view all, std::size_t end) {
  const std::string_view names = all.substr(0, end);
  return names.substr(names.find_last_of(":.&( =") + 1);
}

/// "… [with T = tofray::Pixel]", "… [T = tofray::Pixel]"
template <class T>
constexpr std::string_view full_type_name() {
  constexpr std::string_view all = __PRETTY_FUNCTION__;
  constexpr std::size_t from = all.find("T = ") + 4;
  return all.substr(from, all.find_first_of(";]", from) - from);
}

template <class T>
inline constexpr bool is_named_as_ours = full_type_name<T>().starts_with("tofray::");

}  // namespace detail

/// A struct of ours, and no array.
template <class T>
concept Record = std::is_aggregate_v<T> && detail::is_named_as_ours<T>;

template <Record T>
inline constexpr std::size_t member_count = detail::member_count<T>();

/// References to all members.
template <class T>
requires Record<std::remove_const_t<T>>
constexpr auto members_of(T& record) {
  constexpr std::size_t count = member_count<std::remove_const_t<T>>;
  static_assert(count >= 1 && count <= 40, "members_of() has no line for so many members");
#define TOFRAY_SO_MANY(n, ...)    \
  if constexpr (count == n) {     \
    auto& [__VA_ARGS__] = record; \
    return std::tie(__VA_ARGS__); \
  }
  // clang-format off
  TOFRAY_SO_MANY(1, a)
  TOFRAY_SO_MANY(2, a, b)
  TOFRAY_SO_MANY(3, a, b, c)
  TOFRAY_SO_MANY(4, a, b, c, d)
  TOFRAY_SO_MANY(5, a, b, c, d, e)
  TOFRAY_SO_MANY(6, a, b, c, d, e, f)
  TOFRAY_SO_MANY(7, a, b, c, d, e, f, g)
  TOFRAY_SO_MANY(8, a, b, c, d, e, f, g, h)
  TOFRAY_SO_MANY(9, a, b, c, d, e, f, g, h, i)
  TOFRAY_SO_MANY(10, a, b, c, d, e, f, g, h, i, j)
  TOFRAY_SO_MANY(11, a, b, c, d, e, f, g, h, i, j, k)
  TOFRAY_SO_MANY(12, a, b, c, d, e, f, g, h, i, j, k, l)
  TOFRAY_SO_MANY(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
  TOFRAY_SO_MANY(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
  TOFRAY_SO_MANY(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
  TOFRAY_SO_MANY(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
  TOFRAY_SO_MANY(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
  TOFRAY_SO_MANY(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
  TOFRAY_SO_MANY(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
  TOFRAY_SO_MANY(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
  TOFRAY_SO_MANY(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
  TOFRAY_SO_MANY(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
  TOFRAY_SO_MANY(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
  TOFRAY_SO_MANY(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
  TOFRAY_SO_MANY(25, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y)
  TOFRAY_SO_MANY(26, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z)
  TOFRAY_SO_MANY(27, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A)
  TOFRAY_SO_MANY(28, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B)
  TOFRAY_SO_MANY(29, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C)
  TOFRAY_SO_MANY(30, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D)
  TOFRAY_SO_MANY(31, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E)
  TOFRAY_SO_MANY(32, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F)
  TOFRAY_SO_MANY(33, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G)
  TOFRAY_SO_MANY(34, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H)
  TOFRAY_SO_MANY(35, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H, I)
  TOFRAY_SO_MANY(36, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H, I, J)
  TOFRAY_SO_MANY(37, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H, I, J, K)
  TOFRAY_SO_MANY(38, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H, I, J, K, L)
  TOFRAY_SO_MANY(39, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H, I, J, K, L, M)
  TOFRAY_SO_MANY(40, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x, y, z, A, B, C, D, E, F, G, H, I, J, K, L, M, N)
  // clang-format on
#undef TOFRAY_SO_MANY
}

template <Record T>
using MembersOf = decltype(members_of(std::declval<T&>()));

namespace detail {

/// Declared, and never made: addresses of its members are constants all the same, and the compiler writes such a constant with its name.
template <class T>
struct Nowhere {
  T record;
};
template <class T>
extern const Nowhere<T> nowhere;

template <class Member>
struct Address {
  Member at;
};

#ifdef __clang__
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wundefined-var-template"
#endif
template <class T, std::size_t I>
constexpr auto address_of_member() {
  const auto* const at = &std::get<I>(members_of(nowhere<T>.record));
  return Address<decltype(at)>{at};
}
#ifdef __clang__
#pragma clang diagnostic pop
#endif

/// "… {(& nowhere<tofray::Pixel>.…::record.tofray::Pixel::read_noise_e)} …", "… {&nowhere.record.read_noise_e}]"
template <auto At>
constexpr std::string_view name_at() {
  constexpr std::string_view all = __PRETTY_FUNCTION__;
  constexpr std::size_t brace = all.rfind('}');
  return name_before(all, all[brace - 1] == ')' ? brace - 1 : brace);
}

}  // namespace detail

/// Names of all members.
template <Record T>
inline constexpr auto member_names = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<std::string_view, sizeof...(I)>{detail::name_at<detail::address_of_member<T, I>()>()...};
}
(std::make_index_sequence<member_count<T>>());

/// Two names that are known.
struct NamesKnown {
  int first;
  std::string second_name;
};
static_assert(member_names<NamesKnown> == std::array<std::string_view, 2>{"first", "second_name"}, "this compiler writes names otherwise");

template <Record T>
std::string record_name() {
  constexpr std::string_view full = detail::full_type_name<T>();
  return std::string(detail::name_before(full, full.size()));
}

/// Calls with each member: its name, and a reference to it.
template <class T, class Call>
void each_member(T& record, const Call& call) {
  const auto& names = member_names<std::remove_const_t<T>>;
  std::apply(
      [&](auto&... member) {
        std::size_t i = 0;
        (call(names[i++], member), ...);
      },
      members_of(record));
}

/// Empty where the enumeration has no such value: compilers write a number in brackets then.
template <auto E>
constexpr std::string_view enumerator_name() {
  constexpr std::string_view all = __PRETTY_FUNCTION__;
  constexpr std::size_t from = all.find("E = "), end = all.find_first_of(";]", from);
  if (all.substr(from, end - from).find(')') != std::string_view::npos) return {};  // "(tofray::Noise)7"
  return detail::name_before(all, end);
}

/// The names of an enumeration that counts from 0 on, at the places of their values.
inline constexpr std::size_t most_enumerators = 16;
template <class E>
constexpr auto enumerators() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<std::string_view, sizeof...(I)>{enumerator_name<static_cast<E>(I)>()...};
  }
  (std::make_index_sequence<most_enumerators>());
}

// Which structs there are: those that some are made of.

template <class... T>
struct Types {};

namespace detail {

/// What a type is made of.
template <class T>
struct Parts {
  using All = Types<>;
};
template <class T>
struct Parts<std::vector<T>> {
  using All = Types<T>;
};
template <class T>
struct Parts<std::optional<T>> {
  using All = Types<T>;
};
template <class A, class B>
struct Parts<std::pair<A, B>> {
  using All = Types<A, B>;
};
template <class... T>
struct Parts<std::variant<T...>> {
  using All = Types<T...>;
};
template <class... T>
struct Parts<std::tuple<T&...>> {
  using All = Types<T...>;
};
template <Record T>
struct Parts<T> {
  using All = typename Parts<MembersOf<T>>::All;
};

template <class... Known>
constexpr Types<Known...> with_parts(Types<Known...> known, Types<>) {
  return known;
}
template <class... Known, class First, class... Rest>
constexpr auto with_parts(Types<Known...> known, Types<First, Rest...>) {
  if constexpr ((std::is_same_v<First, Known> || ...)) {
    return with_parts(known, Types<Rest...>{});
  } else {
    using Below = decltype(with_parts(known, typename Parts<First>::All{}));
    if constexpr (Record<First>) {
      return []<class... All>(Types<All...>) { return with_parts(Types<All..., First>{}, Types<Rest...>{}); }(Below{});
    } else {
      return with_parts(Below{}, Types<Rest...>{});
    }
  }
}

}  // namespace detail

/// These structs and all that they are made of, each once and behind its own parts.
template <class... T>
using WithParts = decltype(detail::with_parts(Types<>{}, Types<T...>{}));

}  // namespace tofray::python
