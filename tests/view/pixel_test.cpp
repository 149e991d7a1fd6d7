// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What the viewer says of a pixel beyond `inspect`: flow, phasors, curves; and why its depth is wrong.
#include <cmath>
#include <map>
#include <thread>

#include "support/pi.h"
#include "support/text.h"
#include "view/viewer.h"

namespace tofray::test {
namespace {

using files::Json;

/// The large pixels of the small sensor would be saturated.
const std::string weak = "camera.lens.f_number=6";

Json pixel_of(Greeted& one, const std::string& what) {
  one.page.send(R"({"type":"pixel","id":1,)" + what + "}");
  const auto answer = one.page.text("pixel");
  return answer ? *answer : Json::object();
}

/// A value of the flow; of one modulation frequency where `phase` is not negative.
const Json* flow_value(const Json& pixel, const std::string& stage, const std::string& name, int phase = -1) {
  for (const Json& one : *pixel.find("flow")->items()) {
    if (*one.find("stage")->string() != stage) continue;
    for (const Json& value : *one.find("values")->items()) {
      const bool this_phase = value.find("phase") == nullptr ? phase < 0 : number_in(value, "phase") == phase;
      if (*value.find("name")->string() == name && this_phase) return value.find("value");
    }
  }
  return nullptr;
}

double number(const Json& json) {
  double out = std::nan("");
  json.number(out);
  return out;
}

TEST(pixel, flows_through_all_stages_with_the_report_s_numbers) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"card", "--seed", "2", "--set", weak});
  Greeted one(viewer);
  const Json pixel = pixel_of(one, R"("u":13,"v":10)");
  ASSERT_NE(pixel.find("flow"), nullptr);
  std::string stages;
  for (const Json& stage : *pixel.find("flow")->items()) stages += *stage.find("stage")->string() + " ";
  EXPECT_EQ(stages, "light electrons taps adc correlation phase unwrapping range z ");
  const Json& report = *pixel.find("report");
  EXPECT_EQ(number(*flow_value(pixel, "z", "z")), number_in(*report.find("depth"), "z_m"));
  EXPECT_EQ(number(*flow_value(pixel, "light", "true_range")), number_in(*report.find("truth"), "range_m"));
  const std::vector<Json>& raw = *report.find("raw_frames")->items();
  ASSERT_EQ(flow_value(pixel, "taps", "tap_a")->items()->size(), raw.size());
  for (std::size_t k = 0; k < raw.size(); ++k) {
    EXPECT_EQ(number((*flow_value(pixel, "taps", "tap_a")->items())[k]), number_in(raw[k], "tap_a_e"));
    EXPECT_EQ(number((*flow_value(pixel, "adc", "code")->items())[k]), number_in(raw[k], "raw_dn"));
  }
  for (int k = 0; k < 2; ++k) {
    const Json& phase = (*report.find("phases")->items())[static_cast<std::size_t>(k)];
    EXPECT_NEAR(std::hypot(number(*flow_value(pixel, "correlation", "i", k)), number(*flow_value(pixel, "correlation", "q", k))),
                number_in(phase, "amplitude_e"), 1e-6 * number_in(phase, "amplitude_e"));
    EXPECT_EQ(number(*flow_value(pixel, "unwrapping", "cycles", k)), number_in(phase, "cycles"));
    EXPECT_EQ(number((*(*report.find("unwrapping")->find("candidates")->items())[0].find("cycles")->items())[static_cast<std::size_t>(k)]),
              number_in(phase, "cycles"));
  }
  EXPECT_GT(number_in(*report.find("unwrapping"), "runner_up_ratio"), 1);
}

TEST(pixel, has_phasors_whose_truth_is_the_frame_without_noise) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"card", "--seed", "2", "--set", weak});
  Greeted one(viewer);
  const Json pixel = pixel_of(one, R"("u":13,"v":10)");
  const Result said = run(with_small_sensor({"inspect", "card", "--set", weak, "--noise", "off", "--pixel", "13,10", "--json"}));
  const Json expected = files::parse_json(said.out, "inspect");
  ASSERT_EQ(pixel.find("phasors")->items()->size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    const Json &phasor = (*pixel.find("phasors")->items())[k], &phase = (*expected.find("phases")->items())[k];
    const double i = number_in(phasor, "i"), q = number_in(phasor, "q"), amplitude = number_in(phase, "amplitude_e");
    EXPECT_NEAR(std::atan2(q, i), std::remainder(number_in(phasor, "phase_rad"), 2 * pi), 1e-9);
    EXPECT_NEAR(number_in(phasor, "truth_i"), amplitude * std::cos(number_in(phase, "measured_phase_rad")), 1e-3 * amplitude);
    EXPECT_NEAR(number_in(phasor, "truth_q"), amplitude * std::sin(number_in(phase, "measured_phase_rad")), 1e-3 * amplitude);
    const double sigma = number_in(phasor, "sigma_i");
    EXPECT_NEAR(sigma, number_in((*pixel.find("report")->find("phases")->items())[k], "noise_e"), 1e-6 * sigma);
    EXPECT_NEAR(number_in(phasor, "sigma_q"), sigma, 1e-6 * sigma);
    EXPECT_NEAR(number_in(phasor, "covariance"), 0, 1e-6 * sigma * sigma);
    EXPECT_GT(std::hypot(i - number_in(phasor, "truth_i"), q - number_in(phasor, "truth_q")), 0);
    EXPECT_LT(std::hypot(i - number_in(phasor, "truth_i"), q - number_in(phasor, "truth_q")), 5 * sigma);
  }
}

TEST(pixel, has_curves_that_go_through_its_samples_where_nothing_is_noise) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"card", "--noise", "off", "--set", weak});
  Greeted one(viewer);
  const Json pixel = pixel_of(one, R"("u":13,"v":10)");
  ASSERT_EQ(pixel.find("curve")->items()->size(), 2u);
  for (const Json& curve : *pixel.find("curve")->items()) {
    const std::vector<Json>& points = *curve.find("points")->items();
    ASSERT_EQ(points.size(), 64u);
    ASSERT_EQ(curve.find("samples")->items()->size(), 4u);
    for (const Json& sample : *curve.find("samples")->items()) {
      const double phase = number((*sample.items())[0]), value = number((*sample.items())[1]);
      EXPECT_NEAR(number(points[static_cast<std::size_t>(std::lround(phase / (2 * pi) * 64))]), value, 1e-3 * std::abs(value) + 1);
    }
  }
}

TEST(pixel, flows_with_each_of_the_report_s_numbers_in_its_place) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"corner", "--seed", "2", "--set", weak, "--bounces", "1", "--samples", "16"});
  Greeted one(viewer);
  const Json pixel = pixel_of(one, R"("u":16,"v":9)");
  const Json& report = *pixel.find("report");
  struct Place {
    const char *stage, *name, *of;
  };
  const auto near = [](double is, double has_to_be, const Place& place) {
    EXPECT_NEAR(is, has_to_be, 1e-12 * std::abs(has_to_be)) << place.stage << " " << place.name;
  };
  for (const Place& one_place : {Place{"light", "object", "object_id"}, Place{"light", "reflectivity", "reflectivity"},
                                 Place{"light", "incidence", "incidence_rad"}, Place{"light", "irradiance", "irradiance_w_m2"},
                                 Place{"light", "radiance", "radiance_w_m2_sr"}, Place{"light", "power", "power_w"}})
    near(number(*flow_value(pixel, one_place.stage, one_place.name)), number_in(*report.find("truth"), one_place.of), one_place);
  for (const Place& one_place : {Place{"range", "range", "range_m"}, Place{"range", "noise", "noise_m"}, Place{"z", "z", "z_m"}})
    near(number(*flow_value(pixel, one_place.stage, one_place.name)), number_in(*report.find("depth"), one_place.of), one_place);
  const auto point = three(*report.find("depth")->find("point_m"));
  EXPECT_EQ(number(*flow_value(pixel, "z", "x")), point[0]);
  EXPECT_EQ(number(*flow_value(pixel, "z", "y")), point[1]);
  const std::vector<Json>& raw = *report.find("raw_frames")->items();
  for (const Place& one_place :
       {Place{"electrons", "signal", "signal_e"}, Place{"electrons", "direct", "direct_e"}, Place{"electrons", "indirect", "indirect_e"},
        Place{"taps", "tap_a", "tap_a_e"}, Place{"taps", "tap_b", "tap_b_e"}, Place{"adc", "code", "raw_dn"},
        Place{"adc", "difference", "difference_e"}}) {
    const auto& list = *flow_value(pixel, one_place.stage, one_place.name)->items();
    ASSERT_EQ(list.size(), raw.size()) << one_place.name;
    for (std::size_t k = 0; k < raw.size(); ++k)
      if (double value = 0; raw[k].find(one_place.of)->number(value)) near(number(list[k]), value, one_place);
  }
  EXPECT_GT(number_in(raw[1], "indirect_e"), 0) << "light bounces";
  EXPECT_NE(point[0], point[1]);
  const double turn = 2 * pi;
  for (int k = 0; k < 2; ++k) {
    const Json& phase = (*report.find("phases")->items())[static_cast<std::size_t>(k)];
    near(turn * number(*flow_value(pixel, "phase", "measured", k)), number_in(phase, "measured_phase_rad"), {"phase", "measured", ""});
    near(turn * number(*flow_value(pixel, "phase", "calibrated", k)), number_in(phase, "calibrated_phase_rad"),
         {"phase", "calibrated", ""});
    EXPECT_NE(number_in(phase, "measured_phase_rad"), number_in(phase, "calibrated_phase_rad"));
    near(number(*flow_value(pixel, "correlation", "amplitude", k)), number_in(phase, "amplitude_e"), {"correlation", "amplitude", ""});
    near(number(*flow_value(pixel, "unwrapping", "half_wave", k)), number_in(phase, "half_wave_m"), {"unwrapping", "half_wave", ""});
    near(number(*flow_value(pixel, "unwrapping", "half_path", k)), number_in(phase, "half_path_m"), {"unwrapping", "half_path", ""});
  }
}

TEST(pixel, flows_through_a_filter_where_there_is_one) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"card", "--set", weak, "--set", "camera.decoding.filter={kind: gaussian, sigma: 1.5 px}", "--set",
                       "camera.decoding.temporal.frames=2"});
  Greeted one(viewer);
  const Json pixel = pixel_of(one, R"("u":13,"v":10)");
  ASSERT_NE(flow_value(pixel, "filter", "sigma"), nullptr);
  EXPECT_EQ(number(*flow_value(pixel, "filter", "sigma")), 1.5);
  EXPECT_EQ(number(*flow_value(pixel, "filter", "temporal_frames")), 2);
  EXPECT_EQ(flow_value(pixel, "filter", "radius"), nullptr);
}

/// The phasor (theory 4.2) of a curve at four reference phases.
std::pair<double, double> phasor_of(const Json& curve) {
  double i = 0, q = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double phase = pi / 2 * static_cast<double>(k), value = number((*curve.find("points")->items())[16 * k]);
    i += value * std::cos(phase) / 2, q -= value * std::sin(phase) / 2;
  }
  return {i, q};
}

TEST(pixel, has_curves_through_what_is_expected_or_with_bounces_through_what_was_measured) {
  NEEDS_THE_VIEWER;
  std::map<std::size_t, double> truth;
  for (const bool bounces : {false, true}) {
    Arguments words{"corner", "--seed", "2", "--set", weak};
    if (bounces) words.insert(words.end(), {"--bounces", "1", "--samples", "16"});
    const Viewer viewer(words);
    Greeted one(viewer);
    const Json pixel = pixel_of(one, R"("u":13,"v":10)");
    ASSERT_EQ(pixel.find("phasors")->items()->size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      const Json& phasor = (*pixel.find("phasors")->items())[k];
      const auto [i, q] = phasor_of((*pixel.find("curve")->items())[k]);
      const double amplitude = number_in(phasor, "amplitude"), off = std::hypot(number_in(phasor, "i") - number_in(phasor, "truth_i"),
                                                                                number_in(phasor, "q") - number_in(phasor, "truth_q"));
      ASSERT_GT(off, 1e-3 * amplitude) << "there is noise";
      if (bounces) {
        EXPECT_EQ(number_in(phasor, "truth_i"), truth[k]) << "the truth is of direct light";
      }
      truth[k] = number_in(phasor, "truth_i");
      EXPECT_NEAR(i, number_in(phasor, bounces ? "i" : "truth_i"), 1e-4 * amplitude) << bounces;
      EXPECT_NEAR(q, number_in(phasor, bounces ? "q" : "truth_q"), 1e-4 * amplitude) << bounces;
    }
  }
}

TEST(pixel, is_one_of_the_frame_that_the_page_got_last) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"card", "--set", weak});
  Greeted slow(viewer), quick(viewer);
  slow.page.want("\"z_m\"", "\"max\"");
  const auto first = slow.page.frame(), second = slow.page.frame();  // and no more: they are not acknowledged
  ASSERT_TRUE(first && second);
  quick.page.want("\"z_m\"", "\"max\"");
  ASSERT_TRUE(quick.page.frame_with([&](const WireFrame& one) { return one.frame > second->frame + 4; }));
  const Json pixel = slow.page.answer(R"({"type":"pixel","id":1,"u":13,"v":10})", "pixel");
  EXPECT_EQ(number_in(pixel, "frame"), static_cast<double>(second->frame));
  const double z = static_cast<double>(little<float>(second->arrays.at(number_of(slow.hello, "z_m")), 4 * (10 * 28 + 13)));
  EXPECT_EQ(number_in(*pixel.find("report")->find("depth"), "z_m"), z);
  const Json measure = slow.page.answer(R"({"type":"measure","id":1,"a":[13,10],"b":[14,10]})", "measure");
  EXPECT_EQ(number_in(measure, "frame"), static_cast<double>(second->frame));
  EXPECT_EQ(three(*measure.find("a")->find("measured"))[2], z);
}

double sum_of(const Json& why) {
  double out = number_in(why, "rest_mm");
  for (const Json& one : *why.find("causes")->items()) out += number_in(one, "mm");
  return out;
}

TEST(why, names_the_noise_of_a_pixel_in_millimetres) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"card", "--seed", "4", "--set", weak});
  Greeted one(viewer);
  one.page.send(R"({"type":"why","id":9,"u":13,"v":10})");
  const auto why = one.page.text("why");
  ASSERT_TRUE(why);
  EXPECT_EQ(number_in(*why, "id"), 9);
  EXPECT_EQ(number_in(*why, "u"), 13);
  EXPECT_EQ(number_in(*why, "v"), 10);
  EXPECT_EQ(number_in(*why, "pixels"), 1);
  EXPECT_EQ(number_in(*why, "count"), 1);
  const auto z_of = [&](const char* noise) {
    const Result said =
        run(with_small_sensor({"inspect", "card", "--set", weak, "--seed", "4", "--noise", noise, "--pixel", "13,10", "--json"}));
    const Json json = files::parse_json(said.out, "inspect");
    return std::pair{number_in(*json.find("depth"), "z_m"), number_in(*json.find("truth"), "z_m")};
  };
  const auto [z, truth] = z_of("exact");
  EXPECT_NEAR(number_in(*why, "error_m"), z - truth, 1e-9);
  const std::vector<Json>& causes = *why->find("causes")->items();
  ASSERT_FALSE(causes.empty());
  EXPECT_EQ(*causes[0].find("cause")->string(), "noise");
  EXPECT_NEAR(number_in(causes[0], "mm"), 1e3 * (z - z_of("off").first), 1e-4);
  EXPECT_NEAR(sum_of(*why), 1e3 * number_in(*why, "error_m"), 1e-6);
  EXPECT_GT(number_in(*why, "sigma_m"), 0);
}

TEST(why, of_a_region_is_a_mean_and_goes_on_beside_frames) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room", "--bounces", "1", "--samples", "4"});
  Greeted one(viewer);
  one.page.want("\"z_m\"", "\"max\"");
  one.page.frame();
  one.page.send(R"({"type":"why","id":1,"region":[3,4,12,9]})");
  const auto why = one.page.text("why");
  ASSERT_TRUE(why);
  EXPECT_EQ(number_in(*why, "count"), 60);
  EXPECT_LE(number_in(*why, "pixels"), 60);
  EXPECT_GT(number_in(*why, "pixels"), 0);
  EXPECT_EQ(why->find("region")->items()->size(), 4u);
  EXPECT_EQ(why->find("u"), nullptr);
  std::string names;
  for (const Json& cause : *why->find("causes")->items()) names += *cause.find("cause")->string() + " ";
  EXPECT_TRUE(has(names, "noise ")) << names;
  EXPECT_TRUE(has(names, "multipath ")) << names;
  EXPECT_NEAR(sum_of(*why), 1e3 * number_in(*why, "error_m"), 1e-6);
}

TEST(why, beyond_the_image_or_of_no_side_is_a_fault_that_says_so) {
  NEEDS_THE_VIEWER;
  const Viewer viewer;
  Greeted one(viewer);
  for (const char* wrong :
       {R"("u":28,"v":0)", R"("u":0,"v":22)", R"("region":[0,0,28,0])", R"("region":[0,0,0,22])", R"("u":1,"v":1,"side":"b")"}) {
    one.page.send(std::string(R"({"type":"why","id":7,)") + wrong + "}");
    const auto fault = one.page.text("fault");
    ASSERT_TRUE(fault) << wrong;
    EXPECT_EQ(number_in(*fault, "id"), 7) << wrong;
  }
  one.page.send(R"({"type":"why","id":8,"u":27,"v":21})");
  ASSERT_TRUE(one.page.text("why")) << "the session goes on";
}

TEST(why, of_a_state_that_changes_meanwhile_is_not_answered_for_the_old_one) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room", "--bounces", "2", "--samples", "512"});
  Greeted one(viewer);
  one.page.send(R"({"type":"why","id":5,"u":13,"v":10})");
  one.page.send(R"({"type":"set","id":6,"key":"camera.lens.f_number","text":"1.8"})");
  one.page.send(R"({"type":"why","id":7,"u":13,"v":10})");
  // The first one may come to its end before the state changes; not behind that.
  for (bool changed = false;;) {
    const WsMessage message = one.page.next();
    ASSERT_GE(message.opcode, 0);
    if (message.opcode != 1) continue;
    const Json json = message.json();
    if (*json.find("type")->string() == "done") changed = true;
    if (*json.find("type")->string() != "why") continue;
    EXPECT_EQ(number_in(json, "generation"), changed ? 2 : 1);
    EXPECT_EQ(number_in(json, "id"), changed ? 7 : 5) << "the newest question counts";
    if (number_in(json, "id") == 7) break;
  }
}

TEST(why, says_which_causes_change_nothing_here) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"flying-ball", "--set", weak});
  Greeted one(viewer);
  const Json why = one.page.answer(R"({"type":"why","id":9,"u":1,"v":1})", "why");
  ASSERT_EQ(*why.find("type")->string(), "why");
  std::map<std::string, std::pair<bool, double>> causes;
  for (const Json& each : *why.find("causes")->items())
    causes[*each.find("cause")->string()] = {*each.find("changes")->boolean(), number_in(each, "mm")};
  ASSERT_TRUE(causes.contains("motion") && causes.contains("noise"));
  EXPECT_FALSE(causes["motion"].first) << "the wall stands still";
  EXPECT_EQ(causes["motion"].second, 0);
  EXPECT_TRUE(causes["noise"].first);
}

TEST(why, ends_with_a_fault_where_the_state_changes_on_the_way) {
  NEEDS_THE_VIEWER;
  const Viewer viewer({"room", "--bounces", "4", "--samples", "8192", "--set", weak});
  Greeted one(viewer);
  one.page.send(R"({"type":"why","id":5,"u":13,"v":10})");
  std::this_thread::sleep_for(milliseconds(50));
  one.page.send(R"({"type":"set","id":6,"key":"camera.lens.f_number","text":"1.8"})");
  for (bool ended = false; !ended;) {
    const WsMessage message = one.page.next(milliseconds(30'000));
    ASSERT_GE(message.opcode, 0);
    if (message.opcode != 1) continue;
    const Json json = message.json();
    const std::string& type = *json.find("type")->string();
    ASSERT_NE(type, "why") << "of the state before";
    if (type != "fault") continue;
    EXPECT_EQ(number_in(json, "id"), 5);
    EXPECT_TRUE(has(*json.find("text")->string(), "the state has changed")) << *json.find("text")->string();
    ended = true;
  }
}

// What came back of each type, in its order, where newer questions follow one that keeps the session busy frame by frame.
void ask_while_busy(const std::string& samples, std::map<std::string, std::string>& order) {
  const Viewer viewer({"room", "--bounces", "2", "--samples", samples, "--set", weak});
  Greeted one(viewer);
  one.page.send(R"({"type":"why","id":1,"u":13,"v":10})");
  std::this_thread::sleep_for(milliseconds(50));
  for (const char* id : {"2", "3"}) {
    one.page.send(std::string(R"({"type":"why","u":12,"v":9,"id":)") + id + "}");
    one.page.send(std::string(R"({"type":"camera","position":[0,0,0],"rotation":null,"id":)") + id + "}");
    one.page.send(std::string(R"({"type":"pixel","u":12,"v":9,"id":)") + id + "}");
  }
  const Clock::time_point end = Clock::now() + std::chrono::seconds(60);
  while (order["why"].empty() && Clock::now() < end) {
    const WsMessage message = one.page.next(milliseconds(60'000));
    ASSERT_GE(message.opcode, 0);
    if (message.opcode != 1) continue;
    const Json json = message.json();
    if (json.find("id") != nullptr) order[*json.find("type")->string()] += std::to_string(static_cast<int>(number_in(json, "id"))) + " ";
  }
}

TEST(questions, that_wait_give_way_to_newer_ones_of_their_kind) {
  NEEDS_THE_VIEWER;
  std::map<std::string, std::string> order;
  // A quick machine answers the first question before the others arrive: then it gets more to do.
  for (const char* samples : {"512", "4096", "32768", "262144"}) {
    order.clear();
    ASSERT_NO_FATAL_FAILURE(ask_while_busy(samples, order));
    if (order["why"] != "1 ") break;
  }
  EXPECT_EQ(order["why"], "3 ");
  EXPECT_EQ(order["camera"], "3 ");
  EXPECT_EQ(order["pixel"], "3 ");
}

}  // namespace
}  // namespace tofray::test
