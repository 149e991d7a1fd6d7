// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "mesh/ear_clipping.h"

#include <algorithm>
#include <cmath>

namespace tofray::mesh {
namespace {

/// Of three points on a line: whether the way over the middle one turns back there.
bool turns_back(const Point& a, const Point& b, const Point& c) {
  for (std::size_t k = 0; k < 2; ++k)
    if ((a[k] < b[k] && c[k] < b[k]) || (a[k] > b[k] && c[k] > b[k])) return true;
  return false;
}

}  // namespace

std::size_t EarClipping::Grid::cell(double x, std::size_t axis) const {
  const double place = (x - low[axis]) * per_length[axis];
  const std::size_t last = cells[axis] - 1;  // (Ears may be far outside: no whole number holds that.)
  if (!(place > 0)) return 0;
  return place < static_cast<double>(last) ? static_cast<std::size_t>(place) : last;
}

EarClipping::Outcome EarClipping::divide(const std::vector<Point>& polygon, std::int64_t& work, std::vector<Corners>& triangles) {
  polygon_ = &polygon;
  triangles.clear();
  begin();
  fill_grid(work);
  if (!cut_all(work, triangles)) return work <= 0 ? Outcome::too_long : Outcome::crosses_itself;
  const Corners& last = triangles.back();
  return orientation(at(last[0]), at(last[1]), at(last[2])) < 0 ? Outcome::crosses_itself : Outcome::divided;
}

void EarClipping::begin() {
  left_ = polygon_->size();
  next_.resize(left_), before_.resize(left_), changes_.assign(left_, 0);
  for (std::size_t i = 0; i < left_; ++i) {
    next_[i] = static_cast<std::int32_t>(i + 1 < left_ ? i + 1 : 0);
    before_[i] = static_cast<std::int32_t>((i > 0 ? i : left_) - 1);
  }
  is_hollow_.assign(left_, false), is_in_grid_.assign(left_, false);
  for (std::size_t i = 0; i < left_; ++i) is_hollow_[i] = turn(static_cast<std::int32_t>(i)) < 0;
  candidates_.clear();
  for (std::size_t i = 0; i < left_; ++i) look_again(static_cast<std::int32_t>(i));
}

// What has no inside goes before all ears: beside it nobody could tell on which side the polygon lies.
void EarClipping::look_again(std::int32_t corner) {
  const Candidate one{corner, ++changes_[static_cast<std::size_t>(corner)]};
  if (is_idle(corner))
    candidates_.push_front(one);
  else
    candidates_.push_back(one);
}

bool EarClipping::cut_all(std::int64_t& work, std::vector<Corners>& triangles) {
  std::int32_t last = 0;
  while (left_ > 3) {
    if (candidates_.empty()) return false;
    const Candidate one = candidates_.front();
    candidates_.pop_front();
    if (!is_left(one.corner) || changes_[static_cast<std::size_t>(one.corner)] != one.changes) continue;
    if (work <= 0) return false;
    if (!may_be_cut(one.corner, work)) continue;
    last = before(one.corner);
    cut(one.corner, triangles);
    if (grid_lacks_some_ || 2 * grid_.hollow < grid_.filled) fill_grid(work);
  }
  triangles.push_back({last, next(last), before(last)});
  return true;
}

// What is not cut off now is looked at again when one of its neighbours is another.
void EarClipping::cut(std::int32_t corner, std::vector<Corners>& triangles) {
  const std::int32_t a = before(corner), c = next(corner);
  triangles.push_back({a, corner, c});
  set_hollow(corner, false);
  next(a) = c, before(c) = a;
  next(corner) = before(corner) = -1;
  --left_;
  for (const std::int32_t one : {a, c}) {
    set_hollow(one, turn(one) < 0);
    look_again(one);
  }
}

void EarClipping::set_hollow(std::int32_t corner, bool hollow) {
  const auto i = static_cast<std::size_t>(corner);
  if (is_hollow_[i] == hollow) return;
  is_hollow_[i] = hollow;
  if (!is_in_grid_[i])
    grid_lacks_some_ = true;
  else
    hollow ? ++grid_.hollow : --grid_.hollow;
}

/// Whether a corner stands twice, or the way turns back there.
bool EarClipping::is_idle(std::int32_t corner) const {
  const Point &a = at(before(corner)), &b = at(corner), &c = at(next(corner));
  return b == c || (orientation(a, b, c) == 0 && turns_back(a, b, c));
}

/// Whether a corner lies on the line between two others.
bool EarClipping::is_between(std::int32_t a, std::int32_t corner, std::int32_t c) const {
  const Point& b = at(corner);
  return b != at(a) && b != at(c) && orientation(at(a), b, at(c)) == 0 && !turns_back(at(a), b, at(c));
}

bool EarClipping::may_be_cut(std::int32_t corner, std::int64_t& work) const {
  if (is_idle(corner)) return true;
  const Corners ear{before(corner), corner, next(corner)};
  if (turn(corner) <= 0) return false;
  // What lies on the diagonal would be left without an inside.
  if (is_between(ear[0], before(ear[0]), ear[2]) || is_between(ear[0], next(ear[2]), ear[2])) return false;
  return !is_blocked(ear, work);
}

bool EarClipping::is_blocked(const Corners& ear, std::int64_t& work) const {
  const Point &a = at(ear[0]), &b = at(ear[1]), &c = at(ear[2]);
  const Point low{std::min({a[0], b[0], c[0]}), std::min({a[1], b[1], c[1]})};
  const Point high{std::max({a[0], b[0], c[0]}), std::max({a[1], b[1], c[1]})};
  const auto is_near = [&](const Point& p) { return p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] && p[1] <= high[1]; };
  const std::size_t from = grid_.cell(low[0], 0), to = grid_.cell(high[0], 0);
  for (std::size_t row = grid_.cell(low[1], 1), last = grid_.cell(high[1], 1); row <= last; ++row) {
    // The cells of a row lie one behind the other.
    const auto begin = static_cast<std::size_t>(grid_.start[row * grid_.cells[0] + from]);
    const auto end = static_cast<std::size_t>(grid_.start[row * grid_.cells[0] + to + 1]);
    work -= static_cast<std::int64_t>(1 + end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t corner = grid_.corners[i];
      if (is_hollow_[static_cast<std::size_t>(corner)] && is_near(at(corner)) && blocks(corner, ear)) return true;
    }
  }
  return false;
}

/// Whether a corner lies in the triangle or on its rim.
bool EarClipping::blocks(std::int32_t corner, const Corners& ear) const {
  if (std::find(ear.begin(), ear.end(), corner) != ear.end()) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (orientation(at(ear[k]), at(ear[(k + 1) % 3]), at(corner)) < 0) return false;
  return true;
}

void EarClipping::fill_grid(std::int64_t& work) {
  work -= static_cast<std::int64_t>(next_.size());
  Point high{};
  grid_.filled = 0;
  for (std::size_t i = 0; i < next_.size(); ++i) {
    is_in_grid_[i] = is_hollow_[i];
    if (!is_hollow_[i]) continue;
    const Point& p = (*polygon_)[i];
    if (grid_.filled++ == 0) grid_.low = high = p;
    for (std::size_t k = 0; k < 2; ++k) grid_.low[k] = std::min(grid_.low[k], p[k]), high[k] = std::max(high[k], p[k]);
  }
  grid_.hollow = grid_.filled, grid_lacks_some_ = false;
  measure_grid(high);
  // Counted, summed, and each put before those that follow in its cell.
  grid_.start.assign(grid_.cells[0] * grid_.cells[1] + 1, 0);
  grid_.corners.resize(grid_.filled);
  for (std::size_t i = 0; i < next_.size(); ++i)
    if (is_hollow_[i]) ++grid_.start[grid_.cell((*polygon_)[i])];
  for (std::size_t i = 1; i < grid_.start.size(); ++i) grid_.start[i] += grid_.start[i - 1];
  for (std::size_t i = next_.size(); i-- > 0;)
    if (is_hollow_[i]) grid_.corners[static_cast<std::size_t>(--grid_.start[grid_.cell((*polygon_)[i])])] = static_cast<std::int32_t>(i);
}

/// Cells about as wide as high, half as many as corners.
void EarClipping::measure_grid(const Point& high) {
  const double wanted = std::max(1.0, 0.5 * static_cast<double>(grid_.filled));
  const Point length{high[0] - grid_.low[0], high[1] - grid_.low[1]};
  const double wide = length[0] > 0 && length[1] > 0 ? std::sqrt(wanted * (length[0] / length[1])) : length[0] > 0 ? wanted : 1;
  grid_.cells[0] = static_cast<std::size_t>(std::clamp(wide, 1.0, wanted));
  grid_.cells[1] = static_cast<std::size_t>(length[1] > 0 ? std::max(1.0, wanted / static_cast<double>(grid_.cells[0])) : 1);
  for (std::size_t k = 0; k < 2; ++k) grid_.per_length[k] = length[k] > 0 ? static_cast<double>(grid_.cells[k]) / length[k] : 0;
}

}  // namespace tofray::mesh
