// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/list.h"
#include "pipeline/pass/blooming.h"
#include "pipeline/pass/bounces.h"
#include "pipeline/pass/derive_scene.h"
#include "pipeline/pass/flying_pixels.h"
#include "pipeline/pass/from_arrays.h"
#include "pipeline/pass/from_rays.h"
#include "pipeline/pass/line_noise.h"
#include "pipeline/pass/path_error.h"
#include "pipeline/pass/path_noise.h"
#include "pipeline/pass/range_filter.h"
#include "pipeline/pass/scatter.h"
#include "pipeline/pass/smooth.h"
#include "pipeline/pass/sum_light.h"
#include "pipeline/pass/transient.h"
#include "pipeline/pass/write_depth.h"

/// All passes, and what is asked of one whose number is known. plan.h has the order in which a frame takes them.
namespace tofray::pipeline {

using Passes = num::List<DeriveScene, LineNoise, FromRays, FromArrays, Bounces, PathError, PathNoise, Smooth, SumLight, TransientHistogram,
                         ScatterRows, ScatterColumns, Blooming, FlyingPixels, RangeFilter, WriteDepth>;

/// A pass as a number: its place in the list.
enum class Pass : std::int32_t {};
template <class P>
inline constexpr Pass pass{num::place_in<P>(Passes{})};

template <class Do, class... P>
static void with_pass(Pass number, const Do& act, num::List<P...>) {
  (void)((number == pass<P> ? (act(P{}), true) : false) || ...);
}
/// Calls act(P{}) for the pass of this number.
template <class Do>
static void with_pass(Pass number, const Do& act) {
  with_pass(number, act, Passes{});
}

static inline const char* name_of(Pass number) {
  const char* name = nullptr;
  with_pass(number, [&](auto it) { name = decltype(it)::name; });
  return name;
}
static inline const char* what_does(Pass number) {
  const char* does = nullptr;
  with_pass(number, [&](auto it) { does = decltype(it)::does; });
  return does;
}
static inline Over over_of(Pass number) {
  Over over = Over::scene;
  with_pass(number, [&](auto it) { over = decltype(it)::over; });
  return over;
}
/// About how many rays each pixel sends.
static inline std::int64_t rays_of(Pass number, const Setup& s, int item) {
  std::int64_t rays = 1;
  with_pass(number, [&](auto it) {
    using P = decltype(it);
    if constexpr (requires { P::rays(s, item); }) rays = P::rays(s, item);
  });
  return rays;
}

}  // namespace tofray::pipeline
