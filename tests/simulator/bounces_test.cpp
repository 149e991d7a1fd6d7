// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Light that goes from surface to surface, against closed forms: the integrating sphere in time, and a corner by quadrature in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <tuple>

#include "backend/cpu/cpu.h"
#include "support/bounces.h"
#include "support/cuda_cases.h"
#include "support/meshes.h"
#include "support/pixels.h"
#include "support/random_scene.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr double light_speed = 299792458.0;

/// A light source that shines evenly to all sides.
Illumination bulb(const Vec3& position = {0, 0, 0}) {
  Illumination light = one_watt_per_steradian(position);
  light.pattern.half_angle_rad = pi, light.power_w = 4 * pi;
  return light;
}

Camera at_frequency(double hz, int side, double focal_px) {
  Camera camera = plain_camera(side, side, focal_px);
  for (RawFrame& k : camera.mode.sequence) k.modulation_frequency_hz = hz;
  return camera;
}

/// A dim lamp, so that codes are not held at their ends.
Camera dim_camera(int width, int height, double focal_px) {
  Camera camera = lit_camera(width, height, focal_px);
  camera.illumination[0].power_w *= 2e-3;
  return camera;
}

/// Z of four phases, of all pixels from `first` to `last`, in double precision and whatever the ADC does.
std::complex<double> phasor(const Raw& raw, std::size_t first, std::size_t last) {
  std::complex<double> sum = 0;
  const std::size_t pixels = raw.raw.size() / 4;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = first; i < last; ++i) {
      const double d = static_cast<double>(raw.tap_a[k * pixels + i]) - static_cast<double>(raw.tap_b[k * pixels + i]);
      sum += d * std::polar(1.0, -raw.reference_phase_rad[k]);
    }
  return sum;
}

/// A mean and its standard error, of groups of pixels that have nothing to do with each other.
struct Measured {
  double mean = 0, error = 0;
};
template <class Of>
Measured of_groups(std::size_t pixels, const Of& of) {
  constexpr std::size_t groups = 32;
  double sum = 0, square = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    const double value = of(g * pixels / groups, (g + 1) * pixels / groups);
    sum += value, square += value * value;
  }
  const double mean = sum / groups;
  return {mean, std::sqrt(std::fmax(square / groups - mean * mean, 0) / (groups - 1))};
}

/// What bounces add, of all pixels alike.
struct Added {
  Measured share;    ///< indirect : direct electrons
  Measured shift_m;  ///< half path of all light less that of the direct light
};
Added added(const Scene& scene, const Camera& camera, int bounces, int samples) {
  const Frame direct = frame_with_bounces(scene, camera, 0, 1), all = frame_with_bounces(scene, camera, bounces, samples);
  const auto pixels = direct.truth.range_m.size();
  const double per_turn = light_speed / (2 * direct.raw.modulation_frequency_hz[0]);
  Added out;
  out.share = of_groups(
      pixels, [&](std::size_t a, std::size_t b) { return sum_over(all.truth.indirect_e, a, b) / sum_over(direct.truth.signal_e, a, b); });
  out.shift_m = of_groups(
      pixels, [&](std::size_t a, std::size_t b) { return std::arg(phasor(all.raw, a, b) / phasor(direct.raw, a, b)) / two_pi * per_turn; });
  return out;
}

void expect_near(const Measured& m, double expected, double most, const std::string& what) {
  EXPECT_LT(std::abs(m.mean - expected), 4 * m.error + 1e-9 * std::abs(expected) + 2e-6) << what << ": " << m.mean << " +- " << m.error;
  EXPECT_LT(m.error, most) << what << " is hardly known";
}

constexpr int side = with_sanitizers ? 16 : 64;
constexpr double unsure = with_sanitizers ? 8 : 1;  ///< fewer pixels, larger errors

Scene white_ball(double reflectivity, double radius = 1) {
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, reflectivity, 0, 1});
  scene.objects.push_back(object(Sphere{{0, 0, 0}, radius}));
  return scene;
}

/// Half path that a camera shows within a white ball, with the light at its side: of ρI/(πR²)·e^{−2ikR}/(1 − ρF), F = 2(e^{−ia}(1 + ia) − 1)/a²
/// with a = 2kR.
double range_in_ball(double rho, double radius, double hz) {
  const double k = two_pi * hz / light_speed, a = 2 * k * radius;
  const std::complex<double> i(0, 1), f = 2.0 * (std::exp(-i * a) * (1.0 + i * a) - 1.0) / (a * a);
  return radius + std::arg(1.0 - rho * f) / (2 * k);
}

}  // namespace

// T1: all bounces of an integrating sphere; P8: of one that is white to 90 %, too, whose light grows tenfold (but for what more than 64 bring).
TEST(bounces, of_an_integrating_sphere_have_its_closed_form) {
  for (const auto& [rho, known] : {std::pair{0.9, 0.0}, {0.8, 1.0897588}, {0.5, 1.0636135}, {0.2, 1.0291499}}) {
    const double expected = range_in_ball(rho, 1, 80.32e6);
    Camera camera = at_frequency(80.32e6, side / 2, 30);
    camera.illumination.push_back(bulb());
    const Added a = added(white_ball(rho), camera, 64, 4096);
    expect_near(a.share, (1 - std::pow(rho, 65)) / (1 - rho) - 1, 2e-3 * unsure, "gain");
    if (!(known > 0)) continue;  // transport's numbers are of all bounces
    EXPECT_NEAR(expected, known, 2e-7);
    expect_near(a.shift_m, expected - 1, 1e-4 * unsure, "range");
    EXPECT_NEAR(a.shift_m.mean, expected - 1, 1e-4 * unsure);
  }
}

// T2: each bounce alone. All of the ball gets the same light: nothing is left to chance until the roulette begins.
TEST(bounces, of_an_integrating_sphere_bring_a_power_of_its_reflectivity_each) {
  Camera camera = at_frequency(60e6, 8, 20);
  camera.illumination.push_back(bulb());
  const double direct = sum_over(frame_with_bounces(white_ball(0.7), camera, 0, 1).truth.signal_e, 0, 64);
  double sum = 0, before = 0;
  for (int b = 1; b <= 4; ++b) {
    const Frame frame = frame_with_bounces(white_ball(0.7), camera, b, 4096);
    const double now = sum_over(frame.truth.indirect_e, 0, 64) / direct;
    sum += std::pow(0.7, b);
    EXPECT_NEAR(now, sum, b < 3 ? 2e-5 : 2e-3) << b;
    EXPECT_NEAR(now - before, std::pow(0.7, b), b < 3 ? 2e-5 : 2e-3) << b;
    before = now;
  }
}

// T3, T4: two walls of 80 %, z = 2 m (|x|, |y| <= 1) and x = 1 m (z 0.5 to 2, |y| <= 1); an isotropic light at (0.01547, 0, 0).
TEST(bounces, in_a_corner_are_those_of_the_quadrature) {
  struct Point {
    Vec3 at;
    double share;
    std::array<double, 3> shift_mm;
  };
  const std::array<double, 3> frequencies{80.32e6, 60.24e6, 20e6};
  for (const Point& point : {Point{{0.9, 0.1, 2}, 0.241916130, {18.66150, 19.12097, 19.67132}},
                             Point{{0, 0.1, 2}, 0.130120038, {37.16010, 46.23095, 56.93467}}}) {
    Scene scene;
    scene.materials.push_back({"white", Material::Brdf::lambert, 0.8, 0, 1});
    scene.objects.push_back(object(Rectangle{{0, 0, 2}, {2, 2}}));
    Object other = object(Rectangle{{0, 0, 0}, {1.5, 2}});
    other.rotation = {{0, 1, 0}, pi / 2}, other.position = {1, 0, 1.25};
    scene.objects.push_back(other);
    scene.camera.pose = {{0, 0, 0}, point.at, {0, -1, 0}};
    // The light stands in the world; its place is said in the camera's frame.
    const Vec3 z = base::normalized(point.at), x = base::normalized(base::cross(Vec3{0, 1, 0}, z)), y = base::cross(z, x);
    const Vec3 light{0.01547, 0, 0};
    for (std::size_t i = 0; i < 3; ++i) {
      Camera camera = at_frequency(frequencies[i], side, 2e5);
      camera.illumination.push_back(bulb({base::dot(light, x), base::dot(light, y), base::dot(light, z)}));
      const Added a = added(scene, camera, 1, 256);
      expect_near(a.share, point.share, 0.003 * point.share * unsure, "share");
      expect_near(a.shift_m, 1e-3 * point.shift_mm[i], 0.003e-3 * point.shift_mm[i] * unsure, "shift");
      EXPECT_NEAR(a.share.mean, point.share, 0.003 * point.share * unsure);
      EXPECT_NEAR(a.shift_m.mean, 1e-3 * point.shift_mm[i], 0.003e-3 * point.shift_mm[i] * unsure);
    }
  }
}

// T6: a metal mirror at 1 m that is turned by 45 degrees shows a wall at its side: 1 m to it, 0.7 m on to the wall, and straight back.
TEST(bounces, of_a_mirror_have_the_length_of_the_folded_way) {
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, 0.8, 0, 1});
  Material silver{"silver", Material::Brdf::ggx, 0, 0.95, 1};
  silver.alpha = 1e-3;
  scene.materials.push_back(silver);
  scene.objects.push_back(object(Plane{{0, 0, 1}, {-1, 0, -1}}, 1));
  scene.objects.push_back(object(Plane{{-0.7, 0, 0}, {1, 0, 0}}));
  const Camera camera = lit_camera(4, 4, 2e4);
  const Frame frame = frame_with_bounces(scene, camera, 1, 256);
  const double path = 1 + 0.7 + std::hypot(0.7, 1.0);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(range_of_taps(frame.raw, i), path / 2, 0.25e-3) << i;
  // It is the wall's light through the mirror: E·ρ/π·F, F what the metal reflects of it.
  const double radiance = 0.8 / pi / 1.49 * (0.7 / std::hypot(0.7, 1.0)) * 0.95;
  const Frame white = frame_with_bounces(wall(1, 1), camera, 0, 1);  // 1/π of 1 W/m²
  EXPECT_NEAR(sum_over(frame.truth.indirect_e, 0, 16) / sum_over(white.truth.signal_e, 0, 16), radiance * pi, 0.01 * radiance * pi);
}

// What a convex thing sends out never comes back to it, and a room without a way out has no sky.
TEST(bounces, of_the_sky_come_where_rays_leave_the_scene) {
  const auto ambient = [](const Scene& scene, int bounces, int samples) {
    Camera camera = at_frequency(60e6, 8, 20);
    camera.illumination.push_back(bulb());
    return frame_with_bounces(scene, camera, bounces, samples).truth.ambient_e_per_s;
  };
  const Scene plane = sunny_wall(0.5);
  const std::vector<float> open = ambient(plane, 0, 1), alone = ambient(plane, 3, 16);
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_NEAR(alone[i] / open[i], 1, 1e-6) << i;
  Scene ball = white_ball(0.5);
  ball.ambient = plane.ambient;
  for (const float rate : ambient(ball, 20, 16)) EXPECT_EQ(rate, 0.0f);
  // Two endless walls of 50 % face each other: of what leaves one, half comes back from the other, never the sky.
  Scene between = plane;
  between.objects.push_back(object(Plane{{0, 0, -1}, {0, 0, 1}}));
  for (const float rate : ambient(between, 20, 16)) EXPECT_EQ(rate, 0.0f);
  // A wall that ends at a long one that it stands on: half of what the foot of it sees is the other wall. Of that side it gets
  // 1/2·(sky seen there, and so on): for endless ones at a right angle, close to the edge, x = 1/2 + 1/2·ρ·x.
  Scene edge = plane;
  edge.objects.push_back(object(Plane{{0, 0, 0}, {1, 0, 0}}));
  edge.camera.pose = {{1, 0, 0}, {1e-4, 0, 1}, {0, -1, 0}};
  Camera camera = at_frequency(60e6, 32, 2e5);
  camera.illumination.push_back(bulb());
  const Frame frame = frame_with_bounces(edge, camera, 30, 256), whole = frame_with_bounces(edge, camera, 0, 1);
  const double share = sum_over(frame.truth.ambient_e_per_s, 0, 1024) / sum_over(whole.truth.ambient_e_per_s, 0, 1024);
  EXPECT_NEAR(share, 0.5 / (1 - 0.5 * 0.5), 2e-3);
  const Frame one = frame_with_bounces(edge, camera, 1, 1024);  // what leaves the last surface may still see the sky
  EXPECT_NEAR(sum_over(one.truth.ambient_e_per_s, 0, 1024) / sum_over(whole.truth.ambient_e_per_s, 0, 1024), 0.5 + 0.5 * 0.5 * 0.5, 2e-3);
}

// Light that the sun brings to one wall shines on the other: of a lit floor's ρE, a wall that stands on it gets half.
TEST(bounces, of_the_sun_come_from_what_it_shines_on) {
  Scene scene = sunny_wall(0.5);
  scene.ambient.direction = Vec3{1, 0, 0};  // it grazes the wall at z = 1 m, and shines on what faces −x
  scene.objects.push_back(object(Plane{{1, 0, 0}, {-1, 0, 0}}));
  scene.camera.pose = {{0, 0, 0}, {0.9999, 0, 1}, {0, -1, 0}};
  Camera camera = at_frequency(60e6, 16, 2e5);
  camera.illumination.push_back(bulb());
  const Frame direct = frame_with_bounces(scene, camera, 0, 1), one = frame_with_bounces(scene, camera, 1, 1024);
  EXPECT_EQ(sum_over(direct.truth.ambient_e_per_s, 0, 256), 0);
  Scene facing = sunny_wall(0.5);
  facing.ambient.direction = Vec3{0, 0, 1};
  facing.camera.pose = scene.camera.pose;
  const double full = sum_over(frame_with_bounces(facing, camera, 0, 1).truth.ambient_e_per_s, 0, 256);
  EXPECT_NEAR(sum_over(one.truth.ambient_e_per_s, 0, 256) / full, 0.5 * 0.5, 2e-3);
  scene.materials.push_back({"black", Material::Brdf::lambert, 0, 0, 1});
  scene.objects.push_back(object(Plane{{-1, 0, 0}, {1, 0, 0}}, 1));  // in the way of the sun
  EXPECT_EQ(sum_over(frame_with_bounces(scene, camera, 1, 64).truth.ambient_e_per_s, 0, 256), 0);
}

// A black card keeps the light off a part of the side wall that the point sees, and its sight off another one, by quadrature.
TEST(bounces, know_of_shadows_on_what_they_meet) {
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, 0.8, 0, 1});
  scene.materials.push_back({"black", Material::Brdf::lambert, 0, 0, 1});
  scene.objects.push_back(object(Plane{{0, 0, 1}, {0, 0, -1}}));
  const Vec3 p{-0.2, 0, 1};
  for (const auto& [x, z, length, material] : {std::tuple{0.4, 0.0, 2.0, 0}, {0.1, 0.275, 0.45, 1}}) {
    Object upright = object(Rectangle{{0, 0, 0}, {length, material == 0 ? 2.0 : 6.0}}, material);
    upright.rotation = {{0, 1, 0}, pi / 2}, upright.position = {x, 0, z};
    scene.objects.push_back(upright);
  }
  scene.camera.pose = {{0, 0, 0}, p, {0, -1, 0}};
  Camera camera = at_frequency(60e6, side, 2e5);
  camera.illumination.push_back(bulb());
  double sum = 0;
  constexpr int cells = 1000;
  for (int i = 0; i < cells; ++i) {
    const double z = -1 + 2 * (i + 0.5) / cells, of_light = 0.25 * z, of_sight = 0.5 * (1 + z);  // where the card may be in the way
    if ((of_light > 0.05 && of_light < 0.5) || (of_sight > 0.05 && of_sight < 0.5)) continue;
    for (int k = 0; k < cells; ++k) {
      const Vec3 q{0.4, -1 + 2 * (k + 0.5) / cells, z}, way = q - p;
      const double r = base::length(q), d = base::length(way);
      sum += 0.4 / (r * r * r) * (way[0] / d) * ((1 - z) / d) / (d * d);
    }
  }
  const double r0 = base::length(p), share = 0.8 / pi * sum * 4 / (cells * cells) / (1 / (r0 * r0 * r0));
  const Added a = added(scene, camera, 1, 256);
  expect_near(a.share, share, 0.005 * share * unsure, "share");
  EXPECT_NEAR(a.share.mean, share, 0.005 * share * unsure);
}

// T8 and what frames say of it.
TEST(bounces, give_the_same_bytes_on_every_machine) {
  for (int i = 0; i < 4; ++i) {
    Random random(static_cast<std::uint64_t>(i) + 300);
    Scene scene = random_scene(random, 12, i % 2 == 1);
    scene.transport = {1 + 2 * i, 3, 5, i % 2 == 1 ? 16 : 0, i == 1 ? 1e-3 : 0, i >= 2};
    if (i == 1) scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.2, {}, {}, Vec3{0.2, 0.5, 1}};
    if (i == 2) scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 0.2, {}, {}, {}};
    Camera camera = small(load_camera("pico-flexx"));
    if (i == 3) camera.lens.scatter = {Scatter::Kind::gaussians, 0.1, {1, 9}};
    const auto with = [&](Isa isa, int threads, bool culling) {
      return Simulator(scene, camera,
                       {.threads = threads, .isa = isa, .exposure_samples = 1 + i % 2, .subpixel = 1 + i / 2, .culling = culling})
          .frame(2);
    };
    const Frame reference = with(Isa::scalar, 1, true);
    EXPECT_GT(sum_over(reference.truth.indirect_e, 0, reference.truth.indirect_e.size()), 0);
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;
      for (const int threads : {1, 3}) EXPECT_EQ(first_difference(with(isa, threads, threads == 1), reference), "") << i << " " << threads;
    }
  }
}

TEST(bounces, leave_the_direct_light_as_it_is) {
  Random random(12);
  for (const bool moves : {false, true}) {
    Scene scene = random_scene(random, 12, moves);
    scene.ambient = {};
    Camera camera = small(load_camera("pico-flexx"));
    const auto frame = [&](int bounces, int subpixel) {
      scene.transport.bounces = bounces, scene.transport.samples = 4, scene.transport.smooth = true;
      return Simulator(scene, camera, {.noise = Noise::off, .subpixel = subpixel}).frame(1);
    };
    for (const int subpixel : {1, 2}) {
      const Frame direct = frame(0, subpixel), all = frame(3, subpixel);
      EXPECT_EQ(all.truth.direct_e, direct.truth.signal_e);
      EXPECT_TRUE(direct.truth.direct_e.empty() && direct.truth.indirect_e.empty() && direct.truth.multipath_m.empty());
      EXPECT_EQ(all.truth.object_id, direct.truth.object_id);
      EXPECT_EQ(all.truth.mixed, direct.truth.mixed);
      double indirect = 0;
      for (std::size_t i = 0; i < all.truth.signal_e.size(); ++i) {
        ASSERT_NEAR(all.truth.signal_e[i], all.truth.direct_e[i] + all.truth.indirect_e[i], 1e-6f * all.truth.signal_e[i] + 1e-6f) << i;
        indirect += static_cast<double>(all.truth.indirect_e[i]);
      }
      EXPECT_GT(indirect, 0);
    }
  }
}

// What the truth says of multipath is what the decoder's range is off by, for a camera whose light stands where it does.
TEST(bounces, pull_the_range_by_what_the_truth_says) {
  const Camera camera = dim_camera(24, 20, 20);
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  const Frame direct = frame_with_bounces(scene, camera, 0, 1), all = frame_with_bounces(scene, camera, 4, 64);
  int seen = 0;
  for (std::size_t i = 0; i < direct.depth.range_m.size(); ++i) {
    if (!std::isfinite(direct.depth.range_m[i]) || !std::isfinite(all.depth.range_m[i])) continue;
    for (std::size_t k = 0; k < 4; ++k)
      ASSERT_NEAR(all.truth.multipath_m[k * direct.depth.range_m.size() + i], all.depth.range_m[i] - direct.depth.range_m[i], 2e-6f) << i;
    ++seen;
  }
  EXPECT_GT(seen, 300);
}

// Steps, smoothing and samples within pixels each have memory of their own, and each two of them.
TEST(bounces, are_as_bright_by_every_way_of_following_them) {
  const Camera camera = dim_camera(16, 12, 20);
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  scene.transport.bounces = 2, scene.transport.samples = 16;
  double expected = 0;
  for (const int subpixel : {1, 2})
    for (const int most : {0, 32, 64})
      for (const bool smooth : {false, true})
        for (const bool truth : {true, false}) {
          scene.transport.max_samples = most, scene.transport.smooth = smooth;
          SimulatorOptions options{.noise = Noise::off, .truth = truth};
          options.subpixel = subpixel;
          const Frame frame = Simulator(scene, camera, options).frame(0);
          const double light = sum_over(frame.raw.tap_a, 0, frame.raw.tap_a.size());
          if (expected == 0) expected = light;
          EXPECT_NEAR(light / expected, 1, 0.01) << subpixel << " " << most << " " << smooth << " " << truth;
        }
}

// The light of what stands still is followed once; another seed follows other ways of the same light.
TEST(bounces, are_the_same_from_frame_to_frame) {
  const Camera camera = dim_camera(16, 12, 20);
  Scene scene = wall(1, 0.8);
  scene.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  scene.transport = {3, 16, 1, 64, 0, true};
  Simulator simulator(scene, camera, {.seed = 4});
  const Frame first = simulator.frame(0), second = simulator.frame(1);
  EXPECT_EQ(first.truth.indirect_e, second.truth.indirect_e);
  EXPECT_EQ(first.truth.path_noise_m, second.truth.path_noise_m);
  EXPECT_NE(first.raw.raw, second.raw.raw) << "their noise is their own";
  EXPECT_EQ(first_difference(second, Simulator(scene, camera, {.seed = 4}).frame(1)), "");
  scene.transport.seed = 2;
  const Frame other = Simulator(scene, camera, {.seed = 4}).frame(0);
  EXPECT_NE(first.truth.indirect_e, other.truth.indirect_e);
  EXPECT_EQ(first.truth.direct_e, other.truth.direct_e);
  const double one = sum_over(first.truth.indirect_e, 0, first.truth.indirect_e.size()),
               two = sum_over(other.truth.indirect_e, 0, other.truth.indirect_e.size());
  EXPECT_NEAR(one / two, 1, 0.02);
}

// What moves is elsewhere in each frame, also where each frame is a single raw frame: no light is left over from the one before.
TEST(bounces, of_what_moves_are_followed_anew_in_each_frame) {
  Camera camera = dim_camera(12, 10, 20);
  camera.mode.sequence = {{false, 0, 0, 600e-6}};
  Scene scene = sunny_wall(0.8);
  scene.ambient.direction = Vec3{0.2, 0.3, 1};
  scene.objects.push_back(object(Box{{0.1, -0.1, 0.6}, {0.3, 0.1, 0.8}}));
  scene.objects[1].velocity_m_per_s = {-2, 0, 0};
  scene.transport.bounces = 1, scene.transport.samples = 16;
  const SimulatorOptions options{.noise = Noise::off};
  Simulator simulator(scene, camera, options);
  const std::vector<Frame> frames = {simulator.frame(0), simulator.frame(1), simulator.frame(2)};
  for (const Frame& frame : frames)
    EXPECT_EQ(first_difference(frame, Simulator(scene, camera, options).frame(frame.index)), "") << frame.index;
  EXPECT_NE(frames.at(0).raw.tap_a, frames.at(1).raw.tap_a);
}

// A camera in the middle of a box's open side sees its edges exactly along a diagonal of pixels. There light is as it is beside them.
TEST(bounces, leave_no_rims_where_walls_meet) {
  Scene scene;
  scene.materials.push_back({"white", Material::Brdf::lambert, 0.5, 0, 1});
  scene.objects.push_back(object(Rectangle{{0, 0, 0}, {1, 1}}));
  scene.objects.back().position = {0, 0, 2};
  for (int k = 0; k < 4; ++k) {
    Object side_wall = object(Rectangle{{0, 0, 0}, {k < 2 ? 1.5 : 1.0, k < 2 ? 1.0 : 1.5}});
    side_wall.rotation = {k < 2 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, pi / 2};
    side_wall.position = {k == 0 ? -0.5 : k == 1 ? 0.5 : 0, k == 2 ? -0.5 : k == 3 ? 0.5 : 0, 1.25};
    scene.objects.push_back(side_wall);
  }
  constexpr int n = 65;
  Camera camera = lit_camera(n, n, 100);
  const Frame frame = frame_with_bounces(scene, camera, 3, with_sanitizers ? 64 : 1024);
  int edges = 0;
  for (const bool mirrored : {false, true})
    for (std::size_t i = 1; i < n / 2; ++i) {
      const auto at = [&](std::size_t x) { return static_cast<double>(frame.truth.indirect_e[i * n + (mirrored ? n - 1 - x : x)]); };
      if (std::abs(frame.truth.position_m[3 * (i * n + i)]) < 0.4999f) continue;
      ++edges;
      EXPECT_GT(at(i), 0.85 * std::min(at(i - 1), at(i + 1))) << i << " " << mirrored;
    }
  EXPECT_GT(edges, 10);
}

// Rays that leave surfaces beside others: no light gets through where they meet.
TEST(bounces, do_not_leak_where_walls_meet) {
  // A closed room of 90 % under the sky, camera inside: whatever it is built of, nothing comes in.
  for (int kind = 0; kind < 3; ++kind) {
    Scene scene;
    scene.materials.push_back({"white", Material::Brdf::lambert, 0.9, 0, 1});
    scene.ambient = {Ambient::Spectrum::sun_am15, Ambient::Quantity::level, 1, {}, {}, {}};
    if (kind == 0) scene.objects.push_back(object(Box{{-1, -0.7, -0.5}, {0.8, 0.9, 1.5}}));
    if (kind == 1) {  // rectangles that reach beyond each other
      const Vec3 low{-1, -0.7, -0.5}, high{0.8, 0.9, 1.5};
      for (std::size_t k = 0; k < 3; ++k)
        for (const double at : {low[k], high[k]}) {
          Object face = object(Rectangle{{0, 0, 0}, {2.5, 2.5}});
          face.rotation = {k == 0 ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, k == 2 ? 0 : pi / 2};
          face.position = 0.5 * (low + high), face.position[k] = at;
          scene.objects.push_back(face);
        }
    }
    if (kind == 2) {
      TriangleMesh room;
      for (int i = 0; i < 8; ++i) room.vertices.push_back({i & 1 ? 0.8f : -1.0f, i & 2 ? 0.9f : -0.7f, i & 4 ? 1.5f : -0.5f});
      for (const auto& [a, b, c, d] : {std::array{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}})
        room.triangles.push_back({a, b, c}), room.triangles.push_back({a, c, d});
      scene.objects.push_back(object(shared(std::move(room))));
    }
    Camera camera = lit_camera(with_sanitizers ? 16 : 64, with_sanitizers ? 16 : 64, with_sanitizers ? 12 : 48);
    scene.camera.pose = {{0, 0, 0}, {0.8, 0.9, 1.5}, {0, -1, 0}};  // into the corner
    int leaks = 0;
    for (unsigned long long seed = 0; seed < (with_sanitizers ? 1 : 8); ++seed)
      for (const float rate : frame_with_bounces(scene, camera, 8, 64, seed).truth.ambient_e_per_s) leaks += rate > 0;
    // Of 10⁷ rays a few leave within micrometres of an edge, where nobody knows on which side of it they are. From inside a box none does.
    EXPECT_LE(leaks, kind == 0 ? 0 : 12) << kind;
    if (kind != 1) continue;
    // Nor does the sun, however far light goes in there.
    scene.ambient.direction = Vec3{0.3, 0.5, 0.8};
    const Frame sunny = frame_with_bounces(scene, camera, 24, 16);
    int lit = 0;
    for (const float rate : sunny.truth.ambient_e_per_s) lit += rate > 0;
    EXPECT_LE(lit, 200);
  }
}

// A mesh with a picture of half its reflectivity is a rectangle of that, wherever light meets it.
TEST(bounces, see_meshes_and_their_pictures_as_they_see_rectangles) {
  const Camera camera = lit_camera(24, 20, 20);
  const auto seen = [&](bool mesh) {
    Scene scene = wall(1, 0.8);
    Material tinted{"side", Material::Brdf::lambert, mesh ? 0.8 : 0.4, 0, 1};
    if (mesh) tinted.map = std::make_shared<ReflectivityMap>(ReflectivityMap{2, 2, {0.5f, 0.5f, 0.5f, 0.5f}});
    scene.materials.push_back(tinted);
    if (mesh) {
      TriangleMesh triangles{{{0.4f, -1, -1}, {0.4f, 1, -1}, {0.4f, 1, 1}, {0.4f, -1, 1}}, {{0, 1, 2}, {0, 2, 3}}};
      triangles.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
      triangles.normals.assign(4, {-1, 0, 0});
      scene.objects.push_back(object(shared(std::move(triangles)), 1));
    } else {
      Object one = object(Rectangle{{0, 0, 0}, {2, 2}}, 1);
      one.rotation = {{0, 1, 0}, pi / 2}, one.position = {0.4, 0, 0};
      scene.objects.push_back(one);
    }
    return frame_with_bounces(scene, camera, 1, 256);
  };
  const Frame mesh = seen(true), rectangle = seen(false);
  // From the wall the same ways are taken; from the side others, since an axis of a rectangle may have another sign.
  double of_side = 0, expected = 0;
  for (std::size_t i = 0; i < mesh.truth.range_m.size(); ++i) {
    const auto one = static_cast<double>(mesh.truth.indirect_e[i]), other = static_cast<double>(rectangle.truth.indirect_e[i]);
    if (mesh.truth.object_id[i] == 0) {
      ASSERT_NEAR(one, other, 3e-5 * other) << i;  // rays toward a mesh begin some micrometres before the wall
    } else {
      of_side += one, expected += other;
    }
  }
  EXPECT_GT(expected, 0);
  EXPECT_NEAR(of_side / expected, 1, 0.01);
}

// A box stands close before a wall: its faces as six rectangles, which are met one by one, or as a body that light passes into and out of.
TEST(bounces, between_a_body_and_what_is_close_are_those_of_its_faces) {
  const Camera camera = dim_camera(24, 20, 60);
  const auto seen = [&](bool body) {
    Scene scene = wall(1, 0.8);
    scene.materials.push_back({"box", Material::Brdf::lambert, 0.5, 0, 1});
    const Vec3 low{0.05, -0.1, 0.85}, high{0.25, 0.1, 0.97};
    if (body) {
      scene.objects.push_back(object(Box{low, high}, 1));
    } else {
      TriangleMesh faces;
      for (int i = 0; i < 8; ++i) {
        const auto at = [&](std::size_t k) { return static_cast<float>((i >> k & 1) != 0 ? high[k] : low[k]); };
        faces.vertices.push_back({at(0), at(1), at(2)});
      }
      for (const std::array<std::int32_t, 4>& q :
           {std::array<std::int32_t, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        faces.triangles.push_back({q[0], q[1], q[2]}), faces.triangles.push_back({q[0], q[2], q[3]});
      scene.objects.push_back(object(shared(std::move(faces)), 1));
    }
    return frame_with_bounces(scene, camera, 1, 64);
  };
  const Frame body = seen(true), faces = seen(false);
  double of_wall = 0, other = 0;
  int compared = 0;
  for (std::size_t i = 0; i < body.truth.range_m.size(); ++i) {
    ASSERT_EQ(body.truth.object_id[i], faces.truth.object_id[i]) << i;
    if (body.truth.object_id[i] != 0) continue;
    // Both take the same paths; a few pass an edge on another side.
    const auto one = static_cast<double>(body.truth.indirect_e[i]), two = static_cast<double>(faces.truth.indirect_e[i]);
    of_wall += one, other += std::abs(one - two), ++compared;
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(of_wall, 0);
  EXPECT_LT(other, 1e-3 * of_wall);
}

// Each raw frame's light bounces where things are while it is exposed, in the middle of each part of its exposure.
TEST(bounces, of_what_moves_are_those_of_where_it_is) {
  const Camera camera = lit_camera(16, 12, 15);
  for (const int samples : {1, 2}) {
    const auto at = [&](const Vec3& shift, const Vec3& velocity) {
      Scene scene = wall(1, 0.8);
      scene.transport = {2, 8, 3};
      scene.objects.push_back(object(Box{{-0.5, -0.3, 0.5}, {-0.1, 0.5, 0.9}}));
      scene.objects.push_back(object(Sphere{{0.2, 0, 0.8}, 0.15}));
      scene.objects[1].position = shift, scene.objects[1].velocity_m_per_s = velocity;
      return Simulator(scene, camera, {.noise = Noise::off, .exposure_samples = samples}).frame(0);
    };
    const Vec3 velocity{30, 5, -20};
    const Frame moving = at({0, 0, 0}, velocity);
    const std::size_t pixels = moving.truth.range_m.size();
    for (std::size_t k = 0; k < 4; ++k) {
      std::vector<double> mean(pixels, 0);
      for (int m = 0; m < samples; ++m) {
        const double time = moving.raw.start_time_s[k] + (m + 0.5) / samples * moving.raw.integration_time_s[k];
        const Frame still = at(time * velocity, {0, 0, 0});
        for (std::size_t i = 0; i < pixels; ++i) mean[i] += static_cast<double>(still.truth.indirect_e[k * pixels + i]) / samples;
      }
      double all = 0, off = 0;
      for (std::size_t i = 0; i < pixels; ++i)
        all += mean[i], off += std::abs(mean[i] - static_cast<double>(moving.truth.indirect_e[k * pixels + i]));
      EXPECT_LT(off, 1e-3 * all) << k;
    }
  }
}

// 64 bounces between walls that lose nothing, lights in walls, nothing to be seen: an end, and numbers.
TEST(bounces, of_odd_scenes_end_in_numbers) {
  const auto finite = [](const Frame& frame) {
    const auto all = [](const auto& array) {
      return std::all_of(array.begin(), array.end(), [](float value) { return std::isfinite(value); });
    };
    return all(frame.truth.signal_e) && all(frame.truth.indirect_e) && all(frame.truth.ambient_e_per_s) && all(frame.raw.tap_a);
  };
  Camera camera = lit_camera(8, 8, 10);
  Scene box;
  box.materials.push_back({"white", Material::Brdf::lambert, 1, 0, 1});
  box.objects.push_back(object(Box{{-1, -1, -1}, {1, 1, 1}}));
  EXPECT_TRUE(finite(frame_with_bounces(box, camera, 64, 16)));
  EXPECT_TRUE(finite(frame_with_bounces(white_ball(1, 0.5), camera, 64, 16)));
  Scene nothing;
  EXPECT_TRUE(finite(frame_with_bounces(nothing, camera, 8, 16)));
  camera.illumination[0].position = {0, 0, 1};  // in the wall
  EXPECT_TRUE(finite(frame_with_bounces(wall(1), camera, 8, 16)));
  camera.illumination[0].position = {0.3, 0, 0.99999};
  Scene corner = wall(1);
  corner.objects.push_back(object(Plane{{0.4, 0, 0}, {-1, 0, 0}}));
  EXPECT_TRUE(finite(frame_with_bounces(corner, camera, 8, 256)));
  camera.illumination.clear();
  EXPECT_TRUE(finite(frame_with_bounces(corner, camera, 8, 4)));
}
