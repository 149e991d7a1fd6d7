// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "simulator/input.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "base/limits.h"
#include "base/readout.h"
#include "base/text.h"
#include "camera/frozen_camera.h"
#include "camera/readout/image_camera.h"
#include "model/tables.h"
#include "simulator/check.h"
#include "simulator/checks.h"

namespace tofray::simulator {

namespace {

// What arrays that come from elsewhere may hold.
constexpr base::Range bins_m{0, 1e6}, bin_width_m{1e-6, 1e6}, pixel_power_w{0, 1}, path_length_m{0, 1e6}, ambient_e_per_s{0, 1e20},
    unit_length{0.999, 1.001};

template <class Vector>
const typename Vector::value_type* data_of(const Vector& array) {
  return array.empty() ? nullptr : array.data();
}

/// Looks at the arrays of one input, each called by its name behind `path`.
class Look {
 public:
  Look(const std::string& path, int width, int height, int moments, const camera::ImageCamera& camera)
      : path_(path),
        width_(static_cast<std::size_t>(camera.sensor.width)),
        pixels_(width_ * static_cast<std::size_t>(camera.sensor.height)) {
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
  [[nodiscard]] std::size_t image() const { return pixels_; }
  [[nodiscard]] std::size_t pixels() const { return moments_ * pixels_; }
  [[nodiscard]] std::size_t by_light() const { return pixels() * lights_; }

  template <class T>
  void size(const std::vector<T>& array, std::size_t wanted, const char* name) const {
    if (array.size() == wanted) return;
    refuse(path_ + "." + name + " has the wrong size",
           "got " + std::to_string(array.size()) + " values, expected " + std::to_string(wanted));
  }
  template <class T>
  void size_or_empty(const std::vector<T>& array, std::size_t wanted, const char* name) const {
    if (!array.empty()) size(array, wanted, name);
  }
  void value(float value, const base::Range& range, const char* name, std::size_t i, const char* of = "", std::size_t each = 1) const {
    if (!range.contains(static_cast<double>(value))) within(static_cast<double>(value), range, place(name, i, of, each));
  }
  /// @param of, each  what a moment's images are of ("light", "path"), and how many there are
  void values(const std::vector<float>& array, const base::Range& range, const char* name, const char* of, std::size_t each) const {
    for (std::size_t i = 0; i < array.size(); ++i) value(array[i], range, name, i, of, each);
  }
  /// "geometry.z_m, moment 2, pixel (column 7, row 12)"
  [[nodiscard]] std::string place(const char* name, std::size_t i, const char* of = "", std::size_t each = 1) const {
    const std::size_t image = i / pixels_, at = i % pixels_;
    std::string text = path_ + "." + name;
    if (moments_ > 1) text += ", moment " + std::to_string(image / each);
    if (each > 1) text += ", " + std::string(of) + " " + std::to_string(image % each);
    return text + ", pixel (column " + std::to_string(at % width_) + ", row " + std::to_string(at / width_) + ")";
  }

 private:
  std::string path_;
  std::size_t width_, pixels_, moments_ = 1, lights_ = 0;
};

}  // namespace

OwnInput input_of(const Geometry& seen, const camera::ImageCamera& camera) {
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
  OwnInput own;
  pipeline::Input& input = own.input;
  input.entry = Stage::power, input.moments = seen.moments;
  input.surface = {seen.z_m.data(),        seen.normal.data(),      seen.diffuse.data(),  data_of(seen.specular),
                   data_of(seen.exponent), data_of(seen.object_id), data_of(seen.shadow), data_of(seen.sun_shadow)};
  return own;
}

namespace {

std::string text_of(float value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Which light each path comes from.
std::vector<std::int32_t> lights_of_paths(const PixelLight& light, std::size_t lights) {
  std::vector<std::int32_t> out(light.light_of_path.begin(), light.light_of_path.end());
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out[i] >= 0 && static_cast<std::size_t>(out[i]) < lights) continue;
    refuse("pixel light.light_of_path[" + std::to_string(i) + "] is " + std::to_string(out[i]),
           "the camera has " + std::to_string(lights) + " light sources, counted from 0");
  }
  for (std::size_t l = 0; out.size() < lights && light.light_of_path.empty(); ++l) out.push_back(static_cast<std::int32_t>(l));
  return out;
}

/// How many harmonics of each modulation frequency there are. No phasor is longer than the powers that it is the sum of.
std::size_t check_phasors(const PixelLight& light, const Look& look, std::size_t lights, std::size_t modulations) {
  if (!light.path_length_m.empty() || !light.light_of_path.empty()) {
    refuse("pixel light has both paths and phasors", "give path_length_m (and light_of_path), or phasor_w");
  }
  const std::size_t one = look.by_light() * modulations;
  if (one == 0 || light.phasor_w.size() % one != 0) {
    refuse("pixel light.phasor_w has the wrong size",
           "got " + std::to_string(light.phasor_w.size()) + " values, expected a multiple of " + std::to_string(one) +
               ": [moment][light][modulation "
               "frequency][harmonic][height][width], the camera has " +
               std::to_string(lights) + " lights and " + std::to_string(modulations) + " modulation frequencies");
  }
  const std::size_t orders = light.phasor_w.size() / one, pixels = look.image();
  for (std::size_t i = 0; i < light.phasor_w.size(); ++i) {
    const float most = light.power_w[i / (pixels * orders * modulations) * pixels + i % pixels];
    if (std::abs(light.phasor_w[i]) <= most * 1.0001f) continue;
    refuse("pixel light.phasor_w[" + std::to_string(i) + "] is longer than its light's power",
           "got " + text_of(std::abs(light.phasor_w[i])) + " W of " + text_of(most) + " W");
  }
  return orders;
}

}  // namespace

OwnInput input_of(const PixelLight& light, const camera::ImageCamera& camera) {
  const Look look("pixel light", light.width, light.height, light.moments, camera);
  OwnInput own;
  own.light_of_path = lights_of_paths(light, camera.illumination.size());
  const bool phasors = !light.phasor_w.empty();
  const std::size_t paths = phasors ? camera.illumination.size() : own.light_of_path.size();
  look.size(light.power_w, look.pixels() * paths, "power_w");
  if (!phasors) look.size(light.path_length_m, look.pixels() * paths, "path_length_m");
  look.size_or_empty(light.ambient_e_per_s, look.pixels(), "ambient_e_per_s");
  look.values(light.power_w, pixel_power_w, "power_w", phasors ? "light" : "path", paths);
  look.values(light.path_length_m, path_length_m, "path_length_m", "path", paths);
  look.values(light.ambient_e_per_s, ambient_e_per_s, "ambient_e_per_s", "", 1);
  const std::size_t orders =
      phasors ? check_phasors(light, look, camera.illumination.size(), camera::modulations_of(camera.mode).frequency_hz.size()) : 0;
  own.input.entry = Stage::raw, own.input.moments = light.moments;
  own.input.light = {data_of(light.power_w),
                     data_of(light.path_length_m),
                     data_of(own.light_of_path),
                     phasors ? 0 : static_cast<std::int32_t>(paths),
                     phasors ? reinterpret_cast<const float*>(light.phasor_w.data()) : nullptr,
                     static_cast<std::int32_t>(orders),
                     data_of(light.ambient_e_per_s),
                     static_cast<std::int32_t>(camera.illumination.size()),
                     0};
  return own;
}

namespace {

void check_histograms(const Transient& light, const camera::ImageCamera& camera) {
  const Look look("transient", light.width, light.height, 1, camera);
  within(light.bins, {1, 1e6}, "transient.bins");
  within(light.first_m, bins_m, "transient.first_m"), within(light.bin_width_m, bin_width_m, "transient.bin_width_m");
  const std::int64_t values = light.bins * static_cast<std::int64_t>(look.image()), most = base::limit::transient_values.value;
  if (values > most)
    refuse("the histograms of light by path length are too large",
           "got " + std::to_string(light.bins) + " bins for each of " + std::to_string(look.image()) + " pixels, " +
               std::to_string(values) + " values, at most " + std::to_string(most) + "\n  take fewer bins, each of them wider",
           ErrorKind::limit);
  look.size(light.e_per_s, static_cast<std::size_t>(values), "e_per_s");
  look.size_or_empty(light.ambient_e_per_s, look.image(), "ambient_e_per_s");
  look.values(light.e_per_s, ambient_e_per_s, "e_per_s", "bin", static_cast<std::size_t>(light.bins));
  look.values(light.ambient_e_per_s, ambient_e_per_s, "ambient_e_per_s", "", 1);
}

}  // namespace

OwnInput input_of(const Transient& light, const camera::ImageCamera& camera, const pipeline::Setup& setup) {
  check_histograms(light, camera);
  if (camera.illumination.empty()) refuse("the camera has no light source", "a histogram does not say how its light is modulated");
  const std::vector<double> frequencies = camera::modulations_of(camera.mode).frequency_hz;
  if (frequencies.empty()) refuse("the camera's mode has no lit raw frame", "a histogram is of light by the camera's illumination");
  check_one_waveform(setup);
  OwnInput own;
  own.sums = sums_of(light, frequencies, camera.refractive_index, setup.phasors.orders);
  own.input.entry = Stage::raw, own.input.moments = 1;
  own.input.light = {own.sums.rate.data(),           nullptr, nullptr, 0, own.sums.phasor.data(), setup.phasors.orders,
                     data_of(light.ambient_e_per_s), 1,       1};
  return own;
}

OwnInput input_of(const Raw& raw) {
  OwnInput own;
  own.input.entry = Stage::depth;
  own.input.recording = {data_of(raw.raw), data_of(raw.tap_a), data_of(raw.tap_b)};
  return own;
}

}  // namespace tofray::simulator

tofray::ImageSize tofray::image_size(const Camera& camera) {
  simulator::check(camera);
  const base::ImageExtent image = base::image_extent(camera);
  return {image.width, image.height};
}

std::vector<float> tofray::pixel_rays(const Camera& camera) {
  simulator::check(camera);
  const camera::FrozenCamera frozen(camera, false, 0);
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
