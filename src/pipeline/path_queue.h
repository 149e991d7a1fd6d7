// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/path.h"

/// Many paths of a pack of pixels at once, for machines with lanes.                                          [theory: path-tracing]
///
/// Of paths that go on side by side some end at each surface, and a pack is followed until the last of them has ended: from the third bounce
/// on most of its lanes are empty. Here all paths of several samples, of both halves, go from surface to surface together, and those that go
/// on close ranks before the next one. What each surface brings is kept, and added to the light path by path and surface by surface, as if
/// they had been followed one after the other: not a bit of the sum changes.
namespace tofray::pipeline {

/// Ways on of many paths, one after the other.
template <class F>
class PathQueue {
 public:
  static constexpr int most_rows = 16;  ///< a path of each pixel makes a row
  /// A path that goes on.
  struct Entry {
    Onward<F> on;
    F range;             ///< length of the path up to where it goes on [m]
    num::Int<F> number;  ///< row·lanes + lane
  };

  TOFRAY_INLINE int count() const { return count_; }
  TOFRAY_INLINE void clear() { count_ = 0; }
  /// Those lanes whose ray is wanted.
  TOFRAY_INLINE void add(const Entry& e) {
    const std::uint32_t bits = num::lanes_of(e.on.from.wanted);
    int plane = 0;
    each(e, [&](F value) TOFRAY_LAMBDA { num::store_dense(value_[plane++] + count_, value, bits); });
    count_ += __builtin_popcount(bits);
  }
  /// No more are added: what lies behind the last one are zeros.
  TOFRAY_INLINE void close() {
    for (auto& plane : value_) num::store(plane + count_, F(0.0f), num::lanes<F>);
  }
  /// Paths `first` and those after it.
  TOFRAY_INLINE Entry at(int first) const {
    Entry e;
    int plane = 0;
    each(e, [&](F& value) TOFRAY_LAMBDA { value = num::load<F>(value_[plane++] + first, num::lanes<F>); });
    e.on.from.wanted = num::lane_index<F>() < num::Int<F>(count_ - first);
    return e;
  }
  TOFRAY_INLINE std::int32_t number(int path) const { return static_cast<std::int32_t>(num::bits(value_[planes - 1][path])); }

 private:
  static constexpr int planes = 14;
  template <class E, class Visit>
  TOFRAY_INLINE static void each(E& e, const Visit& visit) {
    auto& [ray, from, weight] = e.on;
    visit(ray.x), visit(ray.y), visit(ray.z), visit(ray.dx), visit(ray.dy), visit(ray.dz);
    visit(from.nx), visit(from.ny), visit(from.nz), visit(from.away);
    visit(weight), visit(e.range);
    visit_int(from.facet, visit), visit_int(e.number, visit);
  }
  template <class Visit>
  TOFRAY_INLINE static void visit_int(const num::Int<F>& value, const Visit& visit) {
    visit(num::from_bits(num::to_uint(value)));
  }
  template <class Visit>
  TOFRAY_INLINE static void visit_int(num::Int<F>& value, const Visit& visit) {
    F bits;
    visit(bits);
    value = num::to_signed(num::bits(bits));
  }

  float value_[planes][(most_rows + 1) * num::lanes<F>];
  int count_ = 0;
};

/// Seeds of paths of which some may be of the first half and some of the second.
/// @param from, to  halves of the first one and of the last one: one after the other
template <class F>
TOFRAY_INLINE ChoiceSeed<F> seed_of_halves(const BounceView& s, num::Int<F> pixel, int bounce, num::Mask<F> second, int from, int to) {
  ChoiceSeed<F> seed = seed_of<F>(s, pixel, bounce, from);
  if (from == to) return seed;
  const ChoiceSeed<F> other = seed_of<F>(s, pixel, bounce, to);
  for (int i = 0; i < 4; ++i) seed.word.w[i] = num::select(second, other.word.w[i], seed.word.w[i]);
  return seed;
}

/// What the surfaces of all paths bring: of each bounce, and of each light there, a list in the order of its queue.
template <class F>
class PathLights {
 public:
  static constexpr int most_bounces = 65;

  /// @return how many rows there is room for
  TOFRAY_INLINE static int rows(const Setup& s, const power::Wanted& wanted) {
    const int by_room = room / (planes(s, wanted) * most_surfaces(s) * num::lanes<F>);
    return by_room < PathQueue<F>::most_rows ? by_room : PathQueue<F>::most_rows;
  }
  TOFRAY_INLINE PathLights(const Setup& s, const power::Wanted& wanted, int rows) : s_(s), wanted_(wanted), rows_(rows) {}

  TOFRAY_INLINE void put_ambient(int bounce, int first, F rate) { put(bounce, 0, first, rate); }
  /// As far as it can be summed already: the sums alone, or the path itself.
  TOFRAY_INLINE void put(int bounce, int l, int first, const flow::Path<F>& path) {
    int plane = 1 + l * planes_of_light(s_, wanted_);
    put(bounce, plane++, first, path.rate);
    if (s_.phasors.sums_alone == 0) return put(bounce, plane, first, path.length);
    power::sums_of_path(s_.phasors, wanted_, path, [&](int, F in_phase, F quarter) TOFRAY_LAMBDA {
      put(bounce, plane++, first, in_phase), put(bounce, plane++, first, quarter);
    });
  }
  /// Adds what a bounce has of a row. [as power::add_one_of_many]
  /// @param first  where that stands in the lists
  /// @param bits   lanes that have some
  TOFRAY_INLINE void add_to(flow::Light<F>& light, int bounce, int l, int first, std::uint32_t bits) const {
    int plane = 1 + l * planes_of_light(s_, wanted_);
    const F rate = at(bounce, plane++, first, bits);
    if (s_.phasors.sums_alone == 0) return power::add_one_of_many(s_.phasors, wanted_, l, {rate, at(bounce, plane, first, bits)}, light);
    light.signal_rate = light.signal_rate + rate;
    for (int j = wanted_.first; j < wanted_.last; ++j) {
      light.in_phase[j] = light.in_phase[j] + at(bounce, plane++, first, bits);
      light.quarter[j] = light.quarter[j] + at(bounce, plane++, first, bits);
    }
  }
  TOFRAY_INLINE void add_ambient_to(flow::Light<F>& light, int bounce, int first, std::uint32_t bits) const {
    light.ambient_rate = light.ambient_rate + at(bounce, 0, first, bits);
  }

 private:
  static constexpr int room = 32768;
  TOFRAY_INLINE static int planes_of_light(const Setup& s, const power::Wanted& wanted) {
    return s.phasors.sums_alone != 0 ? 1 + 2 * (wanted.last - wanted.first) : 2;
  }
  TOFRAY_INLINE static int planes(const Setup& s, const power::Wanted& wanted) { return 1 + s.scene.lights * planes_of_light(s, wanted); }
  TOFRAY_INLINE int place(int bounce, int plane) const { return ((bounce - 1) * planes(s_, wanted_) + plane) * rows_ * num::lanes<F>; }
  TOFRAY_INLINE void put(int bounce, int plane, int first, F value) {
    num::store(value_ + place(bounce, plane) + first, value, num::lanes<F>);
  }
  TOFRAY_INLINE F at(int bounce, int plane, int first, std::uint32_t bits) const {
    return num::load_dense<F>(value_ + place(bounce, plane) + first, bits);
  }

  const Setup& s_;
  const power::Wanted wanted_;
  const int rows_;
  float value_[room + num::lanes<F>];
};

/// The light of one path of each pixel, of either half, for each of some samples.
/// @param sample, samples  the first of them, and how many: half of PathLights::rows at most
template <class F>
TOFRAY_NOINLINE void follow_paths(const Setup& s, int moment, F area, const power::Wanted& wanted, const Pixels& p, const Vertex<F>& first,
                                  F vignetting, int sample, int samples, flow::Light<F>* halves) {
  constexpr int lanes = num::lanes<F>;
  using Int = num::Int<F>;
  using Uint = num::Uint<F>;
  const bool uniform = s.power.ambient == camera::AmbientLight::uniform, sun = s.power.ambient == camera::AmbientLight::directional;
  const int rows = 2 * samples;
  alignas(64) float area_of[lanes], vignetting_of[lanes];
  num::store(area_of, area, lanes), num::store(vignetting_of, vignetting, lanes);
  PathQueue<F> queue[2];
  PathLights<F> lights(s, wanted, rows);
  std::uint32_t lanes_with[PathLights<F>::most_bounces + 1][PathQueue<F>::most_rows];
  const auto note_lanes = [&](int bounce, const PathQueue<F>& paths) TOFRAY_LAMBDA {
    for (int row = 0; row < rows; ++row) lanes_with[bounce][row] = 0;
    for (int k = 0; k < paths.count(); ++k) lanes_with[bounce][paths.number(k) / lanes] |= std::uint32_t{1} << paths.number(k) % lanes;
  };

  for (int row = 0; row < rows; ++row) {
    const int half = row / samples;
    const ChoiceSeed<F> seed = seed_of<F>(s.bounces, Int(p.index) + num::lane_index<F>(), 1, half);
    const Choice<F> choice = choose<F>(seed, Uint(static_cast<std::uint32_t>(sample + row - half * samples)));
    queue[0].add({leave<F>(choice, false, first, F(1.0f)), first.at.range, num::lane_index<F>() + Int(row * lanes)});
  }
  int bounce = 1;
  for (; queue[(bounce - 1) % 2].count() > 0; ++bounce) {
    PathQueue<F>&now = queue[(bounce - 1) % 2], &next = queue[bounce % 2];
    now.close(), next.clear();
    note_lanes(bounce, now);
    for (int k = 0; k < now.count(); k += lanes) {
      const auto e = now.at(k);
      const Int lane = e.number & Int(lanes - 1), row = num::to_signed(num::to_uint(e.number) >> __builtin_ctz(lanes));
      const Vertex<F> v =
          next_vertex<F>(s, moment, s.scene.any_details != 0 ? num::gather(area_of, lane) : F(0.0f), e.on.ray, e.on.from, e.range);
      const F share = e.on.weight * num::gather(vignetting_of, lane);
      if (uniform) lights.put_ambient(bounce, k, num::select(v.escaped, share * F(s.power.ambient_rate), F(0.0f)));
      if (bounce <= s.bounces.most) {
        each_light<F>(s, moment, v.at, ray_to(v), v.step, share,
                      [&](int l, const flow::Path<F>& path) TOFRAY_LAMBDA { lights.put(bounce, l, k, path); });
        if (sun) lights.put_ambient(bounce, k, sunlight<F>(s, moment, v, share));
      }
      if (bounce == most_surfaces(s)) continue;
      const auto second = row > Int(samples - 1);
      const int last = k + lanes < now.count() ? k + lanes - 1 : now.count() - 1;
      const ChoiceSeed<F> seed = seed_of_halves<F>(s.bounces, Int(p.index) + lane, bounce + 1, second, now.number(k) / lanes / samples,
                                                   now.number(last) / lanes / samples);
      const Choice<F> choice = choose<F>(seed, num::to_uint(Int(sample) + row - num::select(second, Int(samples), Int(0))));
      next.add({leave<F>(choice, bounce + 1 >= first_roulette, v, e.on.weight), v.at.range, e.number});
    }
  }

  int done[PathLights<F>::most_bounces + 1];  // of each bounce's list
  for (int b = 1; b < bounce; ++b) done[b] = 0;
  for (int row = 0; row < rows; ++row) {
    flow::Light<F>& light = halves[row / samples];
    for (int b = 1; b < bounce && lanes_with[b][row] != 0; ++b) {
      const std::uint32_t bits = lanes_with[b][row];
      for (int l = 0; l < s.scene.lights && b <= s.bounces.most; ++l) lights.add_to(light, b, l, done[b], bits);
      if (uniform || sun) lights.add_ambient_to(light, b, done[b], bits);
      done[b] += __builtin_popcount(bits);
    }
  }
}

}  // namespace tofray::pipeline
