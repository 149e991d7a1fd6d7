// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>

/// Woven into a copy of the sources by weave.py, and included in front of every file there: each mutant has a number, and the environment
/// variable TOFRAY_MUTANT says which of them is switched on. One build holds hundreds of mutants.
extern "C" {
extern int tofray_mutant;                   ///< the one that is on; 0 for none
extern unsigned char tofray_mutant_seen[];  ///< for each: bit 0 where its place was reached, bit 1 where it cannot be there (`text - text`)
}

namespace tofray_mutation {

#define TOFRAY_MUTATION_FN __attribute__((always_inline)) inline constexpr

/// Constants of the compiler (array sizes, template arguments) stay as they are, and do not count as reached.
template <int N>
TOFRAY_MUTATION_FN bool on() {
  if (__builtin_is_constant_evaluated()) return false;
  tofray_mutant_seen[N] |= 1;
  return tofray_mutant == N;
}
/// There is no such mutant of these types.
template <int N>
TOFRAY_MUTATION_FN void none() {
  if (!__builtin_is_constant_evaluated()) tofray_mutant_seen[N] |= 2;
}

template <class A>
struct PlainOf {
  using Type = A;
};
template <class A>
struct PlainOf<A&> {
  using Type = A;
};
template <class A>
struct PlainOf<const A&> {
  using Type = A;
};
template <class A>
struct PlainOf<const A> {
  using Type = A;
};
template <class A>
using Plain = typename PlainOf<A>::Type;

}  // namespace tofray_mutation

// Arrays are looked up in std; the operators of base/vec.h have to be named.
namespace tofray::base {
inline std::array<double, 3> operator+(const std::array<double, 3>&, const std::array<double, 3>&);
inline std::array<double, 3> operator-(const std::array<double, 3>&, const std::array<double, 3>&);
inline std::array<double, 3> operator*(double, const std::array<double, 3>&);
inline std::array<double, 3> operator*(const std::array<std::array<double, 3>, 3>&, const std::array<double, 3>&);
}  // namespace tofray::base

namespace tofray_mutation {

using tofray::base::operator+;
using tofray::base::operator-;
using tofray::base::operator*;

// A binary operator: `a + b` becomes `a + At<7, Minus>{} + b`, which leaves precedence as it is.
template <int N, class Other>
struct At {};
template <int N, class Other, class A>
struct Left {
  A&& a;
};

struct Plus {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a + b) {
    return a + b;
  }
};
struct Minus {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a - b) {
    return a - b;
  }
};
struct Times {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a * b) {
    return a * b;
  }
};
struct Over {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a / b) {
    return a / b;
  }
};
struct Less {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a < b) {
    return a < b;
  }
};
struct LessEqual {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a <= b) {
    return a <= b;
  }
};
struct Greater {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a > b) {
    return a > b;
  }
};
struct GreaterEqual {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a >= b) {
    return a >= b;
  }
};
struct Equal {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a == b) {
    return a == b;
  }
};
struct Unequal {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a != b) {
    return a != b;
  }
};
struct BitAnd {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a & b) {
    return a & b;
  }
};
struct BitOr {
  template <class A, class B>
  TOFRAY_MUTATION_FN static auto of(A&& a, B&& b) -> decltype(a | b) {
    return a | b;
  }
};

#define TOFRAY_MUTATION_OPERATOR(op)                                                                                          \
  template <int N, class Other, class A>                                                                                      \
  TOFRAY_MUTATION_FN Left<N, Other, A> operator op(A&& a, At<N, Other>) {                                                     \
    return {static_cast<A&&>(a)};                                                                                             \
  }                                                                                                                           \
  template <int N, class Other, class A, class B>                                                                             \
  TOFRAY_MUTATION_FN auto operator op(Left<N, Other, A>&& l, B&& b)->decltype(static_cast<A&&>(l.a) op static_cast<B&&>(b)) { \
    using R = decltype(static_cast<A&&>(l.a) op static_cast<B&&>(b));                                                         \
    if constexpr (requires { static_cast<R>(Other::of(l.a, b)); }) {                                                          \
      if (on<N>()) return static_cast<R>(Other::of(l.a, b));                                                                  \
    } else {                                                                                                                  \
      none<N>();                                                                                                              \
    }                                                                                                                         \
    return static_cast<A&&>(l.a) op static_cast<B&&>(b);                                                                      \
  }
TOFRAY_MUTATION_OPERATOR(+)
TOFRAY_MUTATION_OPERATOR(-)
TOFRAY_MUTATION_OPERATOR(*)
TOFRAY_MUTATION_OPERATOR(/)
TOFRAY_MUTATION_OPERATOR(<)
TOFRAY_MUTATION_OPERATOR(<=)
TOFRAY_MUTATION_OPERATOR(>)
TOFRAY_MUTATION_OPERATOR(>=)
TOFRAY_MUTATION_OPERATOR(==)
TOFRAY_MUTATION_OPERATOR(!=)
TOFRAY_MUTATION_OPERATOR(&)
TOFRAY_MUTATION_OPERATOR(|)

/// A literal.
template <int N, class T>
TOFRAY_MUTATION_FN T number(T original, T other) {
  return on<N>() ? other : original;
}

/// That of a constant, which is none of the compiler's any more.
template <int N, class T>
__attribute__((always_inline)) inline T constant(T original, T other) {
  return on<N>() ? other : original;
}

/// −a, and a in its place.
template <int N, class A>
TOFRAY_MUTATION_FN auto negative(A a) -> decltype(-a) {
  if (on<N>()) return a;
  return -a;
}
/// What += takes, and its negative in its place.
template <int N, class A>
TOFRAY_MUTATION_FN decltype(auto) added(A&& a) {
  if constexpr (requires { static_cast<Plain<A>>(-a); }) {
    if (on<N>()) return static_cast<Plain<A>>(-a);
    return static_cast<Plain<A>>(a);
  } else {
    none<N>();
    return static_cast<A&&>(a);
  }
}
/// A condition, and its opposite.
template <int N, class A>
TOFRAY_MUTATION_FN bool condition(A&& a) {
  const bool value = static_cast<bool>(a);
  return on<N>() ? !value : value;
}
/// An index, and the next one.
template <int N, class A>
TOFRAY_MUTATION_FN decltype(auto) index(A&& a) {
  if constexpr (requires {
                  static_cast<Plain<A>>(a + 1);
                  static_cast<unsigned>(a);
                }) {
    return static_cast<Plain<A>>(on<N>() ? a + 1 : a);
  } else {
    none<N>();
    return static_cast<A&&>(a);
  }
}
/// a && b, and a || b in its place; b is asked only where it counts.
template <int N, class A, class B>
TOFRAY_MUTATION_FN bool both(A&& a, B&& b) {
  return on<N>() ? static_cast<bool>(a) || b() : static_cast<bool>(a) && b();
}
template <int N, class A, class B>
TOFRAY_MUTATION_FN bool either(A&& a, B&& b) {
  return on<N>() ? static_cast<bool>(a) && b() : static_cast<bool>(a) || b();
}

}  // namespace tofray_mutation

/// A function's name, and another's. `f` and `g` are looked up where the name stands.
#define TOFRAY_MUTATION_CALL(N, f, g)                                                 \
  [](const auto&... v) __attribute__((always_inline)) {                               \
    if constexpr (requires { static_cast<decltype(f(v...))>(g(v...)); }) {            \
      if (::tofray_mutation::on<N>()) return static_cast<decltype(f(v...))>(g(v...)); \
    } else {                                                                          \
      ::tofray_mutation::none<N>();                                                   \
    }                                                                                 \
    return f(v...);                                                                   \
  }
/// Mutants of a selection: the last two arguments changed about, or the first one alone.
#define TOFRAY_MUTATION_SELECT(N, f)                                               \
  [](const auto& m, const auto& a, const auto& b) __attribute__((always_inline)) { \
    if (::tofray_mutation::on<N>()) return f(m, b, a);                             \
    return f(m, a, b);                                                             \
  }
#define TOFRAY_MUTATION_NONE(N, f)                                         \
  [](const auto& a) __attribute__((always_inline)) {                       \
    if (::tofray_mutation::on<N>()) return static_cast<decltype(f(a))>(a); \
    return f(a);                                                           \
  }
