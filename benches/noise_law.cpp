// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Draws what docs/theory/03-pixel.md shows of merged noise: the law of a tap's charge, and how far [theory: merged-noise] is from it.
//     noise_law FOLDER      writes noise-law.png and noise-distance.png
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "pictures/chart.h"
#include "support/noise_law.h"

namespace {

using namespace tofray;
using namespace tofray::test;
using pictures::Chart;
using pictures::Curve;
using pictures::curve_color;

/// [theory: merged-noise] without its last term.
double second_order(double mean, double read, double z) {
  const double variance = mean + read * read;
  return mean + std::sqrt(variance) * z + mean / variance * (z * z - 1) / 6;
}

Curve curve(const std::string& name, std::size_t color, bool dashed = false) { return {name, curve_color(color), dashed, {}, {}}; }

/// Density of charge where the distance is largest: the smallest read noise that is merged, 2.4 electrons.
Chart law_chart() {
  constexpr double mean = 2.4, read = 4;
  const NoiseLaw law(mean, read);
  const auto charge = [&](double z) { return expansion(mean, read, z); };
  Chart chart;
  chart.title = "Charge of one tap: shot noise of 2.4 e\u207b and read noise of 4 e\u207b";
  chart.notes = {"where merged noise is furthest from the true law: half of the area between both is 0.00002"};
  chart.x_label = "charge [e\u207b]", chart.y_label = "density, and differences \u00d7 100 [1/e\u207b]";
  chart.x_ticks = {-15, -10, -5, 0, 5, 10, 15, 20};
  Curve exact = curve("true law", 0), ours = curve("merged noise", 1, true);
  Curve of_ours = curve("(merged noise \u2212 true) \u00d7 100", 2), of_normal = curve("(normal \u2212 true) \u00d7 100", 3);
  for (double z = -4; z <= 4.3; z += 0.1) {
    const double x = charge(z), density = normal_density(z) / slope_of(charge, z);
    if (x < -15 || x > 20) continue;
    const double of_a_normal = normal_density((x - mean) / std::sqrt(mean + read * read)) / std::sqrt(mean + read * read);
    for (Curve* one : {&exact, &ours, &of_ours, &of_normal}) one->x.push_back(x);
    exact.y.push_back(law.density(x)), ours.y.push_back(density);
    of_ours.y.push_back(100 * (density - law.density(x))), of_normal.y.push_back(100 * (of_a_normal - law.density(x)));
  }
  chart.curves = {exact, ours, of_ours, of_normal};
  return chart;
}

/// Total variation against the mean.
Chart distance_chart() {
  Chart chart;
  chart.title = "Distance from the true law (total variation)";
  chart.notes = {"full: merged noise; dashed: without its last term; below 4 e\u207b of read noise both noises are drawn apart"};
  chart.x_label = "mean \u03bb, power of ten of electrons", chart.y_label = "total variation";
  chart.x_ticks = {-1, 0, 1, 2, 3, 4};
  chart.log_y = true;
  for (const double read : {4.0, 8.0, 50.0}) {
    const std::string name = "\u03c3 = " + std::to_string(static_cast<int>(read)) + " e\u207b";
    const std::size_t color = read < 5 ? 0 : read < 10 ? 1 : 2;
    Curve full = curve(name, color), shorter = curve(name + ", no last term", color, true);
    for (int tenths = -10; tenths <= 40; ++tenths) {
      const double power = tenths / 10.0, mean = std::pow(10, power);
      const NoiseLaw law(mean, read);
      full.x.push_back(power), shorter.x.push_back(power);
      full.y.push_back(total_variation(law, [&](double z) { return expansion(mean, read, z); }));
      shorter.y.push_back(total_variation(law, [&](double z) { return second_order(mean, read, z); }));
    }
    chart.curves.insert(chart.curves.end(), {full, shorter});
  }
  return chart;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const std::filesystem::path folder = words[1];
  std::ofstream(folder / "noise-law.png", std::ios::binary) << pictures::chart_png(law_chart());
  std::ofstream(folder / "noise-distance.png", std::ios::binary) << pictures::chart_png(distance_chart());
}
