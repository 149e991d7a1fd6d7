// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "base/vec.h"
#include "num/num.h"
#include "scene/frozen_scene.h"
#include "trace/nearest.h"

/// What tests of single rays share. Closed forms are computed in double from the direction as single precision holds it.
namespace tofray::test {

using Ray = flow::Ray<float>;

inline Ray ray(const Vec3& d) { return flow::make_ray(static_cast<float>(d[0]), static_cast<float>(d[1]), static_cast<float>(d[2])); }
inline Vec3 direction(const Ray& r) { return {static_cast<double>(r.x), static_cast<double>(r.y), static_cast<double>(r.z)}; }

inline shape::Vec vec(const Vec3& a) { return {a[0], a[1], a[2]}; }
inline Vec3 vec3(const shape::Vec& a) { return {a.x, a.y, a.z}; }
inline shape::Mat mat(const base::Mat3& m) { return {{vec(m[0]), vec(m[1]), vec(m[2])}}; }

/// Forms of some shapes as seen from one point; each is an object and a facet of its own kind's number.
class Seen {
 public:
  Seen() = default;
  Seen(Seen&&) = default;
  Seen& operator=(Seen&&) = default;
  template <class T>
  void add(const T& shape, const Vec3& origin, int object = 0) {
    auto& list = forms_.of<T>().list;
    list.push_back(seen_from(shape, vec(origin)));
    list.back().facet = static_cast<int>(list.size()) - 1, list.back().object = object;
    view_.of<T>() = {list.data(), static_cast<std::int32_t>(list.size())};
  }
  [[nodiscard]] const scene::Forms& forms() const { return view_; }
  template <class T>
  [[nodiscard]] const typename T::Form& first() const {
    return *view_.of<T>().at;
  }

 private:
  template <class T>
  struct ListOf {
    std::vector<typename T::Form> list;
  };
  shape::ByShape<ListOf> forms_;
  scene::Forms view_{};
};

/// All forms, none culled.
inline trace::Culled everything(const scene::Forms& forms) {
  trace::Culled all{};
  trace::cull<float>(forms, nullptr, {}, all);
  return all;
}

}  // namespace tofray::test
