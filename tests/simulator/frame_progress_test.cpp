// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What a waiting thread is told of a frame, and frames that are given up.
#include <gtest/gtest.h>

#include <thread>

#include "support/pixels.h"
#include "support/random_scene.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Scene bouncing_scene() {
  Random random(3);
  Scene scene = random_scene(random, 20, false);
  scene.transport = {3, 64, 0};
  return scene;
}

}  // namespace

TEST(frame_progress, ends_where_it_said_it_would) {
  const Camera camera = lit_camera(70, 50, 60);
  for (const int subpixel : {1, 2})
    for (const int bounces : {0, 3}) {
      FrameProgress now;
      Scene scene = bouncing_scene();
      scene.transport.bounces = bounces;
      Simulator simulator(scene, camera, {.backend = Backend::cpu, .subpixel = subpixel, .progress = &now});
      EXPECT_EQ(now.total, 0);
      (void)simulator.frame(0);
      const std::int64_t first = now.total;
      EXPECT_GT(first, 0);
      EXPECT_EQ(now.done, first) << subpixel << ", " << bounces;
      // The second frame finds the light of what stands still where the first has left it.
      (void)simulator.frame(1);
      EXPECT_EQ(now.done, now.total);
      EXPECT_EQ(now.total * 10 < first, bounces > 0) << subpixel;
    }
}

TEST(frame_progress, that_is_stopped_does_nothing_and_leaves_nothing_for_the_next_frame) {
  const Camera camera = lit_camera(70, 50, 60);
  FrameProgress now;
  Simulator simulator(bouncing_scene(), camera, {.backend = Backend::cpu, .progress = &now});
  now.stop = true;
  (void)simulator.frame(0);
  EXPECT_EQ(now.done, 0);
  EXPECT_GT(now.total, 0);
  now.stop = false;
  const Frame again = simulator.frame(0), fresh = Simulator(bouncing_scene(), camera, {.backend = Backend::cpu}).frame(0);
  EXPECT_EQ(again.raw.raw, fresh.raw.raw);
  EXPECT_EQ(again.truth.indirect_e, fresh.truth.indirect_e);
}

TEST(frame_progress, is_seen_and_stopped_from_another_thread) {
  Scene scene = bouncing_scene();
  scene.transport = {8, 4096, 0};
  FrameProgress now;
  Simulator simulator(scene, lit_camera(224, 172, 212), {.threads = 2, .backend = Backend::cpu, .progress = &now});
  std::int64_t seen = 0;
  {
    const std::jthread other([&] {
      while (now.done == 0) std::this_thread::yield();
      seen = now.done;
      now.stop = true;
    });
    (void)simulator.frame(0);
  }
  EXPECT_GT(seen, 0);
  EXPECT_LT(now.done, now.total / 2);
}
