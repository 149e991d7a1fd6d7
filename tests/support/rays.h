// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "num/num.h"
#include "trace/nearest.h"
#include "base/vec.h"
#include "scene/frozen_scene.h"

/// What tests of single rays share. Closed forms are computed in double from the direction as single precision holds it.
namespace tofray::test {

using Ray = flow::Ray<float>;

inline Ray ray(const Vec3& d) { return flow::make_ray(static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])); }
inline Vec3 direction(const Ray& r) { return {static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z)}; }

/// All forms, none culled.
inline trace::Culled everything(const scene::Forms& forms) {
  trace::Culled all;
  trace::cull(forms, nullptr, all);
  return all;
}

}  // namespace tofray::test
