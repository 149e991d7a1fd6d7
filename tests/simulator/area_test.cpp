// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Lights that are disks and rectangles.                                                 [theory: rectangle-light, disk-light]
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>

#include "backend/cpu/cpu.h"
#include "base/vec.h"
#include "camera/light/emitters.h"
#include "support/pixels.h"
#include "support/random_scene.h"
#include "support/same_frame.h"
#include "tofray/stages.h"
#include "tofray/tofray.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Area shining_disk(double radius, int points = 16) { return {Area::Kind::disk, radius, 0, 0, points}; }
Area shining_rectangle(double width, double height, int points = 16) { return {Area::Kind::rectangle, 0, width, height, points}; }

Camera with_area(Camera camera, const Area& area) {
  camera.illumination[0].area = area;
  return camera;
}

/// A camera in the middle of its light, which shines like a matt disk.
Camera matt_light(int width, double focal, const Area& area) {
  Camera camera = lit_camera(width, width, focal);
  camera.illumination[0].pattern.kind = Pattern::Kind::lambertian;
  camera.illumination[0].power_w = 1;
  camera.adc.step_e_per_dn = 1e4;  // nothing clips
  return with_area(camera, area);
}

double middle_irradiance(const Scene& scene, const Camera& camera) {
  const Truth t = truth(scene, camera);
  return static_cast<double>(t.irradiance_w_m2[t.irradiance_w_m2.size() / 2]);
}

/// The greatest difference of two exposures, relative to their light.
double taps_apart(const Raw& a, const std::vector<double>& tap_a, const std::vector<double>& tap_b) {
  double most = 0;
  for (std::size_t i = 0; i < tap_a.size(); ++i) {
    const double light = tap_a[i] + tap_b[i] + 1e-6;
    most = std::max(
        {most, std::abs(static_cast<double>(a.tap_a[i]) - tap_a[i]) / light, std::abs(static_cast<double>(a.tap_b[i]) - tap_b[i]) / light});
  }
  return most;
}

/// Exposures to each of the lights alone, added up.
void add_up_alone(const Scene& scene, const Camera& camera, std::vector<double>& tap_a, std::vector<double>& tap_b) {
  for (const Illumination& light : camera.illumination) {
    Camera alone = camera;
    alone.illumination = {light};
    const Raw raw = expected_frame(scene, alone).raw;
    tap_a.resize(raw.tap_a.size()), tap_b.resize(raw.tap_b.size());
    for (std::size_t i = 0; i < tap_a.size(); ++i) {
      tap_a[i] += static_cast<double>(raw.tap_a[i]), tap_b[i] += static_cast<double>(raw.tap_b[i]);
    }
  }
}

Camera small_pico() {
  Camera camera = load_camera("pico-flexx");
  camera.sensor.width = 56, camera.sensor.height = 43;
  camera.lens.fx_px /= 4, camera.lens.fy_px /= 4, camera.lens.cx_px /= 4, camera.lens.cy_px /= 4;
  return camera;
}

}  // namespace

// Its four points, by hand: a quarter of the power each, with paths and shadows of their own.
TEST(area_light, is_its_points) {
  Camera area = small_pico();
  area.illumination[0].position = {0.01, -0.02, 0.003};
  Camera each = area;
  area.illumination[0].area = shining_rectangle(0.06, 0.04, 4);
  each.illumination.clear();
  // an eighth, three, five and seven eighths of width and height each
  for (const auto& [x, y] : {std::pair{-0.0225, -0.005}, std::pair{0.0075, -0.015}, std::pair{-0.0075, 0.015}, std::pair{0.0225, 0.005}}) {
    Illumination one = area.illumination[0];
    one.area = {};
    one.position[0] += x, one.position[1] += y;
    one.power_w /= 4;
    each.illumination.push_back(one);
  }
  for (const char* name : {"demo", "flying-ball", "step-and-rod"}) {
    const Scene scene = load_scene(name);
    const Frame a = expected_frame(scene, area), b = expected_frame(scene, each);
    const std::vector<double> tap_a(b.raw.tap_a.begin(), b.raw.tap_a.end()), tap_b(b.raw.tap_b.begin(), b.raw.tap_b.end());
    EXPECT_LT(taps_apart(a.raw, tap_a, tap_b), 1e-5) << name;
  }
}

// Any number of them, up to the most that there may be, each alone and then added up.
TEST(area_light, is_the_sum_of_its_points_alone) {
  Random random(5);
  const Scene scene = random_scene(random, 6, false);
  for (const Area& area : {shining_disk(0.05), shining_disk(0.05, 64), shining_rectangle(0.1, 0.03, 23)}) {
    Camera camera = lit_camera(32, 24, 25);
    camera.illumination[0].position = {0.1, 0.02, 0}, camera.illumination[0].axis = {-0.2, 0.1, 1};
    camera.illumination[0].area = area;
    std::vector<double> tap_a, tap_b;
    add_up_alone(scene, camera::with_emitters(camera), tap_a, tap_b);
    EXPECT_LT(taps_apart(expected_frame(scene, camera).raw, tap_a, tap_b), 1e-5);
  }
}

TEST(area_light, of_one_point_is_a_point) {
  const Scene scene = load_scene("demo");
  const Camera camera = small_pico();
  const Frame point = Simulator(scene, camera).frame(3);
  EXPECT_EQ(first_difference(Simulator(scene, with_area(camera, shining_disk(0.03, 1))).frame(3), point), "");
  EXPECT_EQ(first_difference(Simulator(scene, with_area(camera, shining_rectangle(0.03, 0.02, 1))).frame(3), point), "");
  EXPECT_NE(first_difference(Simulator(scene, with_area(camera, shining_disk(0.03, 2))).frame(3), point), "");
}

namespace {

constexpr double card_z = 1, back_z = 2;

/// What of its light a row of a wall gets at each place x beside the shadow of a card's edge; the camera is a telescope.
struct Penumbra {
  std::vector<double> x, share;
};

/// @param edge   the card reaches from x = edge on to the right
/// @param light  about x = aside, 0.1 W
Penumbra penumbra_of(const Area& area, double edge, double aside, double turn = 0) {
  const double focal = 10'000, middle = edge * back_z / card_z - aside * (back_z - card_z) / card_z;
  Camera camera = plain_camera(500, 1, focal);
  camera.lens.cx_px -= middle / back_z * focal;
  Illumination light = one_watt_per_steradian({aside, 0, 0});
  light.pattern.kind = Pattern::Kind::lambertian;
  light.area = area;
  camera.illumination.push_back(light);
  Scene open = wall(back_z), shaded = open;
  const auto turned = [&](double x, double y) {  // about the point that the light's middle sees over the shadow's
    return Vec3{edge + x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), card_z};
  };
  shaded.objects.push_back(object(Triangle{{turned(0, -50), turned(0, 50), turned(80, 0)}}));
  const Truth all = truth(open, camera), left = truth(shaded, camera);
  Penumbra out;
  for (std::size_t i = 0; i < all.irradiance_w_m2.size(); ++i) {
    EXPECT_EQ(left.object_id[i], 0);
    out.x.push_back((static_cast<double>(i) - camera.lens.cx_px) / focal * back_z);
    out.share.push_back(static_cast<double>(left.irradiance_w_m2[i]) / static_cast<double>(all.irradiance_w_m2[i]));
  }
  return out;
}

/// How far the shares are at most from those of the area that a point of the wall sees past the edge.
/// @param share  of the area on the left of a line at t from its middle
double off_the_profile(const Penumbra& seen, double edge, double aside, const std::function<double(double)>& share) {
  double most = 0;
  for (std::size_t i = 0; i < seen.x.size(); ++i) {
    // on the light's side the line through this point and the edge is at …
    const double line = (edge * back_z - seen.x[i] * card_z) / (back_z - card_z);
    most = std::max(most, std::abs(seen.share[i] - share(line - aside)));
  }
  return most;
}

double share_of_disk(double t) { return t <= -1 ? 0 : t >= 1 ? 1 : 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi; }

}  // namespace

// How much of the light's area a point of the wall sees past the card's edge, and that alone, is what it gets: within half a point's share,
// a thousandth more since the light's far side is further away.
TEST(penumbra, has_the_profile_of_the_area_that_is_seen) {
  const double edge = 0.02, aside = 0.06, s = 0.06;
  const auto strip = [&](double t) { return std::clamp(t / s + 0.5, 0.0, 1.0); };
  const auto disk = [&](double t) { return share_of_disk(t / (s / 2)); };
  const auto worst_of = [&](const Area& area, const auto& share) {
    return off_the_profile(penumbra_of(area, edge, aside), edge, aside, share);
  };
  for (const int points : {16, 23, 50, 64}) {
    const double most = 0.5 / points + 1e-3;
    EXPECT_LT(worst_of(shining_rectangle(s, 1e-6, points), strip), most) << points;
    EXPECT_LT(worst_of(shining_rectangle(s, s, points), strip), most) << points;
    EXPECT_LT(worst_of(shining_rectangle(s, 2 * s, points), strip), most) << points;
    EXPECT_LT(worst_of(shining_disk(s / 2, points), disk), most) << points;
  }
  EXPECT_LT(worst_of(shining_rectangle(s, s, 64), strip), 0.01);
  EXPECT_LT(worst_of(shining_disk(s / 2, 64), disk), 0.01);
  // and not of another area
  EXPECT_GT(worst_of(shining_disk(s / 2, 64), strip), 0.05);
  EXPECT_GT(worst_of(shining_rectangle(1.05 * s, s, 64), strip), 0.02);
}

// Edges that lie aslant: a disk is a disk.
TEST(penumbra, is_that_of_a_disk_at_any_slant) {
  const double edge = 0.02, aside = 0.06, r = 0.03;
  for (const double turn : {0.3, 0.6, -0.5}) {
    // across the edge all is cos(turn) of what it is along x
    const auto disk = [&](double t) { return share_of_disk(t * std::cos(turn) / r); };
    EXPECT_LT(off_the_profile(penumbra_of(shining_disk(r, 64), edge, aside, turn), edge, aside, disk), 0.06) << turn;
    EXPECT_LT(off_the_profile(penumbra_of(shining_disk(r, 16), edge, aside, turn), edge, aside, disk), 0.14) << turn;
  }
}

// From full light to none over w = s·(z2 − z1)/z1, s the light's width; where it ends, within a point's share.
TEST(penumbra, is_as_wide_as_similar_triangles_say) {
  const double edge = 0.02, aside = 0.06, s = 0.06, w = s * (back_z - card_z) / card_z;
  const auto width_of = [&](const Area& area) {
    const Penumbra seen = penumbra_of(area, edge, aside);
    const auto first = std::find_if(seen.share.begin(), seen.share.end(), [](double share) { return share < 0.999; });
    const auto last = std::find_if(seen.share.begin(), seen.share.end(), [](double share) { return share == 0; });
    EXPECT_NE(last, seen.share.end());
    EXPECT_TRUE(std::all_of(last, seen.share.end(), [](double share) { return share == 0; }));
    return seen.x[static_cast<std::size_t>(last - seen.share.begin())] - seen.x[static_cast<std::size_t>(first - seen.share.begin())];
  };
  const double pixel = back_z / 10'000;
  for (const int points : {16, 64}) {
    EXPECT_NEAR(width_of(shining_rectangle(s, 0.02, points)), w * (points - 1) / points, 2 * pixel);
    // the outermost of n points in a disk stands where half a point's share of the area lies beyond
    double line = 1;
    while (share_of_disk(line) > 1 - 0.5 / points) line -= 1e-5;
    EXPECT_NEAR(width_of(shining_disk(s / 2, points)), w * line, 2 * pixel);
  }
  EXPECT_LT(width_of(shining_disk(1e-6)), 2 * pixel);
}

// A disk of radius R that shines like a matt surface sends out the radiance L = P/(π·πR²); what faces it on its axis at a distance d gets
// E = πL·sin²θ = P/(π(R² + d²)).
TEST(area_light, lights_its_axis_as_a_matt_disk_does) {
  const double radius = 0.1;
  for (const auto& [d, of_16, of_64] : {std::array{0.1, 1.4e-2, 1.8e-3}, {0.2, 1e-3, 5e-4}, {0.5, 5e-4, 2e-4}, {3.0, 2e-5, 1e-5}}) {
    const double expected = 1 / (pi * (radius * radius + d * d));
    EXPECT_NEAR(middle_irradiance(wall(d), matt_light(1, 200, shining_disk(radius))) / expected, 1, of_16) << d;
    EXPECT_NEAR(middle_irradiance(wall(d), matt_light(1, 200, shining_disk(radius, 64))) / expected, 1, of_64) << d;
  }
  // near by it is not what a point would do
  EXPECT_NEAR(middle_irradiance(wall(0.1), matt_light(1, 200, {})) * pi * 0.01, 1, 1e-5);
}

// From afar the size does not matter: R²/d² of the light, and no more.
TEST(area_light, is_a_point_from_afar) {
  const double size = 0.01, d = 4, small = size * size / (d * d);
  const Scene scene = wall(d);
  const Truth point = truth(scene, matt_light(9, 6, {}));
  for (const Area& area : {shining_disk(size), shining_rectangle(2 * size, size), shining_rectangle(size, 1.3 * size, 13)}) {
    const Truth t = truth(scene, matt_light(9, 6, area));
    for (std::size_t i = 0; i < t.irradiance_w_m2.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(t.irradiance_w_m2[i] / point.irradiance_w_m2[i]), 1, 5 * small + roundings(50)) << i;
    }
  }
}

// All of the power arrives at a wall that a narrow lobe does not miss, however large the light is and wherever it looks: Σ E·dA = P.
TEST(area_light, keeps_the_power) {
  const double d = 1, focal = 60;
  for (const Area& area : {shining_disk(0.2), shining_disk(0.1, 37), shining_rectangle(0.3, 0.1, 8)}) {
    for (const int leds : {1, 3}) {
      if (leds * area.points > 64) continue;
      Camera camera = matt_light(220, focal, area);
      Illumination& light = camera.illumination[0];
      light.power_w = 0.7, light.axis = {0.2, -0.1, 1}, light.position = {-0.1, 0.1, 0};
      light.ring_leds = leds, light.ring_radius_m = 0.1;
      light.pattern.kind = Pattern::Kind::cosine_lobe, light.pattern.exponent = 60;
      const Truth t = truth(wall(d), camera);
      double sum = 0;
      for (const float e : t.irradiance_w_m2) sum += static_cast<double>(e);
      EXPECT_NEAR(sum * (d / focal) * (d / focal), 0.7, 1e-5);
    }
  }
}

// The phasor of a disk around the lens, seen on its axis: ∫ E·e^{ikℓ} over rings of it, ℓ = √(ρ² + z²) + z.
TEST(area_light, has_the_mean_phasor_of_its_paths) {
  const double radius = 0.2, z = 0.4, k = 2 * pi * 60e6 / 299'792'458;
  std::complex<double> sum = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double square = radius * radius * (i + 0.5) / 10'000, away = square + z * z;
    sum += z * z / (away * away) * std::polar(1.0, k * (std::sqrt(away) + z)) / 10'000.0;
  }
  const auto phasor = [&](const Area& area) {
    const Raw raw = expected_frame(wall(z), matt_light(1, 200, area)).raw;
    const auto difference = [&](std::size_t i) { return static_cast<double>(raw.tap_a[i]) - static_cast<double>(raw.tap_b[i]); };
    return std::complex<double>(difference(0) - difference(2), difference(3) - difference(1));
  };
  const std::complex<double> ratio = phasor(shining_disk(radius, 64)) / phasor({});
  const std::complex<double> expected = sum / (std::polar(1.0, 2 * k * z) / (z * z));
  EXPECT_NEAR(std::abs(ratio / expected), 1, 1e-3);
  EXPECT_NEAR(std::arg(ratio / expected), 0, 1e-4);  // 40 µm of 11 mm
  EXPECT_GT(std::arg(expected), 0.028);
}

// Depth counts the mean of |L|² [theory: several-lights]: near the axis a large light does not shift it.
TEST(area_light, does_not_shift_depth) {
  for (const double z : {0.5, 1.0, 2.0}) {
    const Frame frame = expected_frame(wall(z), matt_light(1, 200, shining_disk(0.05)));
    EXPECT_NEAR(static_cast<double>(frame.depth.z_m[0]), z, 2e-5) << z;
  }
}

// As many lights as there may be, in tiles of any size, with shadows of what stands still, of what moves and of meshes.
TEST(area_light, of_64_points_has_the_same_bytes_on_all_processors) {
  for (int number = 0; number < 4; ++number) {
    Random random(static_cast<std::uint64_t>(number) + 70);
    const Scene scene = random_scene(random, 8, number % 2 == 1);
    Camera camera = small_pico();
    camera.illumination[0].ring_leds = 4, camera.illumination[0].ring_radius_m = 0.1;
    camera.illumination[0].area = number < 2 ? shining_disk(0.03) : shining_rectangle(0.05, 0.02);
    const Frame reference = Simulator(scene, camera, {.threads = 1, .isa = Isa::scalar}).frame(1);
    for (const Isa isa : backend::isas_here) {
      if (!backend::can_run(isa)) continue;
      for (const bool culling : {true, false}) {
        EXPECT_EQ(first_difference(Simulator(scene, camera, {.threads = 3, .isa = isa, .culling = culling}).frame(1), reference), "")
            << number << " " << backend::isa_name(isa);
      }
    }
  }
}

// Arrays of one's own count its points as lights: a shadow on all but one of eight leaves an eighth.
TEST(area_light, has_a_light_for_each_of_its_points_in_arrays_of_ones_own) {
  const Camera camera = matt_light(3, 20, shining_rectangle(1e-3, 1e-3, 8));
  Geometry geometry{3, 3, 1, {}, {}, {}, {}, {}, {}, {}, {}};
  for (int i = 0; i < 9; ++i) {
    geometry.z_m.push_back(1), geometry.diffuse.push_back(1);
    for (const float n : {0.0F, 0.0F, -1.0F}) geometry.normal.push_back(n);
  }
  Simulator simulator({}, camera, {.noise = Noise::off});
  const Truth open = simulator.frame(0, geometry).truth;
  geometry.shadow.assign(8 * 9, 1);
  std::fill_n(geometry.shadow.begin() + 5 * 9, 9, std::uint8_t{0});
  const Truth shaded = simulator.frame(0, geometry).truth;
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_NEAR(static_cast<double>(shaded.irradiance_w_m2[i] / open.irradiance_w_m2[i]), 0.125, 1e-3);
  }
}

TEST(area_light, of_more_points_than_there_may_be_lights_is_refused) {
  const auto refusal = [](const Camera& camera) {
    try {
      (void)Simulator({}, camera);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::limit);
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string rest =
      ", at most 64 (`tofray --limits`); each LED of a ring and each point of an area is a source; take fewer points or LEDs";
  Camera camera = matt_light(1, 20, shining_disk(0.01, 60));
  camera.illumination.resize(5, lit_camera().illumination[0]);
  EXPECT_EQ(refusal(camera), "");
  camera.illumination.resize(6, lit_camera().illumination[0]);
  EXPECT_EQ(refusal(camera), "error: illumination[0].area.points: the camera has too many light sources\n  got 65" + rest);
  camera.illumination[0].area = {};
  camera.illumination[2].ring_leds = 60;
  EXPECT_EQ(refusal(camera), "error: illumination[2].ring_leds: the camera has too many light sources\n  got 65" + rest);
  camera.illumination.resize(65, lit_camera().illumination[0]);
  camera.illumination[2].ring_leds = 1;
  EXPECT_NE(refusal(camera), "");
}

// A table is kept for each point: eight of the largest, not sixty-four.
TEST(area_light, of_a_large_table_has_few_points) {
  Camera camera = matt_light(1, 20, shining_disk(0.01, 8));
  Pattern& pattern = camera.illumination[0].pattern;
  pattern.kind = Pattern::Kind::table, pattern.columns = pattern.rows = 1024;
  pattern.half_range_x_rad = pattern.half_range_y_rad = 0.5;
  pattern.samples.assign(1 << 20, 1);
  camera.illumination[0].area.points = 9;
  try {
    (void)Simulator({}, camera);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_NE(std::string(error.what()).find("too many samples of their patterns\n  got 9437184, at most 8388608"), std::string::npos)
        << error.what();
  }
}
