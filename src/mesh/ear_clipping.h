// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "mesh/fan.h"
#include "mesh/orientation.h"

namespace tofray::mesh {

/// Divides polygons into triangles: an ear, two edges and the diagonal that closes them, is cut off until one triangle is left. A polygon
/// of n corners gives n − 2, some of which may have no area.
///
/// The triangles' boundaries add up to the polygon's, so those that all turn to the left cover each point as often as the polygon winds
/// round it: where one triangle turns to the right there is no division, whatever led to it. Holes may be joined to the rim by a slit;
/// corners may stand twice, on edges, or back to back.
///
/// An ear has no hollow corner in it, and only such are looked at: where an edge leads into a triangle, one of the corners that lie deepest
/// in it is hollow.
class EarClipping {
 public:
  enum class Outcome { divided, crosses_itself, too_long };

  /// @param polygon    its corners, the inner side to the left
  /// @param work       points and cells of the grid that may be looked at; less by those that were
  /// @param triangles  out, where it is divided: three of the corners each, turning as the polygon does
  Outcome divide(const std::vector<Point>& polygon, std::int64_t& work, std::vector<Corners>& triangles);

 private:
  struct Candidate {
    std::int32_t corner;
    std::uint32_t changes;  ///< of its neighbours, until then
  };
  /// Hollow corners by the cell in which they lie, to find those in a triangle.
  struct Grid {
    std::array<std::size_t, 2> cells{1, 1};
    std::size_t filled = 0, hollow = 0;  ///< corners in it, and those of them that are still there and hollow
    Point low{}, per_length{};
    std::vector<std::int32_t> start, corners;
    [[nodiscard]] std::size_t cell(double x, std::size_t axis) const;
    [[nodiscard]] std::size_t cell(const Point& p) const { return cell(p[1], 1) * cells[0] + cell(p[0], 0); }
  };

  void begin();
  bool cut_all(std::int64_t& work, std::vector<Corners>& triangles);
  void cut(std::int32_t corner, std::vector<Corners>& triangles);
  void look_again(std::int32_t corner);
  [[nodiscard]] int turn(std::int32_t corner) const { return orientation(at(before(corner)), at(corner), at(next(corner))); }
  [[nodiscard]] bool is_idle(std::int32_t corner) const;
  [[nodiscard]] bool is_between(std::int32_t a, std::int32_t corner, std::int32_t c) const;
  [[nodiscard]] bool may_be_cut(std::int32_t corner, std::int64_t& work) const;
  [[nodiscard]] bool is_blocked(const Corners& ear, std::int64_t& work) const;
  [[nodiscard]] bool blocks(std::int32_t corner, const Corners& ear) const;
  void set_hollow(std::int32_t corner, bool hollow);
  void fill_grid(std::int64_t& work);
  void measure_grid(const Point& high);

  [[nodiscard]] const Point& at(std::int32_t corner) const { return (*polygon_)[static_cast<std::size_t>(corner)]; }
  std::int32_t& next(std::int32_t corner) { return next_[static_cast<std::size_t>(corner)]; }
  std::int32_t& before(std::int32_t corner) { return before_[static_cast<std::size_t>(corner)]; }
  [[nodiscard]] std::int32_t next(std::int32_t corner) const { return next_[static_cast<std::size_t>(corner)]; }
  [[nodiscard]] std::int32_t before(std::int32_t corner) const { return before_[static_cast<std::size_t>(corner)]; }
  [[nodiscard]] bool is_left(std::int32_t corner) const { return next(corner) >= 0; }

  const std::vector<Point>* polygon_ = nullptr;
  std::vector<std::int32_t> next_, before_;  ///< of each corner that is left; −1 of one that is cut off
  std::vector<std::uint32_t> changes_;
  /// Of each corner: whether the polygon turns to the right there, and whether the grid has it.
  std::vector<bool> is_hollow_, is_in_grid_;
  std::deque<Candidate> candidates_;
  std::size_t left_ = 0;
  Grid grid_;
  bool grid_lacks_some_ = false;
};

}  // namespace tofray::mesh
