// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "scene/view.h"

/// Which forms a bundle of rays can meet at all. Culling never changes a result: it only leaves out what no ray of the bundle hits, and
/// what is left stays in its order, on which it depends which of two surfaces at one place is seen.
///
/// The rays of a tile look at clusters of bodies (scene/clusters.h), then at the bodies of those that they can meet. Where many are left,
/// squares of the tile's rays look once more at these alone (square_search.h), or each of its packs does (narrow).
namespace tofray::trace {

using scene::cluster_size;
using scene::ManyBounds;

/// To narrow a list takes a pack about as long as to test as many forms.
constexpr int few_forms = 12;

/// Indices of the forms that are left, and their rectangles.
struct Picked {
  std::int32_t count;
  bool everything;      ///< all forms are left; nothing is written down
  std::int32_t* index;  ///< [count]
  ManyBounds* bounds;   ///< [count/32]
  TOFRAY_INLINE int at(int i) const { return everything ? i : index[i]; }
};

/// A way through the forms that are left, in their order.
template <class Form>
struct FormIterator {
  const Picked& picked;
  const Form* forms;
  int i;
  TOFRAY_INLINE bool more() const { return i < picked.count; }
  TOFRAY_INLINE const Form& form() const { return forms[picked.at(i)]; }
  TOFRAY_INLINE void next() { ++i; }
};

/// Forms as a point sees them.
template <class T>
struct PickedForms {
  using Form = typename T::Form;
  static constexpr bool in_depth = true;  ///< they have an order
  /// So many go from pack to pack. They are put in order and their rectangles are not, so that nobody may narrow them.
  static constexpr int few = shape::many_of<T> ? 1 : few_forms;
  Picked picked;
  const Form* forms;
  std::int32_t in_squares;  ///< so many are in the lists in place of picked.count: squares of a tile look for them, and its packs do not
  TOFRAY_INLINE static bool meets(const Form& form, const scene::Bounds& r) { return can_meet(form, r); }
};
/// Which forms of a shape parallel light can meet.
template <class T>
struct PickedAlongs {
  using Form = typename T::Along;
  static constexpr bool in_depth = false;
  Picked picked;
  const Form* forms;
  std::int32_t in_squares;  ///< not 0: squares of a tile look for what is in the clusters
  TOFRAY_INLINE static bool meets(const Form& form, const scene::Bounds& r) { return shape::can_shade(form, r); }
};

/// What is left of all shapes. (Another type with these iterators can stand in its place.)
template <template <class> class From>
struct CulledOf : shape::ByShape<From> {
  unsigned char* room;  ///< for room_of(bodies) bytes, aligned to 64; what is picked is written there
  bool many;            ///< so many that it pays to narrow them
  bool by_squares;      ///< there are some that squares look for

  TOFRAY_INLINE bool empty() const { return count() == 0 && !by_squares; }
  TOFRAY_INLINE int count() const { return count(shape::Shapes{}); }
  template <class T>
  TOFRAY_INLINE FormIterator<typename From<T>::Form> iterate() const {
    return {this->template of<T>().picked, this->template of<T>().forms, 0};
  }

 private:
  template <class... T>
  TOFRAY_INLINE int count(shape::List<T...>) const {
    return (this->template of<T>().picked.count + ...);
  }
};
using Culled = CulledOf<PickedForms>;
using CulledAlong = CulledOf<PickedAlongs>;

/// Everything, without a list, for rays that each look at meshes by themselves.
/// \tparam Views  scene::Forms or scene::Alongs
template <class Views>
struct Uncut {
  static constexpr bool each_by_itself = true;
  template <class Form>
  struct Way {
    const Form* at;
    int left;
    TOFRAY_INLINE bool more() const { return left > 0; }
    TOFRAY_INLINE const Form& form() const { return *at; }
    TOFRAY_INLINE void next() { ++at, --left; }
  };
  Views forms;
  template <class T>
  TOFRAY_INLINE auto iterate() const {
    const auto& its = forms.template of<T>();
    return Way<std::remove_cvref_t<decltype(*its.at)>>{its.at, its.count};
  }
};
template <class Views>
Uncut(Views) -> Uncut<Views>;

/// Bytes of one shape's list.
TOFRAY_INLINE std::size_t list_bytes(int forms) {
  return static_cast<std::size_t>((forms + cluster_size - 1) / cluster_size) * (4 * cluster_size + sizeof(ManyBounds));
}
template <class... T>
TOFRAY_INLINE std::size_t room_of(shape::List<T...>, const scene::Bodies& bodies) {
  return (list_bytes(bodies.of<T>().count) + ...);
}
/// Bytes that a Culled writes to.
TOFRAY_INLINE std::size_t room_of(const scene::Bodies& bodies) { return room_of(shape::Shapes{}, bodies); }

/// Numbers of bodies, marked in any order and read in theirs: a bit for each, and a bit for each word of 64 in which there is one.
struct Marks {
  std::uint64_t *words, *sums;

  static constexpr int per_word = 64, per_sum = per_word * per_word;
  TOFRAY_INLINE static int sums_of(int bodies) { return (bodies + per_sum - 1) / per_sum; }
  /// Words that `words` and `sums` have together.
  TOFRAY_INLINE static int words_of(int bodies) { return sums_of(bodies) * (per_word + 1); }

  TOFRAY_INLINE void clear(int bodies) const {
    for (int i = 0; i < sums_of(bodies); ++i) sums[i] = 0;
  }
  TOFRAY_INLINE void mark(std::int32_t body) const {
    const std::int32_t word = body / per_word;
    const std::uint64_t bit = std::uint64_t{1} << (body % per_word), its = std::uint64_t{1} << (word % per_word);
    words[word] = (sums[word / per_word] & its) != 0 ? words[word] | bit : bit;
    sums[word / per_word] |= its;
  }
  template <class Each>
  TOFRAY_INLINE void each(int bodies, const Each& run) const {
    for (int s = 0; s < sums_of(bodies); ++s) {
      for (std::uint64_t full = sums[s]; full != 0; full &= full - 1) {
        const int word = s * per_word + __builtin_ctzll(full);
        for (std::uint64_t left = words[word]; left != 0; left &= left - 1) run(word * per_word + __builtin_ctzll(left));
      }
    }
  }
};

template <class... T>
TOFRAY_INLINE int most_bodies(shape::List<T...>, const scene::Bodies& bodies) {
  int most = 0;
  ((most = bodies.of<T>().count > most ? bodies.of<T>().count : most), ...);
  return most;
}
/// Marks for any one shape of a group.
TOFRAY_INLINE std::size_t marks_bytes(const scene::Bodies& bodies) {
  return static_cast<std::size_t>(Marks::words_of(most_bodies(shape::Shapes{}, bodies))) * sizeof(std::uint64_t);
}

/// A bit for each of 32 that overlap the rectangle and, if `deep`, begin before `far`.
template <class F, bool deep = false>
TOFRAY_INLINE std::uint32_t overlaps(const ManyBounds& many, const scene::Bounds& r, float far = 0) {
  std::uint32_t out = 0;
  for (int i = 0; i < cluster_size; i += num::lanes<F>) {
    const auto load = [&](const float* from) TOFRAY_LAMBDA { return num::load<F>(from + i, num::lanes<F>); };
    const F x_min = load(many.x_min), x_max = load(many.x_max), y_min = load(many.y_min), y_max = load(many.y_max);
    auto met = (x_min <= F(r.x_max)) & (x_max >= F(r.x_min)) & (y_min <= F(r.y_max)) & (y_max >= F(r.y_min));
    if (deep) met = met & (load(many.near) <= F(far));
    out |= num::lanes_of(met) << i;
  }
  return out;
}

template <class Form>
TOFRAY_INLINE void write_down(int i, const Form& form, Picked& out) {
  out.index[out.count] = i;
  if constexpr (requires { form.bounds; }) {
    ManyBounds& many = out.bounds[out.count / cluster_size];
    const int at = out.count % cluster_size;
    many.x_min[at] = form.bounds.x_min, many.x_max[at] = form.bounds.x_max;
    many.y_min[at] = form.bounds.y_min, many.y_max[at] = form.bounds.y_max;
  }
  ++out.count;
}

/// Calls run(cluster) for those that overlap the rectangle.
template <class F, class Run>
TOFRAY_INLINE void each_cluster(const scene::Clusters& clusters, const scene::Bounds& r, const Run& run) {
  const int groups = (clusters.count + cluster_size - 1) / cluster_size;
  for (int above = 0; above < groups; above += cluster_size) {
    for (std::uint32_t those = overlaps<F>(clusters.of_groups()[above / cluster_size], r); those != 0; those &= those - 1) {
      const int group = above + __builtin_ctz(those);
      for (std::uint32_t near = overlaps<F>(clusters.of_clusters[group], r); near != 0; near &= near - 1)
        run(group * cluster_size + __builtin_ctz(near));
    }
  }
}

/// Marks what is in the clusters, by its number.
/// @param numbers  [cluster][32] the bodies, or their ranks
template <class F>
TOFRAY_INLINE void mark_all(const scene::Clusters& clusters, const std::int32_t* numbers, const scene::Bounds& r, const Marks& marks) {
  each_cluster<F>(clusters, r, [&](int cluster) TOFRAY_LAMBDA {
    const std::int32_t* its = numbers + cluster * cluster_size;
    for (std::uint32_t left = overlaps<F>(clusters.of_bodies[cluster], r); left != 0; left &= left - 1)
      marks.mark(its[__builtin_ctz(left)]);
  });
}

TOFRAY_INLINE void put_in_order(Picked& few) {
  for (int i = 1; i < few.count; ++i) {
    const std::int32_t one = few.index[i];
    int at = i;
    for (; at > 0 && few.index[at - 1] > one; --at) few.index[at] = few.index[at - 1];
    few.index[at] = one;
  }
}

/// Of forms that have clusters those that the rectangle holds: few of them in their order, many with the nearest first, for squares.
/// (Each form itself is not asked: it lies elsewhere in memory, and its squares ask for its rectangle once more.)
template <class F, class From, class FormsOf>
TOFRAY_INLINE void pick_nearest(const FormsOf& forms, const scene::Bounds& r, const Marks& marks, From& to) {
  const scene::Clusters& clusters = forms.clusters;
  const std::int32_t* const order = clusters.order();
  marks.clear(forms.count);
  mark_all<F>(clusters, clusters.ranks(), r, marks);
  Picked out = to.picked;
  marks.each(forms.count, [&](int rank) TOFRAY_LAMBDA {
    const std::int32_t place = order[rank], from = place % cluster_size, at = out.count % cluster_size;
    const ManyBounds& its = clusters.of_bodies[place / cluster_size];
    ManyBounds& many = out.bounds[out.count / cluster_size];
    const std::int32_t body = clusters.bodies[place];
    for (std::size_t i = 0; i < sizeof forms.at[0]; i += 64) __builtin_prefetch(reinterpret_cast<const char*>(forms.at + body) + i);
    out.index[out.count++] = body;
    many.x_min[at] = its.x_min[from], many.x_max[at] = its.x_max[from];
    many.y_min[at] = its.y_min[from], many.y_max[at] = its.y_max[from], many.near[at] = its.near[from];
  });
  if (out.count > From::few) {
    to.in_squares = out.count, out.count = 0;
  } else {
    put_in_order(out);
  }
  to.picked = out;
}

/// Whether anything of a group is before a rectangle on the screen of parallel light. The points of a tile are at many depths, and the
/// rectangle that holds them there holds much that is before none of them. Squares look at the clusters themselves; here it is asked
/// whether there is anything at all.
template <class F>
TOFRAY_INLINE bool any_on_screen(const scene::Clusters& clusters, const scene::Bounds& r) {
  bool any = false;
  each_cluster<F>(clusters, r, [&](int) TOFRAY_LAMBDA { any = true; });
  return any;
}

/// Of forms that have clusters. Apart: where there are few, nothing is to be paid for it.
/// @param to  picked: its lists, empty
template <class F, class From, class FormsOf>
TOFRAY_NOINLINE void pick_of_many(const FormsOf& forms, const scene::Bounds& r, const Marks& marks, From& to) {
  if constexpr (!shape::has_beams<F>) {
    marks.clear(forms.count);
    mark_all<F>(forms.clusters, forms.clusters.bodies, r, marks);
    marks.each(forms.count, [&](int i) TOFRAY_LAMBDA {
      if (From::meets(forms.at[i], r)) write_down(i, forms.at[i], to.picked);
    });
  } else if constexpr (From::in_depth) {
    pick_nearest<F>(forms, r, marks, to);
  } else {
    to.in_squares = any_on_screen<F>(forms.clusters, r) ? forms.count : 0;
  }
}

template <class F, class From, class FormsOf>
TOFRAY_INLINE bool pick(const FormsOf& forms, const scene::Bounds* r, unsigned char*& room, const Marks& marks, From& picked) {
  picked.forms = forms.at, picked.picked = {}, picked.in_squares = 0;
  if (forms.count == 0) return false;
  Picked out{r == nullptr ? forms.count : 0, r == nullptr, reinterpret_cast<std::int32_t*>(room), nullptr};
  if (r != nullptr) {
    const int padded = (forms.count + cluster_size - 1) / cluster_size * cluster_size;
    out.bounds = reinterpret_cast<ManyBounds*>(out.index + padded);
    room += list_bytes(forms.count);
    if (forms.clusters.count > 0) {
      picked.picked = out;
      pick_of_many<F>(forms, *r, marks, picked);
      return picked.picked.count > few_forms;
    }
    for (int i = 0; i < forms.count; ++i)
      if (From::meets(forms.at[i], *r)) write_down(i, forms.at[i], out);
  }
  picked.picked = out;
  return !out.everything && out.count > few_forms;
}

template <class F, template <class> class From, class... T, class Forms>
TOFRAY_INLINE void cull_each(shape::List<T...>, const Forms& forms, const scene::Bounds* rectangle, const Marks& marks,
                             CulledOf<From>& out) {
  unsigned char* room = out.room;
  out.many = false;
  ((out.many = pick<F>(forms.template of<T>(), rectangle, room, marks, out.template of<T>()) || out.many), ...);
  out.by_squares = (out.template of<T>().in_squares | ...) != 0;
}

/// For rays d = (x, y, 1) with (x, y) in `rectangle`, or on the screen of parallel light; a null pointer keeps everything.
/// @param marks  for the most bodies of any shape
template <class F, template <class> class From, class Forms>
TOFRAY_NOINLINE void cull(const Forms& forms, const scene::Bounds* rectangle, const Marks& marks, CulledOf<From>& out) {
  cull_each<F>(shape::Shapes{}, forms, rectangle, marks, out);
}

template <class F, class T, template <class> class From>
TOFRAY_INLINE void narrow_one(const CulledOf<From>& from, const scene::Bounds& r, unsigned char*& room, CulledOf<From>& to) {
  const Picked& all = from.template of<T>().picked;
  Picked out = all;
  if constexpr (shape::bounded<T> && !(shape::many_of<T> && shape::has_beams<F>)) {
    if (!all.everything && all.count > few_forms) {
      out.count = 0, out.index = reinterpret_cast<std::int32_t*>(room);
      room += list_bytes(all.count);
      for (int first = 0; first < all.count; first += cluster_size) {
        std::uint32_t left = overlaps<F>(all.bounds[first / cluster_size], r);
        if (all.count - first < cluster_size) left &= (1u << (all.count - first)) - 1;
        for (; left != 0; left &= left - 1) out.index[out.count++] = all.index[first + __builtin_ctz(left)];
      }
    }
  }
  to.template of<T>().picked = out, to.template of<T>().forms = from.template of<T>().forms;
}

template <class F, template <class> class From, class... T>
TOFRAY_INLINE void narrow_each(shape::List<T...>, const CulledOf<From>& from, const scene::Bounds& r, CulledOf<From>& to) {
  unsigned char* room = to.room;
  to.many = false;
  (narrow_one<F, T>(from, r, room, to), ...);
}

/// Points of a pack on the screen of parallel light, each a small rectangle.
template <class F>
struct OnScreenPack {
  F u_low, u_high, v_low, v_high;
  num::Mask<F> use;
  TOFRAY_INLINE bool meets(const ManyBounds& many, int i) const {
    return num::any(use & (u_high >= F(many.x_min[i])) & (u_low <= F(many.x_max[i])) & (v_high >= F(many.y_min[i])) &
                    (v_low <= F(many.y_max[i])));
  }
  TOFRAY_INLINE scene::Bounds bounds() const {
    const F far = F(3e38f);
    return {num::lowest(num::select(use, u_low, far)), num::highest(num::select(use, u_high, -far)),
            num::lowest(num::select(use, v_low, far)), num::highest(num::select(use, v_high, -far))};
  }
};

template <class F, class T>
TOFRAY_INLINE void narrow_one(const scene::Alongs& alongs, const CulledAlong& from, const OnScreenPack<F>& at, const scene::Bounds& r,
                              unsigned char*& room, CulledAlong& to) {
  Picked out = from.of<T>().picked;
  to.of<T>().forms = from.of<T>().forms;
  if constexpr (shape::bounded<T> && !(shape::many_of<T> && shape::has_beams<F>)) {
    const scene::Clusters& clusters = alongs.of<T>().clusters;
    if (clusters.count > 0 && out.count > few_forms) {
      out.count = 0, out.index = reinterpret_cast<std::int32_t*>(room);
      room += list_bytes(alongs.of<T>().count);
      each_cluster<F>(clusters, r, [&](int cluster) TOFRAY_LAMBDA {
        if (!at.meets(clusters.of_clusters[cluster / cluster_size], cluster % cluster_size)) return;
        const ManyBounds& bodies = clusters.of_bodies[cluster];
        for (std::uint32_t left = overlaps<F>(bodies, r); left != 0; left &= left - 1) {
          const int i = __builtin_ctz(left);
          if (at.meets(bodies, i)) out.index[out.count++] = clusters.bodies[cluster * cluster_size + i];
        }
      });
    }
  }
  to.of<T>().picked = out;
}
template <class F, class... T>
TOFRAY_INLINE void narrow_each(shape::List<T...>, const scene::Alongs& alongs, const CulledAlong& from, const OnScreenPack<F>& at,
                               CulledAlong& to) {
  unsigned char* room = to.room;
  const scene::Bounds r = at.bounds();
  to.many = false;
  (narrow_one<F, T>(alongs, from, at, r, room, to), ...);
}

/// What can keep the sun off the points of a pack. Where they are at many depths, the rectangle that holds them on the screen is long and
/// holds much that is behind none of them: each cluster, and each form, is asked whether it is before any point. In no order: a shadow
/// has none.
template <class F>
TOFRAY_INLINE void narrow(const scene::Alongs& alongs, const CulledAlong& from, const OnScreenPack<F>& at, CulledAlong& to) {
  narrow_each<F>(shape::Shapes{}, alongs, from, at, to);
}

/// What of it a smaller rectangle holds. Shapes of which there are few, and meshes that tiles look at as a whole, stay as they are.
template <class F, template <class> class From>
TOFRAY_INLINE void narrow(const CulledOf<From>& from, const scene::Bounds& rectangle, CulledOf<From>& to) {
  narrow_each<F>(shape::Shapes{}, from, rectangle, to);
}

}  // namespace tofray::trace
