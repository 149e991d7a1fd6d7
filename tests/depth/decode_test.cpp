// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "depth/decode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "support/bench.h"

using namespace tofray;
using namespace tofray::test;

namespace {

Camera two_frequencies() {
  Camera camera = bench_camera({80.32e6, 60.24e6}, 4, 0.7, true);
  camera.pixel.read_noise_e = 30;
  return camera;
}

int flags_of(const Bench& bench, const Incoming& in) { return bench.measure(in).depth.flags; }

}  // namespace

// Beyond the range it wraps, unnoticed: d mod c/2f.
TEST(range, wraps_at_the_unambiguous_range) {
  for (const auto& frequencies : {std::vector<double>{20e6}, {80.32e6}, {80.32e6, 60.24e6}}) {
    const Bench bench(bench_camera(frequencies));
    const double range = static_cast<double>(bench.decoder().common_range);
    for (const double d : {0.3, 0.99 * range, 1.01 * range, 1.7 * range, 5.3 * range}) {
      EXPECT_NEAR(static_cast<double>(bench.measure({10000, d, 0}).depth.range), d - range * std::floor(d / range), 5e-6)
          << frequencies[0] << " " << d;
    }
  }
}

// range = (ℓ² − |L|²)/(2(ℓ − u·L)): with the light 15.47 mm aside the range of ℓ = |P − L| + |P| comes back for any direction.
TEST(range, is_the_exact_inverse_of_the_path) {
  Camera camera = bench_camera();
  camera.illumination[0].position = {0.01547, -0.003, 0.002};
  const Bench bench(camera);
  for (const double x : {-0.6, 0.0, 0.5}) {
    for (const double y : {-0.4, 0.3}) {
      for (const double z : {0.05, 0.1, 0.5, 1.5}) {
        const double range = z * std::sqrt(x * x + y * y + 1);
        const double path = std::hypot(x * z - 0.01547, y * z + 0.003, z - 0.002) + range;
        const double length = std::sqrt(x * x + y * y + 1);
        const float got = depth::range_from_path<float>(bench.decoder(), static_cast<float>(path), static_cast<float>(x / length),
                                                        static_cast<float>(y / length), static_cast<float>(1 / length))
                              .range;
        EXPECT_NEAR(static_cast<double>(got), range, 1e-6);
      }
    }
  }
}

// Range of raw frames, along the pixel's own ray.
TEST(range, follows_the_ray_of_its_pixel) {
  Camera camera = bench_camera();
  camera.illumination[0].position = {0.1, -0.2, 0.05};
  const Bench bench(camera);
  for (const double x : {-0.6, 0.5}) {
    for (const double y : {-0.4, 0.7}) {
      constexpr double z = 1.2;
      const double range = z * std::sqrt(x * x + y * y + 1), path = std::hypot(x * z - 0.1, y * z + 0.2, z - 0.05) + range;
      std::vector<float> difference;
      for (const auto& taps : bench.expose({10000, 0.5 * path, 0})) difference.push_back(taps.difference);
      const auto ray = flow::make_ray(static_cast<float>(x), static_cast<float>(y), 1.0f);
      EXPECT_NEAR(static_cast<double>(depth::decode<float>(bench.decoder(), difference.data(), false, false, ray, {0, 1}).range), range,
                  5e-6);
    }
  }
}

// Â, B̂ and σ̂ of a quiet pixel are those that went in; the mean over the modulation frequencies.
TEST(decode, finds_amplitude_and_ambient) {
  const Bench bench(two_frequencies());
  const auto depth = bench.measure({20000, 1.2, 3000}).depth;
  EXPECT_NEAR(static_cast<double>(depth.amplitude), 14000, 0.05);
  EXPECT_NEAR(static_cast<double>(depth.ambient), 3000, 0.05);
  EXPECT_EQ(depth.flags, 0);
}

TEST(decode, takes_ambient_from_the_grey_frames_share_of_time) {
  Camera camera = two_frequencies();
  camera.mode.sequence[0].integration_time_s = 0.2e-3;  // a fifth of the lit ones
  EXPECT_NEAR(static_cast<double>(Bench(camera).measure({20000, 1.2, 3000}).depth.ambient), 3000, 0.05);
}

// σ̂ against the spread that it estimates: 5e4 draws; 2 % for its own first order and the draws' 0.3 %.
TEST(noise_estimate, is_the_spread_of_the_range) {
  struct Case {
    double signal, ambient, half_path;
    bool wiggling;
  };
  for (const Case& at : {Case{20000, 3000, 1.2, false}, Case{5000, 0, 3.3, false}, Case{40000, 50000, 6.0, false},
                         Case{20000, 3000, 1.23, true}, Case{20000, 3000, 1.5, true}}) {
    Camera camera = two_frequencies();
    camera.adc.step_e_per_dn = 20, camera.adc.mid_code = 32768;
    if (at.wiggling) {
      camera.illumination[0].waveform.harmonics = 4, camera.illumination[0].waveform.duty = 0.25;
      camera.pixel.contrast = {{60e6}, {0.6}};
    }
    const Bench bench(camera, true);
    Moments range(at.half_path), estimate;
    int warned = 0;
    for (int i = 0; i < 50'000; ++i) {
      const auto depth = bench.measure({at.signal, at.half_path, at.ambient}, i).depth;
      range.add(static_cast<double>(depth.range)), estimate.add(static_cast<double>(depth.noise));
      warned += depth.flags != 0;
    }
    EXPECT_NEAR(estimate.mean() / range.deviation(), 1, 0.02) << at.signal << " at " << at.half_path;
    EXPECT_LT(warned, 10) << at.signal;
  }
}

TEST(noise_estimate, counts_dark_current_and_the_step) {
  Camera camera = two_frequencies();
  const double quiet = static_cast<double>(Bench(camera).measure({5000, 1, 0}).depth.noise);
  const auto sigma = [](double extra) {
    return std::sqrt((5000 + 1800 + 1.0 / 12 + extra) / 2) / 3500 * c / (4 * pi) / std::hypot(80.32e6, 60.24e6);
  };
  EXPECT_NEAR(quiet / sigma(0), 1, 1e-4);
  camera.pixel.dark_current_e_per_s = 2e6;  // 2000 e⁻ in each tap; the grey frame's A−B does not show it
  EXPECT_NEAR(static_cast<double>(Bench(camera).measure({5000, 1, 0}).depth.noise) / sigma(4000), 1, 1e-4);
  camera.pixel.dark_current_e_per_s = 0;
  camera.adc.step_e_per_dn = 100;
  EXPECT_NEAR(static_cast<double>(Bench(camera).measure({5000, 1, 0}).depth.noise) / sigma(1e4 / 12 - 1.0 / 12), 1, 1e-4);
}

// σ̂ is that of the range, not of half the path: with the light aside the range follows half the path by dr/dd, here from differences of
// range = (ℓ² − |L|²)/(2(ℓ − u·L)) in double.
TEST(noise_estimate, counts_how_the_range_follows_half_the_path) {
  const double sigma = std::sqrt((5000 + 1800 + 1.0 / 12) / 2) / 3500 * c / (4 * pi) / std::hypot(80.32e6, 60.24e6);
  for (const double z : {0.0, 0.03, -0.03}) {
    Camera camera = two_frequencies();
    camera.illumination[0].position = {0.1, 0, z};
    const auto range_of = [&](double d) { return (4 * d * d - (0.01 + z * z)) / (2 * (2 * d - z)); };
    for (const double range : {0.08, 0.15, 0.5, 3.0}) {
      const double half_path = 0.5 * (range + std::hypot(0.1, range - z));
      const double slope = (range_of(half_path + 1e-5) - range_of(half_path - 1e-5)) / 2e-5;
      const auto depth = Bench(camera).measure({5000, half_path, 0}).depth;
      EXPECT_NEAR(static_cast<double>(depth.range), range, 3e-6);
      EXPECT_NEAR(static_cast<double>(depth.noise) / (slope * sigma), 1, 1e-4) << range << " " << z;
      if (range == 0.15 && z == 0) {
        EXPECT_NEAR(slope, 1.0917, 1e-4);
      }
    }
  }
}

// A budget without a threshold is no suppression.
TEST(noise_estimate, counts_no_suppression_that_is_off) {
  Camera camera = two_frequencies();
  const float quiet = Bench(camera).measure({20000, 1.2, 300000}).depth.noise;
  camera.pixel.suppression_budget_e = 1e6, camera.pixel.suppression_noise_factor = 1;
  EXPECT_EQ(Bench(camera).measure({20000, 1.2, 300000}).depth.noise, quiet);
}

// What is left in a tap, the mean over both and all raw frames: ½·collected − mean of min(budget, ½(collected − |D_k|) − threshold).
TEST(noise_estimate, knows_what_suppression_leaves) {
  Camera camera = bench_camera();
  camera.pixel.suppression_threshold_e = 2000, camera.pixel.suppression_budget_e = 5000;
  const Bench bench(camera);
  const float difference[] = {9000, -1000, -7000, 3000};
  const double removed = (0.5 * (14000 - 9000) - 2000 + 4500 + (0.5 * (14000 - 7000) - 2000) + 3500) / 4;
  EXPECT_NEAR(static_cast<double>(depth::charge_left<float>(bench.decoder(), bench.decoder().modulation[0], difference, 14000, 1)),
              7000 - removed, 1e-3);
  EXPECT_NEAR(static_cast<double>(depth::charge_left<float>(bench.decoder(), bench.decoder().modulation[0], difference, 40000, 1)), 15000,
              1e-2);
}

// Background suppression adds its own noise, more of it in the raw frames whose taps are alike. 4e4 draws know the spread to 0.35 %; the
// estimate is first order in the noise, which may differ by 1 %: 3 %. Without it, the estimate would be low by 15 % to 60 % here.
TEST(noise_estimate, counts_what_background_suppression_adds) {
  struct Case {
    double signal, ambient, half_path, budget, factor;
  };
  for (const Case& at : {Case{20000, 300000, 1.2, 1e6, 1}, Case{20000, 300000, 1.2, 60000, 2}, Case{200000, 20000, 3.3, 1e6, 1},
                         Case{200000, 20000, 0.02, 1e6, 1}, Case{200000, 20000, 1.0, 40000, 1.5}}) {
    Camera camera = two_frequencies();
    camera.adc.step_e_per_dn = 20, camera.adc.mid_code = 32768;
    camera.pixel.dark_current_e_per_s = 2e6;
    camera.pixel.suppression_threshold_e = 20000, camera.pixel.suppression_budget_e = at.budget;
    camera.pixel.suppression_noise_factor = at.factor;
    const Bench bench(camera, true);
    Moments range(at.half_path), estimate;
    int warned = 0;
    for (int i = 0; i < 40'000; ++i) {
      const auto depth = bench.measure({at.signal, at.half_path, at.ambient}, i).depth;
      range.add(static_cast<double>(depth.range)), estimate.add(static_cast<double>(depth.noise));
      warned += depth.flags != 0;
    }
    EXPECT_NEAR(estimate.mean() / range.deviation(), 1, 0.03) << at.signal << " at " << at.half_path;
    EXPECT_LT(warned, 10) << at.signal;
    camera.pixel.suppression_noise_factor = 0;
    const double without = static_cast<double>(Bench(camera).measure({at.signal, at.half_path, at.ambient}).depth.noise);
    EXPECT_GT(range.deviation() / without, 1.15) << at.signal << " at " << at.half_path << ": the case shows nothing";
  }
}

TEST(flags, are_none_for_a_good_pixel) { EXPECT_EQ(flags_of(Bench(two_frequencies(), true), {20000, 1.2, 3000}), 0); }

// σ̂ of 0.07 m: from either side. Never where noise is off.
TEST(flags, say_low_signal_where_the_noise_is_above_its_limit) {
  const Camera camera = two_frequencies();
  const auto signal_for = [](double noise_m) {  // V = S + floor, solved for S by bisection
    double low = 1, high = 1e6;
    for (int i = 0; i < 100; ++i) {
      const double s = 0.5 * (low + high);
      (std::sqrt((s + 1800 + 1.0 / 12) / 2) / (0.7 * s) * c / (4 * pi) / std::hypot(80.32e6, 60.24e6) > noise_m ? low : high) = s;
    }
    return low;
  };
  // expectations decoded as if with noise, so that the edge is sharp
  const Bench bench(camera, true), silent(camera);
  for (const double noise : {0.069, 0.071}) {
    std::vector<float> difference;
    for (const auto& taps : silent.expose({signal_for(noise), 1.2, 0})) difference.push_back(taps.difference);
    EXPECT_EQ(bench.decode(difference).flags & depth::low_signal, noise > 0.07 ? depth::low_signal : 0) << noise;
    EXPECT_EQ(silent.decode(difference).flags & depth::low_signal, 0);
  }
}

// Â = 0.7·S, with noise and without.
TEST(flags, say_low_signal_where_the_amplitude_is_below_its_threshold) {
  Camera camera = two_frequencies();
  camera.decoding.amplitude_threshold_e = 7000;
  for (const bool noise : {false, true}) {
    const Bench bench(camera, noise), silent(camera);
    for (const double signal : {9900.0, 10100.0}) {
      std::vector<float> difference;
      for (const auto& taps : silent.expose({signal, 1.2, 0})) difference.push_back(taps.difference);
      EXPECT_EQ(bench.decode(difference).flags & depth::low_signal, signal < 10000 ? depth::low_signal : 0) << signal;
    }
  }
}

// D = 0 reads code 32768: the lower end of the narrowest range there is, half a code from its middle.
TEST(flags, say_nothing_of_codes_at_the_ends_of_the_narrowest_range) {
  for (const double lower : {32767.0, 32768.0, 32769.0}) {
    Camera camera = bench_camera();
    camera.decoding.lower_saturation_dn = lower, camera.decoding.upper_saturation_dn = lower + 1;
    bool found = false;
    (void)Bench(camera).expose({}, 0, 0, &found);
    EXPECT_EQ(found, lower > 32768) << lower;
  }
}

// φ = 0: D_0 = 7000 and D_2 = −7000, about code 32768. Either limit may be given alone; the other one is the ADC's.
TEST(flags, say_saturated_beyond_the_codes_of_the_decoding) {
  const auto saturated = [](std::optional<double> lower, std::optional<double> upper) {
    Camera camera = bench_camera();
    camera.decoding.lower_saturation_dn = lower, camera.decoding.upper_saturation_dn = upper;
    bool found = false;
    (void)Bench(camera).expose({10000, 0, 0}, 0, 0, &found);
    return found;
  };
  EXPECT_FALSE(saturated({}, {}));
  EXPECT_FALSE(saturated({}, 39769));
  EXPECT_TRUE(saturated({}, 39767));
  EXPECT_FALSE(saturated(25767, {}));
  EXPECT_TRUE(saturated(25769, {}));
  EXPECT_FALSE(saturated(25767, 39769));
}

TEST(flags, say_no_return_where_nothing_comes_back) {
  const Bench bench(two_frequencies());
  EXPECT_EQ(flags_of(bench, {0, 1.2, 3000}) & depth::no_return, depth::no_return);
  EXPECT_EQ(flags_of(bench, {0.99 / 0.7, 1.2, 0}) & depth::no_return, depth::no_return);  // Â just below one electron
  EXPECT_EQ(flags_of(bench, {1.01 / 0.7, 1.2, 0}) & depth::no_return, 0);
}

TEST(flags, say_no_return_where_the_path_is_shorter_than_the_light_s_offset) {
  Camera camera = bench_camera();
  camera.illumination[0].position = {0.1, 0, 0};
  const Bench bench(camera);
  EXPECT_EQ(flags_of(bench, {10000, 0.049, 0}) & depth::no_return, depth::no_return);
  EXPECT_EQ(flags_of(bench, {10000, 0.051, 0}) & depth::no_return, 0);
}

TEST(flags, say_saturated_and_outside_where_they_are_told) {
  const Bench bench(bench_camera());
  std::vector<float> difference;
  for (const auto& taps : bench.expose({10000, 1, 0})) difference.push_back(taps.difference);
  const auto ray = flow::make_ray(0.0f, 0.0f, 1.0f);
  EXPECT_EQ(depth::decode<float>(bench.decoder(), difference.data(), true, false, ray, {0, 1}).flags, depth::saturated);
  EXPECT_EQ(depth::decode<float>(bench.decoder(), difference.data(), false, true, ray, {0, 1}).flags, depth::outside_lens);
  EXPECT_EQ(depth::decode<float>(bench.decoder(), difference.data(), false, false, ray, {0, 1}).flags, 0);
}

// |D_0 + D_2| > 5·√(2V̂): just above and just below; likewise the other pair.
TEST(flags, warn_where_opposite_phases_do_not_cancel) {
  const Bench bench(two_frequencies());
  std::vector<float> difference;
  for (const auto& taps : bench.expose({20000, 1.2, 0})) difference.push_back(taps.difference);
  const double limit = 5 * std::sqrt(2 * (20000 + 1800 + 1.0 / 12));
  for (std::size_t k = 1; k < difference.size(); ++k) {
    for (const double share : {0.95, 1.05}) {
      auto moved = difference;
      moved[k] += static_cast<float>(share * limit);
      const bool warned = (bench.decode(moved).flags & depth::inconsistent_phases) != 0;
      EXPECT_EQ(warned, share > 1) << k << " " << share;
    }
  }
}

// |D_0 + D_2| > max(limit, k√(2V̂)), √(2V̂) = 208 e⁻.
TEST(flags, warn_of_phases_by_the_limit_and_the_factor_that_are_set) {
  const double noise = std::sqrt(2 * (20000 + 1800 + 1.0 / 12));
  for (const double sigmas : {0.0, 2.0, 9.0}) {
    for (const double limit : {300.0, 1000.0}) {
      Camera camera = two_frequencies();
      camera.decoding.asymmetry_sigmas = sigmas, camera.decoding.asymmetry_limit_e = limit;
      const Bench bench(camera);
      for (const double share : {0.95, 1.05}) {
        std::vector<float> difference;
        for (const auto& taps : bench.expose({20000, 1.2, 0})) difference.push_back(taps.difference);
        difference[3] += static_cast<float>(share * std::max(limit, sigmas * noise));
        EXPECT_EQ(bench.decode(difference).flags, share > 1 ? depth::inconsistent_phases : 0) << sigmas << " " << limit << " " << share;
      }
    }
  }
}

// What warns makes the depth invalid where the camera says so, each warning by itself.
TEST(flags, say_rejected_where_a_warning_shall_be_heeded) {
  for (const bool phases : {false, true}) {
    for (const bool frequencies : {false, true}) {
      Camera camera = two_frequencies();
      camera.decoding.asymmetry_reject = phases, camera.decoding.multipath_reject = frequencies;
      const Bench bench(camera);
      std::vector<float> good, moved, apart;
      for (const auto& taps : bench.expose({20000, 1.2, 0})) good.push_back(taps.difference);
      for (const auto& taps : bench.expose({20000, 1.5, 0})) apart.push_back(taps.difference);
      moved = good, moved[3] += 2000;
      for (std::size_t k = 0; k < 5; ++k) apart[k] = good[k];
      const int warned = bench.decode(moved).flags, differ = bench.decode(apart).flags;
      EXPECT_EQ(bench.decode(good).flags, 0);
      EXPECT_EQ(warned & ~depth::inconsistent_frequencies, depth::inconsistent_phases + (phases ? depth::rejected : 0));
      EXPECT_EQ(differ, depth::inconsistent_frequencies + (frequencies ? depth::rejected : 0));
      EXPECT_EQ((warned & depth::invalid) != 0, phases) << "a warning alone leaves the depth";
    }
  }
}

// |d_1 − d_2| > 0.1 m and > 3 times its σ̂, or what is set in their place.
TEST(flags, warn_where_the_frequencies_do_not_agree) {
  Camera camera = two_frequencies();
  camera.adc.step_e_per_dn = 10;  // the brighter one would clip at the bench's 1 e⁻
  for (const auto& [limit, sigmas] : {std::pair{0.1, 3.0}, {0.19, 3.0}, {0.1, 1.0}, {0.0, 6.0}}) {
    for (const double signal : {2e5, 1500.0}) {
      camera.decoding.multipath_limit_m = limit, camera.decoding.multipath_sigmas = sigmas;
      const Bench bench(camera);
      for (const double apart : {0.09, 0.11, 0.2}) {
        const auto first = bench.expose({signal, 1.0, 0}), second = bench.expose({signal, 1.0 + apart, 0});
        std::vector<float> difference;
        for (std::size_t k = 0; k < 9; ++k) difference.push_back(k < 5 ? first[k].difference : second[k].difference);
        const auto got = bench.decode(difference);
        const double sigma = std::sqrt((signal + 1800) / 2) / (0.7 * signal) * c / (4 * pi) * std::hypot(1 / 80.32e6, 1 / 60.24e6);
        const bool expected = apart > limit && apart > sigmas * sigma;
        EXPECT_EQ((got.flags & depth::inconsistent_frequencies) != 0, expected) << signal << " " << apart << " " << sigmas * sigma;
      }
    }
  }
}

// φ = 30°, four phases: D_k = A·cos(φ + τ_k). With A twice what the codes hold, D_0 and D_2 stop at their ends, D_1 and D_3 do not:
// φ̂ = atan2(A·sin 30°, held) = 45°.
TEST(depth, without_noise_is_that_of_the_codes_where_they_clip) {
  Camera camera = bench_camera({60.24e6}, 4, 0.7);
  camera.adc = {12, 20, 2048, 0, 4095};
  const double most = 20 * 2047, turn = c / (2 * 60.24e6);
  const Bench bench(camera);
  const auto below = bench.measure({0.99 * most / 0.7 / std::cos(pi / 6), turn / 12, 0}).depth;
  EXPECT_EQ(below.flags, 0);
  EXPECT_NEAR(static_cast<double>(below.range), turn / 12, 2e-6);
  const auto clipped = bench.measure({2 * most / 0.7, turn / 12, 0}).depth;
  EXPECT_EQ(clipped.flags & depth::saturated, depth::saturated);
  EXPECT_NEAR(static_cast<double>(clipped.range), turn / 8, 1e-3 * turn);  // the lower end lies a code further: 2048 against 2047
}

TEST(depth, does_not_depend_on_the_amplitude) {
  Camera camera = bench_camera({80.32e6, 60.24e6});
  camera.adc.step_e_per_dn = 100;  // so that no code clips
  const Bench bench(camera);
  const double one = static_cast<double>(bench.measure({100, 2.7, 0}).depth.range);
  for (const double factor : {3.0, 10.0, 100.0, 1e4})
    EXPECT_NEAR(static_cast<double>(bench.measure({100 * factor, 2.7, 0}).depth.range), one, 2e-6);
}

// Temperature moves every measured half path by the drift; the decoder knows nothing of it.
TEST(depth, drifts_with_the_temperature) {
  Camera camera = bench_camera({80.32e6, 60.24e6});
  camera.temperature.drift_m_per_kelvin = 0.0002, camera.temperature.celsius = 35;
  EXPECT_NEAR(static_cast<double>(Bench(camera).measure({20000, 1.5, 0}).depth.range), 1.502, 5e-6);
  camera.temperature.drift_m_per_kelvin = 0;
  camera.temperature.warm_up_m = 0.01, camera.temperature.warm_up_time_s = 600, camera.temperature.since_start_s = 600;
  EXPECT_NEAR(static_cast<double>(Bench(camera).measure({20000, 1.5, 0}).depth.range), 1.5 + 0.01 * (1 - std::exp(-1.0)), 5e-6);
}

// Light is slower in a medium, for the raw frames and for the decoder alike.
TEST(depth, counts_the_refractive_index) {
  Camera camera = bench_camera();
  camera.refractive_index = 1.33;
  const Bench bench(camera);
  EXPECT_FLOAT_EQ(bench.decoder().common_range, static_cast<float>(c / 1.33 / (2 * 60.24e6)));
  EXPECT_NEAR(static_cast<double>(bench.measure({20000, 1.5, 0}).depth.range), 1.5, 2e-6);
  EXPECT_NEAR(static_cast<double>(bench.estimate(bench.expose({20000, 0.5, 0})).turns), 2 * 0.5 * 60.24e6 * 1.33 / c, 1e-6);
}
