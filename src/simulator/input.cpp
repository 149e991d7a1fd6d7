// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/input.h"

#include <cmath>
#include <limits>

#include "base/text.h"
#include "camera/frozen_camera.h"
#include "model/tables.h"
#include "simulator/check.h"
#include "simulator/checks.h"

namespace tofray::simulator {

namespace {

// What arrays that come from elsewhere may hold.
constexpr base::Range pixel_power_w{0, 1}, path_length_m{0, 1e6}, ambient_e_per_s{0, 1e20}, unit_length{0.999, 1.001};

template <class T>
const T* data_of(const std::vector<T>& array) {
  return array.empty() ? nullptr : array.data();
}

/// Looks at the arrays of one input, each called by its name behind `path`.
class Look {
 public:
  Look(const std::string& path, int width, int height, int moments, const Camera& camera)
      : path_(path), width_(static_cast<std::size_t>(camera.sensor.width)), pixels_(width_ * static_cast<std::size_t>(camera.sensor.height)) {
    if (width != camera.sensor.width || height != camera.sensor.height) {
      refuse(path + " has the wrong size", "got " + std::to_string(width) + " × " + std::to_string(height) + " pixels, the camera has " +
                                               std::to_string(camera.sensor.width) + " × " + std::to_string(camera.sensor.height));
    }
    const std::size_t raw_frames = camera.mode.sequence.size();
    if (moments != 1 && (moments < 1 || static_cast<std::size_t>(moments) != raw_frames)) {
      refuse(path + ".moments is " + std::to_string(moments), "expected 1, or " + std::to_string(raw_frames) + ": one for each raw frame");
    }
    moments_ = static_cast<std::size_t>(moments), lights_ = camera.illumination.size();
  }
  [[nodiscard]] std::size_t pixels() const { return moments_ * pixels_; }
  [[nodiscard]] std::size_t by_light() const { return pixels() * lights_; }

  template <class T>
  void size(const std::vector<T>& array, std::size_t wanted, const char* name) const {
    if (array.size() == wanted) return;
    refuse(path_ + "." + name + " has the wrong size", "got " + std::to_string(array.size()) + " values, expected " + std::to_string(wanted));
  }
  template <class T>
  void size_or_empty(const std::vector<T>& array, std::size_t wanted, const char* name) const {
    if (!array.empty()) size(array, wanted, name);
  }
  void value(float value, const base::Range& range, const char* name, std::size_t i, bool has_lights = false) const {
    if (!range.contains(static_cast<double>(value))) within(static_cast<double>(value), range, place(name, i, has_lights));
  }
  void values(const std::vector<float>& array, const base::Range& range, const char* name, bool has_lights) const {
    for (std::size_t i = 0; i < array.size(); ++i) value(array[i], range, name, i, has_lights);
  }
  /// "geometry.z_m, moment 2, pixel (column 7, row 12)"
  [[nodiscard]] std::string place(const char* name, std::size_t i, bool has_lights = false) const {
    const std::size_t image = i / pixels_, at = i % pixels_, lights = has_lights ? lights_ : 1;
    std::string text = path_ + "." + name;
    if (moments_ > 1) text += ", moment " + std::to_string(image / lights);
    if (lights > 1) text += ", light " + std::to_string(image % lights);
    return text + ", pixel (column " + std::to_string(at % width_) + ", row " + std::to_string(at / width_) + ")";
  }

 private:
  std::string path_;
  std::size_t width_, pixels_, moments_ = 1, lights_ = 0;
};

}  // namespace

pipeline::Input input_of(const Geometry& seen, const Camera& camera) {
  const Look look("geometry", seen.width, seen.height, seen.moments, camera);
  look.size(seen.z_m, look.pixels(), "z_m");
  look.size(seen.normal, 3 * look.pixels(), "normal");
  look.size(seen.diffuse, look.pixels(), "diffuse");
  look.size_or_empty(seen.specular, look.pixels(), "specular");
  if (seen.specular.empty() != seen.exponent.empty()) {
    refuse("geometry has specular or exponent without the other", "expected both, or neither for Lambertian surfaces");
  }
  look.size_or_empty(seen.exponent, look.pixels(), "exponent");
  look.size_or_empty(seen.object_id, look.pixels(), "object_id");
  look.size_or_empty(seen.shadow, look.by_light(), "shadow");
  look.size_or_empty(seen.sun_shadow, look.pixels(), "sun_shadow");
  for (std::size_t i = 0; i < look.pixels(); ++i) {
    if (!(seen.z_m[i] > 0 && seen.z_m[i] <= flow::max_distance)) continue;
    const float* n = &seen.normal[3 * i];
    look.value(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), unit_length, "normal's length", i);
    look.value(seen.diffuse[i], model::share, "diffuse", i);
    if (seen.specular.empty()) continue;
    look.value(seen.specular[i], model::share, "specular", i);
    look.value(seen.exponent[i], model::phong_exponent, "exponent", i);
    if (seen.diffuse[i] + seen.specular[i] > 1.000001f) {
      refuse(look.place("diffuse", i) + ": diffuse + specular is more than 1", "a surface cannot send back more light than it gets");
    }
  }
  pipeline::Input input{};
  input.entry = pipeline::stage_power, input.moments = seen.moments;
  input.surface = {seen.z_m.data(),         seen.normal.data(),       seen.diffuse.data(),  data_of(seen.specular),
                   data_of(seen.exponent),  data_of(seen.object_id),  data_of(seen.shadow), data_of(seen.sun_shadow)};
  return input;
}

pipeline::Input input_of(const PixelLight& light, const Camera& camera) {
  const Look look("pixel light", light.width, light.height, light.moments, camera);
  look.size(light.power_w, look.by_light(), "power_w");
  look.size(light.path_length_m, look.by_light(), "path_length_m");
  look.size_or_empty(light.ambient_e_per_s, look.pixels(), "ambient_e_per_s");
  look.values(light.power_w, pixel_power_w, "power_w", true);
  look.values(light.path_length_m, path_length_m, "path_length_m", true);
  look.values(light.ambient_e_per_s, ambient_e_per_s, "ambient_e_per_s", false);
  pipeline::Input input{};
  input.entry = pipeline::stage_raw, input.moments = light.moments;
  input.light = {data_of(light.power_w), data_of(light.path_length_m), data_of(light.ambient_e_per_s)};
  return input;
}

pipeline::Input input_of(const Raw& raw) {
  pipeline::Input input{};
  input.entry = pipeline::stage_depth;
  input.recording = {data_of(raw.raw), data_of(raw.tap_a), data_of(raw.tap_b)};
  return input;
}

}  // namespace tofray::simulator

std::vector<float> tofray::pixel_rays(const Camera& camera) {
  simulator::check(camera);
  const camera::FrozenCamera frozen(camera, 0, 0);
  const camera::LensView& lens = frozen.lens();
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> out;
  const auto pixels = static_cast<std::size_t>(lens.width) * static_cast<std::size_t>(lens.height);
  for (std::size_t i = 0; i < pixels; ++i) {
    const bool inside = lens.vignetting[i] > 0;
    out.insert(out.end(), {inside ? lens.ray_x[i] : none, inside ? lens.ray_y[i] : none});
  }
  return out;
}
