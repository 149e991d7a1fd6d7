// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Electrons and codes are written past the caches where nobody will find them there: the rule, what it needs of memory, and the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "backend/cpu/cpu.h"
#include "simulator/frame_memory.h"
#include "support/same_frame.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;
using pipeline::TapStores;

namespace {

struct Memory {
  alignas(64) float a[64], b[64];
  alignas(64) std::uint16_t codes[64];
  [[nodiscard]] flow::FrameView view() {
    flow::FrameView out{};
    out.tap_a = a, out.tap_b = b, out.raw = codes;
    return out;
  }
};

template <class T>
bool begins_a_line(const Array<T>& array) {
  return reinterpret_cast<std::uintptr_t>(array.data()) % 64 == 0;
}

Camera of_width(const Scene& scene, int width) {
  Camera camera = load_camera(scene);
  camera.sensor.width = width, camera.sensor.height = 43;
  return camera;
}

}  // namespace

TEST(array, begins_with_a_line_of_the_cache) {
  for (const std::size_t size : {1u, 3u, 100u, 1001u, 40'000u}) {
    const Array<float> floats(size, 2.5f);
    const Array<std::uint16_t> halves(size), copy = halves;
    EXPECT_TRUE(begins_a_line(floats) && begins_a_line(halves) && begins_a_line(copy)) << size;
    EXPECT_EQ(halves[size - 1], 0) << "like a std::vector's, new values are zero";
  }
}

TEST(array, stands_where_a_vector_does) {
  std::vector<float> plain(77);
  std::iota(plain.begin(), plain.end(), 1.0f);
  const Array<float> array = plain;
  EXPECT_TRUE(begins_a_line(array));
  const std::vector<float> back = array;
  EXPECT_EQ(back, plain);
  EXPECT_EQ(array, plain);
  Array<float> other = array;
  EXPECT_EQ(other, array);
  other[76] = 0;
  EXPECT_NE(other, array);
  EXPECT_NE(other, plain);
  other.pop_back();
  EXPECT_NE(other, plain);
}

TEST(past_caches, goes_what_lies_in_another_place_than_before_or_is_too_much) {
  Memory here, there;
  const flow::FrameSize small{std::int64_t{224} * 172, 9, 0, 0}, large{std::int64_t{640} * 480, 9, 0, 0};
  EXPECT_EQ(simulator::tap_stores(here.view(), nullptr, 224, small), TapStores::past_caches) << "the first frame";
  EXPECT_EQ(simulator::tap_stores(here.view(), there.a, 224, small), TapStores::past_caches) << "another place";
  EXPECT_EQ(simulator::tap_stores(here.view(), here.a, 224, small), TapStores::all) << "the same place, which the caches hold";
  EXPECT_EQ(simulator::tap_stores(here.view(), here.a, 640, large), TapStores::past_caches) << "more than they hold";
}

TEST(past_caches, go_whole_lines_alone) {
  Memory memory;
  const flow::FrameSize size{std::int64_t{640} * 480, 9, 0, 0};
  for (const int width : {8, 16, 48, 200, 639})
    EXPECT_EQ(simulator::tap_stores(memory.view(), nullptr, width, size), TapStores::all) << width;
  flow::FrameView view = memory.view();
  ++view.tap_a;
  EXPECT_EQ(simulator::tap_stores(view, nullptr, 640, size), TapStores::all);
  view = memory.view(), ++view.tap_b;
  EXPECT_EQ(simulator::tap_stores(view, nullptr, 640, size), TapStores::all);
  view = memory.view(), ++view.raw;
  EXPECT_EQ(simulator::tap_stores(view, nullptr, 640, size), TapStores::all);
  view = memory.view(), view.raw = nullptr;
  EXPECT_EQ(simulator::tap_stores(view, nullptr, 640, size), TapStores::some) << "raw frames are not wanted";
}

TEST(past_caches, goes_the_same_frame) {
  for (const char* name : {"card", "flying-ball"}) {
    const Scene scene = load_scene(name);
    for (const int width : {96, 90}) {
      const Camera camera = of_width(scene, width);
      const Frame plain = Simulator(scene, camera, {.threads = 1, .isa = Isa::scalar}).frame(3);
      for (const Isa isa : backend::machine_isas) {
        if (!backend::can_run(isa)) continue;
        for (const int subpixel : {1, 2}) {
          Simulator simulator(scene, camera, {.threads = 2, .isa = isa, .subpixel = subpixel});
          Frame kept, other;
          simulator.frame(2, kept);
          simulator.frame(3, kept);   // to the same place
          simulator.frame(3, other);  // to another one
          EXPECT_EQ(first_difference(kept, other), "") << name << " " << width << " " << backend::isa_name(isa) << " " << subpixel;
          if (subpixel == 1) {
            EXPECT_EQ(first_difference(other, plain), "") << name << " " << width << " " << backend::isa_name(isa);
          }
        }
      }
    }
  }
}

// A batch lies in memory of its own, which need not begin with a line.
TEST(past_caches, goes_no_batch_that_follows_a_frame) {
  const Scene scene = load_scene("card");
  const Camera camera = of_width(scene, 96);
  Simulator simulator(scene, camera, {.threads = 1, .backend = Backend::cpu});
  const Frame alone = simulator.frame(1);
  int seen = 0;
  simulator.frames(1, 1, [&](const FrameArrays& one) {
    EXPECT_TRUE(std::equal(alone.raw.tap_a.begin(), alone.raw.tap_a.end(), one.tap_a));
    EXPECT_TRUE(std::equal(alone.raw.raw.begin(), alone.raw.raw.end(), one.raw));
    ++seen;
  });
  EXPECT_EQ(seen, 1);
}
