// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Draws of a set against their laws: right samplers keep them whatever is refused, wrong ones are told.
#include "dataset/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dataset/draw.h"
#include "dataset/scenes.h"
#include "support/samples.h"
#include "support/text.h"

namespace {

using namespace tofray;
using dataset::DrawCounts;
using dataset::Judgement;
using test::has;

constexpr double endless = std::numeric_limits<double>::infinity();

Judgement judged(const std::string& text, std::uint64_t samples) {
  const dataset::Scenes scenes(text, "set.yaml");
  Judgement out;
  for (std::uint64_t i = 0; i < samples; ++i)
    for (std::uint64_t view = 0; view < scenes.set().views; ++view) scenes.judge(i, view, out);
  return out;
}

TEST(judge, finds_that_every_form_keeps_its_law) {
  const Judgement draws = judged(
      "name: all\nsamples: 4000\nseed: 3\nviews: 2\ndevices: 500\n"
      "let: {wall: {uniform: [1 m, 3 m]}, dim: {log_uniform: [0.5, 2]}, few: {integer: [3, 9]}}\n"
      "scene:\n  camera: {pose: {position: [{uniform: [0 m, 1 cm]}, 0, 0]}}\n  objects:\n"
      "    - plane: {name: back, point: [0, 0, \"= wall\"], reflectivity: {even: [5 %, 95 %]}, normal: {cap: {around: [0, 0, -1], within: "
      "30 deg}}}\n"
      "    - sphere: {name: ball, center: [0, 0, {uniform: [50 cm, \"= wall\"]}], radius: {normal: [10 cm, 3 cm], within: [3 cm, 12 cm]}, "
      "material: {choice: {paper: 3, wood: 1}}}\n"
      "    - box: {name: box, min: [0, 0, 1], max: [0.1, 0.1, 1.1], rotation: any, material: paper, position: [0, 0, {normal: [1 m, 1 cm], "
      "within: [1.02 m, 1.2 m]}]}\n"
      "    - scatter: {name: things, count: 2, of: {sphere: {center: [0, 0, 0], radius: {uniform: [1 cm, 2 cm]}, reflectivity: 0.5}}, "
      "view: [0.5 m, 1 m]}\n"
      "set: {camera.lens.fx: {normal: [212 px, 1 px], per: device}, camera.illumination.0.power: {uniform: [1 W, 2 W], per: set}}\n",
      4000);
  EXPECT_EQ(dataset::missed_laws(draws), "");
  const std::map<std::string, std::uint64_t> counts{{"let/wall", 4000},
                                                    {"let/dim", 4000},
                                                    {"let/few", 4000},
                                                    {"camera/pose/position[0]", 8000},
                                                    {"objects/back/reflectivity", 4000},
                                                    {"objects/back/normal", 4000},
                                                    {"objects/ball/center[2]", 4000},
                                                    {"objects/ball/radius", 4000},
                                                    {"objects/ball/material", 4000},
                                                    {"objects/box/rotation", 4000},
                                                    {"objects/box/position[2]", 4000},
                                                    {"objects/things[*]/of/sphere/radius", 8000},
                                                    {"set/camera.lens.fx", 500}};
  std::map<std::string, std::uint64_t> seen;
  for (const auto& [path, one] : draws) seen[path] = one.draws();
  EXPECT_EQ(seen, counts);
}

/// Draws through a sampler that may be wrong.
template <class Draw>
DrawCounts drawn_by(const Draw& draw) {
  DrawCounts out;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    const std::uint64_t bits = dataset::random_bits({.seed = 7, .sample = i}, "a");
    const std::optional<dataset::Portion> place = draw(bits);
    if (place) out.add(*place, dataset::unit_number(dataset::random_bits({.seed = 7, .sample = i}, "b")));
  }
  return out;
}

TEST(judge, tells_samplers_that_miss_their_law) {
  using namespace dataset;
  // Each right, and with a fault that nobody sees in a few pictures.
  const auto uniform_from = [](double a) { return drawn_by([a](auto bits) { return uniform_place(uniform(a, 3, bits), 1, 3); }); };
  EXPECT_FALSE(uniform_from(1).misses());
  EXPECT_TRUE(uniform_from(1.1).misses());
  EXPECT_FALSE(drawn_by([](auto bits) { return log_uniform_place(log_uniform(1, 4, bits), 1, 4); }).misses());
  EXPECT_TRUE(drawn_by([](auto bits) { return log_uniform_place(uniform(1, 4, bits), 1, 4); }).misses());
  for (const std::pair<double, double>& within :
       {std::pair{-endless, endless}, {2.0, endless}, {-endless, -2.0}, {2.0, 2.5}, {-1.0, 0.5}}) {
    const double low = within.first, high = within.second;
    EXPECT_FALSE(drawn_by([&](auto bits) { return normal_place(normal(0, 1, low, high, bits), 0, 1, low, high); }).misses()) << low;
    EXPECT_TRUE(drawn_by([&](auto bits) {
                  return normal_place(std::clamp(normal(0, 1.2, -endless, endless, bits), low, high), 0, 1, low, high);
                }).misses())
        << low << ": clamped, and too wide";
  }
  const auto among = [](std::int64_t last) {
    return drawn_by([=](auto bits) { return place_among(static_cast<double>(integer(0, last, bits)), 7); });
  };
  EXPECT_FALSE(among(6).misses());
  EXPECT_TRUE(among(5).misses());
  const std::vector<double> weights{3, 0, 1}, others{3, 1, 1};
  EXPECT_FALSE(drawn_by([&](auto bits) { return place_by_weight(weighted(weights, bits), weights); }).misses());
  EXPECT_TRUE(drawn_by([&](auto bits) { return place_by_weight(weighted(others, bits), weights); }).misses());
}

TEST(judge, says_nothing_of_a_few_draws_and_of_ends_without_numbers_between) {
  DrawCounts few;
  for (std::uint64_t i = 0; i + 1 < DrawCounts::least; ++i) few.add({0.5, 0}, 0);
  EXPECT_FALSE(few.misses());
  few.add({0.5, 0}, 0);
  EXPECT_TRUE(few.misses());
  few.form = "uniform";
  EXPECT_TRUE(has(dataset::missed_laws({{"let/wall", few}}), "let/wall (uniform): χ² 4800.0 of 320 draws"));
  EXPECT_FALSE(dataset::uniform_place(1, 1, 1));
  EXPECT_FALSE(dataset::uniform_place(1, 1, 1 + 1e-12));
  EXPECT_FALSE(dataset::normal_place(1, 1, 0, 0, 2));
}

TEST(judge, looks_at_what_was_drawn_before_anything_was_refused) {
  // Of these samples accept takes those with a near wall alone; the sampler is right all the same.
  const Judgement draws = judged(
      "name: some\nsamples: 400\nseed: 3\naccept: [{valid: 60 %}]\nscene:\n  objects:\n    - plane: {name: wall, point: [0, 0, {uniform: "
      "[1 m, 30 m]}], reflectivity: 0.5}\n",
      400);
  EXPECT_EQ(draws.at("objects/wall/point[2]").draws(), 400U);
  EXPECT_EQ(dataset::missed_laws(draws), "");
}

}  // namespace
