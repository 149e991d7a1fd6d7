// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// decoding.calibration: exact, none, or a file, which says of its faults where in it they are.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "files/npy.h"
#include "tofray/tofray.h"

using namespace tofray;

namespace {

using Kind = DecoderCalibration::Kind;

/// A folder with a file of a pico flexx's specimen.
class SpecimenFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("tofray_specimen_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
    std::filesystem::current_path(folder_);
    write("cal.yaml",
          "reference: 31 degC\nsource: bench 7\nfrequencies:\n  - modulation_frequency: 80.32 MHz\n    phase_offset: 0.25 rad\n"
          "    drift: 0.5 mm/K\n    wiggling: {cos: [0 rad, 0.01 rad], sin: [0.002 rad, 0 rad]}\n    pixel_phase: eighty.npy\n"
          "  - modulation_frequency: 60.24 MHz\n");
    std::string phases = files::npy_header({'f', 4}, {172, 224});
    for (int i = 0; i < 172 * 224; ++i) {
      const float value = 1e-6F * static_cast<float>(i);
      phases.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    write("eighty.npy", phases);
  }
  void TearDown() override {
    std::filesystem::current_path("/");
    std::filesystem::remove_all(folder_);
  }
  static void write(const std::string& name, const std::string& text) { std::ofstream(name, std::ios::binary) << text; }
  static Camera camera(const std::string& value) { return load_camera("pico-flexx", {"", {{"decoding.calibration", value}}, {}}); }
  static std::string refusal_of(const std::string& value) {
    try {
      (void)camera(value);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_F(SpecimenFile, is_exact_unless_something_else_is_said) {
  EXPECT_EQ(load_camera("pico-flexx").decoding.calibration.kind, Kind::exact);
  EXPECT_EQ(camera("exact").decoding.calibration.kind, Kind::exact);
  EXPECT_EQ(camera("none").decoding.calibration.kind, Kind::none);
  EXPECT_EQ(camera("{kind: none}").decoding.calibration.kind, Kind::none);
}

TEST_F(SpecimenFile, has_what_it_says) {
  const DecoderCalibration known = camera("cal.yaml").decoding.calibration;
  EXPECT_EQ(known.kind, Kind::specimen);
  EXPECT_EQ(known.reference_celsius, 31);
  ASSERT_EQ(known.frequencies.size(), 2U);
  const FrequencyCalibration& first = known.frequencies[0];
  EXPECT_EQ(first.modulation_frequency_hz, 80.32e6);
  EXPECT_EQ(first.phase_offset_rad, 0.25);
  EXPECT_EQ(first.drift_m_per_kelvin, 0.5e-3);
  EXPECT_EQ(first.wiggling_cos_rad, (std::vector<double>{0, 0.01}));
  EXPECT_EQ(first.wiggling_sin_rad, (std::vector<double>{0.002, 0}));
  ASSERT_EQ(first.pixel_phase_rad.size(), 172U * 224);
  EXPECT_EQ(first.pixel_phase_rad[1000], static_cast<double>(1e-6F * 1000.0F));
  EXPECT_TRUE(known.frequencies[1].pixel_phase_rad.empty());
}

// A profile names files beside it; one mode may have a calibration of its own.
TEST_F(SpecimenFile, is_named_by_a_profile_and_by_a_mode) {
  const ProfileFile profile = profile_file("pico-flexx");
  write("own.yaml", profile.text + "\n");
  EXPECT_EQ(load_camera("own.yaml", {"", {{"decoding.calibration", "cal.yaml"}}, {}}).decoding.calibration.reference_celsius, 31);
  const std::string first = load_camera("pico-flexx").mode.name;
  const Camera of_mode = load_camera("own.yaml", {first, {{"modes." + first + ".decoding", "{calibration: none}"}}, {}});
  EXPECT_EQ(of_mode.decoding.calibration.kind, Kind::none);
}

TEST_F(SpecimenFile, that_is_wrong_is_refused_by_file_and_place) {
  const std::string missing = refusal_of("cla.yaml");
  EXPECT_TRUE(says(missing, "\"cla.yaml\" is no calibration")) << missing;
  EXPECT_TRUE(says(missing, "expected exact, none, or a specimen's file")) << missing;
  EXPECT_TRUE(says(refusal_of("nnoe"), "did you mean \"none\"?")) << refusal_of("nnoe");
  write("lens.yaml", "camera_matrix: [1, 2]\n");
  EXPECT_TRUE(says(refusal_of("lens.yaml"), "lens.yaml:1:1: error: this is no calibration of a specimen")) << refusal_of("lens.yaml");
  write("typo.yaml", "frequencies:\n  - modulation_frequency: 80.32 MHz\n    phase_ofset: 1 rad\n  - modulation_frequency: 60.24 MHz\n");
  EXPECT_TRUE(says(refusal_of("typo.yaml"), "typo.yaml:3:5: error: unknown key \"phase_ofset\"")) << refusal_of("typo.yaml");
  write("one.yaml", "frequencies:\n  - modulation_frequency: 80.32 MHz\n");
  EXPECT_TRUE(says(refusal_of("one.yaml"), "one.yaml:2:3: error: the calibration has no 60.24 MHz")) << refusal_of("one.yaml");
  write("steep.yaml", "frequencies:\n  - modulation_frequency: 80.32 MHz\n    wiggling: {cos: [1 rad, 1 rad], sin: [0 rad, 0 rad]}\n");
  EXPECT_TRUE(says(refusal_of("steep.yaml"), "steep.yaml:3:")) << refusal_of("steep.yaml");
  write("far.yaml", "frequencies:\n  - modulation_frequency: 80.32 MHz\n    pixel_phase: ../eighty.npy\n");
  EXPECT_TRUE(says(refusal_of("far.yaml"), "far.yaml:3:18")) << refusal_of("far.yaml");
  write("flat.npy", files::npy_header({'f', 4}, {4}) + std::string(16, '\0'));
  write("shape.yaml", "frequencies:\n  - modulation_frequency: 80.32 MHz\n    pixel_phase: flat.npy\n");
  EXPECT_TRUE(says(refusal_of("shape.yaml"), "shape.yaml:3:18: error: these are no phases of pixels\n  got float32 of shape (4,)"))
      << refusal_of("shape.yaml");
  write("small.npy", files::npy_header({'f', 4}, {2, 2}) + std::string(16, '\0'));
  write("size.yaml",
        "frequencies:\n  - modulation_frequency: 80.32 MHz\n    pixel_phase: small.npy\n  - modulation_frequency: 60.24 MHz\n");
  EXPECT_TRUE(says(refusal_of("size.yaml"), "size.yaml:3:18: error: the pixels' phases at 80.32 MHz are of another image\n  got 4 of them"))
      << refusal_of("size.yaml");
}
