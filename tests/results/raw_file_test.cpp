// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raw_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "files/npz.h"
#include "results/frame_file.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using namespace tofray::results;
using out_test::error_of;
using out_test::TemporaryFolder;

namespace {

constexpr PoseMatrix identity = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// What is wrong with a file of these arrays; nothing: empty.
std::string fault_of(const std::vector<NpyView>& arrays) {
  try {
    (void)parse_raw_npz(npz_bytes(arrays), "x.npz");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(raw_file, round_trip_keeps_every_array) {
  TemporaryFolder folder;
  const Frame frame = out_test::sample_frame(12, 9);
  write_frame_npz(folder.file("frame.npz"), frame, out_test::sample_camera(12, 9), identity, "{}");
  const Raw back = read_raw_npz(folder.file("frame.npz"));
  EXPECT_EQ(back.width, 12);
  EXPECT_EQ(back.height, 9);
  EXPECT_EQ(back.phases, 9);
  EXPECT_EQ(back.raw, frame.raw.raw);
  EXPECT_EQ(back.tap_a, frame.raw.tap_a);
  EXPECT_EQ(back.tap_b, frame.raw.tap_b);
  EXPECT_EQ(back.modulation_frequency_hz, frame.raw.modulation_frequency_hz);
  EXPECT_EQ(back.reference_phase_rad, frame.raw.reference_phase_rad);
  EXPECT_EQ(back.integration_time_s, frame.raw.integration_time_s);
  EXPECT_EQ(back.start_time_s, frame.raw.start_time_s);
  EXPECT_EQ(back.lit, frame.raw.lit);
}

TEST(raw_file, says_everything_that_is_missing_or_misshapen_at_once) {
  TemporaryFolder folder;
  const std::vector<std::uint16_t> raw(2 * 3 * 4, 2048);
  const std::vector<double> two = {80e6, 80e6}, three = {1, 2, 3};
  const std::vector<float> tap(24, 1.F);
  out_test::write_file(folder.file("x.npz"),
                       npz_bytes({npy_view("raw", {2, 3, 4}, raw), npy_view("tap_a", {2, 4, 3}, tap), npy_view("lit", {2}, two),
                                  npy_view("modulation_frequency_hz", {3}, three), npy_view("integration_time_s", {2}, two)}));
  const Error error = error_of([&] { (void)read_raw_npz(folder.file("x.npz")); });
  EXPECT_EQ(error.kind(), ErrorKind::bad_input);
  const std::string text = error.what();
  for (const char* part :
       {"array \"tap_a\" has the wrong shape\n  got (2, 4, 3), expected (2, 3, 4)", "array \"tap_b\" is missing",
        "array \"lit\" has the wrong type", "array \"modulation_frequency_hz\" has the wrong shape\n  got (3,), expected (2,)",
        "array \"reference_phase_rad\" is missing"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
  EXPECT_EQ(text.find("start_time_s"), std::string::npos) << text;
  out_test::write_file(folder.file("y.npz"),
                       npz_bytes({npy_view("lit", {2}, raw.size() == 24 ? std::vector<std::uint8_t>{1, 1} : std::vector<std::uint8_t>{})}));
  EXPECT_NE(std::string(error_of([&] { (void)read_raw_npz(folder.file("y.npz")); }).what()).find("expected raw, or tap_a and tap_b"),
            std::string::npos);
}

TEST(raw_file, start_times_may_be_missing_but_not_be_of_another_length) {
  const std::vector<std::uint16_t> raw(2 * 3 * 4, 2048);
  const std::vector<double> f = {80e6, 80e6}, tau = {0, 1}, time = {1e-3, 1e-3}, three = {0, 1, 2};
  const std::vector<std::uint8_t> lit = {1, 1};
  std::vector<NpyView> views = {npy_view("raw", {2, 3, 4}, raw), npy_view("modulation_frequency_hz", {2}, f),
                                npy_view("reference_phase_rad", {2}, tau), npy_view("integration_time_s", {2}, time),
                                npy_view("lit", {2}, lit)};
  EXPECT_TRUE(parse_raw_npz(npz_bytes(views), "x.npz").start_time_s.empty());
  views.push_back(npy_view("start_time_s", {3}, three));
  EXPECT_NE(
      std::string(error_of([&] { (void)parse_raw_npz(npz_bytes(views), "x.npz"); }).what()).find("\"start_time_s\" has the wrong shape"),
      std::string::npos);
}

TEST(raw_file, wider_integers_are_taken_where_they_fit) {
  TemporaryFolder folder;
  const std::vector<double> f = {80e6}, tau = {0}, time = {1e-3};
  const std::vector<std::uint8_t> lit = {1};
  for (const std::int32_t code : {65535, 65536, -1}) {
    const std::vector<std::int32_t> raw = {1, 2, 3, code};
    out_test::write_file(
        folder.file("x.npz"),
        npz_bytes({npy_view("raw", {1, 2, 2}, raw), npy_view("modulation_frequency_hz", {1}, f), npy_view("reference_phase_rad", {1}, tau),
                   npy_view("integration_time_s", {1}, time), npy_view("start_time_s", {1}, tau), npy_view("lit", {1}, lit)}));
    if (code == 65535)
      EXPECT_EQ(read_raw_npz(folder.file("x.npz")).raw, (std::vector<std::uint16_t>{1, 2, 3, 65535}));
    else
      EXPECT_NE(std::string(error_of([&] { (void)read_raw_npz(folder.file("x.npz")); }).what()).find("no uint16"), std::string::npos);
  }
}

TEST(raw_file, of_one_row_and_of_one_column_is_one) {
  const std::vector<double> f = {80e6}, tau = {0}, time = {1e-3};
  const std::vector<std::uint8_t> lit = {1};
  const std::vector<std::uint16_t> raw = {1, 2, 3};
  for (const bool row : {true, false}) {
    const Raw back = parse_raw_npz(
        npz_bytes({npy_view("raw", row ? NpyShape{1, 1, 3} : NpyShape{1, 3, 1}, raw), npy_view("modulation_frequency_hz", {1}, f),
                   npy_view("reference_phase_rad", {1}, tau), npy_view("integration_time_s", {1}, time), npy_view("lit", {1}, lit)}),
        "x.npz");
    EXPECT_EQ(back.width, row ? 3 : 1);
    EXPECT_EQ(back.height, row ? 1 : 3);
    EXPECT_EQ(back.raw, raw);
  }
}

TEST(raw_file, needs_a_frequency_of_each_lit_raw_frame_and_a_time_of_each) {
  const std::vector<std::uint16_t> raw(3 * 2, 2048);
  const std::vector<double> tau = {0, 0, 0};
  const auto said = [&](const std::vector<std::uint8_t>& lit, const std::vector<double>& f,
                        const std::vector<double>& time) -> std::string {
    return fault_of({npy_view("raw", {3, 1, 2}, raw), npy_view("modulation_frequency_hz", {3}, f),
                     npy_view("reference_phase_rad", {3}, tau), npy_view("integration_time_s", {3}, time), npy_view("lit", {3}, lit)});
  };
  EXPECT_EQ(said({1, 0, 1}, {8e7, 0, 6e7}, {1e-3, 1e-3, 1e-3}), "");
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> f(3, 8e7), time(3, 1e-3);
    f[k] = 0;
    const std::string number = "raw frame " + std::to_string(k);
    EXPECT_NE(said({1, 1, 1}, f, time).find(number + " is lit and has no modulation frequency"), std::string::npos)
        << said({1, 1, 1}, f, time);
    f[k] = 8e7, time[k] = 0;
    EXPECT_NE(said({1, 0, 1}, f, time).find(number + " has no integration time"), std::string::npos) << said({1, 0, 1}, f, time);
  }
}

TEST(raw_file, of_megahertz_or_of_turned_axes_says_so) {
  const auto said = [](const NpyShape& shape, double f) -> std::string {
    const std::vector<std::uint16_t> raw(24, 2048);
    const std::vector<double> fs = {0, f}, tau = {0, 0}, times = {1e-3, 1e-3};
    const std::vector<std::uint8_t> lit = {0, 1};
    return fault_of({npy_view("raw", shape, raw), npy_view("modulation_frequency_hz", {2}, fs), npy_view("reference_phase_rad", {2}, tau),
                     npy_view("integration_time_s", {2}, times), npy_view("lit", {2}, lit)});
  };
  EXPECT_EQ(said({2, 3, 4}, 80.32e6), "");
  EXPECT_EQ(said({2, 3, 4}, 80.32),
            "x.npz: error: array \"modulation_frequency_hz\" has 80.32 Hz for raw frame 1\n"
            "  expected hertz, 1000 or more; are these megahertz? Then multiply them by 1e6");
  EXPECT_EQ(said({3, 4, 2}, 80.32e6),
            "x.npz: error: array \"raw\": got (3, 4, 2); its last axis are the 2 raw frames: np.moveaxis(raw, -1, 0)\n"
            "  expected (2, 3, 4); the arrays by raw frame have 2 values each");
  EXPECT_NE(said({3, 2, 4}, 80.32e6).find("got (3, 2, 4); its middle axis are the 2 raw frames: np.moveaxis(raw, 1, 0)"),
            std::string::npos);
}

// One fault, at the array that is wrong: those by raw frame are right, whichever of them are there.
TEST(raw_file, with_raw_frames_last_has_one_fault_besides_what_is_missing) {
  const std::vector<std::uint16_t> raw(24 * 32 * 4, 2048);
  const std::vector<double> f(4, 80e6), tau = {0, 1.57, 3.14, 4.71}, times(4, 1e-3);
  const std::string said = fault_of({npy_view("raw", {24, 32, 4}, raw), npy_view("modulation_frequency_hz", {4}, f),
                                     npy_view("reference_phase_rad", {4}, tau), npy_view("integration_time_s", {4}, times)});
  EXPECT_NE(said.find("got (24, 32, 4); its last axis are the 4 raw frames: np.moveaxis(raw, -1, 0)"), std::string::npos) << said;
  EXPECT_NE(said.find("array \"lit\" is missing"), std::string::npos) << said;
  EXPECT_EQ(said.find("modulation_frequency_hz\""), std::string::npos) << said;
}

TEST(raw_file, of_differences_says_how_they_become_codes_or_taps) {
  const std::vector<double> f(2, 80e6), tau = {0, 1.57}, times(2, 1e-3);
  const std::vector<std::uint8_t> lit = {1, 1};
  const auto said = [&](const NpyView& raw) {
    return fault_of({raw, npy_view("modulation_frequency_hz", {2}, f), npy_view("reference_phase_rad", {2}, tau),
                     npy_view("integration_time_s", {2}, times), npy_view("lit", {2}, lit)});
  };
  const std::string help =
      "\n  differences A-B of the taps? Add mid_code (adc.mid_code of the camera) and write uint16, or give tap_a and tap_b";
  const std::vector<std::int16_t> whole = {5, -3};
  EXPECT_EQ(said(npy_view("raw", {2, 1, 1}, whole)),
            "x.npz: error: array \"raw\" has a code that is no uint16\n  got -3, expected 0 to 65535" + help);
  const std::vector<float> floating = {5, 3};
  EXPECT_EQ(
      said(npy_view("raw", {2, 1, 1}, floating)),
      "x.npz: error: array \"raw\" has the wrong type\n  got float32, expected uint16 codes of the ADC, (phase, height, width)" + help);
}

TEST(raw_file, of_degrees_is_told_at_the_phases) {
  const std::vector<std::uint16_t> raw(4, 2048);
  const std::vector<double> f(4, 80e6), tau = {0, 90, 180, 270}, times(4, 1e-3);
  const std::vector<std::uint8_t> lit(4, 1);
  EXPECT_EQ(fault_of({npy_view("raw", {4, 1, 1}, raw), npy_view("modulation_frequency_hz", {4}, f),
                      npy_view("reference_phase_rad", {4}, tau), npy_view("integration_time_s", {4}, times), npy_view("lit", {4}, lit)}),
            "x.npz: error: array \"reference_phase_rad\" has 90 rad for raw frame 1\n"
            "  expected radians; are these degrees? np.deg2rad(reference_phase_rad) turns them into radians");
}

TEST(raw_file, of_a_shape_or_with_numbers_that_make_no_sense_says_so) {
  const auto said = [](const NpyShape& shape, double phase, double time) -> std::string {
    std::size_t count = 1;
    for (const std::size_t extent : shape) count *= extent;
    const std::vector<std::uint16_t> raw(count, 2048);
    const std::vector<double> f = {8e7, 8e7}, tau = {0, phase}, times = {1e-3, time};
    const std::vector<std::uint8_t> lit = {1, 1};
    return fault_of({npy_view("raw", shape, raw), npy_view("modulation_frequency_hz", {2}, f), npy_view("reference_phase_rad", {2}, tau),
                     npy_view("integration_time_s", {2}, times), npy_view("lit", {2}, lit)});
  };
  EXPECT_EQ(said({2, 3, 4}, 1, 1e-3), "");
  for (const NpyShape& shape : {NpyShape{0, 3, 4}, {2, 0, 4}, {2, 3, 0}, {3, 4}, {2, 3, 4, 1}, {24}})
    EXPECT_NE(said(shape, 1, 1e-3).find("array \"raw\" has the wrong shape\n  got ("), std::string::npos) << said(shape, 1, 1e-3);
  const double nan = std::nan("");
  EXPECT_NE(said({2, 3, 4}, nan, 1e-3)
                .find("array \"reference_phase_rad\" has a value that makes no sense\n  got nan for raw frame 1, expected a finite number"),
            std::string::npos);
  EXPECT_EQ(said({2, 3, 4}, nan, 1e-3).find("0 or more"), std::string::npos);
  EXPECT_EQ(said({2, 3, 4}, -1, 1e-3), "");
  EXPECT_NE(
      said({2, 3, 4}, 1, -1e-3)
          .find(
              "\"integration_time_s\" has a value that makes no sense\n  got -0.001 for raw frame 1, expected a finite number, 0 or more"),
      std::string::npos);
}
