// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Draws what docs/theory/03-pixel.md shows of merged noise: the law of a tap's charge, and how far equation 3.11 is from it.
//     noise_law FOLDER      writes noise-law.png and noise-distance.png
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "pictures/chart.h"
#include "support/noise_law.h"

namespace {

using namespace tofray;
using namespace tofray::test;
using pictures::Chart;
using pictures::Curve;
using pictures::curve_color;

enum class Order { normal = 1, skew = 2, full = 3 };

/// Equation 3.11 up to an order: λ + √V·z, with the skew's term, with all.
double up_to(Order order, double mean, double read, double z) {
  if (order == Order::full) return expansion(mean, read, z);
  const double variance = mean + read * read;
  return mean + std::sqrt(variance) * z + (order == Order::skew ? mean / variance * (z * z - 1) / 6 : 0);
}

double slope(Order order, double mean, double read, double z) {
  return (up_to(order, mean, read, z + 1e-4) - up_to(order, mean, read, z - 1e-4)) / 2e-4;
}

double total_variation(Order order, double mean, double read) {
  const NoiseLaw law(mean, read);
  double sum = 0;
  for (double z = -7; z < 7; z += 0.02)
    sum += std::abs(law.density(up_to(order, mean, read, z)) * slope(order, mean, read, z) - normal_density(z)) * 0.02;
  return sum / 2;
}

Curve curve(const std::string& name, std::size_t color, bool dashed = false) { return {name, curve_color(color), dashed, {}, {}}; }

/// Density of charge where the distance is largest: the smallest read noise that is merged, 2.4 electrons.
Chart law_chart() {
  constexpr double mean = 2.4, read = 4;
  const NoiseLaw law(mean, read);
  Chart chart;
  chart.title = "Charge of one tap: shot noise of 2.4 e\u207b and read noise of 4 e\u207b";
  chart.notes = {"where equation 3.11 is furthest from the true law: half of the area between both is 0.00002"};
  chart.x_label = "charge [e\u207b]", chart.y_label = "density, and differences \u00d7 100 [1/e\u207b]";
  chart.x_ticks = {-15, -10, -5, 0, 5, 10, 15, 20};
  Curve exact = curve("true law", 0), ours = curve("eq. 3.11", 1, true);
  Curve of_ours = curve("(eq. 3.11 \u2212 true) \u00d7 100", 2), of_normal = curve("(normal \u2212 true) \u00d7 100", 3);
  for (double z = -4; z <= 4.3; z += 0.1) {
    const double x = up_to(Order::full, mean, read, z), density = normal_density(z) / slope(Order::full, mean, read, z);
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
  chart.notes = {"full: equation 3.11; dashed: without its last term; below 4 e\u207b of read noise both noises are drawn apart"};
  chart.x_label = "mean \u03bb, power of ten of electrons", chart.y_label = "total variation";
  chart.x_ticks = {-1, 0, 1, 2, 3, 4};
  chart.log_y = true;
  for (const double read : {4.0, 8.0, 50.0}) {
    for (const Order order : {Order::full, Order::skew}) {
      const std::string name =
          "\u03c3 = " + std::to_string(static_cast<int>(read)) + " e\u207b" + (order == Order::full ? "" : ", no last term");
      Curve one = curve(name, read < 5 ? 0 : read < 10 ? 1 : 2, order == Order::skew);
      for (double power = -1; power < 4.01; power += 0.1) {
        one.x.push_back(std::min(4.0, power));
        one.y.push_back(total_variation(order, std::pow(10, power), read));
      }
      chart.curves.push_back(one);
    }
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
