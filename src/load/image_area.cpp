// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/image_area.h"

#include <algorithm>
#include <string>

namespace tofray::load {

using yaml::Value;

void take_region(const Value& region, Camera& camera, base::Faults& faults) {
  if (!region || !region.good) return;
  Sensor& sensor = camera.sensor;
  const auto of = [&](const char* key) { return static_cast<int>(region[key].number); };
  const int left = of("left"), top = of("top"), width = of("width"), height = of("height");
  if (left + width > sensor.width || top + height > sensor.height) {
    faults.add(region.place(), "the region reaches over the sensor's edge",
               "got columns " + std::to_string(left) + " to " + std::to_string(left + width - 1) + " and rows " + std::to_string(top) +
                   " to " + std::to_string(top + height - 1) + " of " + std::to_string(sensor.width) + " x " +
                   std::to_string(sensor.height));
    return;
  }
  sensor.width = width, sensor.height = height;
  camera.lens.cx_px -= left, camera.lens.cy_px -= top;
}

namespace {

constexpr double most_charge = 1e30;  // wells without a bottom stay so

/// What collects charge is n² times as much; what differs from pixel to pixel averages; what is read is read once.
void collect_together(double n, Pixel& pixel) {
  for (double* charge : {&pixel.full_well_e, &pixel.dark_current_e_per_s, &pixel.suppression_threshold_e, &pixel.suppression_budget_e})
    *charge = std::min(*charge * n * n, most_charge);
  for (double* by_chance : {&pixel.prnu, &pixel.delay_s, &pixel.phase_offset_rad}) *by_chance /= n;
  // Only pixels at the rim have neighbours: n of n².
  for (double* share : {&pixel.crosstalk_left_right, &pixel.crosstalk_up_down, &pixel.blooming_share}) *share /= n;
}

}  // namespace

void take_binning(const Value& binning, Camera& camera, base::Faults& faults) {
  if (!binning || !binning.good || binning.number == 1) return;
  Sensor& sensor = camera.sensor;
  Lens& lens = camera.lens;
  const auto count = static_cast<int>(binning.number);
  const double n = count;
  if (sensor.width % count != 0 || sensor.height % count != 0)
    return faults.add(binning.place(), "the binning leaves pixels over",
                      "got " + std::to_string(sensor.width) + " x " + std::to_string(sensor.height) + " pixels by " +
                          std::to_string(count) + "; choose a region of a multiple of it");
  if (sensor.mask.kind == PixelMask::Kind::table || lens.scatter.kind == Scatter::Kind::kernel)
    return faults.add(binning.place(), "sensor.mask and lens.scatter.kernel are those of single pixels",
                      "got binning beside one of them; give the profile of the binned camera instead");
  sensor.width /= count, sensor.height /= count, sensor.pixel_pitch_m *= n;
  lens.fx_px /= n, lens.fy_px /= n;
  lens.cx_px = (lens.cx_px - 0.5 * (n - 1)) / n, lens.cy_px = (lens.cy_px - 0.5 * (n - 1)) / n;
  for (double& sigma : lens.scatter.sigma_px) sigma /= n;
  collect_together(n, camera.pixel);
}

}  // namespace tofray::load
