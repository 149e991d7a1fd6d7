// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/error.h"
#include "tofray/frame.h"

namespace out_test {

/// A folder of its own for each test, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tofray-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp");
    path_ = pattern;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  /// How many entries there are, hidden ones too.
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// Runs a Python program that uses numpy. @return its exit status, or nothing where there is no such interpreter
class Python {
 public:
  Python() : there_(std::system("/usr/bin/python3 -c 'import numpy' >/dev/null 2>&1") == 0) {}
  [[nodiscard]] bool there() const { return there_; }
  [[nodiscard]] bool has(const std::string& module) const {
    return std::system(("/usr/bin/python3 -c 'import " + module + "' >/dev/null 2>&1").c_str()) == 0;
  }
  /// Runs a script with one argument; what it says goes to the test's output.
  static int run(const std::string& script, const std::string& argument) {
    TemporaryFolder folder;
    write_file(folder.file("check.py"), script);
    const int status = std::system(("/usr/bin/python3 '" + folder.file("check.py") + "' '" + argument + "' 1>&2").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  bool there_;
};

/// What Error a call throws; a test failure where it throws none.
template <class Call>
tofray::Error error_of(const Call& call) {
  try {
    call();
  } catch (const tofray::Error& error) {
    return error;
  }
  ADD_FAILURE() << "no error was thrown";
  return {tofray::ErrorKind::bug, ""};
}

/// A small deterministic generator, so that the tests need no other part of the library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }
  /// About normal, variance 1: the sum of 12 uniforms.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(next() >> 11) * 0x1p-53;
    return sum;
  }

 private:
  std::uint64_t state_;
};

inline constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();

/// A camera with 1 + 4 + 4 raw frames.
inline tofray::Camera sample_camera(int width, int height) {
  tofray::Camera camera;
  camera.name = "sample";
  camera.sensor = {width, height, 12e-6, 0.8};
  camera.lens.fx_px = camera.lens.fy_px = 0.95 * width;
  camera.lens.cx_px = 0.5 * (width - 1);
  camera.lens.cy_px = 0.5 * (height - 1);
  camera.lens.k1 = -0.3;
  camera.illumination.resize(1);
  camera.mode.name = "MODE_9_5FPS_2000";
  camera.mode.frame_rate_hz = 5;
  camera.mode.sequence.push_back({false, 0, 0, 200e-6});
  for (const double f : {80.32e6, 60.24e6})
    for (int k = 0; k < 4; ++k) camera.mode.sequence.push_back({true, f, k * 1.5707963267948966, 2000e-6});
  return camera;
}

/// A ball in front of a wall with noise, a corner without return and a few flying pixels: every array is filled.
inline tofray::Frame sample_frame(int width, int height) {
  const tofray::Camera camera = sample_camera(width, height);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t phases = camera.mode.sequence.size();
  tofray::Frame frame;
  tofray::Raw& raw = frame.raw;
  tofray::Depth& depth = frame.depth;
  tofray::Truth& truth = frame.truth;
  raw.width = depth.width = truth.width = width;
  raw.height = depth.height = truth.height = height;
  raw.phases = truth.phases = static_cast<int>(phases);
  double time = 0;
  for (const tofray::RawFrame& exposure : camera.mode.sequence) {
    raw.modulation_frequency_hz.push_back(exposure.modulation_frequency_hz);
    raw.reference_phase_rad.push_back(exposure.reference_phase_rad);
    raw.integration_time_s.push_back(exposure.integration_time_s);
    raw.start_time_s.push_back(time);
    raw.lit.push_back(exposure.lit ? 1 : 0);
    time += exposure.integration_time_s + 1e-4;
  }
  truth.time_s = 0.5 * time;
  Random random(5);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double x = (static_cast<double>(i % static_cast<std::size_t>(width)) - camera.lens.cx_px) / camera.lens.fx_px;
    const double y = (static_cast<double>(i / static_cast<std::size_t>(width)) - camera.lens.cy_px) / camera.lens.fy_px;
    const double rr = (x - 0.1) * (x - 0.1) + y * y;
    const bool ball = rr < 0.04, none = x < -0.42 && y < -0.28;
    const double z = none ? std::nan("") : ball ? 1.3 - std::sqrt(0.0626 - 1.56 * rr) : 2.0 + 0.6 * x;
    const double ray = std::sqrt(1 + x * x + y * y);
    const double amplitude = none ? 0 : (ball ? 3000 : 5000) / (z * z) * (1 - 0.8 * (x * x + y * y));
    const double noise = none ? 0 : 4 / std::sqrt(amplitude + 100);
    const bool flying = std::abs(rr - 0.04) < 0.0015;
    const double measured = z + 0.1 * noise * random.normal() + 0.004 * std::sin(12 * z);
    const bool invalid = none || flying;
    const auto value = [&](double v) { return invalid ? nan_f : static_cast<float>(v); };
    depth.z_m.push_back(value(measured));
    depth.range_m.push_back(value(measured * ray));
    for (const double v : {x * measured, y * measured, measured}) depth.points_m.push_back(value(v));
    depth.amplitude_e.push_back(static_cast<float>(amplitude));
    depth.ambient_e.push_back(120.F);
    depth.noise_m.push_back(value(0.1 * noise));
    depth.confidence.push_back(static_cast<std::uint8_t>(invalid ? 0.0 : 255 - std::min(255.0, 2000 * noise)));
    depth.flags.push_back(static_cast<std::uint16_t>(none ? tofray::flag_no_return : flying ? tofray::flag_flying_pixel : 0));
    const auto true_value = [&](double v) { return none ? nan_f : static_cast<float>(v); };
    truth.z_m.push_back(true_value(z));
    truth.range_m.push_back(true_value(z * ray));
    truth.reflectivity.push_back(true_value(ball ? 0.4 : 0.85));
    for (const double v : {x * z, y * z, z}) truth.position_m.push_back(true_value(v));
    for (const double v : {0.0, 0.0, -1.0}) truth.normal.push_back(true_value(v));
    truth.object_id.push_back(none ? -1 : ball ? 1 : 0);
    truth.material_id.push_back(none ? -1 : 1 - truth.object_id.back());
    truth.class_id.push_back(none ? -1 : 0);
    truth.triangle_id.push_back(none || ball ? -1 : x > y);
    for (const double v : {x, y}) truth.texcoord.push_back(none || ball ? nan_f : static_cast<float>(v));
    for (const double v : {ball ? 0.5 : 0.0, 0.0, 0.0}) truth.velocity_m_per_s.push_back(true_value(v));
    for (const double v : {ball ? 3.5 : 0.0, 0.0}) truth.flow_px.push_back(true_value(v));
    truth.mixed.push_back(flying ? 1 : 0), truth.object_share.push_back(flying ? 0.6F : 1.F);
    truth.irradiance_w_m2.push_back(true_value(0.05 / (z * z)));
    truth.radiance_w_m2_sr.push_back(true_value(0.01 / (z * z)));
    truth.power_w.push_back(true_value(1e-12 / (z * z)));
    truth.ambient_e_per_s.push_back(none ? 0.F : 6e4F);
  }
  for (std::size_t k = 0; k < phases; ++k) {
    const double f = raw.modulation_frequency_hz[k];
    for (std::size_t i = 0; i < pixels; ++i) {
      const double z = truth.z_m[i], s = raw.lit[k] != 0 && z > 0 ? 2.0 * depth.amplitude_e[i] : 0;
      const double wave = s > 0 ? 0.7 * std::cos(6.283185307179586 * f * 2 * z / 299792458.0 - raw.reference_phase_rad[k]) : 0;
      raw.tap_a.push_back(static_cast<float>(0.5 * s * (1 + wave) + 60));
      raw.tap_b.push_back(static_cast<float>(0.5 * s * (1 - wave) + 60));
      raw.raw.push_back(static_cast<std::uint16_t>(2048 + (raw.tap_a.back() - raw.tap_b.back()) / 10 + random.normal()));
      truth.signal_e.push_back(static_cast<float>(s));
      truth.direct_e.push_back(static_cast<float>(0.75 * s)), truth.indirect_e.push_back(static_cast<float>(0.25 * s));
      truth.raw_dn.push_back(static_cast<float>(2048 + (raw.tap_a.back() - raw.tap_b.back()) / 10));
      truth.raw_direct_dn.push_back(truth.raw_dn.back() - 1.5F);
      for (const double v : {-0.5, 0.25}) truth.phase_flow_px.push_back(static_cast<float>(v));
      truth.multipath_m.push_back(raw.lit[k] != 0 ? 0.02F : std::nanf(""));
      truth.path_noise_m.push_back(raw.lit[k] != 0 ? 0.002F : std::nanf(""));
    }
  }
  depth.modulations = 1;
  depth.amplitude_by_frequency_e = depth.amplitude_e, depth.range_by_frequency_m = depth.range_m;
  depth.cycle_by_frequency.assign(pixels, 0);
  truth.path_count.assign(pixels, 16);
  truth.bins = 2;
  truth.transient_e_per_s.assign(2 * pixels, 3e6F), truth.transient_lost_e_per_s.assign(pixels, 1e3F);
  return frame;
}

}  // namespace out_test
