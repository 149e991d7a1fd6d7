// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/findings.h"

namespace tofray::analysis {

using Kind = SceneFinding::Kind;

namespace {

constexpr double same_m = 1e-6;
/// Most objects that are compared for one inside another: more would take longer than a frame.
constexpr std::size_t most_compared = 2000;
constexpr std::size_t most_told = 5;

/// What is the same of two things in the same place, to a micrometre or so.
using Print = std::array<std::int64_t, 15>;
Print print_of(const Object& object, const Body& body) {
  const auto rounded = [](double m) { return std::isfinite(m) ? std::llround(std::clamp(m, -1e9, 1e9) / same_m) : 0; };
  Print out{static_cast<std::int64_t>(object.shape.index())};
  auto to = out.begin() + 1;
  for (const Vec& corner : {body.low, body.high})
    for (int k = 0; k < 3; ++k) *to++ = rounded(corner[k]);
  for (const double one : body.print) *to++ = rounded(one);
  return out;
}

void find_same_place(const Seen& seen, SceneReport& report) {
  std::map<Print, int> first;
  std::size_t found = 0;
  for (std::size_t i = 0; i < seen.scene.objects.size(); ++i) {
    const Object& object = seen.scene.objects[i];
    if (scene::moves(object)) continue;
    const auto [known, fresh] = first.try_emplace(print_of(object, seen.bodies[i]), static_cast<int>(i));
    if (fresh || (!object.key.empty() && object.key == seen.scene.objects[static_cast<std::size_t>(known->second)].key)) continue;
    if (++found > most_told) continue;
    const int other = known->second, self = static_cast<int>(i);
    add(seen, report, Kind::same_place, true, {self, other},
        fmt::format("{} is in the same place as {}, and the same", name_of(seen.scene, self), name_of(seen.scene, other)),
        "only one of the two is seen: take the other one out, or move it");
  }
  if (found > most_told)
    add(seen, report, Kind::same_place, true, {}, fmt::format("{} more objects are in the same place as another one", found - most_told),
        "only one of each two is seen");
}

/// The closed object that holds all of another one; −1 where none does.
int holder_of(const Seen& seen, const SceneReport& report, std::size_t i) {
  const std::vector<Vec> points = outermost(seen.scene.objects[i], seen.bodies[i]);
  for (std::size_t k = 0; k < seen.scene.objects.size(); ++k) {
    const Object& other = seen.scene.objects[k];
    if (k == i || report.objects[k].around_camera || scene::moves(other)) continue;
    const auto holds = [&](const Vec& p) { return is_inside(other, report.time_s, p).value_or(false); };
    if (std::all_of(points.begin(), points.end(), holds)) return static_cast<int>(k);
  }
  return -1;
}

void find_inside(const Seen& seen, SceneReport& report) {
  if (seen.scene.objects.size() > most_compared) return;
  std::size_t found = 0;
  for (std::size_t i = 0; i < seen.scene.objects.size(); ++i) {
    const ObjectInView& one = report.objects[i];
    if (one.pixels > 0 || one.endless || scene::moves(seen.scene.objects[i])) continue;
    const int holder = holder_of(seen, report, i);
    if (holder < 0 || ++found > most_told) continue;
    const int self = static_cast<int>(i);
    add(seen, report, Kind::inside_another, true, {self, holder},
        fmt::format("{} is hidden inside {}", name_of(seen.scene, self), name_of(seen.scene, holder)),
        "no light reaches it: move it out, or take it out of the scene");
  }
  if (found > most_told)
    add(seen, report, Kind::inside_another, true, {}, fmt::format("{} more objects are hidden inside another one", found - most_told),
        "no light reaches them");
}

}  // namespace

void find_overlaps(const Seen& seen, SceneReport& report) {
  find_same_place(seen, report);
  find_inside(seen, report);
}

}  // namespace tofray::analysis
