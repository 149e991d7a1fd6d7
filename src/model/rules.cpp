// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/rules.h"

#include <algorithm>
#include <cmath>

#include "base/limits.h"
#include "base/rotation.h"
#include "base/text.h"
#include "base/vec.h"

namespace tofray::model {

using base::number_text;
using base::shortest_m;

void codes_are_in_order(const Adc& adc, Complaints& complaints) {
  const int largest = (1 << adc.bits) - 1;
  const auto within = [&](const void* member, const char* name, double code) {
    if (code > largest)
      complaints.add(
          adc, member, std::string(name) + " is above the largest code",
          "got " + number_text(code) + ", a code of " + std::to_string(adc.bits) + " bits is at most " + std::to_string(largest));
  };
  within(&adc.mid_code, "mid_code", adc.mid_code);
  within(&adc.valid_min, "valid_min", adc.valid_min);
  within(&adc.valid_max, "valid_max", adc.valid_max);
  if (adc.valid_min >= adc.valid_max)
    complaints.add(adc, &adc.valid_min, "valid_min is not below valid_max",
                   "got " + std::to_string(adc.valid_min) + " and " + std::to_string(adc.valid_max));
}

void contrast_is_full(Pixel& pixel, const Given& given) {
  if (!given(&pixel.contrast.x)) pixel.contrast = {{0}, {1}};
}

void codes_by_bits(Adc& adc, const Given& given) {
  if (!given(&adc.mid_code)) adc.mid_code = 1 << (adc.bits - 1);
  if (!given(&adc.valid_min)) adc.valid_min = 0;
  if (!given(&adc.valid_max)) adc.valid_max = (1 << adc.bits) - 1;
}

void far_is_beyond_near(const Decoding& d, Complaints& complaints) {
  if (!(d.flying_far_z_m - d.flying_near_z_m >= 1e-6))
    complaints.add(d, &d.flying_far_z_m, "far_z is not beyond near_z",
                   "got " + number_text(d.flying_far_z_m) + " m and " + number_text(d.flying_near_z_m) + " m");
}

void lit_raw_frames_have_a_frequency(const RawFrame& raw, Complaints& complaints) {
  if (raw.lit && raw.modulation_frequency_hz == 0)
    complaints.add(raw, &raw.modulation_frequency_hz, "a lit raw frame lacks modulation_frequency",
                   "expected modulation_frequency, or lit: false");
}

namespace {
/// What takes the place of one end of the ADC's valid codes has to fit the other one.
void saturation_is_in_order(const Camera& camera, Complaints& complaints) {
  const Decoding& d = camera.decoding;
  const double lower = d.lower_saturation_dn.value_or(camera.adc.valid_min), upper = d.upper_saturation_dn.value_or(camera.adc.valid_max);
  if (lower < upper || (!d.lower_saturation_dn && !d.upper_saturation_dn)) return;
  const void* member = d.lower_saturation_dn ? static_cast<const void*>(&d.lower_saturation_dn) : &d.upper_saturation_dn;
  complaints.add(d, member, "lower_saturation is not below upper_saturation",
                 "got " + number_text(lower) + " and " + number_text(upper) + ", adc.valid_min and adc.valid_max where they are not given");
}
}  // namespace

void cameras_are_within_the_limits(const Camera& camera, Complaints& complaints) {
  saturation_is_in_order(camera, complaints);
  lights_are_within_the_limits(camera, complaints);
  const Sensor& sensor = camera.sensor;
  const long long pixels = static_cast<long long>(sensor.width) * sensor.height;
  const auto raw_frames = static_cast<long long>(camera.mode.sequence.size());
  const std::string got = "got " + std::to_string(sensor.width) + " x " + std::to_string(sensor.height);
  if (pixels > base::limit::sensor_pixels.value) {
    complaints.add(
        sensor, nullptr, "the sensor has too many pixels",
        got + " = " + std::to_string(pixels) + ", at most " + std::to_string(base::limit::sensor_pixels.value) + " (`tofray --limits`)",
        ErrorKind::limit);
  } else if (pixels * raw_frames > base::limit::raw_samples.value) {
    complaints.add(camera.mode, &camera.mode.sequence, "a frame has too many raw samples",
                   got + " x " + std::to_string(raw_frames) + " raw frames, at most " + std::to_string(base::limit::raw_samples.value) +
                       " (`tofray --limits`)",
                   ErrorKind::limit);
  }
}

void filter_at_the_light(Camera& camera, const Given& given) {
  if (!given(&camera.filter.center_m) && !camera.illumination.empty())
    camera.filter.center_m = camera.illumination[0].illumination_wavelength_m;
}

namespace {

/// Rows times columns of numbers, not all of them 0.
template <class T>
void check_grid(const T& record, const std::vector<double>& values, int rows, int columns, const std::string& what,
                Complaints& complaints) {
  if (rows < 0 || columns < 0 || static_cast<long long>(values.size()) != static_cast<long long>(rows) * columns)
    return complaints.add(
        record, &values, what + " does not have rows times columns numbers",
        "got " + std::to_string(values.size()) + " numbers for " + std::to_string(rows) + " x " + std::to_string(columns));
  if (std::all_of(values.begin(), values.end(), [](double value) { return value == 0; }))
    complaints.add(record, &values, what + " is 0 everywhere", "expected a number above 0");
}

}  // namespace

void masks_let_light_through(const PixelMask& mask, Complaints& complaints) {
  if (mask.kind == PixelMask::Kind::table) check_grid(mask, mask.samples, mask.rows, mask.columns, "the mask", complaints);
}

void scatter_goes_somewhere(const Scatter& scatter, Complaints& complaints) {
  if (scatter.kind == Scatter::Kind::gaussians) {
    const std::vector<double>& weights = scatter.weights;
    if (!weights.empty() && weights.size() != scatter.sigma_px.size())
      complaints.add(scatter, &weights, "the scatter has not as many weights as Gaussians",
                     "got " + std::to_string(weights.size()) + " weights for " + std::to_string(scatter.sigma_px.size()));
    if (!weights.empty() && std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; }))
      complaints.add(scatter, &weights, "the weights of the scatter are all 0", "expected one above 0");
  }
  if (scatter.kind == Scatter::Kind::kernel) {
    check_grid(scatter, scatter.kernel, scatter.rows, scatter.columns, "the kernel", complaints);
    if (scatter.rows % 2 == 0 || scatter.columns % 2 == 0)
      complaints.add(
          scatter, &scatter.kernel, "the kernel has no middle",
          "got " + std::to_string(scatter.rows) + " rows of " + std::to_string(scatter.columns) + "; expected odd numbers of both");
  }
}

void tables_shine(const Pattern& pattern, Complaints& complaints) {
  if (pattern.kind == Pattern::Kind::flat_top && (pattern.columns > 0) != (pattern.rows > 0))
    complaints.add(pattern, nullptr, "pattern has columns or rows alone", "expected both, or none");
  const long long cells = static_cast<long long>(pattern.columns) * pattern.rows;
  if (cells > base::limit::table_samples.value)
    complaints.add(pattern, pattern.kind == Pattern::Kind::table ? &pattern.samples : nullptr, "the pattern has too many samples",
                   "got " + std::to_string(pattern.columns) + " x " + std::to_string(pattern.rows) + ", at most " +
                       std::to_string(base::limit::table_samples.value),
                   ErrorKind::limit);
  if (pattern.kind != Pattern::Kind::table) return;
  const std::vector<double>& samples = pattern.samples;
  if (static_cast<long long>(samples.size()) != cells)
    complaints.add(pattern, &samples, "the pattern does not have rows times columns samples",
                   "got " + std::to_string(samples.size()) + " samples");
  if (std::all_of(samples.begin(), samples.end(), [](double sample) { return sample == 0; }))
    complaints.add(pattern, &samples, "the pattern is dark", "expected a sample above 0");
  if (pattern.rows < 2 || pattern.columns < 2)
    complaints.add(pattern, &samples, "the pattern has fewer than two rows or columns", "a constant one needs the same number four times");
}

namespace {
/// @return whether there is a quaternion
template <class Record>
bool good_quaternion(const Record& record, Complaints& complaints) {
  if (!record.quaternion) return false;
  const base::NoRotation wrong = base::why_no_rotation(*record.quaternion);
  if (!wrong.what.empty()) complaints.add(record, &record.quaternion, wrong.what, wrong.more);
  return true;
}
}  // namespace

void turns_have_an_axis(const Rotation& rotation, Complaints& complaints) {
  if (good_quaternion(rotation, complaints)) {
    if (rotation.angle_rad != 0)
      complaints.add(rotation, &rotation.angle_rad, "the rotation has a quaternion and an angle", "take the one out or the other");
  } else if (rotation.angle_rad != 0 && base::length(rotation.axis) < shortest_m)
    complaints.add(rotation, &rotation.axis, "axis has no length", "expected a direction such as [0, 0, 1]");
}

void poses_look_somewhere(const Pose& pose, Complaints& complaints) {
  using base::operator-;
  if (good_quaternion(pose, complaints)) {
    const Pose fresh;
    if (pose.look_at != fresh.look_at || pose.up != fresh.up)
      complaints.add(pose, &pose.quaternion, "the pose has a quaternion, and look_at or up",
                     "the quaternion says how the camera is turned; take it out, or leave the others as they are in a new pose");
    return;
  }
  const Vec3 view = pose.look_at - pose.position;
  const double view_length = base::length(view), up_length = base::length(pose.up);
  if (view_length < shortest_m) {
    complaints.add(pose, &pose.look_at, "the camera looks at the point where it stands", "look_at has to differ from position");
  } else if (up_length >= shortest_m && base::length(base::cross(view, pose.up)) < 1e-6 * view_length * up_length) {
    complaints.add(pose, &pose.up, "the camera's up is its direction of view",
                   "expected another direction, such as up: [0, -1, 0] or, for a view along y, up: [0, 0, 1]");
  }
}

namespace {
/// @return whether there are keyframes
template <class Key>
bool follow_each_other(const std::vector<Key>& keys, Complaints& complaints) {
  for (std::size_t i = 1; i < keys.size(); ++i)
    if (!(keys[i].time_s > keys[i - 1].time_s))
      complaints.add(keys[i], &keys[i].time_s, "a keyframe is not later than the one before",
                     "got " + number_text(keys[i].time_s) + " s after " + number_text(keys[i - 1].time_s) + " s");
  return !keys.empty();
}
}  // namespace

void objects_move_one_way(const Object& object, Complaints& complaints) {
  if (!follow_each_other(object.keyframes, complaints)) return;
  const auto only = [&](const void* member, const char* name, bool is_set) {
    if (is_set)
      complaints.add(object, member, std::string("the object has keyframes and ") + name,
                     "its keyframes say where it is; take the one out or the other");
  };
  const Vec3 zero{0, 0, 0};
  only(&object.position, "a position", object.position != zero);
  only(&object.rotation, "a rotation", base::turns(object.rotation));
  only(&object.velocity_m_per_s, "a velocity", object.velocity_m_per_s != zero);
  only(&object.angular_velocity_rad_per_s, "an angular velocity", object.angular_velocity_rad_per_s != zero);
}

void paths_have_an_aim(const Transport& transport, Complaints& complaints) {
  if (transport.max_samples != 0 && transport.max_samples < 2 * transport.samples)
    complaints.add(transport, &transport.max_samples, "max_samples is less than twice samples",
                   "got " + std::to_string(transport.max_samples) + " and " + std::to_string(transport.samples) +
                       ", with which a pixel begins; its next step is twice as many. 0 means no more than those");
  if (transport.path_noise_m > 0 && transport.max_samples == 0)
    complaints.add(transport, &transport.path_noise_m, "path_noise can change nothing",
                   "pixels go on until they reach it where max_samples is at least twice samples");
}

void cameras_move_one_way(const CameraChoice& camera, Complaints& complaints) {
  using base::cross, base::dot, base::operator-, base::operator+;
  const std::vector<CameraKeyframe>& keys = camera.keyframes;
  if (!follow_each_other(keys, complaints)) return;
  const Pose fresh;
  if (camera.pose.position != fresh.position || camera.pose.look_at != fresh.look_at || camera.pose.up != fresh.up ||
      camera.pose.quaternion)
    complaints.add(camera, &camera.pose, "the camera has keyframes and a pose", "its keyframes say where it stands; take the pose out");
  // View f and up u change evenly; f × u, to the image's left, never vanishes where its three Bernstein coefficients are ahead of the first.
  for (std::size_t i = 1; i < keys.size(); ++i) {
    const Pose &a = keys[i - 1].pose, &b = keys[i].pose;
    if (a.quaternion || b.quaternion) continue;  // it turns the shortest way
    const Vec3 from = a.look_at - a.position, to = b.look_at - b.position, left = cross(from, a.up);
    const Vec3 last = cross(to, b.up);
    const double halfway = dot(cross(from, b.up) + cross(to, a.up), left);
    if (dot(left, left) == 0 || dot(last, last) == 0) continue;  // the pose itself is no good, and is told
    if (!(dot(from, to) > 0 && halfway > 0 && dot(last, left) > 0))
      complaints.add(keys[i], &keys[i].pose, "the camera turns too far between two keyframes",
                     "expected less than a quarter turn; put another keyframe between them");
  }
}

namespace {

void objects_have_a_material(const Scene& scene, Complaints& complaints) {
  for (const Object& object : scene.objects)
    if (static_cast<std::size_t>(object.material) >= scene.materials.size())
      complaints.add(object, &object.material, "the object names a material that the scene has not",
                     "got index " + std::to_string(object.material) + " of " + std::to_string(scene.materials.size()) + " materials");
}

void classes_are_listed(const Scene& scene, Complaints& complaints) {
  if (scene.classes.empty()) return;
  for (const Object& object : scene.objects)
    if (!object.class_name.empty() && std::find(scene.classes.begin(), scene.classes.end(), object.class_name) == scene.classes.end())
      complaints.add(object, &object.class_name, "the object is of a class that the scene's classes have not",
                     "got " + object.class_name + ", expected " + base::listed(scene.classes, "or") + "; or add it there");
}

}  // namespace

void objects_fit_their_scene(const Scene& scene, Complaints& complaints) {
  objects_have_a_material(scene, complaints);
  classes_are_listed(scene, complaints);
}

void light_is_the_suns(Ambient& ambient, const Given& given) {
  if (!given(&ambient.spectrum)) ambient.spectrum = Ambient::Spectrum::sun_am15;
}

}  // namespace tofray::model
