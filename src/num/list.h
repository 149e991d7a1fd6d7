// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// A list of types that functions fold over.
namespace tofray::num {

template <class... T>
struct List {
  static constexpr int size = sizeof...(T);
};

template <class A, class B>
inline constexpr bool same = false;
template <class A>
inline constexpr bool same<A, A> = true;

/// Where T stands in it; −1: nowhere.
template <class T, class... All>
constexpr int place_in(List<All...>) {
  int place = 0, found = -1;
  ((found = same<T, All> ? place : found, ++place), ...);
  return found;
}

}  // namespace tofray::num
