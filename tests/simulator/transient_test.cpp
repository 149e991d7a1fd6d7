// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light by the length of its path, against closed forms.
#include <gtest/gtest.h>

#include <numeric>

#include "backend/cpu/cpu.h"
#include "support/cuda_cases.h"
#include "support/pixels.h"
#include "support/random_scene.h"
#include "support/sanitizers.h"
#include "support/text.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Scene with_bins(Scene scene, int bins, double first_m, double width_m) {
  scene.transport.transient = {bins, first_m, width_m};
  return scene;
}

Frame silent(const Scene& scene, const Camera& camera, SimulatorOptions options = {}) {
  options.noise = Noise::off;
  return Simulator(scene, camera, options).frame(0);
}

/// Light of one pixel, bin by bin.
std::vector<double> bins_of(const Truth& truth, std::size_t pixel) {
  const std::size_t pixels = truth.range_m.size();
  std::vector<double> out;
  for (std::size_t i = pixel; i < truth.transient_e_per_s.size(); i += pixels)
    out.push_back(static_cast<double>(truth.transient_e_per_s[i]));
  return out;
}
double total(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
double total(const std::vector<float>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// S of a pixel, as raw frame 0 collects it.
double rate_of(const Frame& frame, std::size_t pixel) {
  return static_cast<double>(frame.truth.signal_e[pixel]) / frame.raw.integration_time_s[0];
}

/// All light of each pixel is in its bins, or lost, and nothing but that is in `lost`.
void expect_all_light(const Frame& frame, bool none_lost) {
  for (std::size_t i = 0; i < frame.truth.range_m.size(); ++i) {
    const double rate = rate_of(frame, i), lost = static_cast<double>(frame.truth.transient_lost_e_per_s[i]);
    ASSERT_NEAR(total(bins_of(frame.truth, i)) + lost, rate, 3e-6 * rate) << i;
    if (none_lost) {
      ASSERT_EQ(lost, 0) << i;
    }
  }
}

/// A lamp that codes are not held at their ends by.
Camera dim(int width, int height, double focal_px) {
  Camera camera = lit_camera(width, height, focal_px);
  camera.illumination[0].power_w *= 2e-3;
  return camera;
}

Scene nook() {
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  return scene;
}

}  // namespace

// A wall at 1 m with the light at the camera: 2 m. Bins of 0.3 m from 0.5 m on have their centres at 0.65, 0.95 … 1.85, 2.15 m.
TEST(transient, of_a_wall_stands_in_the_two_nearest_bins) {
  const Camera camera = lit_camera();
  const Frame frame = silent(with_bins(wall(1, 0.5), 8, 0.5, 0.3), camera);
  ASSERT_EQ(frame.truth.bins, 8);
  ASSERT_EQ(frame.truth.transient_e_per_s.size(), 8u);
  const double rate = rate_of(frame, 0);
  const std::vector<double> found = bins_of(frame.truth, 0);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(found[k] / rate, k == 4 ? 0.5 : k == 5 ? 0.5 : 0, 1e-6) << k;
  // 0.1 bins further on: 10 % of it go on to the next one.
  const std::vector<double> moved = bins_of(silent(with_bins(wall(1, 0.5), 8, 0.47, 0.3), camera).truth, 0);
  EXPECT_NEAR(moved[4] / rate, 0.4, 2e-6);
  EXPECT_NEAR(moved[5] / rate, 0.6, 2e-6);
  EXPECT_EQ(moved[3] + moved[6], 0);
}

TEST(transient, keeps_in_the_outermost_bins_what_lies_in_them_and_loses_what_does_not) {
  const Camera camera = lit_camera();
  const auto with = [&](int bins, double first, double width) { return silent(with_bins(wall(1, 0.5), bins, first, width), camera); };
  const double rate = rate_of(with(1, 0, 10), 0);
  EXPECT_NEAR(bins_of(with(1, 0, 10).truth, 0)[0], rate, 1e-6 * rate) << "one bin";
  EXPECT_NEAR(bins_of(with(3, 1.99, 0.1).truth, 0)[0], rate, 1e-6 * rate) << "in the first half of the first bin";
  EXPECT_NEAR(bins_of(with(3, 1.71, 0.1).truth, 0)[2], rate, 1e-6 * rate) << "in the last half of the last bin";
  for (const double first : {2.01, 1000.0, 1e6, 1.69}) {
    const Frame none = with(3, first, 0.1);
    EXPECT_EQ(total(bins_of(none.truth, 0)), 0) << first;
    EXPECT_NEAR(static_cast<double>(none.truth.transient_lost_e_per_s[0]), rate, 1e-6 * rate) << first;
  }
  const Frame nothing = silent(with_bins({}, 5, 0, 1), camera);
  EXPECT_EQ(total(bins_of(nothing.truth, 0)) + total(nothing.truth.transient_lost_e_per_s), 0) << "an empty scene";
}

// Within a white ball all of it gets the same light S_0, straight back after 2R. Of that ρ comes again over a chord c, whose density is
// c/(2R²), as cosines have it: ρ·S_0·(ℓ − 2R)/(2R²) for ℓ of 2R to 4R. Sharing between bins leaves a straight line as it is.
TEST(transient, of_an_integrating_spheres_first_bounce_is_a_straight_line) {
  constexpr double rho = 0.7;
  constexpr int side = with_sanitizers ? 8 : 24;
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, rho, 0, 1});
  scene.objects.push_back(object(Sphere{{0, 0, 0}, 1}));
  scene.transport.bounces = 1, scene.transport.samples = 4096;
  Camera camera = plain_camera(side, side, 20);
  camera.illumination.push_back(one_watt_per_steradian());
  camera.illumination[0].pattern.half_angle_rad = pi, camera.illumination[0].power_w = 4 * pi;
  const Frame frame = silent(with_bins(scene, 20, 2.0001, 0.1), camera);
  std::vector<double> sum(20);
  double direct = 0;
  for (std::size_t i = 0; i < side * side; ++i) {
    const std::vector<double> one = bins_of(frame.truth, i);
    for (std::size_t k = 0; k < 20; ++k) sum[k] += one[k];
    direct += static_cast<double>(frame.truth.transient_lost_e_per_s[i]);  // 2 m are before the first bin
  }
  EXPECT_NEAR(total(frame.truth.direct_e) / frame.raw.integration_time_s[0] / 4, direct, 1e-4 * direct) << "four raw frames have it each";
  EXPECT_NEAR(total(sum), rho * direct, 1e-4 * direct);
  for (std::size_t k = 1; k < 19; ++k) {
    const double expected = rho * direct * 0.1 * (0.1 * (static_cast<double>(k) + 0.5) + 0.0001) / 2;
    EXPECT_NEAR(sum[k] / expected, 1, 5e-3) << k;
  }
}

// Wide and low, or narrow and high: as many pieces of the image as there are, whichever way they are counted.
TEST(transient, is_there_in_every_pixel_of_any_image) {
  for (const auto& [width, height] : {std::pair(400, 2), std::pair(2, 400), std::pair(33, 17)}) {
    const Frame frame = silent(with_bins(wall(1, 0.8), 4, 1.5, 0.5), dim(width, height, 400));
    for (std::size_t i = 0; i < frame.truth.range_m.size(); ++i) ASSERT_GT(total(bins_of(frame.truth, i)), 0) << width << " " << i;
  }
}

// Sharing keeps the mean: with the light at the camera it is twice the range, wherever a scene's surfaces stand at the time of the truth.
TEST(transient, has_the_mean_length_of_what_the_truth_sees) {
  for (const bool moves : {false, true}) {
    Random random(31);
    Camera camera = small(load_camera("pico-flexx"));
    camera.illumination[0].position = {0, 0, 0};
    for (int i = 0; i < 5; ++i) {
      const Scene scene = with_bins(random_scene(random, 15, moves), 400, 0, 0.1);
      const Frame frame = silent(scene, camera, {.exposure_samples = 1 + i % 3});
      int seen = 0;
      for (std::size_t p = 0; p < frame.truth.range_m.size(); ++p) {
        const std::vector<double> bins = bins_of(frame.truth, p);
        const double rate = total(bins), range = static_cast<double>(frame.truth.range_m[p]);
        if (!(rate > 0) || !(range < 19)) continue;
        double mean = 0;
        for (std::size_t k = 0; k < bins.size(); ++k) mean += bins[k] / rate * 0.1 * (static_cast<double>(k) + 0.5);
        ASSERT_NEAR(mean, 2 * range, 1e-5 * range + 2e-6) << p;
        ++seen;
      }
      EXPECT_GT(seen, 150);
    }
  }
}

TEST(transient, has_all_light_and_leaves_everything_else_as_it_is) {
  const Camera one = dim(24, 20, 20);
  Camera two = one;
  two.illumination.push_back(two.illumination[0]);
  two.illumination[1].position = {-0.1, 0.05, 0.02};
  for (const Camera& camera : {one, two}) {
    for (const int bounces : {0, 3}) {
      for (const int subpixel : {1, 2}) {
        Scene scene = nook();
        scene.transport.bounces = bounces, scene.transport.samples = 64;
        const SimulatorOptions options{.subpixel = subpixel};
        Frame frame = silent(with_bins(scene, 20000, 0, 0.1), camera, options);
        expect_all_light(frame, true);
        expect_all_light(silent(with_bins(scene, 50, 2.1, 0.01), camera, options), false);
        frame.truth.transient_e_per_s.clear(), frame.truth.transient_lost_e_per_s.clear();
        EXPECT_EQ(first_difference(frame, silent(scene, camera, options)), "");
      }
    }
  }
}

// Before the lens scatters it, and known before raw frames are.
TEST(transient, is_light_of_stages_1_and_2) {
  Scene scene = with_bins(nook(), 300, 0, 0.1);
  scene.transport.bounces = 2;
  Camera camera = dim(24, 20, 20);
  const Frame clear = silent(scene, camera);
  EXPECT_EQ(silent(scene, camera, {.last_stage = Stage::power}).truth.transient_e_per_s, clear.truth.transient_e_per_s);
  EXPECT_EQ(total(silent(scene, camera, {.last_stage = Stage::trace}).truth.transient_e_per_s), 0);
  EXPECT_TRUE(silent(scene, camera, {.truth = false}).truth.transient_e_per_s.empty());
  camera.lens.scatter = {Scatter::Kind::gaussians, 0.3, {2}};
  EXPECT_EQ(silent(scene, camera).truth.transient_e_per_s, clear.truth.transient_e_per_s);
  scene.ambient = sunny_wall().ambient;
  EXPECT_EQ(silent(scene, camera).truth.transient_e_per_s, clear.truth.transient_e_per_s) << "ambient light has no length";
}

TEST(transient, gives_the_same_bytes_on_every_machine) {
  for (int i = 0; i < 4; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 700);
    Scene scene = with_bins(random_scene(random, 12, i % 2 == 1), 300, 0.5, 0.03);
    scene.transport.bounces = i < 2 ? 0 : 3, scene.transport.samples = 5;
    Camera camera = small(load_camera("pico-flexx"));
    if (i > 0) camera.illumination.push_back(camera.illumination[0]), camera.illumination[1].position = {0.1, 0, 0};
    const auto with = [&](Isa isa, int threads) {
      return Simulator(scene, camera,
                       {.threads = threads, .isa = isa, .exposure_samples = 1 + i % 2, .subpixel = 1 + i / 2, .culling = threads == 1})
          .frame(2);
    };
    const Frame reference = with(Isa::scalar, 1);
    EXPECT_GT(total(reference.truth.transient_e_per_s), 0);
    EXPECT_GT(total(reference.truth.transient_lost_e_per_s), 0);
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;
      for (const int threads : {1, 3}) EXPECT_EQ(first_difference(with(isa, threads), reference), "") << i << " " << threads;
    }
  }
}

// Also where the light of what stands still is kept, and in batches.
TEST(transient, is_that_of_its_frame) {
  Scene scene = with_bins(nook(), 100, 1, 0.05);
  scene.transport.bounces = 2;
  const Camera camera = dim(24, 20, 20);
  Simulator simulator(scene, camera, {});
  const Frame first = simulator.frame(0), second = simulator.frame(1);
  EXPECT_GT(total(first.truth.transient_e_per_s), 0);
  EXPECT_EQ(first.truth.transient_e_per_s, second.truth.transient_e_per_s);
  std::uint64_t next = 0;
  simulator.frames(0, 2, [&](const FrameArrays& arrays) {
    EXPECT_EQ(arrays.bins, 100);
    EXPECT_EQ(first_difference(copy_of(arrays), arrays_only(next++ == 0 ? first : second)), "");
  });
  EXPECT_EQ(next, 2u);
}

TEST(transient, that_cannot_be_is_refused) {
  const auto told_of = [](const Scene& scene, const Camera& camera) -> std::string {
    try {
      Simulator(scene, camera, {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const Camera camera = lit_camera(100, 100);
  EXPECT_EQ(told_of(with_bins(wall(1), 26843, 0, 1), camera), "");
  EXPECT_EQ(
      told_of(with_bins(wall(1), 26843, 0, 1), lit_camera(101, 100)),
      "error: the histograms of light by path length are too large\n  got 26843 bins for each of 10100 pixels, 271114300 values, at most "
      "268435456\n  lower transport.transient.bins, or let each be wider");
  for (const auto& [bins, first, width] : {std::tuple{-1, 0.0, 1.0},
                                           {1'000'001, 0.0, 1.0},
                                           {5, -1.0, 1.0},
                                           {5, 0.0, 0.0},
                                           {5, 0.0, -1.0},
                                           {5, std::nan(""), 1.0},
                                           {5, 0.0, std::nan("")},
                                           {5, 2e6, 1.0}})
    EXPECT_NE(told_of(with_bins(wall(1), bins, first, width), camera).find("transport.transient."), std::string::npos)
        << bins << " " << first;
  Camera two = camera;
  two.illumination.push_back(two.illumination[0]);
  EXPECT_EQ(told_of(with_bins(wall(1), 5, 0, 1), two), "");
  two.illumination[1].waveform.kind = Waveform::Kind::rectangular, two.illumination[1].waveform.duty = 0.3;
  EXPECT_EQ(told_of(wall(1), two), "");
  EXPECT_NE(told_of(with_bins(wall(1), 5, 0, 1), two).find("light source 1 of the camera has another waveform than the first one"),
            std::string::npos);
}
