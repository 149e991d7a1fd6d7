// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/noise_over_time.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "analysis/samples.h"
#include "base/rotation.h"
#include "scene/motion.h"
#include "tofray/error.h"

namespace tofray::analysis {

namespace {

template <class Of>
auto image_of(const Of& of, std::size_t pixels) {
  std::vector<decltype(of(std::size_t{0}))> out(pixels);
  for (std::size_t i = 0; i < pixels; ++i) out[i] = of(i);
  return out;
}

}  // namespace

Scene standing_still(const Scene& scene, double time_s) {
  Scene out = scene;
  out.camera.pose = scene::pose_at(scene.camera, time_s), out.camera.keyframes.clear();
  for (Object& object : out.objects) {
    if (!scene::moves(object)) continue;
    const scene::Motion motion = scene::motion_at(object, {0, 0, 0}, time_s);
    const shape::Mat turn = scene::product(motion.turn, scene::rotation_matrix(object.rotation));
    base::Mat3 rows{};
    for (std::size_t i = 0; i < 3; ++i) rows[i] = {turn.row[i].x, turn.row[i].y, turn.row[i].z};
    object.rotation = {}, object.rotation.quaternion = base::quaternion_of(rows);
    object.position = {object.position[0] + motion.shift.x, object.position[1] + motion.shift.y, object.position[2] + motion.shift.z};
    object.keyframes.clear(), object.velocity_m_per_s = object.angular_velocity_rad_per_s = {0, 0, 0};
    auto* mesh = std::get_if<Mesh>(&object.shape);
    if (mesh == nullptr || mesh->motion == nullptr || mesh->triangles == nullptr) continue;
    auto stands = std::make_shared<TriangleMesh>(*mesh->triangles);
    mesh->motion->at(time_s, stands->vertices, stands->normals);
    mesh->triangles = std::move(stands), mesh->motion = nullptr;
  }
  return out;
}

void NoiseOverTime::add(const Depth& depth) {
  check_depth(depth, "the frame");
  if (frames_ == 0) width_ = depth.width, height_ = depth.height, pixels_.assign(depth.z_m.size(), {});
  if (depth.width != width_ || depth.height != height_)
    throw Error(ErrorKind::bad_input, "error: the frames are of different sizes\n  expected frames of one camera in one mode");
  ++frames_;
  const bool known = !depth.range_m.empty() && !depth.noise_m.empty();
  const auto take = [](double value, double n, double& mean, double& squares) {
    const double off = value - mean;
    mean += off / n, squares += off * (value - mean);
  };
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (!has_depth(depth, i)) continue;
    Pixel& pixel = pixels_[i];
    const double n = ++pixel.count, z = depth.z_m[i];
    take(z, n, pixel.z, pixel.z_squares);
    if (!known) continue;
    const double range = depth.range_m[i], noise = depth.noise_m[i], of_z = noise * z / range;
    take(range, n, pixel.range, pixel.range_squares);
    pixel.least = n > 1 ? std::min(pixel.least, range) : range, pixel.most = n > 1 ? std::max(pixel.most, range) : range;
    pixel.claimed += noise * noise, pixel.of_z += of_z * of_z;
  }
}

double NoiseOverTime::sigma_of(const Pixel& pixel) {
  return pixel.count < 2 ? unknown : std::sqrt(pixel.z_squares / (static_cast<double>(pixel.count) - 1));
}

double NoiseOverTime::predicted_of(const Pixel& pixel) {
  return pixel.count < 1 || !(pixel.of_z > 0) ? unknown : std::sqrt(pixel.of_z / static_cast<double>(pixel.count));
}

std::vector<float> NoiseOverTime::sigma_m() const {
  return image_of([&](std::size_t i) { return static_cast<float>(sigma_of(pixels_[i])); }, pixels_.size());
}
std::vector<float> NoiseOverTime::mean_m() const {
  return image_of([&](std::size_t i) { return static_cast<float>(pixels_[i].count > 0 ? pixels_[i].z : unknown); }, pixels_.size());
}
std::vector<std::uint32_t> NoiseOverTime::counts() const {
  return image_of([&](std::size_t i) { return pixels_[i].count; }, pixels_.size());
}
std::vector<float> NoiseOverTime::predicted_m() const {
  return image_of([&](std::size_t i) { return static_cast<float>(predicted_of(pixels_[i])); }, pixels_.size());
}

NoiseSummary NoiseOverTime::summary() const {
  NoiseSummary out;
  std::vector<double> sigmas, predicted, ratios;
  double valid = 0;
  for (const Pixel& pixel : pixels_) {
    const double n = pixel.count;
    valid += n;
    if (pixel.count < 2) continue;
    sigmas.push_back(sigma_of(pixel));
    if (const double one = predicted_of(pixel); std::isfinite(one)) predicted.push_back(one);
    if (static_cast<int>(pixel.count) < frames_ || !std::isfinite(pixel.claimed) || !(pixel.claimed > 0)) continue;
    const double claimed = pixel.claimed / n, far = outlier_sigmas * std::sqrt(claimed);
    if (pixel.most - pixel.range > far || pixel.range - pixel.least > far) continue;
    ratios.push_back(pixel.range_squares / (n - 1) / claimed);
  }
  const double all = static_cast<double>(pixels_.size()) * frames_;
  out.fill = all > 0 ? valid / all : unknown;
  out.sigma_median_m = median_of(std::move(sigmas)), out.predicted_median_m = median_of(std::move(predicted));
  out.chi2 = mean_of(ratios);
  return out;
}

}  // namespace tofray::analysis
