// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The same bytes from every instruction set, with and without culling, on scenes of all sorts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "backend/cpu/cpu.h"
#include "support/every_array.h"
#include "support/random_scene.h"
#include "support/same_frame.h"
#include "support/sanitizers.h"

using namespace tofray;
using namespace tofray::test;

namespace {

constexpr int scenes = with_sanitizers ? 8 : 20;

struct Case {
  Scene scene;
  Camera camera;
};

Case random_case(int number) {
  const int sizes[][2] = {{1, 1}, {7, 5}, {33, 9}, {224, 172}, {64, 48}, {31, 8}, {32, 8}, {65, 17}, {1, 40}, {97, 3}};
  Random random(static_cast<std::uint64_t>(number) + 1);
  const int* size = sizes[number % 10];
  Case c{random_scene(random, 3 + number, number % 3 == 1 && number != 19), load_camera("pico-flexx")};
  if (number % 2 == 0) cut_out(c.scene);
  c.scene.camera.pose = random_pose(random);
  c.camera.sensor.width = number == 19 ? 640 : size[0], c.camera.sensor.height = number == 19 ? 480 : size[1];
  Lens& lens = c.camera.lens;
  lens.cx_px = 0.5 * (c.camera.sensor.width - 1), lens.cy_px = 0.5 * (c.camera.sensor.height - 1);
  lens.fx_px = lens.fy_px = c.camera.sensor.width * 0.9 + 3;
  if (number % 4 == 1) lens.k1 = -0.5;  // corners without an inverse
  if (number % 5 == 2) lens.k2 = 0.05, lens.p1 = 2e-3, lens.p2 = -1e-3, lens.k3 = -0.01;
  for (int i = 0; i < number % 4; ++i) {
    Illumination light = c.camera.illumination[0];
    light.position = random.point(0.6);
    light.axis = Vec3{0, 0, 1} + random.point(0.5);
    const Pattern::Kind kinds[] = {Pattern::Kind::cone, Pattern::Kind::lambertian, Pattern::Kind::cosine_lobe};
    light.pattern.kind = kinds[random.below(3)];
    light.pattern.half_angle_rad = 0.6, light.pattern.exponent = 6;
    if (i == 1) light.area = {Area::Kind::disk, 0.08, 0, 0, 5}, light.ring_leds = 2, light.ring_radius_m = 0.2;
    c.camera.illumination.push_back(light);
  }
  if (number % 4 == 0) c.camera.power_model = PowerModel::paper_literal;
  if (number % 2 == 0) {
    c.scene.ambient.spectrum = Ambient::Spectrum::sun_am15;
    c.scene.ambient.amount = 0.05;
    if (number % 4 == 0) c.scene.ambient.direction = Vec3{0.3, 0.8, 0.4} + random.point(0.3);
  }
  c.camera.decoding.filter.kind = static_cast<ImageFilter::Kind>(number % 5);
  return c;
}

/// Meshes that stand still and meshes that cross the view within a few raw frames, so that what is seen, and what is in whose shade,
/// changes from one to the next; two lights aside and the sun.
Case swift_case(int number) {
  Random random(static_cast<std::uint64_t>(number) + 1000);
  Case c{Scene{}, load_camera("pico-flexx")};
  c.scene.materials = {{"matt", Material::Brdf::lambert, 0.7, 0, 1}};
  c.scene.objects.push_back(object(Plane{{0, 0, 2.5}, Vec3{0.1, 0, -1}}));
  for (int i = 0; i < 7; ++i) {
    const Vec3 at = random.point(0.6) + Vec3{0, 0, 1.4};
    Object one = object(shared(single(stone(random, 1 + i % 3, random.between(0.1, 0.3), {0, 0, 0}))));
    one.position = at;
    if (i >= 3) one.velocity_m_per_s = random.between(5, 60) * base::normalized(Vec3{random.between(-1, 1), random.between(-1, 1), 0.1});
    c.scene.objects.push_back(one);
  }
  c.camera.sensor.width = 100, c.camera.sensor.height = 41;
  Lens& lens = c.camera.lens;
  lens.cx_px = 49.5, lens.cy_px = 20, lens.fx_px = lens.fy_px = 70;
  c.camera.illumination[0].position = random.point(0.4);
  if (number % 2 == 0) {
    c.camera.illumination.push_back(c.camera.illumination[0]);
    c.camera.illumination[1].position = random.point(0.4);
  }
  if (number % 3 != 0) {
    c.scene.ambient.spectrum = Ambient::Spectrum::sun_am15;
    c.scene.ambient.amount = 0.5, c.scene.ambient.direction = Vec3{0.1, 0.2, 1} + random.point(0.3);
  }
  return c;
}

template <class Vector>
void same(const Vector& a, const Vector& b, const char* name) {
  using T = typename Vector::value_type;
  ASSERT_EQ(a.size(), b.size()) << name;
  if (std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0) return;
  std::size_t first = 0, count = 0;
  for (std::size_t i = a.size(); i-- > 0;) {
    if (std::memcmp(&a[i], &b[i], sizeof(T)) != 0) first = i, ++count;
  }
  ADD_FAILURE() << name << ": " << count << " of " << a.size() << " differ, the first at " << first << ": " << +a[first] << " and "
                << +b[first];
}

/// In the order of the pipeline: the first that differs names the stage.
void same(const Frame& a, const Frame& b) {
  same(a.truth.object_id, b.truth.object_id, "object_id");
  same(a.truth.range_m, b.truth.range_m, "gt range");
  same(a.truth.normal, b.truth.normal, "normal");
  same(a.truth.irradiance_w_m2, b.truth.irradiance_w_m2, "irradiance");
  same(a.truth.radiance_w_m2_sr, b.truth.radiance_w_m2_sr, "radiance");
  same(a.truth.power_w, b.truth.power_w, "power");
  same(a.truth.signal_e, b.truth.signal_e, "signal");
  same(a.raw.tap_a, b.raw.tap_a, "tap_a");
  same(a.raw.tap_b, b.raw.tap_b, "tap_b");
  same(a.raw.raw, b.raw.raw, "raw");
  same(a.depth.range_m, b.depth.range_m, "range");
  same(a.depth.z_m, b.depth.z_m, "z");
  same(a.depth.points_m, b.depth.points_m, "points");
  same(a.depth.amplitude_e, b.depth.amplitude_e, "amplitude");
  same(a.depth.ambient_e, b.depth.ambient_e, "ambient");
  same(a.depth.noise_m, b.depth.noise_m, "noise");
  same(a.depth.confidence, b.depth.confidence, "confidence");
  same(a.depth.flags, b.depth.flags, "flags");
  EXPECT_EQ(first_difference(a, b), "") << "in an array that has no line above";
}

Frame render(const Case& c, Isa isa, bool culling, int threads = 1, std::uint64_t frame = 3, int samples = 1) {
  SimulatorOptions options;
  options.arrays = every_array();
  options.seed = 7, options.isa = isa, options.culling = culling, options.threads = threads, options.exposure_samples = samples;
  return Simulator(c.scene, c.camera, options).frame(frame);
}

/// A quarter of the scenes.
class RandomScenes : public testing::TestWithParam<int> {};

}  // namespace

// The reference of a scene is computed once for all kinds of code.
TEST_P(RandomScenes, are_those_of_the_scalar_reference_without_culling_on_all_kinds_of_code) {
  std::size_t pixels = 0, hits = 0;
  for (int i = GetParam(); i < scenes; i += 4) {
    const Case c = random_case(i);
    const Frame reference = render(c, Isa::scalar, false);
    for (const std::int32_t id : reference.truth.object_id) ++pixels, hits += id >= 0;
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;
      SCOPED_TRACE("scene " + std::to_string(i) + " " + backend::isa_name(isa));
      same(render(c, isa, true), reference);
      if (isa != Isa::scalar) same(render(c, isa, false), reference);
      if (i % 4 == 3) same(render(c, isa, true, 3), reference);
    }
  }
  EXPECT_GT(2 * hits, pixels);
}
INSTANTIATE_TEST_SUITE_P(quarter, RandomScenes, testing::Range(0, 4));

/// A few things before a few pixels, with one or two lights.
Case tiny_case(Random& random, const Camera& camera) {
  Case c{random_scene(random, random.below(4), random.below(3) == 0), camera};
  cut_out(c.scene);
  c.scene.camera.pose = random_pose(random);
  c.camera.sensor.width = 1 + random.below(10), c.camera.sensor.height = 1 + random.below(4);
  Lens& lens = c.camera.lens;
  lens.cx_px = 0.5 * (c.camera.sensor.width - 1), lens.cy_px = 0.5 * (c.camera.sensor.height - 1);
  lens.fx_px = lens.fy_px = random.scale(1, 20);
  if (random.below(3) == 0) c.camera.illumination.push_back(c.camera.illumination[0]);
  const bool plain = random.below(40) != 0;     // the tables of what is not take longer than ten such scenes
  if (plain) c.camera.mode.sequence.resize(5);  // one modulation frequency
  for (Illumination& light : c.camera.illumination) {
    light.position = random.point(0.4);
    if (!plain) continue;
    light.waveform.kind = Waveform::Kind::sine;
    light.pattern.kind = random.below(2) == 0 ? Pattern::Kind::lambertian : Pattern::Kind::cone, light.pattern.half_angle_rad = 0.6;
  }
  if (random.below(3) == 0) {
    c.scene.ambient.spectrum = Ambient::Spectrum::sun_am15, c.scene.ambient.amount = 0.1;
    c.scene.ambient.direction = Vec3{0.3, 0.8, 0.4} + random.point(0.3);
  }
  return c;
}

// Every ray for itself against every shape; and lists of what a tile may see, packs, threads. So many scenes as TOFRAY_LONG_SCENES says where
// it is set (.ci/long: a million).
TEST(tiny_scenes, are_the_same_however_they_are_computed) {
  const int wanted = often_unless("TOFRAY_LONG_SCENES", 1000);
  const Camera camera = load_camera("pico-flexx");
  Random random(77);
  std::size_t hits = 0, shaded = 0;
  for (int i = 0; i < wanted && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i));
    const Case c = tiny_case(random, camera);
    const Frame reference = render(c, Isa::scalar, false);
    for (std::size_t p = 0; p < reference.truth.object_id.size(); ++p) {
      if (reference.truth.object_id[p] < 0) continue;
      ++hits, shaded += !(reference.truth.irradiance_w_m2[p] > 0);
    }
    same(render(c, Isa::scalar, true), reference);
    Isa last = Isa::scalar;
    for (const Isa isa : {Isa::avx2, Isa::avx512, Isa::neon}) {
      if (!backend::can_run(isa)) continue;
      same(render(c, isa, true), reference);
      last = isa;
    }
    same(render(c, last, false, 2), reference);
  }
  EXPECT_GT(hits, static_cast<std::size_t>(wanted));
  EXPECT_GT(shaded, static_cast<std::size_t>(wanted) / 10);
}

// Tiles look at meshes as a whole where the machine has packs; each ray by itself where it has none.
TEST(swift_meshes, are_seen_and_shaded_alike_by_tiles_and_by_single_rays) {
  if (!backend::can_run(Isa::avx2) && !backend::can_run(Isa::neon)) GTEST_SKIP() << "no packs on this machine";
  int moving = 0, changing = 0;
  for (int i = 0; i < (with_sanitizers ? 2 : 6); ++i) {
    const Case c = swift_case(i);
    const Frame reference = render(c, Isa::scalar, false, 1, 0);
    SCOPED_TRACE("scene " + std::to_string(i));
    const std::size_t pixels = reference.truth.object_id.size();
    for (std::size_t p = 0; p < pixels; ++p) {
      moving += reference.truth.object_id[p] > 3;
      changing += reference.truth.signal_e[pixels + p] != reference.truth.signal_e[2 * pixels + p];
    }
    for (const Isa isa : {Isa::avx2, Isa::avx512, Isa::neon}) {
      if (!backend::can_run(isa)) continue;
      same(render(c, isa, true, 1, 0), reference);
      same(render(c, isa, false, 2, 0), reference);
    }
  }
  EXPECT_GT(moving, 200);
  EXPECT_GT(changing, 1000);
}

// Things that turn and follow keyframes, meshes among them, seen by a camera that may move, once or several times in each exposure.
TEST(scenes_in_motion, have_the_same_bytes_on_all_kinds_of_code) {
  int moving = 0, turning = 0;
  for (int i = 0; i < (with_sanitizers ? 4 : 10); ++i) {
    Case c = i % 2 == 0 ? random_case(i) : swift_case(i);
    Random random(static_cast<std::uint64_t>(i) + 2000);
    set_in_motion(random, c.scene, i % 3 != 0);
    c.camera.sensor.width = std::min(c.camera.sensor.width, 100), c.camera.sensor.height = std::min(c.camera.sensor.height, 60);
    if (i % 4 == 1) c.camera.pixel.delay_s = 1e-10;
    const int samples = 1 + i % 5;
    const std::uint64_t frame = i % 2 == 0 ? 1 : 0;
    SCOPED_TRACE("scene " + std::to_string(i));
    const Frame reference = render(c, Isa::scalar, false, 1, frame, samples);
    const std::size_t pixels = reference.truth.object_id.size();
    for (std::size_t p = 0; p < pixels; ++p) {
      moving += reference.truth.flow_px[2 * p] != 0;
      turning +=
          reference.truth.object_id[p] >= 0 && !c.scene.objects[static_cast<std::size_t>(reference.truth.object_id[p])].keyframes.empty();
    }
    same(render(c, Isa::scalar, true, 2, frame, samples), reference);
    for (const Isa isa : backend::machine_isas) {
      if (!backend::can_run(isa)) continue;
      same(render(c, isa, true, 1, frame, samples), reference);
      same(render(c, isa, false, 2, frame, samples), reference);
    }
  }
  EXPECT_GT(moving, with_sanitizers ? 1000 : 5000);
  EXPECT_GT(turning, with_sanitizers ? 200 : 1000);
}

// Path by path without lanes; where there are lanes, all paths of several samples together, those that go on closing ranks at each surface.
// By one light and several, the sun, the sky, phasors and sums alone, in motion, in rounds, more paths than are summed at once.
TEST(bounced_light, has_the_same_bytes_path_by_path_and_many_paths_at_once) {
  const int bounces[] = {7, 1, 3, 12, 2, 64}, samples[] = {16, 7, 140, 4, 34};
  std::size_t indirect = 0;
  for (int i = 0; i < (with_sanitizers ? 4 : 16); ++i) {
    Random random(static_cast<std::uint64_t>(i) + 4000);
    Case c{random_scene(random, 12 + i, i % 5 == 2), load_camera("pico-flexx")};
    cut_out(c.scene);
    c.scene.camera.pose = random_pose(random);
    c.camera.sensor.width = 5 + 3 * i, c.camera.sensor.height = 1 + i % 6;
    Lens& lens = c.camera.lens;
    lens.cx_px = 0.5 * (c.camera.sensor.width - 1), lens.cy_px = 0.5 * (c.camera.sensor.height - 1);
    lens.fx_px = lens.fy_px = c.camera.sensor.width * 0.7;
    c.scene.transport.bounces = bounces[i % 6], c.scene.transport.samples = samples[i % 5];
    if (i % 4 == 3) c.scene.transport.max_samples = 4 * c.scene.transport.samples, c.scene.transport.path_noise_m = 1e-3;
    if (i % 3 == 1) c.camera.illumination.push_back(c.camera.illumination[0]), c.camera.illumination[1].position = random.point(0.4);
    if (i % 3 == 2) c.camera.pixel.delay_s = 1e-10;
    if (i % 4 != 0) c.scene.ambient.spectrum = Ambient::Spectrum::sun_am15, c.scene.ambient.amount = 0.1;
    if (i % 4 == 1) c.scene.ambient.direction = Vec3{0.3, 0.8, 0.4} + random.point(0.3);
    if (i % 6 == 5) set_in_motion(random, c.scene, i % 4 == 1);
    SCOPED_TRACE("scene " + std::to_string(i));
    const Frame reference = render(c, Isa::scalar, false);
    for (const float one : reference.truth.multipath_m) indirect += one != 0 && !std::isnan(one);
    for (const Isa isa : backend::machine_isas) {
      if (!backend::can_run(isa)) continue;
      same(render(c, isa, true, 2), reference);
    }
  }
  EXPECT_GT(indirect, with_sanitizers ? 50U : 500U);
}
