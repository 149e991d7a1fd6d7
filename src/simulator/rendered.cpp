// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of another renderer along the camera's own rays.
#include "tofray/rendered.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <set>

#include "base/limits.h"
#include "base/parallel.h"
#include "base/srgb.h"
#include "base/text.h"
#include "camera/readout/image_camera.h"
#include "flow/flow.h"
#include "model/tables.h"
#include "simulator/check.h"
#include "simulator/checks.h"
#include "simulator/surface_of_z.h"

namespace tofray::simulator::rendered {

namespace {

constexpr base::Range focal_px{1e-3, 1e9}, centre_px{-1e6, 1e6}, pixel_centre{0, 1}, margin_px{0, 1e4}, oversample{0.01, 100};
constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

template <class T>
void size(std::span<const T> array, std::size_t wanted, const char* name, bool may_lack = true) {
  if (array.size() == wanted || (may_lack && array.empty())) return;
  refuse("pictures." + std::string(name) + " has the wrong size",
         "got " + std::to_string(array.size()) + " values, expected " + std::to_string(wanted));
}

void check_pinhole(const Pinhole& pinhole) {
  within(pinhole.width, {1, 65536}, "pinhole.width"), within(pinhole.height, {1, 65536}, "pinhole.height");
  within(pinhole.fx_px, focal_px, "pinhole.fx_px"), within(pinhole.fy_px, focal_px, "pinhole.fy_px");
  within(pinhole.cx_px, centre_px, "pinhole.cx_px"), within(pinhole.cy_px, centre_px, "pinhole.cy_px");
  within(pinhole.pixel_centre, pixel_centre, "pinhole.pixel_centre");
}

void check_material(const LabelMaterial& one) {
  const std::string name = "the material of label " + std::to_string(one.label);
  const Material& m = one.material;
  if (m.brdf != Material::Brdf::lambert && m.brdf != Material::Brdf::phong)
    refuse(name + " is neither lambert nor phong", "a Geometry knows these alone; expected a reflectivity, or another material");
  within(m.diffuse, model::share, name + ": diffuse");
  if (m.brdf == Material::Brdf::lambert) return;
  within(m.specular, model::share, name + ": specular"), within(m.exponent, model::phong_exponent, name + ": exponent");
}

void check_axes(const std::array<double, 9>& m) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double product = m[3 * i] * m[3 * j] + m[3 * i + 1] * m[3 * j + 1] + m[3 * i + 2] * m[3 * j + 2];
      if (!(std::abs(product - (i == j ? 1 : 0)) < 1e-3))
        refuse("pictures.normal_axes is no rotation", "expected its rows of length 1, at right angles");
    }
}

void check_pictures(const RenderedPictures& given, const Camera& camera) {
  check_pinhole(given.pinhole);
  const std::size_t raw_frames = camera.mode.sequence.size();
  if (given.moments != 1 && (given.moments < 1 || static_cast<std::size_t>(given.moments) != raw_frames))
    refuse("pictures.moments is " + std::to_string(given.moments),
           "expected 1, or " + std::to_string(raw_frames) + ": one for each raw frame");
  const std::size_t pixels = static_cast<std::size_t>(given.moments) * static_cast<std::size_t>(given.pinhole.width) *
                             static_cast<std::size_t>(given.pinhole.height);
  size(given.z_m, pixels, "z_m", false), size(given.normal, 3 * pixels, "normal"), size(given.labels, pixels, "labels");
  size(given.reflectivity, pixels, "reflectivity"), size(given.colour, 3 * pixels, "colour"),
      size(given.screen_colour, 3 * pixels, "screen_colour");
  if (int{!given.reflectivity.empty()} + int{!given.colour.empty()} + int{!given.screen_colour.empty()} > 1)
    refuse("pictures have several reflectivities", "expected one of reflectivity, colour and screen_colour");
  if (!(given.background_m > 0)) refuse("pictures.background_m is " + base::number_text(given.background_m), "expected a distance above 0");
  if (given.other_reflectivity) within(*given.other_reflectivity, model::share, "pictures.other_reflectivity");
  if (!given.materials.empty() && given.labels.empty())
    refuse("pictures have materials without labels", "expected labels, which say where they are");
  for (const LabelMaterial& one : given.materials) check_material(one);
  check_axes(given.normal_axes);
}

/// A share of many pixels. "0.3 %"
std::string percent(double share) {
  const double shown = 100 * share;
  return base::number_text(shown < 10 ? std::round(10 * shown) / 10 : std::round(shown)) + " %";
}

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<float>(base::linear_of_srgb(static_cast<double>(i) / 255));
    return out;
  }();
  return table;
}

/// What pixels of the pictures send back.
class Reflectivities {
 public:
  explicit Reflectivities(const RenderedPictures& given) : given_(given), materials_(given.materials) {
    std::stable_sort(materials_.begin(), materials_.end(), [](const auto& a, const auto& b) { return a.label < b.label; });
    for (const LabelMaterial& one : materials_) glossy_ = glossy_ || one.material.brdf == Material::Brdf::phong;
  }
  /// Whether something shines: of all, a lobe is said then.
  [[nodiscard]] bool glossy() const { return glossy_; }
  [[nodiscard]] bool by_colour() const { return !given_.colour.empty() || !given_.screen_colour.empty(); }

  struct Found {
    float diffuse = 0, specular = 0, exponent = 1;
    bool known = true, colour = false;
  };
  /// @param i  the pixel's place in the arrays
  [[nodiscard]] Found at(std::size_t i) const {
    if (const Material* m = material_at(i)) {
      if (m->brdf == Material::Brdf::lambert) return {static_cast<float>(m->diffuse), 0, 1, true, false};
      return {static_cast<float>(m->diffuse), static_cast<float>(m->specular), static_cast<float>(m->exponent), true, false};
    }
    if (!given_.reflectivity.empty()) return {given_.reflectivity[i], 0, 1, true, false};
    if (!given_.colour.empty()) return {(given_.colour[3 * i] + given_.colour[3 * i + 1] + given_.colour[3 * i + 2]) / 3, 0, 1, true, true};
    if (!given_.screen_colour.empty()) {
      const std::array<float, 256>& linear = linear_of_byte();
      const std::uint8_t* const c = &given_.screen_colour[3 * i];
      return {(linear[c[0]] + linear[c[1]] + linear[c[2]]) / 3, 0, 1, true, true};
    }
    return {static_cast<float>(given_.other_reflectivity.value_or(0)), 0, 1, given_.other_reflectivity.has_value(), false};
  }

 private:
  [[nodiscard]] const Material* material_at(std::size_t i) const {
    if (materials_.empty()) return nullptr;
    const std::int32_t label = given_.labels[i];
    const auto found =
        std::lower_bound(materials_.begin(), materials_.end(), label, [](const LabelMaterial& m, std::int32_t l) { return m.label < l; });
    return found != materials_.end() && found->label == label ? &found->material : nullptr;
  }

  const RenderedPictures& given_;
  std::vector<LabelMaterial> materials_;
  bool glossy_ = false;
};

Direction turned(const std::array<double, 9>& m, const Direction& v) {
  return {m[0] * v[0] + m[1] * v[1] + m[2] * v[2], m[3] * v[0] + m[4] * v[1] + m[5] * v[2], m[6] * v[0] + m[7] * v[1] + m[8] * v[2]};
}

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

/// The first one, whichever thread finds it.
void keep_first(std::atomic<std::size_t>& first, std::size_t at) {
  for (std::size_t known = first; at < known && !first.compare_exchange_weak(known, at);) {}
}

/// Looks into the pictures along rays, and counts what is odd.
class Sampler {
 public:
  Sampler(const Camera& camera, const RenderedPictures& given)
      : given_(given), reflectivities_(given), rays_(pixel_rays(camera)), size_(image_size(camera)) {}

  SampledPictures run() {
    Geometry& out = out_.geometry;
    out.width = size_.width, out.height = size_.height, out.moments = given_.moments;
    const std::size_t pixels = rays_.size() / 2 * static_cast<std::size_t>(given_.moments);
    out.z_m.assign(pixels, nothing), out.normal.assign(3 * pixels, 0), out.diffuse.assign(pixels, 0);
    if (reflectivities_.glossy()) out.specular.assign(pixels, 0), out.exponent.assign(pixels, 1);
    if (!given_.labels.empty()) out.object_id.assign(pixels, -1);
    for (int moment = 0; moment < given_.moments; ++moment) {
      const DepthPicture depth(given_, moment);
      base::in_parallel(size_.height, 2, [&](int row) { look_along_row(depth, moment, row); });
    }
    say_what_is_odd(pixels);
    return std::move(out_);
  }

 private:
  void look_along_row(const DepthPicture& depth, int moment, int row);
  void look(const DepthPicture& depth, std::size_t first, int u, int v, const Direction& ray, std::size_t into);
  [[nodiscard]] Direction normal(const DepthPicture& depth, std::size_t at, int u, int v) const;
  void say_what_is_odd(std::size_t pixels);
  void compare_normals();
  void look_for_steps();
  void look_for_millimetres();

  const RenderedPictures& given_;
  Reflectivities reflectivities_;
  std::vector<float> rays_;
  ImageSize size_;
  SampledPictures out_;
  std::atomic<std::size_t> looked_{0}, outside_{0}, by_colour_{0};
  std::atomic<std::size_t> unknown_{none},
      wrong_{none};  ///< the first pixels of the pictures whose reflectivity is not given, or cannot be
};

void Sampler::look_along_row(const DepthPicture& depth, int moment, int row) {
  const auto width = static_cast<std::size_t>(size_.width);
  const std::size_t picture = static_cast<std::size_t>(given_.pinhole.width) * static_cast<std::size_t>(given_.pinhole.height);
  std::size_t looked = 0, outside = 0;
  for (std::size_t i = static_cast<std::size_t>(row) * width; i < static_cast<std::size_t>(row + 1) * width; ++i) {
    if (std::isnan(rays_[2 * i])) continue;  // where the lens has no inverse
    const Direction ray{static_cast<double>(rays_[2 * i]), static_cast<double>(rays_[2 * i + 1]), 1};
    ++looked;
    int u = 0, v = 0;
    if (depth.nearest(ray[0], ray[1], u, v))
      look(depth, static_cast<std::size_t>(moment) * picture, u, v, ray, static_cast<std::size_t>(moment) * rays_.size() / 2 + i);
    else
      ++outside;
  }
  looked_ += looked, outside_ += outside;
}

/// What one ray meets in the pixel (u, v).                                                                      [theory: picture-ray]
void Sampler::look(const DepthPicture& depth, std::size_t first, int u, int v, const Direction& ray, std::size_t into) {
  const double z = depth.z(u, v);
  if (z == 0 || z > static_cast<double>(flow::max_distance)) return;
  const std::size_t at = first + static_cast<std::size_t>(v) * static_cast<std::size_t>(given_.pinhole.width) + static_cast<std::size_t>(u);
  Geometry& out = out_.geometry;
  const Direction n = normal(depth, at, u, v), middle = depth.ray(u, v);
  const double there = dot(n, middle), here = dot(n, ray);
  const bool is_flat =
      std::abs(there) > edge_on * std::sqrt(dot(middle, middle)) && std::abs(here) > 0.5 * std::abs(there) && there * here > 0;
  out.z_m[into] = static_cast<float>(is_flat ? z * there / here : z);
  for (std::size_t k = 0; k < 3; ++k) out.normal[3 * into + k] = static_cast<float>(n[k]);
  const Reflectivities::Found found = reflectivities_.at(at);
  if (!found.known) keep_first(unknown_, at);
  if (!(found.diffuse >= 0 && found.diffuse <= 1)) keep_first(wrong_, at);
  if (found.colour) ++by_colour_;
  out.diffuse[into] = found.diffuse;
  if (!out.specular.empty()) out.specular[into] = found.specular, out.exponent[into] = found.exponent;
  if (!out.object_id.empty()) out.object_id[into] = given_.labels[at];
}

/// Of unit length, turned to the camera.
Direction Sampler::normal(const DepthPicture& depth, std::size_t at, int u, int v) const {
  if (!given_.normal.empty()) {
    const float* const n = &given_.normal[3 * at];
    Direction t = turned(given_.normal_axes, {static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])});
    const double length = std::sqrt(dot(t, t));
    if (length > 0.1 && length < 10) {
      const double scale = (dot(t, depth.ray(u, v)) > 0 ? -1 : 1) / length;
      return {t[0] * scale, t[1] * scale, t[2] * scale};
    }
  }
  return depth.normal(u, v);
}

/// The angle between two unit vectors' lines that half of the pairs stay below [degrees].
double median_degrees(std::vector<double>& cosines) {
  const auto middle = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 2);
  std::nth_element(cosines.begin(), middle, cosines.end());
  return std::acos(std::clamp(*middle, 0.0, 1.0)) * 57.29577951308232;
}

/// Normals of other axes than are said look right from some sides, and are wrong from all others: z says which they are.
void Sampler::compare_normals() {
  if (given_.normal.empty()) return;
  struct Axes {
    const char* name;
    std::array<double, 9> matrix;
  };
  const std::array<Axes, 4> all{{{"", given_.normal_axes},
                                 {"the camera's (x right, y down, z forward)", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                                 {"OpenGL's (x right, y up, z backward)", {1, 0, 0, 0, -1, 0, 0, 0, -1}},
                                 {"a body's (x forward, y left, z up)", {0, -1, 0, 0, 0, -1, 1, 0, 0}}}};
  std::array<std::vector<double>, 4> cosines;
  const DepthPicture depth(given_, 0);
  const int width = given_.pinhole.width, height = given_.pinhole.height, step = std::max(1, std::min(width, height) / 32);
  for (int v = step / 2; v < height; v += step) {
    for (int u = step / 2; u < width; u += step) {
      if (depth.z(u, v) == 0) continue;
      const float* const n =
          &given_.normal[3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u))];
      const Direction given{static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])}, made = depth.normal(u, v);
      const double length = std::sqrt(dot(given, given));
      if (!(length > 0.1 && length < 10)) continue;
      for (std::size_t k = 0; k < all.size(); ++k) cosines[k].push_back(std::abs(dot(turned(all[k].matrix, given), made)) / length);
    }
  }
  constexpr std::size_t few = 50;
  constexpr double fits = 10, does_not = 25;
  if (cosines[0].size() < few) return;
  const double angle = median_degrees(cosines[0]);
  if (!(angle > does_not)) return;
  std::string text = "normals do not fit z: half of them are off by more than " + base::number_text(std::round(angle)) + "°";
  for (std::size_t k = 1; k < all.size(); ++k)
    if (median_degrees(cosines[k]) < fits)
      return out_.notices.push_back(text + "; in axes that are " + all[k].name + " they would fit"), void();
  out_.notices.push_back(text + "; expected them in the camera's axes, x right, y down, z forward, or normal_axes to say others");
}

/// Floats that were whole millimetres: a pixel's neighbours are then a millimetre farther or as far, and a slope is one or none.
void Sampler::look_for_steps() {
  if (!given_.normal.empty()) return;
  const DepthPicture depth(given_, 0);
  std::set<double> different;
  constexpr std::size_t some = 20;
  const std::size_t picture = static_cast<std::size_t>(given_.pinhole.width) * static_cast<std::size_t>(given_.pinhole.height);
  for (std::size_t i = 0; i < picture; i += 97) {
    const auto width = static_cast<std::size_t>(given_.pinhole.width);
    if (depth.z(static_cast<int>(i % width), static_cast<int>(i / width)) == 0) continue;
    const double millimetres = 1000 * static_cast<double>(given_.z_m[i]);
    if (std::abs(millimetres - std::round(millimetres)) > 1e-3) return;
    different.insert(millimetres);
  }
  if (different.size() >= some)
    out_.notices.emplace_back(
        "z is in whole millimetres, and normals are made of its differences: they are wrong; expected finer z, or normals");
}

/// Millimetres that stand where metres are expected: half of what is seen lies beyond all cameras of this kind.
void Sampler::look_for_millimetres() {
  constexpr std::size_t step = 97;
  constexpr double beyond_all_m = 100;
  const DepthPicture depth(given_, 0);
  const auto width = static_cast<std::size_t>(given_.pinhole.width), height = static_cast<std::size_t>(given_.pinhole.height);
  std::vector<double> seen;
  for (std::size_t i = 0; i < width * height; i += step)
    if (const double z = depth.z(static_cast<int>(i % width), static_cast<int>(i / width)); z > 0) seen.push_back(z);
  if (seen.empty()) return;
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  if (*middle > beyond_all_m)
    out_.notices.push_back("z is " + base::number_text(std::round(*middle)) +
                           " m at the median: millimetres? expected metres, as in z * 0.001, or background to say a far plane");
}

void Sampler::say_what_is_odd(std::size_t pixels) {
  if (unknown_ != none)
    refuse(given_.labels.empty() ? std::string("pictures say nothing of reflectivity")
                                 : "nothing says the reflectivity of label " + std::to_string(given_.labels[unknown_]),
           "expected materials by label, a picture of reflectivity or colour, or one number for all");
  if (wrong_ != none) {
    const auto width = static_cast<std::size_t>(given_.pinhole.width),
               row = wrong_ / width % static_cast<std::size_t>(given_.pinhole.height);
    refuse("a reflectivity is " + base::number_text(static_cast<double>(reflectivities_.at(wrong_).diffuse)) + " at (column " +
               std::to_string(wrong_ % width) + ", row " + std::to_string(row) + ") of the picture",
           "expected 0 to 1");
  }
  out_.outside = looked_ == 0 ? 0 : static_cast<double>(outside_) / static_cast<double>(looked_);
  if (outside_ > 0)
    out_.notices.push_back(
        percent(out_.outside) +
        " of the camera's rays look past the picture, where nothing is seen; pinhole_for() says a picture that covers all");
  if (by_colour_ > 0)
    out_.notices.push_back("visible colour stands for reflectivity in " +
                           percent(static_cast<double>(by_colour_) / static_cast<double>(pixels)) +
                           " of the pixels; in the near infrared surfaces send back other shares, which materials by label say");
  if (given_.moments == 1 && !given_.still)
    out_.notices.emplace_back(
        "one moment stands for all raw frames: what motion does to depth is missing; exposure_times() says when to draw, still says that "
        "nothing moves");
  compare_normals();
  look_for_steps();
  look_for_millimetres();
}

}  // namespace

}  // namespace tofray::simulator::rendered

namespace tofray {

Pinhole pinhole_for(const Camera& camera, double margin_px, double oversample, double pixel_centre) {
  using simulator::within, simulator::refuse;
  simulator::check(camera);
  within(margin_px, simulator::rendered::margin_px, "margin_px"), within(oversample, simulator::rendered::oversample, "oversample");
  within(pixel_centre, simulator::rendered::pixel_centre, "pixel_centre");
  const std::vector<float> rays = pixel_rays(camera);
  double x = 0, y = 0;
  for (std::size_t i = 0; i < rays.size(); i += 2) {
    if (std::isnan(rays[i])) continue;
    x = std::max(x, std::abs(static_cast<double>(rays[i]))), y = std::max(y, std::abs(static_cast<double>(rays[i + 1])));
  }
  const Lens lens = camera::ImageCamera(camera).lens;
  const double f = oversample * std::max(lens.fx_px, lens.fy_px);
  const double half_width = std::ceil(x * f + margin_px + 0.5), half_height = std::ceil(y * f + margin_px + 0.5);
  const double pixels = 4 * half_width * half_height;
  constexpr double most = 1 << 26;
  if (pixels > most)
    refuse("no picture of a usable size covers all rays of the camera",
           "got rays at up to " + base::number_text(std::round(std::atan(std::max(x, y)) * 57.29577951308232)) + "° off the axis, " +
               base::number_text(pixels) + " pixels, at most " + base::number_text(most) +
               "\n  lower oversample, or read a region of the sensor",
           ErrorKind::limit);
  Pinhole out;
  out.width = static_cast<int>(2 * half_width), out.height = static_cast<int>(2 * half_height);
  out.fx_px = out.fy_px = f;
  out.cx_px = half_width - 0.5 + pixel_centre, out.cy_px = half_height - 0.5 + pixel_centre;
  out.pixel_centre = pixel_centre;
  return out;
}

SampledPictures from_pictures(const Camera& camera, const RenderedPictures& pictures) {
  simulator::check(camera);
  simulator::rendered::check_pictures(pictures, camera);
  return simulator::rendered::Sampler(camera, pictures).run();
}

}  // namespace tofray
