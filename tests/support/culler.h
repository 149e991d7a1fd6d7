// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <vector>

#include "trace/cull.h"

namespace tofray::test {

/// Room for what culling writes, of forms or of alongs.
class Culler {
 public:
  template <class Forms>
  explicit Culler(const Forms& forms) : Culler(counts(shape::Shapes{}, forms)) {}
  Culler(const Culler&) = delete;
  Culler& operator=(const Culler&) = delete;

  /// The first room or, for what is narrowed, the second one.
  template <class Culled, class Forms>
  Culled cull(const Forms& forms, const scene::Bounds& r) {
    Culled out{};
    out.room = reinterpret_cast<unsigned char*>(first_.data());
    trace::cull<float>(forms, &r, marks_, out);
    return out;
  }
  template <class Culled>
  Culled narrow(const Culled& from, const scene::Bounds& r) {
    Culled out{};
    out.room = reinterpret_cast<unsigned char*>(second_.data());
    trace::narrow<float>(from, r, out);
    return out;
  }
  trace::CulledAlong narrow(const scene::Alongs& alongs, const trace::CulledAlong& from, const trace::OnScreenPack<float>& at) {
    trace::CulledAlong out{};
    out.room = reinterpret_cast<unsigned char*>(second_.data());
    trace::narrow<float>(alongs, from, at, out);
    return out;
  }
  [[nodiscard]] const trace::Marks& marks() const { return marks_; }
  /// The first room.
  unsigned char* room() { return reinterpret_cast<unsigned char*>(first_.data()); }

 private:
  explicit Culler(const scene::Bodies& bodies)
      : first_(trace::room_of(bodies) / sizeof(scene::ManyBounds) + 1),
        second_(first_.size()),
        words_(trace::marks_bytes(bodies) / sizeof(std::uint64_t), 0x5555555555555555u) {
    const int most = trace::most_bodies(shape::Shapes{}, bodies);
    marks_ = {words_.data() + trace::Marks::sums_of(most), words_.data()};
  }
  template <class... T, class Forms>
  static scene::Bodies counts(shape::List<T...>, const Forms& forms) {
    scene::Bodies out{};
    ((out.of<T>().count = forms.template of<T>().count), ...);
    return out;
  }

  std::vector<scene::ManyBounds> first_, second_;
  std::vector<std::uint64_t> words_;
  trace::Marks marks_{};
};

}  // namespace tofray::test
