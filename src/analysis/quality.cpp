// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/quality.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "analysis/samples.h"
#include "analysis/step_edge.h"
#include "base/text.h"
#include "tofray/error.h"

namespace tofray {

namespace analysis {

ImageRegion region_within(const ImageRegion& region, int width, int height) {
  if (region.width == 0 && region.height == 0 && region.u == 0 && region.v == 0) return {0, 0, width, height};
  const bool fits = region.u >= 0 && region.v >= 0 && region.width > 0 && region.height > 0 && region.width <= width - region.u &&
                    region.height <= height - region.v;
  if (!fits)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: the region is not in the image\n  got column {}, row {}, {} x {} pixels, expected some of an image of "
                            "{} x {}",
                            region.u, region.v, region.width, region.height, width, height));
  return region;
}

void check_depth(const Depth& depth, const std::string& whose) {
  if (depth.z_m.empty() || depth.width <= 0 || depth.height <= 0)
    throw Error(ErrorKind::bad_input, fmt::format("error: {} has no depth\n  got no z_m, expected it by pixel; `tofray process` computes "
                                                  "depth of raw frames",
                                                  whose));
  const std::size_t pixels = static_cast<std::size_t>(depth.width) * static_cast<std::size_t>(depth.height);
  const auto fits = [&](const auto& array, std::size_t each, const char* name) {
    if (!array.empty() && array.size() != each * pixels)
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {}: {} has another size than the image\n  got {} numbers, expected {} for {} x {}", whose, name,
                              array.size(), each * pixels, depth.width, depth.height));
  };
  fits(depth.z_m, 1, "z_m"), fits(depth.range_m, 1, "range_m"), fits(depth.points_m, 3, "points_m"), fits(depth.flags, 1, "flags");
  fits(depth.amplitude_e, 1, "amplitude_e"), fits(depth.noise_m, 1, "noise_m");
}

namespace {

using Point = std::array<double, 3>;

/// a x + b y + c z + d = 0 with a normal of unit length, c not below 0: distances are above 0 behind it.
struct FittedPlane {
  Point normal{};
  double d = 0;
  [[nodiscard]] double distance(const Point& p) const { return normal[0] * p[0] + normal[1] * p[1] + normal[2] * p[2] + d; }
  [[nodiscard]] double on_axis() const { return -d / normal[2]; }
};

/// Least squares along the axis that the normal is nearest to, as the Depth Quality Tool does; none for points on a line.
std::optional<FittedPlane> fitted_plane(const std::vector<Point>& points) {
  if (points.size() < 3) return std::nullopt;
  Point middle{};
  for (const Point& p : points)
    for (std::size_t i = 0; i < 3; ++i) middle[i] += p[i] / static_cast<double>(points.size());
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (const Point& p : points) {
    const double x = p[0] - middle[0], y = p[1] - middle[1], z = p[2] - middle[2];
    xx += x * x, xy += x * y, xz += x * z, yy += y * y, yz += y * z, zz += z * z;
  }
  const double by_x = yy * zz - yz * yz, by_y = xx * zz - xz * xz, by_z = xx * yy - xy * xy;
  const double most = std::max({by_x, by_y, by_z});
  if (!(most > 0)) return std::nullopt;
  Point n{};
  if (most == by_x)
    n = {1, (xz * yz - xy * zz) / by_x, (xy * yz - xz * yy) / by_x};
  else if (most == by_y)
    n = {(yz * xz - xy * zz) / by_y, 1, (xy * xz - yz * xx) / by_y};
  else
    n = {(yz * xy - xz * yy) / by_z, (xz * xy - yz * xx) / by_z, 1};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) * (n[2] < 0 ? -1 : 1);
  FittedPlane out;
  for (std::size_t i = 0; i < 3; ++i) out.normal[i] = n[i] / length;
  out.d = -(out.normal[0] * middle[0] + out.normal[1] * middle[1] + out.normal[2] * middle[2]);
  return out;
}

Point point_of(const Depth& depth, std::size_t pixel) {
  return {depth.points_m[3 * pixel], depth.points_m[3 * pixel + 1], depth.points_m[3 * pixel + 2]};
}

/// The valid points of the region.
std::vector<Point> valid_points(const Depth& depth, const std::vector<std::size_t>& pixels) {
  std::vector<Point> out;
  for (const std::size_t pixel : pixels)
    if (has_depth(depth, pixel)) out.push_back(point_of(depth, pixel));
  return out;
}

struct PlaneNumbers {
  double on_axis = unknown, tilt = unknown, rms = unknown, rms_percent = unknown, z_accuracy_percent = unknown;
};

/// @param truth_m  NaN: unknown
PlaneNumbers plane_numbers(const Depth& depth, const std::vector<std::size_t>& pixels, double truth_m) {
  PlaneNumbers out;
  if (depth.points_m.empty()) return out;
  std::vector<Point> points = valid_points(depth, pixels);
  const std::optional<FittedPlane> plane = fitted_plane(points);
  if (!plane) return out;
  std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) { return a[2] < b[2]; });
  const std::size_t cut = points.size() / 200;
  std::vector<double> distances;
  for (std::size_t i = cut; i < points.size() - cut; ++i) distances.push_back(plane->distance(points[i]));
  out.on_axis = plane->on_axis();
  out.tilt = std::acos(std::min(1.0, plane->normal[2]));
  out.rms = std::sqrt(squares_about(distances, 0) / static_cast<double>(distances.size()));
  out.rms_percent = 100 * out.rms / out.on_axis;
  if (std::isnan(truth_m)) return out;
  std::sort(distances.begin(), distances.end());
  out.z_accuracy_percent = 100 * (out.on_axis - truth_m + distances[distances.size() / 2]) / truth_m;
  return out;
}

/// True z of the wall on the optical axis; NaN: unknown.
double wall_truth(const QualityRequest& request, const Depth* truth, const std::vector<std::size_t>& pixels) {
  if (request.truth_m > 0) return request.truth_m;
  if (truth == nullptr || truth->points_m.empty()) return unknown;
  const std::optional<FittedPlane> plane = fitted_plane(valid_points(*truth, pixels));
  return plane ? plane->on_axis() : unknown;
}

/// Mean of those that are known.
double mean_of_known(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  return mean_of(values);
}

void take_planes(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels, double truth_m, Quality& out) {
  std::vector<double> fill, on_axis, tilt, rms, percent, accuracy;
  for (const Depth& depth : frames) {
    const auto valid = std::count_if(pixels.begin(), pixels.end(), [&](std::size_t pixel) { return has_depth(depth, pixel); });
    fill.push_back(100 * static_cast<double>(valid) / static_cast<double>(pixels.size()));
    const PlaneNumbers plane = plane_numbers(depth, pixels, truth_m);
    on_axis.push_back(plane.on_axis), tilt.push_back(plane.tilt), rms.push_back(plane.rms), percent.push_back(plane.rms_percent);
    accuracy.push_back(plane.z_accuracy_percent);
  }
  out.fill_rate_percent = mean_of(fill), out.plane_distance_m = mean_of_known(on_axis), out.plane_tilt_rad = mean_of_known(tilt);
  out.plane_fit_rms_m = mean_of_known(rms), out.plane_fit_rms_percent = mean_of_known(percent);
  out.z_accuracy_percent = mean_of_known(accuracy);
}

/// A pixel's numbers of the frames in which it is valid.
std::vector<double> over_frames(const std::vector<Depth>& frames, std::vector<float> Depth::*array, std::size_t pixel) {
  std::vector<double> out;
  for (const Depth& depth : frames)
    if (has_depth(depth, pixel) && !(depth.*array).empty()) out.push_back((depth.*array)[pixel]);
  return out;
}

double temporal_noise_percent(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels) {
  if (frames.size() < 2) return unknown;
  std::vector<double> shares;
  for (const std::size_t pixel : pixels) {
    const std::vector<double> z = over_frames(frames, &Depth::z_m, pixel);
    const double sigma = z.empty() ? 0 : std::sqrt(squares_about(z, mean_of(z)) / static_cast<double>(z.size()));
    shares.push_back(z.empty() ? 0 : sigma / median_of(z));
  }
  return 100 * median_of(std::move(shares));
}

/// One pixel's range over the frames, in all of which it is valid, against its noise_m.
struct ClaimedNoise {
  bool known = false;    ///< range and noise are there
  bool outlier = false;  ///< a frame is farther from the median than noise of that size ever is: on a wrong cycle
  double variance = 0, claimed = 0;
};

ClaimedNoise claimed_noise(const std::vector<Depth>& frames, std::size_t pixel) {
  const std::vector<double> range = over_frames(frames, &Depth::range_m, pixel), noise = over_frames(frames, &Depth::noise_m, pixel);
  const auto n = static_cast<double>(frames.size());
  ClaimedNoise out;
  out.known = range.size() == frames.size() && noise.size() == frames.size() &&
              std::all_of(noise.begin(), noise.end(), [](double one) { return std::isfinite(one) && one > 0; });
  if (!out.known) return out;
  out.variance = squares_about(range, mean_of(range)) / (n - 1), out.claimed = squares_about(noise, 0) / n;
  const double middle = median_of(range), most = outlier_sigmas * std::sqrt(out.claimed);
  out.outlier = std::any_of(range.begin(), range.end(), [&](double one) { return std::fabs(one - middle) > most; });
  return out;
}

/// Noise over the frames and from pixel to pixel, of the pixels that are valid in all frames.
void take_noise(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels, Quality& out) {
  out.temporal_noise_m = out.spatial_noise_m = out.total_noise_m = out.noise_chi2 = out.noise_chi2_error = out.outliers_percent = unknown;
  const auto n = static_cast<double>(frames.size());
  std::vector<double> variances, ratios;
  std::size_t claims = 0, outliers = 0;
  std::vector<Point> means;
  for (const std::size_t pixel : pixels) {
    const std::vector<double> z = over_frames(frames, &Depth::z_m, pixel);
    if (z.size() != frames.size()) continue;
    if (frames.size() > 1) variances.push_back(squares_about(z, mean_of(z)) / (n - 1));
    if (!frames[0].points_m.empty()) {
      Point mean{};
      for (const Depth& depth : frames)
        for (std::size_t i = 0; i < 3; ++i) mean[i] += depth.points_m[3 * pixel + i] / n;
      means.push_back(mean);
    }
    if (frames.size() < 2) continue;
    const ClaimedNoise noise = claimed_noise(frames, pixel);
    claims += noise.known ? 1 : 0, outliers += noise.outlier ? 1 : 0;
    if (noise.known && !noise.outlier) ratios.push_back(noise.variance / noise.claimed);
  }
  const double temporal2 = mean_of(variances);  // NaN of one frame
  out.temporal_noise_m = std::sqrt(temporal2);
  if (claims > 0) out.outliers_percent = 100 * static_cast<double>(outliers) / static_cast<double>(claims);
  out.noise_chi2 = mean_of(ratios);
  if (!ratios.empty()) out.noise_chi2_error = std::sqrt(2 / ((n - 1) * static_cast<double>(ratios.size())));
  const std::optional<FittedPlane> plane = means.size() > 3 ? fitted_plane(means) : std::nullopt;
  if (!plane) return;
  double squares = 0;
  for (const Point& p : means) {
    const double along =
        (plane->normal[0] * p[0] + plane->normal[1] * p[1]) / p[2] + plane->normal[2];  // the pixel's ray against the normal
    squares += std::pow(plane->distance(p) / along, 2);
  }
  const double about_plane2 = squares / static_cast<double>(means.size() - 3);
  if (frames.size() == 1) {
    out.total_noise_m = std::sqrt(about_plane2);
    return;
  }
  const double spatial2 = std::max(0.0, about_plane2 - temporal2 / n);
  out.spatial_noise_m = std::sqrt(spatial2), out.total_noise_m = std::sqrt(temporal2 + spatial2);
}

void take_bias(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels, const Depth* truth, Quality& out) {
  std::vector<double> errors;
  if (truth != nullptr)
    for (const Depth& depth : frames)
      for (const std::size_t pixel : pixels)
        if (has_depth(depth, pixel) && has_depth(*truth, pixel))
          errors.push_back(static_cast<double>(depth.z_m[pixel]) - static_cast<double>(truth->z_m[pixel]));
  out.bias_m = mean_of(errors), out.bias_median_m = median_of(errors);
  out.rmse_m = errors.empty() ? unknown : std::sqrt(squares_about(errors, 0) / static_cast<double>(errors.size()));
}

/// Mean of the frames in which a pixel is valid; NaN: in none.
std::vector<double> mean_image(const std::vector<Depth>& frames, std::vector<float> Depth::*array, const std::vector<std::size_t>& pixels) {
  std::vector<double> out;
  out.reserve(pixels.size());
  for (const std::size_t pixel : pixels) out.push_back(mean_of(over_frames(frames, array, pixel)));
  return out;
}

void take_amplitude(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels, Quality& out) {
  std::vector<double> image = mean_image(frames, &Depth::amplitude_e, pixels);
  std::erase_if(image, [](double value) { return std::isnan(value); });
  out.amplitude_e = mean_of(image);
  out.amplitude_spread_percent =
      100 * std::sqrt(squares_about(image, out.amplitude_e) / static_cast<double>(image.size())) / out.amplitude_e;
}

/// Of the valid pixels near the step, those between its surfaces.
double flying_percent(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels, const StepEdge& edge, int width) {
  constexpr double near_px = 2;
  std::size_t beside = 0, between = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t row = i / static_cast<std::size_t>(width), column = i % static_cast<std::size_t>(width);
    const double away = edge.by_rows ? static_cast<double>(column) - edge.middle[row] : static_cast<double>(row) - edge.middle[column];
    if (!(std::fabs(away) <= near_px)) continue;
    for (const Depth& depth : frames) {
      if (!has_depth(depth, pixels[i])) continue;
      const double level = (depth.z_m[pixels[i]] - edge.near_m) / (edge.far_m - edge.near_m);
      ++beside, between += level > 0.1 && level < 0.9 ? 1 : 0;
    }
  }
  return beside == 0 ? unknown : 100 * static_cast<double>(between) / static_cast<double>(beside);
}

void take_edge(const std::vector<Depth>& frames, const std::vector<std::size_t>& pixels, const Depth* truth, Quality& out) {
  out.edge_step_m = out.edge_width_px = out.edge_shift_px = out.flying_pixels_percent = out.flying_flags_percent = unknown;
  if (!frames[0].flags.empty()) {
    std::size_t flagged = 0;
    for (const Depth& depth : frames)
      for (const std::size_t pixel : pixels) flagged += !depth.flags.empty() && (depth.flags[pixel] & flag_flying_pixel) != 0 ? 1 : 0;
    out.flying_flags_percent = 100 * static_cast<double>(flagged) / static_cast<double>(pixels.size() * frames.size());
  }
  const int width = out.region.width, height = out.region.height;
  const StepEdge edge = step_edge(mean_image(frames, &Depth::z_m, pixels), width, height);
  if (!edge.found) return;
  out.edge_step_m = edge.far_m - edge.near_m, out.edge_width_px = edge.width_px;
  out.flying_pixels_percent = flying_percent(frames, pixels, edge, width);
  if (truth == nullptr) return;
  const StepEdge right = step_edge(mean_image({*truth}, &Depth::z_m, pixels), width, height);
  if (!right.found || right.by_rows != edge.by_rows) return;
  std::vector<double> shifts;
  for (std::size_t i = 0; i < edge.middle.size(); ++i)
    if (!std::isnan(edge.middle[i]) && !std::isnan(right.middle[i]))
      shifts.push_back((edge.middle[i] - right.middle[i]) * (right.near_first ? 1 : -1));
  out.edge_shift_px = median_of(shifts);
}

const QualityPreset& preset_of(const std::string& name) {
  std::vector<std::string> names;
  for (const QualityPreset& one : quality_presets()) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  throw Error(ErrorKind::bad_input, fmt::format("error: no maker's conditions are called {}{}\n  expected {}", base::in_quotes(name),
                                                base::did_you_mean(name, names), base::listed(names)));
}

/// Region and notes of a preset.
void take_preset(const QualityRequest& request, const Depth& first, std::size_t frames, Quality& out) {
  ImageRegion region = request.region;
  if (!request.preset.empty()) {
    const QualityPreset& preset = preset_of(request.preset);
    const bool own = region.width != 0 || region.height != 0 || region.u != 0 || region.v != 0;
    if (!own && preset.side > 0) {
      const int width = std::min(preset.side, first.width), height = std::min(preset.side, first.height);
      region = {(first.width - width) / 2, (first.height - height) / 2, width, height};
      if (width < preset.side || height < preset.side)
        out.notes.push_back(fmt::format("{} measures {} x {} pixels; the image has fewer", preset.maker, preset.side, preset.side));
    } else if (own && preset.side > 0) {
      out.notes.push_back(fmt::format("{} measures {} x {} pixels in the middle, not this region", preset.maker, preset.side, preset.side));
    }
    if (frames < static_cast<std::size_t>(preset.frames))
      out.notes.push_back(fmt::format("{} takes {} frames; these are {}", preset.maker, preset.frames, frames));
  }
  out.region = region_within(region, first.width, first.height);
}

}  // namespace

}  // namespace analysis

const std::vector<QualityPreset>& quality_presets() {
  static const std::vector<QualityPreset> all = {
      {"realsense", "RealSense", 0, 40, "a flat wall; the region is the user's", ""},
      {"basler", "Basler blaze", 40, 25, "a flat white target of 90 %, no ambient light, 22 degC, 20 min after the start",
       "accuracy +-5 mm from 0.5 to 5.5 m"},
      {"vzense", "Vzense DS86/DS87", 10, 32, "a flat grey target of 40 %, 80 x 80 cm, 200 lx, 22 degC, 20 min after the start", ""},
      {"azure", "Azure Kinect", 0, 1, "a target of 15 % to 95 % at 850 nm, ambient light 2.2 uW/cm2/nm",
       "noise up to 17 mm, bias below 11 mm + 0.1 % of the distance"},
      {"adtf3175", "ADTF3175", 0, 1, "a target of 15 % or more, less than 5 klx", "noise up to 15 mm, accuracy +-3 mm from 0.4 to 4 m"},
  };
  return all;
}

Depth depth_of(const Truth& truth) {
  Depth out;
  out.width = truth.width, out.height = truth.height;
  out.z_m = truth.z_m, out.range_m = truth.range_m, out.points_m = truth.position_m;
  return out;
}

Quality quality(const std::vector<Depth>& frames, const QualityRequest& request, const Depth* truth) {
  if (frames.empty())
    throw Error(ErrorKind::bad_input, "error: there is no frame\n  expected one at least, and two or more for noise over time");
  const Depth& first = frames.front();
  const auto same = [&](const Depth& depth, const std::string& whose) {
    analysis::check_depth(depth, whose);
    if (depth.width != first.width || depth.height != first.height)
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} has another size than frame 0\n  got {} x {}, expected {} x {}: frames of one "
                              "camera in one mode",
                              whose, depth.width, depth.height, first.width, first.height));
  };
  for (std::size_t i = 0; i < frames.size(); ++i) same(frames[i], fmt::format("frame {}", i));
  if (truth != nullptr) same(*truth, "the truth");
  if (!(request.truth_m >= 0 && std::isfinite(request.truth_m)))
    throw Error(ErrorKind::bad_input,
                fmt::format("error: the true distance cannot be {:g} m\n  expected one above 0, or 0: unknown", request.truth_m));
  Quality out;
  out.frames = static_cast<int>(frames.size());
  analysis::take_preset(request, first, frames.size(), out);
  const std::vector<std::size_t> pixels = analysis::pixels_of(out.region, first.width);
  const bool any = std::any_of(frames.begin(), frames.end(), [&](const Depth& depth) {
    return std::any_of(pixels.begin(), pixels.end(), [&](std::size_t pixel) { return analysis::has_depth(depth, pixel); });
  });
  if (!any)
    throw Error(ErrorKind::bad_input,
                "error: no pixel of the region has a depth\n  expected some; `tofray inspect FILE` says why pixels are invalid");
  analysis::take_planes(frames, pixels, analysis::wall_truth(request, truth, pixels), out);
  out.temporal_noise_percent = analysis::temporal_noise_percent(frames, pixels);
  analysis::take_noise(frames, pixels, out);
  analysis::take_bias(frames, pixels, truth, out);
  analysis::take_amplitude(frames, pixels, out);
  analysis::take_edge(frames, pixels, truth, out);
  return out;
}

}  // namespace tofray
