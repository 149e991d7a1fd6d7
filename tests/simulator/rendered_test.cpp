// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pictures drawn through a pinhole by formulas, as a camera with distortion sees them.
#include "tofray/rendered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tofray/error.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

using namespace tofray;

namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();

/// z along the ray (x, y, 1).
using SurfaceZ = std::function<double(double, double)>;

/// The plane n · P = d.
struct Flat {
  std::array<double, 3> n;
  double d;
  double operator()(double x, double y) const { return d / (n[0] * x + n[1] * y + n[2]); }
};

Flat turned_about_y(double degrees, double at_z) {
  const double angle = degrees * 3.14159265358979 / 180;
  return {{std::sin(angle), 0, -std::cos(angle)}, -std::cos(angle) * at_z};
}

struct DrawnPictures {
  Pinhole pinhole;
  std::vector<float> z, normal;
  [[nodiscard]] RenderedPictures pictures() const {
    RenderedPictures out;
    out.pinhole = pinhole, out.still = true, out.z_m = z, out.normal = normal, out.other_reflectivity = 0.5;
    return out;
  }
  [[nodiscard]] std::size_t pixel(int u, int v) const { return static_cast<std::size_t>(v * pinhole.width + u); }
};

DrawnPictures draw(const Pinhole& through, const SurfaceZ& surface) {
  DrawnPictures out{through, {}, {}};
  for (int v = 0; v < through.height; ++v)
    for (int u = 0; u < through.width; ++u)
      out.z.push_back(static_cast<float>(
          surface((u + through.pixel_centre - through.cx_px) / through.fx_px, (v + through.pixel_centre - through.cy_px) / through.fy_px)));
  return out;
}

void add_normal(DrawnPictures& to, const std::array<double, 3>& n) {
  for (std::size_t i = 0; i < to.z.size(); ++i)
    for (const double one : n) to.normal.push_back(static_cast<float>(one));
}

Camera distorted() { return load_camera("pico-flexx"); }

/// Largest error of z against a surface, over all rays that see something. [m]
double worst_z(const Camera& camera, const Geometry& seen, const SurfaceZ& surface) {
  const std::vector<float> rays = pixel_rays(camera);
  double worst = 0;
  for (std::size_t i = 0; i < seen.z_m.size(); ++i) {
    const double expected = surface(static_cast<double>(rays[2 * i]), static_cast<double>(rays[2 * i + 1]));
    worst = std::max(worst, std::abs(static_cast<double>(seen.z_m[i]) - expected));
  }
  return worst;
}

/// Largest angle between normals and the nearest of these [rad].
double worst_angle(const Geometry& seen, const std::vector<std::array<double, 3>>& any_of) {
  double worst = 0;
  for (std::size_t i = 0; i < seen.z_m.size(); ++i) {
    const float* const n = &seen.normal[3 * i];
    double nearest = 4;
    for (const auto& one : any_of) {
      const double x = static_cast<double>(n[0]) - one[0], y = static_cast<double>(n[1]) - one[1], z = static_cast<double>(n[2]) - one[2];
      nearest = std::min(nearest, std::sqrt(x * x + y * y + z * z));
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

std::string message_of(const auto& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

bool says(const SampledPictures& sampled, const std::string& what) {
  return std::any_of(sampled.notices.begin(), sampled.notices.end(),
                     [&](const std::string& one) { return one.find(what) != std::string::npos; });
}

}  // namespace

// Floats of up to 5 m are off by 2.4e-7 m, and the rays' directions by 6e-8.
TEST(rendered_pictures, of_a_slanted_plane_are_its_z_along_each_ray_of_the_lens) {
  const Camera camera = distorted();
  const Flat plane = turned_about_y(45, 1.5);
  for (const double centre : {0.5, 0.0}) {
    DrawnPictures drawn = draw(pinhole_for(camera, 2, 2, centre), plane);
    add_normal(drawn, {-plane.n[0], -plane.n[1], -plane.n[2]});  // of its other side: they are turned
    const SampledPictures sampled = from_pictures(camera, drawn.pictures());
    EXPECT_LT(worst_z(camera, sampled.geometry, plane), 1e-5) << centre;
    EXPECT_LT(worst_angle(sampled.geometry, {plane.n}), 1e-6);
    EXPECT_EQ(sampled.outside, 0);
    EXPECT_TRUE(sampled.notices.empty());
  }
}

// Half a pixel is 1/848 of x/z; z of this plane grows by 1.5 m · tan 45° with x/z at the axis: 1.8 mm.
TEST(rendered_pictures, are_off_by_half_a_pixel_where_the_pixels_middle_is_said_wrong) {
  const Camera camera = distorted();
  const Flat plane = turned_about_y(45, 1.5);
  DrawnPictures drawn = draw(pinhole_for(camera), plane);
  add_normal(drawn, plane.n);
  drawn.pinhole.pixel_centre = 0;
  const SampledPictures sampled = from_pictures(camera, drawn.pictures());
  const std::size_t middle = sampled.geometry.z_m.size() / 2 + 112;
  const std::vector<float> rays = pixel_rays(camera);
  const double x = static_cast<double>(rays[2 * middle]), y = static_cast<double>(rays[2 * middle + 1]);
  EXPECT_NEAR(std::abs(static_cast<double>(sampled.geometry.z_m[middle]) - plane(x, y)), 1.5 / 848, 1e-4);
}

TEST(rendered_pictures, without_normals_have_those_of_their_planes) {
  const Camera camera = distorted();
  const double length = std::sqrt(1.34);
  for (const Flat& plane : {turned_about_y(45, 1.5), turned_about_y(0, 1.0), Flat{{0.5 / length, 0.3 / length, -1 / length}, -1}}) {
    const DrawnPictures drawn = draw(pinhole_for(camera), plane);
    const SampledPictures sampled = from_pictures(camera, drawn.pictures());
    // Two z's of 3 m at most, each off by 1.2e-7 m, over the 2.4 mm per metre of a pixel.
    EXPECT_LT(worst_angle(sampled.geometry, {plane.n}), 1e-3);
    EXPECT_LT(worst_z(camera, sampled.geometry, plane), 1e-5);
  }
}

// Whatever falls between a near and a far surface is a pixel that flies.
TEST(rendered_pictures, of_a_step_have_nothing_between_near_and_far_and_normals_that_do_not_lean) {
  const Camera camera = distorted();
  const DrawnPictures drawn = draw(pinhole_for(camera, 2, 1), [](double x, double y) { return x + 0.2 * y < 0.05 ? 1.0 : 1.4; });
  const Geometry seen = from_pictures(camera, drawn.pictures()).geometry;
  int near = 0, far = 0;
  for (const float z : seen.z_m) {
    near += z == 1.0f, far += z == 1.4f;
    EXPECT_TRUE(z == 1.0f || z == 1.4f) << z;
  }
  EXPECT_TRUE(near > 1000 && far > 1000);
  EXPECT_LT(worst_angle(seen, {{0, 0, -1}}), 1e-3);
}

TEST(rendered_pictures, of_two_planes_that_meet_have_normals_of_one_or_the_other) {
  const Camera camera = distorted();
  const Flat left = turned_about_y(-40, 1.2), right = turned_about_y(40, 1.2);
  for (const bool ridge : {true, false}) {
    const SurfaceZ roof = [&](double x, double y) { return ridge ? std::max(left(x, y), right(x, y)) : std::min(left(x, y), right(x, y)); };
    const DrawnPictures drawn = draw(pinhole_for(camera, 2, 1), roof);  // so that each of its pixels is a ray's nearest
    EXPECT_LT(worst_angle(from_pictures(camera, drawn.pictures()).geometry, {left.n, right.n}), 1e-3) << ridge;
  }
}

// One pixel wide, or two: no line through neighbours leads to it, or one alone.
TEST(rendered_pictures, of_wires_face_the_camera) {
  const Camera camera = distorted();
  for (const int wide : {1, 2}) {
    DrawnPictures drawn = draw(pinhole_for(camera, 2, 1), [](double, double) { return 2.0; });
    const int column = drawn.pinhole.width / 2 + 20;
    for (int v = 0; v < drawn.pinhole.height; ++v)
      for (int u = column; u < column + wide; ++u) drawn.z[drawn.pixel(u, v)] = 1.0f;
    const Geometry seen = from_pictures(camera, drawn.pictures()).geometry;
    int on_wire = 0;
    for (std::size_t i = 0; i < seen.z_m.size(); ++i) {
      EXPECT_TRUE(seen.z_m[i] == 2.0f || std::abs(seen.z_m[i] - 1.0f) < 1e-3f) << seen.z_m[i];
      on_wire += seen.z_m[i] < 1.5f;
    }
    EXPECT_GT(on_wire, 50);
    EXPECT_LT(worst_angle(seen, {{0, 0, -1}}), 0.1) << wide;  // x/z of the wire is 0.096: it faces the camera, not the wall's way
  }
}

TEST(rendered_pictures, show_nothing_at_the_far_plane_and_where_z_is_none) {
  const Camera camera = distorted();
  const double far = 10;
  for (const float none : {10.0f, 9.995f, 12.0f, 0.0f, -1.0f, no_number, endless}) {
    DrawnPictures drawn = draw(pinhole_for(camera), [&](double x, double) { return x < 0 ? 1.0 : static_cast<double>(none); });
    RenderedPictures pictures = drawn.pictures();
    pictures.background_m = far;
    const Geometry seen = from_pictures(camera, pictures).geometry;
    const std::vector<float> rays = pixel_rays(camera);
    for (std::size_t i = 0; i < seen.z_m.size(); ++i)
      EXPECT_EQ(std::isnan(seen.z_m[i]), rays[2 * i] >= 0 && std::abs(rays[2 * i]) > 0.002f) << none << " at " << rays[2 * i];
    EXPECT_LT(worst_angle(seen, {{0, 0, -1}, {0, 0, 0}}), 1e-3) << "the sky is no surface to lean to";
  }
}

TEST(rendered_pictures, may_say_the_range_in_place_of_z) {
  const Camera camera = distorted();
  const Flat plane = turned_about_y(30, 1.2);
  DrawnPictures drawn = draw(pinhole_for(camera), [&](double x, double y) { return plane(x, y) * std::sqrt(x * x + y * y + 1); });
  RenderedPictures pictures = drawn.pictures();
  pictures.along_ray = true;
  EXPECT_LT(worst_z(camera, from_pictures(camera, pictures).geometry, plane), 1e-5);
  pictures.along_ray = false;
  EXPECT_GT(worst_z(camera, from_pictures(camera, pictures).geometry, plane), 0.05);
}

TEST(rendered_pictures, that_are_too_small_show_nothing_beyond_and_say_how_much) {
  const Camera camera = distorted();
  Pinhole narrow = pinhole_for(camera);
  narrow.width -= 200, narrow.cx_px -= 100;
  const DrawnPictures drawn = draw(narrow, [](double, double) { return 1.0; });
  const SampledPictures sampled = from_pictures(camera, drawn.pictures());
  const std::vector<float> rays = pixel_rays(camera);
  const float edge = static_cast<float>(0.5 * narrow.width / narrow.fx_px);
  std::size_t beyond = 0, nothing = 0;
  for (std::size_t i = 0; i < rays.size() / 2; ++i) beyond += std::abs(rays[2 * i]) > edge, nothing += std::isnan(sampled.geometry.z_m[i]);
  EXPECT_GT(beyond, 5000u);
  EXPECT_EQ(nothing, beyond);
  EXPECT_DOUBLE_EQ(sampled.outside, static_cast<double>(beyond) / static_cast<double>(rays.size() / 2));
  EXPECT_TRUE(says(sampled, "of the camera's rays look past the picture"));
}

TEST(rendered_pictures, have_normals_in_the_axes_that_are_said_and_tell_where_others_would_fit) {
  const Camera camera = distorted();
  const Flat floor{{0.3, -0.4, -std::sqrt(0.75)}, -0.75};
  DrawnPictures drawn = draw(pinhole_for(camera), floor);
  add_normal(drawn, {floor.n[0], -floor.n[1], -floor.n[2]});  // OpenGL's: y up, z backward
  RenderedPictures pictures = drawn.pictures();
  const SampledPictures wrong = from_pictures(camera, pictures);
  EXPECT_TRUE(says(wrong, "normals do not fit z")) << "nobody is told of y that points the other way";
  EXPECT_TRUE(says(wrong, "OpenGL's (x right, y up, z backward) they would fit"));
  pictures.normal_axes = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  const SampledPictures right = from_pictures(camera, pictures);
  EXPECT_TRUE(right.notices.empty());
  EXPECT_LT(worst_angle(right.geometry, {floor.n}), 1e-6);
  EXPECT_LT(worst_z(camera, right.geometry, floor), 1e-5);
}

TEST(rendered_pictures, of_whole_millimetres_make_no_normals_and_say_so) {
  const Camera camera = distorted();
  DrawnPictures drawn = draw(pinhole_for(camera), turned_about_y(30, 1.5));
  EXPECT_TRUE(from_pictures(camera, drawn.pictures()).notices.empty());
  for (float& z : drawn.z) z = 0.001f * std::round(1000 * z);
  EXPECT_TRUE(says(from_pictures(camera, drawn.pictures()), "z is in whole millimetres"));
  add_normal(drawn, turned_about_y(30, 1.5).n);
  EXPECT_FALSE(says(from_pictures(camera, drawn.pictures()), "z is in whole millimetres")) << "it does not matter then";
}

TEST(rendered_pictures, in_millimetres_are_noticed) {
  const Camera camera = distorted();
  DrawnPictures drawn = draw(pinhole_for(camera), [](double x, double) { return x < 0 ? 90.0 : 1.5; });
  EXPECT_FALSE(says(from_pictures(camera, drawn.pictures()), "millimetres?"));
  for (float& z : drawn.z) z *= 1000;
  EXPECT_TRUE(says(from_pictures(camera, drawn.pictures()), "millimetres? expected metres"));
}

TEST(rendered_pictures, have_reflectivities_by_label_then_by_picture_and_a_notice_of_colour) {
  const Camera camera = distorted();
  const DrawnPictures drawn = draw(pinhole_for(camera), [](double, double) { return 1.0; });
  std::vector<std::int32_t> labels(drawn.z.size(), 7);
  for (std::size_t i = 0; i < labels.size(); i += 2) labels[i] = i % 4 == 0 ? 3 : 9;
  const std::vector<std::uint8_t> colour(3 * drawn.z.size(), 188);
  RenderedPictures pictures = drawn.pictures();
  Material gloss;
  gloss.brdf = Material::Brdf::phong, gloss.diffuse = 0.2, gloss.specular = 0.5, gloss.exponent = 30;
  pictures.labels = labels, pictures.screen_colour = colour, pictures.materials = {{9, gloss}, {3, load_material("skin")}};
  const SampledPictures sampled = from_pictures(camera, pictures);
  const Geometry& seen = sampled.geometry;
  for (std::size_t i = 0; i < seen.z_m.size(); ++i) {
    const std::int32_t label = seen.object_id[i];
    // 188 of 255: ((188/255 + 0.055)/1.055)^2.4 = 0.5029
    EXPECT_NEAR(seen.diffuse[i], label == 3 ? 0.603f : label == 9 ? 0.2f : 0.5029f, 1e-4f);
    EXPECT_EQ(seen.specular[i], label == 9 ? 0.5f : 0.0f);
    EXPECT_EQ(seen.exponent[i], label == 9 ? 30.0f : 1.0f);
  }
  EXPECT_TRUE(says(sampled, "visible colour stands for reflectivity in "));
  EXPECT_GT(std::count(seen.object_id.begin(), seen.object_id.end(), 7), 1000);
}

TEST(rendered_pictures, may_have_a_moment_for_each_raw_frame_and_say_what_one_alone_lacks) {
  const Camera camera = distorted();
  const std::size_t moments = camera.mode.sequence.size();
  DrawnPictures drawn{pinhole_for(camera), {}, {}};
  for (std::size_t k = 0; k < moments; ++k) {
    const DrawnPictures one = draw(drawn.pinhole, [&](double, double) { return 1.0 + 0.01 * static_cast<double>(k); });
    drawn.z.insert(drawn.z.end(), one.z.begin(), one.z.end());
  }
  RenderedPictures pictures = drawn.pictures();
  pictures.moments = static_cast<int>(moments), pictures.still = false;
  const SampledPictures sampled = from_pictures(camera, pictures);
  const std::size_t pixels = sampled.geometry.z_m.size() / moments;
  for (std::size_t k = 0; k < moments; ++k) EXPECT_FLOAT_EQ(sampled.geometry.z_m[k * pixels + 999], 1.0f + 0.01f * static_cast<float>(k));
  EXPECT_TRUE(sampled.notices.empty());
  const Frame frame = Simulator({}, camera, {.noise = Noise::off}).frame(0, sampled.geometry);
  EXPECT_GT(frame.truth.z_m[999], 1.01f);
  const DrawnPictures once = draw(drawn.pinhole, [](double, double) { return 1.0; });
  pictures.moments = 1, pictures.z_m = once.z;
  EXPECT_TRUE(says(from_pictures(camera, pictures), "one moment stands for all raw frames"));
}

TEST(rendered_pictures, that_cannot_be_are_refused_by_name) {
  const Camera camera = distorted();
  const DrawnPictures drawn = draw(pinhole_for(camera), [](double, double) { return 1.0; });
  const auto told = [&](const std::function<void(RenderedPictures&)>& change) {
    RenderedPictures pictures = drawn.pictures();
    change(pictures);
    return message_of([&] { (void)from_pictures(camera, pictures); });
  };
  const std::vector<float> few(5), bright(drawn.z.size(), 1.5f);
  const std::vector<std::int32_t> labels(drawn.z.size(), 7);
  EXPECT_NE(told([&](RenderedPictures& p) { p.z_m = few; }).find("pictures.z_m has the wrong size"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.normal = few; }).find("pictures.normal has the wrong size"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.pinhole.fx_px = 0; }).find("pinhole.fx_px is out of range"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.moments = 3; }).find("pictures.moments is 3"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.background_m = 0; }).find("background_m is 0"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.other_reflectivity = {}; }).find("pictures say nothing of reflectivity"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.labels = labels, p.other_reflectivity = {}; }).find("reflectivity of label 7"),
            std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.reflectivity = bright; }).find("a reflectivity is 1.5 at (column "), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.materials.emplace_back(); }).find("materials without labels"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) { p.normal_axes[0] = 2; }).find("normal_axes is no rotation"), std::string::npos);
  EXPECT_NE(told([&](RenderedPictures& p) {
              p.labels = labels, p.materials = {{7, load_material("retro-sheet")}};
            }).find("label 7 is neither"),
            std::string::npos);
  EXPECT_NE(message_of([] { (void)load_material("skni"); }).find("did you mean \"skin\"?"), std::string::npos);
}

TEST(pinhole_for, covers_all_rays_with_its_margin_and_no_more) {
  for (const char* profile : {"pico-flexx", "azure-kinect-nfov"}) {
    const Camera camera = load_camera(profile);
    const std::vector<float> rays = pixel_rays(camera);
    float x = 0, y = 0;
    for (std::size_t i = 0; i < rays.size(); i += 2)
      if (!std::isnan(rays[i])) x = std::max(x, std::abs(rays[i])), y = std::max(y, std::abs(rays[i + 1]));
    for (const double margin : {0.0, 2.0, 10.0}) {
      const Pinhole p = pinhole_for(camera, margin, 1);
      EXPECT_TRUE(p.cx_px == 0.5 * p.width && p.cy_px == 0.5 * p.height && p.fx_px == p.fy_px);
      const double spare_x = 0.5 * p.width - 0.5 - p.fx_px * static_cast<double>(x),
                   spare_y = 0.5 * p.height - 0.5 - p.fy_px * static_cast<double>(y);
      EXPECT_TRUE(spare_x >= margin && spare_x < margin + 1) << spare_x;
      EXPECT_TRUE(spare_y >= margin && spare_y < margin + 1) << spare_y;
    }
  }
  Camera fisheye = distorted();
  fisheye.lens.distortion = Lens::Distortion::fisheye, fisheye.lens.k1 = fisheye.lens.k2 = 0, fisheye.lens.fx_px = fisheye.lens.fy_px = 88;
  EXPECT_NE(message_of([&] { (void)pinhole_for(fisheye, 2, 20); }).find("no picture of a usable size"), std::string::npos);
}
