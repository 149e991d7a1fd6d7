// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Calibrations of other software: each pixel's ray, through the equations of that software, comes back to the pixel.
#include "load/lens_calibration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "support/text.h"
#include "tofray/load.h"
#include "tofray/simulator.h"

using namespace tofray;
using namespace tofray::load;
using namespace tofray::test;

namespace {

using Projection = std::function<std::array<double, 2>(double x, double y)>;  // of the ray (x, y, 1), in pixels

/// OpenCV's calib3d: plumb bob and rational.
Projection opencv(double fx, double fy, double cx, double cy, std::array<double, 8> d) {
  return [=](double x, double y) -> std::array<double, 2> {
    const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
    const double radial = (1 + d[0] * r2 + d[1] * r4 + d[4] * r6) / (1 + d[5] * r2 + d[6] * r4 + d[7] * r6);
    return {fx * (x * radial + 2 * d[2] * x * y + d[3] * (r2 + 2 * x * x)) + cx,
            fy * (y * radial + d[2] * (r2 + 2 * y * y) + 2 * d[3] * x * y) + cy};
  };
}

/// OpenCV's fisheye, ROS's equidistant.
Projection fisheye(double fx, double fy, double cx, double cy, std::array<double, 4> k) {
  return [=](double x, double y) -> std::array<double, 2> {
    const double r = std::hypot(x, y), t = std::atan(r), t2 = t * t;
    const double bent = t * (1 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3])))), scale = r > 0 ? bent / r : 1;
    return {fx * x * scale + cx, fy * y * scale + cy};
  };
}

/// Whether each pixel's ray of a profile with the calibration goes back to the pixel.
void expect_rays_meet_their_pixels(const std::string& text, const std::string& profile, const Projection& project) {
  const LensCalibration calibration = lens_calibration(text, "cal.yaml", sensor_of(profile));
  const Camera camera = load_camera_text(profile_with_lens(profile, calibration, "cal.yaml"), "mycam.yaml");
  const std::vector<float> rays = pixel_rays(camera);
  double worst = 0;
  int seen = 0;
  for (int v = 0; v < camera.sensor.height; ++v) {
    for (int u = 0; u < camera.sensor.width; ++u) {
      const float* const ray = &rays[2 * static_cast<std::size_t>(v * camera.sensor.width + u)];
      if (std::isnan(ray[0])) continue;
      const auto [x, y] = project(static_cast<double>(ray[0]), static_cast<double>(ray[1]));
      worst = std::max({worst, std::abs(x - u), std::abs(y - v)}), ++seen;
    }
  }
  EXPECT_LT(worst, 2e-4) << text;  // 2⁻²⁴ of a ray is 4e-5 px, and the inverse stops at 1e-4
  EXPECT_GT(seen, camera.sensor.width * camera.sensor.height / 2);
}

std::string calibration_refusal(const std::string& text, std::optional<PixelGrid> wanted = {}) {
  try {
    (void)lens_calibration(text, "cal.yaml", wanted);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

const std::string matrix = "[ 2.1150000000000000e+02, 0., 1.1275e+02, 0., 2.1225e+02, 8.45e+01, 0., 0., 1. ]";

/// As cv::FileStorage writes it, with OpenCV's sample's names.
std::string file_storage(const std::string& coefficients, int count, const std::string& more = "") {
  return "%YAML:1.0\n---\ncalibration_time: \"Fri Nov 27 2026\"\nimage_width: 224\nimage_height: 172\nflags: 0\n" + more +
         "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: " + matrix +
         "\ndistortion_coefficients: !!opencv-matrix\n   rows: " + std::to_string(count) + "\n   cols: 1\n   dt: d\n   data: [ " +
         coefficients + " ]\navg_reprojection_error: 2.5e-01\n";
}

std::string camera_info(const std::string& model, const std::string& coefficients, int count) {
  return "image_width: 224\nimage_height: 172\ncamera_name: tof\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [211.5, 0.0, 112.75, 0.0, "
         "212.25, 84.5, "
         "0.0, 0.0, 1.0]\ndistortion_model: " +
         model + "\ndistortion_coefficients:\n  rows: 1\n  cols: " + std::to_string(count) + "\n  data: [" + coefficients +
         "]\nrectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]\n";
}

const std::string kinect =
    R"({"CalibrationInformation":{"Cameras":[{"Intrinsics":{"ModelParameterCount":14,"ModelParameters":[0.47,0.63,0.6,0.61,0.1,0,0,0,0,0,0,0,0,0],)"
    R"("ModelType":"CALIBRATION_LensDistortionModelBrownConrady"},"Location":"CALIBRATION_CameraLocationPV0","SensorHeight":3072,"SensorWidth":4096},)"
    R"({"Intrinsics":{"ModelParameterCount":14,"ModelParameters":[0.51,0.515,0.4925,0.4926,5.5,3.5,0.18,5.8,5.3,0.95,0,0,-7.25E-5,2.125E-5],)"
    R"("ModelType":"CALIBRATION_LensDistortionModelBrownConrady"},"Location":"CALIBRATION_CameraLocationD0","SensorHeight":1024,"SensorWidth":1024}]}})";

}  // namespace

TEST(calibration_file, of_opencv_gives_the_rays_of_its_equations) {
  const auto expect = [](const std::string& text, std::array<double, 8> d) {
    expect_rays_meet_their_pixels(text, "pico-flexx", opencv(211.5, 212.25, 112.75, 84.5, d));
  };
  expect(file_storage("-2.5e-01, 1.0e-01, 1.5e-03, -7.5e-04", 4), {-0.25, 0.1, 1.5e-3, -7.5e-4, 0});
  expect(file_storage("-2.5e-01, 1.0e-01, 1.5e-03, -7.5e-04, 2.0e-02", 5), {-0.25, 0.1, 1.5e-3, -7.5e-4, 0.02});
  expect(file_storage("2.5e-01, 1.e-01, 1.5e-03, -7.5e-04, 2.e-02, 4.e-01, 5.e-02, -1.e-02", 8),
         {0.25, 0.1, 1.5e-3, -7.5e-4, 0.02, 0.4, 0.05, -0.01});
  // Thin prism and tilt that are 0 are none.
  expect(file_storage("-2.5e-01, 1.e-01, 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0.", 14), {-0.25, 0.1});
  expect_rays_meet_their_pixels(file_storage("-5.e-02, 1.e-02, -3.e-03, 1.e-04", 4, "fisheye_model: 1\n"), "pico-flexx",
                                fisheye(211.5, 212.25, 112.75, 84.5, {-0.05, 0.01, -0.003, 1e-4}));
  // JSON of FileStorage, names of one's own habit, no size.
  expect(
      R"({"K": {"type_id": "opencv-matrix", "rows": 3, "cols": 3, "dt": "d", "data": [211.5, 0.0, 112.75, 0.0, 212.25, 84.5, 0.0, 0.0, 1.0]},
"D": {"type_id": "opencv-matrix", "rows": 1, "cols": 5, "dt": "d", "data": [-0.25, 0.1, 0.0015, -0.00075, 0.02]}})",
      {-0.25, 0.1, 1.5e-3, -7.5e-4, 0.02});
}

TEST(calibration_file, of_ros_gives_the_rays_of_its_equations) {
  expect_rays_meet_their_pixels(camera_info("plumb_bob", "-0.25, 0.1, 0.0015, -0.00075, 0.02", 5), "pico-flexx",
                                opencv(211.5, 212.25, 112.75, 84.5, {-0.25, 0.1, 1.5e-3, -7.5e-4, 0.02}));
  expect_rays_meet_their_pixels(camera_info("rational_polynomial", "0.25, 0.1, 0.0015, -0.00075, 0.02, 0.4, 0.05, -0.01", 8), "pico-flexx",
                                opencv(211.5, 212.25, 112.75, 84.5, {0.25, 0.1, 1.5e-3, -7.5e-4, 0.02, 0.4, 0.05, -0.01}));
  expect_rays_meet_their_pixels(camera_info("equidistant", "-0.05, 0.01, -0.003, 0.0001", 4), "pico-flexx",
                                fisheye(211.5, 212.25, 112.75, 84.5, {-0.05, 0.01, -0.003, 1e-4}));
  // What `ros2 topic echo` and `rostopic echo` print.
  for (const bool second : {false, true}) {
    const std::string k = second ? "k:\n- 211.5\n- 0.0\n- 112.75\n- 0.0\n- 212.25\n- 84.5\n- 0.0\n- 0.0\n- 1.0\n"
                                 : "K: [211.5, 0.0, 112.75, 0.0, 212.25, 84.5, 0.0, 0.0, 1.0]\n";
    const std::string d = second ? "d:\n- -0.25\n- 0.1\n- 0.0015\n- -0.00075\n- 0.02\n" : "D: [-0.25, 0.1, 0.0015, -0.00075, 0.02]\n";
    expect_rays_meet_their_pixels(
        "header:\n  stamp:\n    sec: 1\n  frame_id: tof\nheight: 172\nwidth: 224\ndistortion_model: plumb_bob\n" + d + k +
            "binning_x: 0\nbinning_y: 0\nroi:\n  x_offset: 0\n  y_offset: 0\n  height: 0\n  width: 0\n  do_rectify: false\n---\n",
        "pico-flexx", opencv(211.5, 212.25, 112.75, 84.5, {-0.25, 0.1, 1.5e-3, -7.5e-4, 0.02}));
  }
}

// Shares of the sensor from the corner of its first pixel: pixel = share·1024 − crop − ½, and half as many pixels where they are binned.
TEST(calibration_file, of_an_azure_kinect_gives_the_rays_of_its_depth_camera) {
  const std::array<double, 8> d = {5.5, 3.5, 2.125e-5, -7.25e-5, 0.18, 5.8, 5.3, 0.95};
  const auto shares = opencv(0.4925, 0.4926, 0.51, 0.515, d);
  const auto expect = [&](const char* profile, double whole, double crop_x, double crop_y) {
    expect_rays_meet_their_pixels(kinect, profile, [=](double x, double y) -> std::array<double, 2> {
      const auto share = shares(x, y);
      return {share[0] * whole - crop_x - 0.5, share[1] * whole - crop_y - 0.5};
    });
  };
  expect("azure-kinect-nfov", 1024, 192, 180);
  expect("azure-kinect-nfov-binned", 512, 96, 90);
  EXPECT_TRUE(has(calibration_refusal(kinect), "an Azure Kinect's depth camera has images of several sizes\n  expected --camera"));
  EXPECT_TRUE(has(calibration_refusal(kinect, PixelGrid{224, 172}), "has no images of 224 x 172 pixels"));
}

TEST(calibration_file, that_does_not_fit_is_refused_by_name) {
  const std::string five = "-2.5e-01, 1.0e-01, 1.5e-03, -7.5e-04, 2.0e-02";
  EXPECT_EQ(calibration_refusal(file_storage(five, 5), PixelGrid{640, 576}),
            "cal.yaml: error: the calibration is of images of 224 x 172 pixels, the camera's sensor has 640 x 576\n"
            "  expected one size: calibrate with images of the sensor's size, or change sensor.width and sensor.height of the profile");
  EXPECT_TRUE(has(calibration_refusal(file_storage("0., 0., 0., 0., 0., 0., 0., 0., 1.e-3, 0., 0., 0.", 12)),
                  "has no thin prism (s1, s2, s3, s4)"));
  EXPECT_TRUE(has(calibration_refusal(file_storage("0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 0., 1.e-3", 14)),
                  "has no tilted sensor (tau_x, tau_y)"));
  EXPECT_TRUE(has(calibration_refusal(file_storage("0., 0., 0.", 3)),
                  "cal.yaml:13:4: error: no model of OpenCV has so many coefficients of distortion"))
      << calibration_refusal(file_storage("0., 0., 0.", 3));
  EXPECT_TRUE(has(calibration_refusal(camera_info("double_sphere", "0.1, 0.2", 2)),
                  "no distortion model \"double_sphere\"\n  expected plumb_bob, rational_polynomial or equidistant"));
  EXPECT_TRUE(has(calibration_refusal(camera_info("plumb_bob", "0.1, .nan, 0, 0, 0", 5)), "this is no number"));
  EXPECT_TRUE(has(calibration_refusal("K: [200, 3, 100, 0, 200, 80, 0, 0, 1]\nD: []\n"), "has a skew of 3 px"));
  EXPECT_TRUE(has(calibration_refusal("K: [200, 0, 900, 0, 200, 80, 0, 0, 1]\nD: []\n", PixelGrid{224, 172}),
                  "lies beside the image of 224 x 172 pixels"));
  EXPECT_TRUE(has(calibration_refusal("K: [200, 0, 100, 0, 200, 80, 0, 0, 1]\n"), "cal.yaml: error: no distortion\n  expected"));
  EXPECT_TRUE(
      has(calibration_refusal("image_size: [1e99, 2]\nK: [200, 0, 100, 0, 200, 80, 0, 0, 1]\nD: []\n"), "this is no size of an image"));
  EXPECT_TRUE(has(calibration_refusal("width: 3\n"), "cal.yaml: error: no camera matrix\n  expected"));
  EXPECT_TRUE(has(calibration_refusal("<?xml version=\"1.0\"?>\n<opencv_storage>"), "this is XML\n  expected YAML or JSON"));
  EXPECT_TRUE(has(calibration_refusal("K: [200, 0, 100, 0, 200, 80, 0, 0, 1]\nD: []\nbinning_x: 2\n"), "these images are binned"));
  EXPECT_TRUE(has(calibration_refusal("M1: [200, 0, 100, 0, 200, 80, 0, 0, 1]\nD1: []\nM2: [200, 0, 100, 0, 200, 80, 0, 0, 1]\nD2: []\n"),
                  "two cameras"));
  std::string other = kinect;
  other.replace(other.rfind("BrownConrady"), 12, "Rational6KT");
  EXPECT_TRUE(has(calibration_refusal(other, PixelGrid{640, 576}), "no distortion model \"CALIBRATION_LensDistortionModelRational6KT\""));
}

// Cut anywhere, a file is read or refused, and nothing else.
TEST(calibration_file, that_is_cut_is_refused_or_read) {
  for (const std::string& text :
       {kinect, file_storage("-2.5e-01, 1.0e-01, 1.5e-03, -7.5e-04", 4), camera_info("plumb_bob", "0, 0, 0, 0, 0", 5)})
    for (std::size_t size = 0; size < text.size(); ++size)
      EXPECT_NO_FATAL_FAILURE((void)calibration_refusal(text.substr(0, size), PixelGrid{640, 576}));
}

TEST(calibration_file, keeps_what_else_a_profile_says) {
  const LensCalibration lens = lens_calibration(file_storage("-2.5e-01, 1.0e-01, 1.5e-03, -7.5e-04", 4), "cal.yaml", PixelGrid{224, 172});
  Camera before = load_camera("pico-flexx"), after = load_camera_text(profile_with_lens("pico-flexx", lens, "cal.yaml"), "mycam.yaml");
  EXPECT_EQ(after.lens.fx_px, 211.5);
  EXPECT_EQ(after.lens.f_number, before.lens.f_number);
  EXPECT_EQ(after.lens.transmission, before.lens.transmission);
  EXPECT_EQ(after.mode_names, before.mode_names);
  EXPECT_EQ(after.pixel.read_noise_e, before.pixel.read_noise_e);
  EXPECT_EQ(after.illumination.size(), before.illumination.size());
}
