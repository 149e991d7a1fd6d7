// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "scene/view.h"

/// Which forms a bundle of rays can meet at all. Culling never changes a result: it only leaves out what no ray of the bundle hits.
namespace tofray::trace {

/// Indices of the forms that are left; all of them where the list would overflow.
struct Picked {
  static constexpr int capacity = 1024;
  std::int32_t count;
  bool everything;
  std::uint16_t index[capacity];
  TOFRAY_FN int at(int i) const { return everything ? i : index[i]; }
};

/// A way through the forms that are left, in their order.
template <class Form>
struct Walk {
  const Picked& picked;
  const Form* forms;
  int i;
  TOFRAY_FN bool more() const { return i < picked.count; }
  TOFRAY_FN const Form& form() const { return forms[picked.at(i)]; }
  TOFRAY_FN void next() { ++i; }
};

template <class T>
struct PickedOf {
  Picked picked;
  const typename T::Form* forms;
};

/// What is left of all shapes. (Another type with these walks can stand in its place.)
struct Culled : shape::ByShape<PickedOf> {
  TOFRAY_FN bool empty() const { return count(shape::Shapes{}) == 0; }
  TOFRAY_FN int count() const { return count(shape::Shapes{}); }
  template <class T>
  TOFRAY_FN Walk<typename T::Form> walk() const {
    return {of<T>().picked, of<T>().forms, 0};
  }

 private:
  template <class... T>
  TOFRAY_FN int count(shape::List<T...>) const {
    return (of<T>().picked.count + ...);
  }
};

template <class T>
TOFRAY_FN void pick(const scene::FormsOf<T>& forms, const scene::Bounds* r, PickedOf<T>& picked) {
  Picked& out = picked.picked;
  picked.forms = forms.at;
  out.everything = r == nullptr;
  out.count = r == nullptr ? forms.count : 0;
  for (int i = 0; i < forms.count && !out.everything; ++i) {
    if (!can_meet(forms.at[i], *r)) continue;
    if (out.count == Picked::capacity || i > 0xffff) {
      out.everything = true;
      out.count = forms.count;
    } else {
      out.index[out.count++] = static_cast<std::uint16_t>(i);
    }
  }
}

template <class... T>
TOFRAY_FN void cull_each(shape::List<T...>, const scene::Forms& forms, const scene::Bounds* rectangle, Culled& out) {
  (pick<T>(forms.of<T>(), rectangle, out.of<T>()), ...);
}

/// For rays d = (x, y, 1) with (x, y) in `rectangle`; a null pointer keeps everything.
TOFRAY_FN void cull(const scene::Forms& forms, const scene::Bounds* rectangle, Culled& out) {
  cull_each(shape::Shapes{}, forms, rectangle, out);
}

}  // namespace tofray::trace
