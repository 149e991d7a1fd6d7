// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Samples within the pixels: mixed pixels against the closed form and against images of finer pixels, what the truth says of them, and that
// nothing else changes.
#include <gtest/gtest.h>

#include "backend/cpu/cpu.h"
#include "camera/frozen_camera.h"
#include "camera/lens/subpixel.h"
#include "support/cuda_cases.h"
#include "support/pixels.h"
#include "support/random_scene.h"

using namespace tofray;
using namespace tofray::test;

namespace {

/// One pixel so small that ranges within it are alike, and the light at the camera: the near half plane ends `share` of the way across.
double mixed_range(double share, int n, Truth* truth = nullptr) {
  Camera camera = plain_camera(1, 1, 1e5);
  camera.illumination.push_back(one_watt_per_steradian());
  Scene scene = wall(1.6);
  const double edge = (share - 0.5) * 1.0 / 1e5;  // at 1 m
  scene.objects.push_back(object(Rectangle{{edge - 0.5, 0, 1.0}, {1, 1}}));
  Simulator simulator(scene, camera, {.noise = Noise::off, .threads = 1, .subpixel = n});
  const Frame frame = simulator.frame(0);
  if (truth != nullptr) *truth = frame.truth;
  return range_of_taps(frame.raw, 0);
}

Scene edges() {
  Random random(7);
  return random_scene(random, 14, false);
}

Camera edge_camera() {
  Camera camera = small(load_camera("pico-flexx"));
  camera.lens.k1 = 0, camera.lens.vignetting = Lens::Vignetting::off;
  camera.sensor.width = 40, camera.sensor.height = 30, camera.sensor.fill_factor = 1;
  return camera;
}

/// A camera of the same view with n × n pixels in the place of each.
Camera finer(Camera camera, int n) {
  camera.sensor.width *= n, camera.sensor.height *= n, camera.sensor.pixel_pitch_m /= n;
  Lens& lens = camera.lens;
  lens.fx_px *= n, lens.fy_px *= n;
  lens.cx_px = (lens.cx_px + 0.5) * n - 0.5, lens.cy_px = (lens.cy_px + 0.5) * n - 0.5;
  return camera;
}

}  // namespace

// S17: 60 MHz, walls at 1.0 and 1.6 m, near share 10, 50, 90 %: arg Σ share/d²·e^{i4πfd/c}.
TEST(subpixel, samples_of_two_walls_mix_as_phasors) {
  EXPECT_NEAR(mixed_range(0.1, 10), 1.491816774, 1e-6);
  EXPECT_NEAR(mixed_range(0.5, 10), 1.144633742, 1e-6);
  EXPECT_NEAR(mixed_range(0.9, 10), 1.017167822, 1e-6);
  EXPECT_NEAR(mixed_range(0.5, 2), 1.144633742, 1e-6);
  EXPECT_NEAR(mixed_range(0.5, 16), 1.144633742, 1e-6);
  EXPECT_NEAR(mixed_range(0.4, 1), 1.6, 1e-6) << "the middle alone";
}

TEST(subpixel, samples_are_compared_with_what_the_middle_sees) {
  Truth truth;
  (void)mixed_range(0.1, 10, &truth);
  EXPECT_EQ(truth.object_id[0], 0);
  EXPECT_NEAR(static_cast<double>(truth.object_share[0]), 0.9, 1e-6);
  EXPECT_EQ(truth.mixed[0], 1);
  (void)mixed_range(0.9, 10, &truth);
  EXPECT_EQ(truth.object_id[0], 1);
  EXPECT_NEAR(static_cast<double>(truth.object_share[0]), 0.9, 1e-6);
  (void)mixed_range(1.1, 10, &truth);
  EXPECT_EQ(truth.object_share[0], 1.0f);
  EXPECT_EQ(truth.mixed[0], 0);
  (void)mixed_range(0.5, 1, &truth);
  EXPECT_TRUE(truth.mixed.empty() && truth.object_share.empty()) << "nothing is known of it";
}

// One object alone makes a mixed pixel where its ranges are more than 5 cm apart; one that ends in nothing does, too.
TEST(subpixel, ranges_and_nothing_make_mixed_pixels) {
  Camera camera = lit_camera(1, 1, 100);
  const auto mixed = [&](const Scene& scene) {
    const Frame frame = Simulator(scene, camera, {.threads = 1, .subpixel = 4}).frame(0);
    return std::pair{frame.truth.mixed[0], frame.truth.object_share[0]};
  };
  for (const double depth : {0.04, 0.08}) {
    Scene steps = wall(1);
    // Rows of samples look 0.375·0.01 m up and down at 1 m.
    steps.objects[0].shape = Plane{{0, 0, 1}, {0, depth / 0.0075, -1}};
    EXPECT_EQ(mixed(steps), (std::pair<std::uint8_t, float>{depth > 0.05 ? 1 : 0, 1.0f})) << depth;
  }
  Scene half = wall(1);
  half.objects[0].shape = Rectangle{{0.5, 0, 1}, {1, 1}};
  EXPECT_EQ(mixed(half), (std::pair<std::uint8_t, float>{1, 0.5f}));
  half.objects[0].shape = Rectangle{{5, 0, 1}, {1, 1}};
  EXPECT_EQ(mixed(half), (std::pair<std::uint8_t, float>{0, 1.0f})) << "all see nothing, as the middle does";
}

// A pixel of n × n samples collects what n × n finer pixels collect together; truth stays that of the middle.
TEST(subpixel, samples_are_finer_pixels_taken_together) {
  const Scene scene = edges();
  const Camera camera = edge_camera();
  for (const int n : {2, 3, 5}) {
    const Frame one = Simulator(scene, camera, {.noise = Noise::off}).frame(0);
    const Frame whole = Simulator(scene, camera, {.noise = Noise::off, .subpixel = n}).frame(0);
    const Camera fine = finer(camera, n);
    const Frame parts = Simulator(scene, fine, {.noise = Noise::off}).frame(0);
    EXPECT_EQ(whole.truth.range_m, one.truth.range_m);
    EXPECT_EQ(whole.truth.power_w, one.truth.power_w);
    std::size_t at = 0;
    for (std::size_t k = 0; k < camera.mode.sequence.size(); ++k) {
      for (int y = 0; y < camera.sensor.height; ++y) {
        for (int x = 0; x < camera.sensor.width; ++x, ++at) {
          double a = 0, b = 0;
          for (int i = 0; i < n * n; ++i) {
            const int row = n * y + i / n, column = n * x + i % n;
            const auto from = (k * static_cast<std::size_t>(fine.sensor.height) + static_cast<std::size_t>(row)) *
                                  static_cast<std::size_t>(fine.sensor.width) +
                              static_cast<std::size_t>(column);
            a += static_cast<double>(parts.raw.tap_a[from]), b += static_cast<double>(parts.raw.tap_b[from]);
          }
          // dark electrons come with each of the finer pixels
          const double dark = (n * n - 1) * camera.pixel.dark_current_e_per_s * camera.mode.sequence[k].integration_time_s;
          ASSERT_NEAR(static_cast<double>(whole.raw.tap_a[at]), a - dark, 2e-5 * a + 1e-3) << n << ", " << k << " at " << x << ", " << y;
          ASSERT_NEAR(static_cast<double>(whole.raw.tap_b[at]), b - dark, 2e-5 * b + 1e-3);
        }
      }
    }
  }
}

// Samples that see pictures: each stands for a share of what a pixel sees of one.
TEST(subpixel, samples_see_pictures_as_finer_pixels_do) {
  auto map = std::make_shared<ReflectivityMap>();
  map->width = map->height = 256;
  for (int i = 0; i < 256 * 256; ++i) map->values.push_back((i ^ i >> 8) & 1 ? 1.0f : 0.0f);
  TriangleMesh card;
  card.vertices = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  card.triangles = {{0, 1, 2}, {0, 2, 3}};
  card.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  Scene scene = wall(2);
  scene.materials[0].map = map;
  Mesh mesh;
  mesh.triangles = std::make_shared<const TriangleMesh>(card);
  scene.objects.push_back(object(mesh));
  const Camera camera = edge_camera(), fine = finer(camera, 2);
  const Frame whole = Simulator(scene, camera, {.noise = Noise::off, .subpixel = 2}).frame(0);
  const Frame parts = Simulator(scene, fine, {.noise = Noise::off}).frame(0);
  const auto width = static_cast<std::size_t>(fine.sensor.width);
  for (int y = 10; y < 20; ++y) {
    for (int x = 10; x < 30; ++x) {
      const std::size_t at = static_cast<std::size_t>(2 * y) * width + static_cast<std::size_t>(2 * x);
      const auto pixels = static_cast<std::size_t>(camera.sensor.width * camera.sensor.height);
      const std::size_t lit = pixels + static_cast<std::size_t>(y * camera.sensor.width + x);  // the second raw frame
      const std::size_t fine_lit = 4 * pixels + at;
      double electrons = 0;
      for (const std::size_t i : {fine_lit, fine_lit + 1, fine_lit + width, fine_lit + width + 1})
        electrons += static_cast<double>(parts.truth.signal_e[i]);
      ASSERT_NEAR(static_cast<double>(whole.truth.signal_e[lit]), electrons, 1e-5 * electrons) << x << ", " << y;
      ASSERT_GT(electrons, 0);
    }
  }
}

// A mask in which a quarter alone is open is a pixel that looks there; one that is open everywhere is the whole pixel.
TEST(subpixel, masks_say_where_a_pixel_looks) {
  Scene scene = edges();
  for (Material& one : scene.materials) one.map = nullptr;  // a sample sees a fourth of what a pixel sees of a picture
  Camera camera = edge_camera();
  const auto frame = [&](const Camera& one, int n) {
    return Simulator(scene, one, {.noise = Noise::off, .truth = false, .subpixel = n}).frame(0);
  };
  Camera masked = camera;
  masked.sensor.mask = {PixelMask::Kind::table, {5, 5, 5, 5, 5, 5}, 3, 2};
  EXPECT_EQ(first_difference(frame(masked, 3), frame(camera, 3)), "");
  masked.sensor.mask = {PixelMask::Kind::table, {0, 7, 0, 0}, 2, 2};  // above, on the right
  Camera aside = camera;
  aside.lens.cx_px -= 0.25, aside.lens.cy_px += 0.25;
  const Frame here = frame(masked, 2), there = frame(aside, 1);
  for (std::size_t i = 0; i < here.raw.tap_a.size(); ++i)
    ASSERT_NEAR(static_cast<double>(here.raw.tap_a[i]), static_cast<double>(there.raw.tap_a[i]),
                1e-5 * static_cast<double>(there.raw.tap_a[i]) + 1e-3);
  // shares are those of areas, also where cells of samples and of the mask overlap in part
  masked.sensor.mask = {PixelMask::Kind::table, {1, 0, 1}, 3, 1};
  const std::vector<camera::SubpixelSample> samples = camera::subpixel_samples(masked.sensor, 2);
  ASSERT_EQ(samples.size(), 4u);
  for (const camera::SubpixelSample& sample : samples) EXPECT_DOUBLE_EQ(sample.share, 0.25);
  masked.sensor.mask = {PixelMask::Kind::table, {1e12, 1, 0}, 3, 1};
  EXPECT_EQ(camera::subpixel_samples(masked.sensor, 3).size(), 6u) << "what is dark has no sample";
}

// Rays are the lens model's own, at any distortion: the middle of a sample's place is where a finer pixel's middle is.
TEST(subpixel, samples_look_where_the_lens_model_says) {
  Camera camera = load_camera("pico-flexx");
  camera.sensor.fill_factor = 0.64;
  const std::vector<camera::SubpixelSample> samples = camera::subpixel_samples(camera.sensor, 3);
  ASSERT_EQ(samples.size(), 9u);
  EXPECT_DOUBLE_EQ(samples[0].offset_px.x, -0.8 / 3);
  EXPECT_DOUBLE_EQ(samples[5].offset_px.x, 0.8 / 3);
  EXPECT_DOUBLE_EQ(samples[5].offset_px.y, 0);
  const camera::FrozenCamera frozen(camera, false, 0, 3);
  const camera::LensView& view = frozen.subpixel().lens[2];
  for (const int at : {0, 223, 38527, 20000}) {
    const camera::Point2 ray{static_cast<double>(view.ray_x[at]), static_cast<double>(view.ray_y[at])};
    const camera::Point2 pixel = camera::project(camera.lens, ray);
    EXPECT_NEAR(pixel.x, at % 224 + samples[2].offset_px.x, 3e-5);
    EXPECT_NEAR(pixel.y, at / 224 + samples[2].offset_px.y, 3e-5);
  }
}

// One after the other from one simulator, with and without motion: what is kept of a frame's light is that of a new simulator.
TEST(subpixel, light_that_is_kept_is_that_of_the_frame) {
  for (const bool moving : {false, true}) {
    Random random(11);
    Scene scene = random_scene(random, 12, moving);
    const Camera camera = small(load_camera("pico-flexx"));
    const SimulatorOptions options{.exposure_samples = 2, .subpixel = 2};
    Simulator simulator(scene, camera, options);
    for (const std::uint64_t i : {0ull, 1ull, 7ull})
      EXPECT_EQ(first_difference(simulator.frame(i), Simulator(scene, camera, options).frame(i)), "") << i;
    const std::vector<FrameRequest> requests = mixed_requests(scene, 8);
    std::size_t next = 0;
    simulator.frames(requests, [&](const FrameArrays& arrays) {
      EXPECT_EQ(first_difference(copy_of(arrays), alone(scene, camera, options, requests[next])), "") << next;
      ++next;
    });
    EXPECT_EQ(next, 8u);
    Frame into;
    for (const FrameRequest& request : requests) {
      simulator.frame(request, into);
      EXPECT_EQ(first_difference(arrays_only(into), alone(scene, camera, options, request)), "") << "request of frame " << request.index;
    }
  }
}

TEST(subpixel, samples_give_the_same_bytes_on_every_machine) {
  for (int i = 0; i < 4; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 20);
    const Scene scene = random_scene(random, 10, i % 2 == 1);
    Camera camera = i < 2 ? small(load_camera("pico-flexx")) : with_everything(load_camera("pico-flexx"));
    if (i > 0) camera.lens.scatter = {Scatter::Kind::gaussians, 0.1, {1.5, 9}, {2, 1}};
    const auto bytes = [&](Isa isa, int threads, bool culling) {
      return Simulator(scene, camera, {.threads = threads, .isa = isa, .exposure_samples = 1 + i, .subpixel = 3, .culling = culling})
          .frame(2);
    };
    const Frame reference = bytes(Isa::scalar, 1, true);
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;  // named by skipped_on_this_machine
      EXPECT_EQ(first_difference(bytes(isa, 3, true), reference), "") << backend::isa_name(isa);
    }
    EXPECT_EQ(first_difference(bytes(Isa::best, 2, false), reference), "");
  }
}

TEST(subpixel, samples_and_stages_go_together) {
  const Scene scene = edges();
  const Camera camera = small(load_camera("pico-flexx"));
  const Frame all = Simulator(scene, camera, {.subpixel = 2}).frame(3);
  for (const Stage last : {Stage::trace, Stage::power, Stage::raw}) {
    const Frame part = Simulator(scene, camera, {.last_stage = last, .subpixel = 2}).frame(3);
    EXPECT_EQ(part.truth.mixed, all.truth.mixed);
    EXPECT_EQ(part.truth.object_share, all.truth.object_share);
    EXPECT_EQ(part.truth.object_id, all.truth.object_id);
    if (last >= Stage::power) {
      EXPECT_EQ(part.truth.power_w, all.truth.power_w);
    }
    if (last >= Stage::raw) {
      EXPECT_EQ(part.raw.raw, all.raw.raw);
    }
  }
  const Frame bare = Simulator(scene, camera, {.truth = false, .subpixel = 2}).frame(3);
  EXPECT_EQ(bare.raw.raw, all.raw.raw);
  EXPECT_EQ(bare.depth.flags, all.depth.flags);
}

TEST(subpixel, numbers_out_of_range_are_refused) {
  const Scene scene = wall(1);
  Camera camera = lit_camera(4, 4);
  for (const int n : {0, -1, 17, 1'000'000'000}) EXPECT_THROW(Simulator(scene, camera, {.subpixel = n}), Error) << n;
  camera.sensor.mask = {PixelMask::Kind::table, {0, 0}, 2, 1};
  EXPECT_THROW(Simulator(scene, camera, {.subpixel = 2}), Error) << "dark";
  camera.sensor.mask = {PixelMask::Kind::table, {1, 1, 1}, 2, 1};
  EXPECT_THROW(Simulator(scene, camera, {.subpixel = 2}), Error);
  Camera large = lit_camera(4096, 4096);
  try {
    Simulator(scene, large, {.subpixel = 16});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_NE(std::string(error.what()).find("--subpixel"), std::string::npos) << error.what();
  }
}
