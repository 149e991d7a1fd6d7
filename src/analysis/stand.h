// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <variant>

#include "model/tables.h"
#include "scene/motion.h"
#include "shape/list.h"

/// How objects stand in the world, whatever shape they are.
namespace tofray::analysis {

using scene::Vec;

/// What files call it.
inline const std::string& kind_of(const Object& object) { return model::names_of_shapes()[object.shape.index()]; }

/// How an object stands in the world at a time: what a placement puts at P is then at turn·P + shift.
struct Stand {
  shape::Placement at;
  scene::Motion motion;
  [[nodiscard]] Vec to_world(const Vec& placed) const { return motion.turn * placed + motion.shift; }
  [[nodiscard]] Vec from_world(const Vec& p) const { return shape::back(motion.turn, p - motion.shift); }
};

template <class Shape, class Said>
Stand stand_of(const Object& object, const Said& said, double time_s) {
  Stand out{scene::placement_of(object), {}};
  if (scene::moves(object)) out.motion = scene::motion_at(object, Shape::center_of(said) + out.at.shift, time_s);
  return out;
}

/// Calls look(shape::List<Shape>, said) with what the object is.
template <class Look, class... Shape, class... Said>
void with_shape(shape::List<Shape...>, const std::variant<Said...>& said, const Look& look) {
  const auto one = [&]<class S, class T>(shape::List<S> type, const T* is) {
    if (is != nullptr) look(type, *is);
  };
  (one(shape::List<Shape>{}, std::get_if<Said>(&said)), ...);
}

}  // namespace tofray::analysis
